"""The report as a reader uses it, in a real browser."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from fmu_regression.results.result import read_csv
from headless_browser import Browser, Tab, find_browser, needs_pages

pytestmark = needs_pages
ZOOMED = "Array.from(document.querySelectorAll('.plot'), plot => plot.classList.contains('zoomed'))"
DATA = "JSON.parse(document.getElementById('data').textContent)"


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    running = Browser(str(find_browser()), tmp_path_factory.mktemp("profile"))
    yield running
    running.close()


@pytest.fixture
def page(browser: Browser, folder: Path) -> Tab:
    tab = browser.tab("about:blank")
    tab.note_errors()
    tab.go((folder / "report.html").as_uri())
    tab.until("document.querySelector('#canvas').dataset.frames > 0")
    return tab


def drag(tab: Tab, start: float, stop: float) -> None:
    """A drag across the first plot, from and to shares of its width."""
    tab.value("document.querySelector('.u-over').scrollIntoView({block: 'center', behavior: 'instant'})")
    box = json.loads(tab.value("JSON.stringify(document.querySelector('.u-over').getBoundingClientRect())"))
    y = box["y"] + box["height"] / 2
    kinds = [("mouseMoved", start), ("mousePressed", start), ("mouseMoved", (start + stop) / 2), ("mouseMoved", stop)]
    for kind, share in [*kinds, ("mouseReleased", stop)]:
        x = box["x"] + share * box["width"]
        tab.command("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1, clickCount=1)


def clock(tab: Tab) -> float:
    return float(tab.value("document.getElementById('clock').textContent.split(' ')[2]"))


def test_everything_is_drawn_without_an_error_and_without_a_network(page: Tab) -> None:
    assert page.errors() == []
    assert page.value("performance.getEntriesByType('resource').length") == 0
    plots = page.value(f"{DATA}.plots.length")
    assert page.value("document.querySelectorAll('.plot .uplot canvas').length") == plots > 3
    marks = page.value(
        "Array.from(document.querySelectorAll('.uplot canvas'), canvas => canvas.getContext('2d')"
        ".getImageData(0, 0, canvas.width, canvas.height).data.filter((value, k) => k % 4 === 3 && value).length)"
    )
    assert min(marks) > 1000
    names = page.value("Array.from(document.querySelectorAll('.plot [role=img]'), e => e.getAttribute('aria-label'))")
    assert all(names)


def test_poses_of_the_csv_become_those_of_the_bodies(page: Tab, folder: Path) -> None:
    result = read_csv(folder / "result.csv")
    page.value(
        f"window.seen = {DATA}.animation;"
        "window.viewer = new contactViewer.Viewer(document.createElement('canvas'), seen);"
        "window.playback = new Playback(viewer, seen); true"
    )
    labels = page.value("seen.bodies.map(body => body.label)")
    rows = np.flatnonzero(np.diff(result.time, append=np.inf) > 0)[[0, 100, 700]]
    for row in rows:
        matrix = page.value(
            f"playback.seek({float(result.time[row])!r}); viewer.paint(); Array.from("
            f"viewer.world.machine.skeleton.boneMatrices.slice(16 * {labels.index('hammer')}).slice(0, 16))"
        )
        origin = page.value("viewer.world.machine.object.position.toArray()")
        shown = np.array(matrix).reshape(4, 4).T
        turn = result.vector([f"hammer.frame_a.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3)])[row]
        position = result.vector([f"hammer.frame_a.r_0[{i}]" for i in (1, 2, 3)])[row]
        assert pytest.approx(turn.reshape(3, 3), abs=1e-6) == shown[:3, :3].T
        assert shown[:3, 3] + origin == pytest.approx(position, abs=1e-6)
    pose = page.value("poseBetween(new Float32Array([0,0,0, 0,0,0,1, 2,4,6, 0,0,1,0]), 0, 0.5)")
    assert pose == pytest.approx([1, 2, 3, 0, 0, 0.5**0.5, 0.5**0.5])


def test_arrows_point_along_forces_and_grow_with_them(page: Tab) -> None:
    forces = [[1, 2, 3, 0, 0, 100], [0, 0, 0, -25, 0, 0], [0, 0, 0, 1e-9, 0, 0]]
    length = page.value(
        f"window.seen = {DATA}.animation; seen.largestForce = 100;"
        "window.viewer = new contactViewer.Viewer(document.createElement('canvas'), seen);"
        f"viewer.world.forces.show({forces}) * seen.radius"
    )
    radius = page.value("seen.radius")
    assert length / radius == pytest.approx(2)  # the third is too small to be seen
    matrices = page.value("Array.from(viewer.world.forces.meshes[1].instanceMatrix.array.subarray(0, 32))")
    for matrix, force in zip(np.reshape(matrices, (2, 4, 4)), forces[:2], strict=True):
        along, size = matrix[1, :3], np.linalg.norm(force[3:])
        assert matrix[3, :3] == pytest.approx(force[:3])
        assert along / np.linalg.norm(along) == pytest.approx(np.array(force[3:]) / size, abs=1e-6)
        assert np.linalg.norm(along) == pytest.approx(radius * (0.12 + 0.55 * (size / 100) ** 0.5), rel=1e-6)


def test_dragging_across_a_plot_zooms_all_plots_over_time_and_show_all_takes_it_back(page: Tab) -> None:
    assert not any(page.value(ZOOMED))
    drag(page, 0.25, 0.75)
    page.until(f"{ZOOMED}.every(Boolean)")
    page.value("document.querySelector('.plot .head button').click()")
    assert not any(page.value(ZOOMED))


def test_a_click_on_a_plot_and_on_a_row_shows_that_moment(page: Tab) -> None:
    duration = page.value("document.getElementById('scrub').max")
    drag(page, 0.4, 0.4)
    page.until("document.getElementById('clock').textContent !== 't = 0.000 s'")
    assert clock(page) == pytest.approx(0.4 * float(duration), rel=0.01)
    lines = page.value("Array.from(document.querySelectorAll('.plot .mark'), mark => parseFloat(mark.style.left))")
    assert lines == pytest.approx([100 * clock(page) / float(duration)] * len(lines), abs=0.1)
    page.value("document.querySelector('tr[data-time]').click()")
    assert clock(page) == pytest.approx(
        float(page.value("document.querySelector('tr[data-time]').dataset.time")), abs=1e-3
    )


def test_values_at_the_pointer_are_those_of_the_result(page: Tab, folder: Path) -> None:
    drag(page, 0.3, 0.3)
    words = page.value("document.querySelector('.bubble').innerText").split()
    assert words[0] == "time"
    series = page.value(f"{DATA}.plots[0].series.length")
    assert page.value("document.querySelectorAll('.bubble:not([hidden]) div').length") == series
    result = read_csv(folder / "result.csv")
    nearest = np.abs(result.time - float(words[1])).argmin()
    assert float(words[-1]) == pytest.approx(result["contacts.normalForce[1]"][nearest], rel=1e-4, abs=1e-6)


def test_curves_switch_off_and_on_and_one_can_be_alone(page: Tab) -> None:
    pressed = "Array.from(legend.querySelectorAll('button'), button => button.getAttribute('aria-pressed') === 'true')"
    page.value("window.legend = [...document.querySelectorAll('.legend')].find(l => l.children.length > 2); true")
    count = page.value("legend.children.length")
    page.value("legend.children[1].click()")
    assert page.value(pressed) == [k != 1 for k in range(count)]
    page.value("legend.children[1].click()")
    assert page.value(pressed) == [True] * count
    page.value("legend.children[1].ondblclick()")
    assert page.value(pressed) == [k == 1 for k in range(count)]


def test_it_plays_and_keys_step_through_frames(page: Tab) -> None:
    page.value("document.getElementById('speed').value = '0.25'; document.getElementById('play').click()")
    page.until("parseFloat(document.getElementById('clock').textContent.split(' ')[2]) > 0.1")
    press = "document.getElementById('canvas').dispatchEvent(new KeyboardEvent('keydown', {key: '%s'}))"
    page.value(press % "Home")
    page.value(press % " ")
    times = page.value(f"Array.from(contactViewer.decodeArray({DATA}.animation.time, Float64Array))")
    page.value(press % "Home")
    assert clock(page) == pytest.approx(times[0], abs=1e-3)
    page.value(press % "ArrowRight")
    page.value(press % "ArrowRight")
    assert clock(page) == pytest.approx(times[2], abs=1e-3)
    page.value(press % "End")
    assert clock(page) == pytest.approx(times[-1], abs=1e-3)
    page.value(press % "ArrowLeft")
    assert clock(page) == pytest.approx(times[-2], abs=1e-3)


def test_on_paper_plots_have_light_colours(browser: Browser, folder: Path) -> None:
    tab = browser.tab("about:blank")
    tab.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    tab.go((folder / "report.html").as_uri())
    ink = "getComputedStyle(document.querySelector('.plot')).getPropertyValue('--ink')"
    assert tab.value(ink) == "#e6eaf0"
    tab.value("dispatchEvent(new Event('beforeprint'))")
    assert tab.value(ink) == "#000"
    tab.value("dispatchEvent(new Event('afterprint'))")
    assert tab.value(ink) == "#e6eaf0"


@pytest.mark.full
def test_the_picture_alone_shows_the_scene_at_its_time(browser: Browser, folder: Path) -> None:
    shots = []
    for time in (0.0, 0.2):
        tab = browser.tab("about:blank")
        tab.command("Emulation.setDeviceMetricsOverride", width=320, height=200, deviceScaleFactor=1, mobile=False)
        tab.go(f"{(folder / 'report.html').as_uri()}#t={time}&picture")
        tab.until("document.querySelector('#canvas').dataset.frames > 0")
        assert tab.value("document.body.scrollHeight <= 200")
        shots.append(tab.picture())
    first, second = shots
    assert (int.from_bytes(first[16:20], "big"), int.from_bytes(first[20:24], "big")) == (320, 200)
    assert len(first) > 8000  # an empty stage compresses to less
    assert first != second
