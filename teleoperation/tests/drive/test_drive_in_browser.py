"""The page in a real browser, with a real simulation behind it."""

from __future__ import annotations

import json
import re
import threading
from dataclasses import replace

import pytest
from fmu_regression.scene.scene_file import load_scene
from headless_browser import Browser, find_browser, needs_pages
from interactive_drive.server.drive_server import DriveServer
from interactive_drive.server.listening import Listening

pytestmark = needs_pages

TRIANGLES = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]
MESH = {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "triangles": TRIANGLES, "color": [1, 0.5, 0]}


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    running = Browser(find_browser(), tmp_path_factory.mktemp("profile"))
    yield running
    running.close()


@pytest.fixture
def server(plan, session, tmp_path):
    body = {"name": "block", "fixed": True, "position": [0, 0, 0], "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}
    file = tmp_path / "scene.json"
    bodies = [{**body, "meshes": [MESH]}]
    file.write_text(json.dumps({"format": 1, "name": "Block", "gravity": [0, 0, -9.81], "bodies": bodies}))
    session = replace(session, scene=load_scene(file), scene_file=file)
    with Listening().bind(0) as bound:
        server = DriveServer(plan, session, bound, lambda _address: None)
        thread = threading.Thread(target=server.serve, daemon=True)
        thread.start()
        yield server
        server.end()
        thread.join(10)
        assert not thread.is_alive()


def state(text):
    return f"document.getElementById('state').textContent.includes('{text}')"


def click(tab, identity):
    tab.value(f"document.getElementById('{identity}').click()")


def slide(tab, value):
    tab.value(
        f"(() => {{ const i = document.getElementById('control-0'); i.value = {value}; i.oninput(); return true; }})()"
    )


def clock(tab):
    return float(tab.value("document.getElementById('clock').textContent.split(' ')[2]"))


CURVE = """(() => {
  const [canvas, ...others] = document.querySelectorAll('#live .uplot canvas');
  if (!canvas || others.length) return 0;
  const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let k = 0; k < data.length; k += 4) if (data[k + 3] && data[k + 2] > data[k] + 80) count += 1;
  return count;
})()"""


def test_a_drive_from_the_first_step_to_a_failure_and_back(browser, server, session):
    tab = browser.tab(server.address)
    tab.until(state("paused · you steer"))
    tab.until("document.getElementById('key').textContent === 'block'")  # the machine is drawn
    assert tab.value("location.search") == ""  # the token does not stay in the address
    click(tab, "step")
    tab.until("document.getElementById('clock').textContent === 't = 0.010 s'")
    slide(tab, 40)
    click(tab, "record")
    click(tab, "run")
    tab.until(state("running"))
    tab.until("parseFloat(document.getElementById('clock').textContent.split(' ')[2]) > 1.1")
    assert "input to picture" in tab.value("document.getElementById('figures').textContent")
    assert tab.value(CURVE) > 100
    slide(tab, 95)
    tab.until(state("stopped with an error"))
    assert "the rope is torn by 95 N" in tab.value("document.getElementById('alarm-text').textContent")
    failed = clock(tab)
    back = "document.querySelector('#alarm-actions button')"
    good = re.fullmatch(r"Go back to the last good state, t = (\d+)\.00 s", tab.value(f"{back}.textContent"))[1]
    assert failed - 2 < int(good) <= failed
    tab.value(f"{back}.click()")
    tab.until(state("paused"))
    tab.until(f"document.getElementById('clock').textContent === 't = {good}.000 s'")
    assert failed > 1.1
    tab.until("document.getElementById('remarks').textContent.includes('recorded: ')")
    assert (session.output / "record-1" / "report.html").is_file()


def test_a_record_is_replayed_and_the_machine_waits(browser, server):
    tab = browser.tab(server.address)
    tab.until(state("paused · you steer"))
    assert tab.value("document.getElementById('replay').hidden")
    slide(tab, 30)
    click(tab, "record")
    tab.until("document.getElementById('record').textContent === 'End the record'")
    for k in range(1, 6):
        click(tab, "step")
        tab.until(f"document.getElementById('clock').textContent === 't = 0.0{k}0 s'")
    click(tab, "record")
    tab.until("document.getElementById('records').value === 'record-1'")
    click(tab, "step")
    slide(tab, 60)
    click(tab, "replay")
    tab.until(state("replay of record-1, paused · you steer"))
    tab.until("document.getElementById('clock').textContent === 't = 0.000 s'")
    assert tab.value("['control-0', 'record', 'save'].every(id => document.getElementById(id).disabled)")
    click(tab, "run")
    tab.until("document.getElementById('remarks').textContent.includes('the record ends here')")
    tab.until("document.getElementById('clock').textContent === 't = 0.050 s'")
    tab.until("document.getElementById('control-0').value === '30'")
    click(tab, "replay")
    tab.until(state("paused · you steer"))
    tab.until("document.getElementById('clock').textContent === 't = 0.060 s'")
    tab.until("document.getElementById('control-0').value === '60'")
    assert not tab.value("document.getElementById('control-0').disabled")
    click(tab, "step")
    tab.until("document.getElementById('clock').textContent === 't = 0.070 s'")


def test_keys_push_and_a_second_page_watches(browser, server):
    tab = browser.tab(server.address)
    tab.until(state("paused · you steer"))
    second = browser.tab(server.access.address)
    second.until(state("you watch, 2 operators"))
    assert second.value("document.getElementById('run').disabled")
    assert second.value("document.getElementById('control-0').disabled")
    tab.value("window.dispatchEvent(new KeyboardEvent('keydown', {code: 'ArrowUp'}))")
    assert tab.value("document.getElementById('control-0').value") == "100"
    tab.value("window.dispatchEvent(new KeyboardEvent('keyup', {code: 'ArrowUp'}))")
    assert tab.value("document.getElementById('control-0').value") == "0"
    tab.value("window.dispatchEvent(new KeyboardEvent('keydown', {code: 'ArrowDown'}))")
    tab.value("window.dispatchEvent(new Event('blur'))")
    assert tab.value("document.getElementById('control-0').value") == "0"
    tab.go("about:blank")
    second.until("!document.getElementById('steer').hidden")
    click(second, "steer")
    second.until(state("you steer"))
    click(second, "step")
    second.until("document.getElementById('clock').textContent === 't = 0.010 s'")


COLOURS = """(async () => {
  await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
  const canvas = document.getElementById('canvas'), gl = canvas.getContext('webgl2');
  const data = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  const found = new Map();
  for (let k = 0; k < data.length; k += 4) {
    if (data[k + 3] < 255) continue;
    const colour = `${data[k]},${data[k + 1]},${data[k + 2]}`;
    found.set(colour, (found.get(colour) || 0) + 1);
  }
  return [...found].filter(([, count]) => count > 20);
})()"""


def test_cues_of_depth_can_be_switched_off(browser, server):
    tab = browser.tab(server.address)
    tab.until("document.getElementById('key').textContent === 'block'")

    def switch(**cues):
        for cue, on in cues.items():
            box = f"document.getElementById('cue-{cue}')"
            tab.value(f"{box}.checked = {str(on).lower()}; {box}.dispatchEvent(new Event('change')); true")
        return {tuple(int(part) for part in colour.split(",")): count for colour, count in tab.value(COLOURS)}

    click(tab, "edges")
    click(tab, "floor")
    shaded = switch()
    assert len(shaded) > 1
    flat = switch(shading=False)
    assert set(flat) == {(255, 128, 0)}  # the block's own colour and no other
    hazy = switch(aerial=True)
    assert len(hazy) > 1
    assert all(blue > 0 and red < 255 for red, _, blue in hazy)
    assert switch(aerial=False) == flat
    size = sum(flat.values())
    assert sum(switch(perspective=False).values()) != size
    assert switch(perspective=True) == flat
    assert switch(shading=True) == shaded


@pytest.mark.full
def test_a_gamepad_pushes_and_one_that_is_unplugged_stands_in_the_middle(browser, server):
    tab = browser.tab(server.address)
    tab.until(state("paused · you steer"))
    slider = "Number(document.getElementById('control-0').value)"
    tab.value("window.pad = {connected: true, axes: [0, 0.05]}; navigator.getGamepads = () => [null, pad]; true")
    slide(tab, 40)
    click(tab, "run")
    tab.until("parseFloat(document.getElementById('clock').textContent.split(' ')[2]) > 0.1")
    assert tab.value(slider) == 40  # an axis that rests takes nothing over
    tab.value("pad.axes[1] = -0.55")
    tab.until(f"Math.abs({slider} - 50) < 1e-6")  # half of the way behind the dead zone, down to up
    tab.value("navigator.getGamepads = () => [null, null]; dispatchEvent(new Event('gamepaddisconnected'))")
    assert tab.value(slider) == 0
    click(tab, "run")
    tab.until(state("paused"))
