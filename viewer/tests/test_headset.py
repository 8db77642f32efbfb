"""The view in a headset, on an emulated one (IWER) in a real browser."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from headless_browser import Browser, Tab, find_browser, needs_pages
from javascript import VIEWER
from scene_viewer.bundle import bundled

EMULATOR = VIEWER / "node_modules" / "iwer" / "build" / "iwer.min.js"
pytestmark = [
    needs_pages,
    pytest.mark.skipif(not EMULATOR.is_file(), reason="The emulated headset is not installed; see scripts/setup."),
]
PAGE = """<!doctype html>
<canvas id="canvas" style="width: 640px; height: 360px"></canvas><div id="panel"></div>
<script src="iwer.js"></script>
<script>
  window.device = new IWER.XRDevice(IWER.metaQuest3, {ipd: 0.064});
  device.installRuntime({forceInstall: true});
</script>
<script src="viewer.js"></script>
<script>
  const data = {up: [0, 0, 1], center: [0, 0, 0.5], radius: 1, floor: 0, follow: false, largestForce: 1, bodies: []};
  window.viewer = new contactViewer.Viewer(document.getElementById("canvas"), data);
  contactViewer.makeViewControls(document.getElementById("panel"), viewer, true);
</script>"""
EYES = "viewer.renderer.xr.getCamera().cameras.map(camera => camera.matrixWorld.elements)"


@pytest.fixture
def tab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tab]:
    folder = tmp_path_factory.mktemp("headset")
    (folder / "page.html").write_text(PAGE, encoding="utf-8")
    (folder / "viewer.js").write_text(bundled("viewer.js"), encoding="utf-8")
    (folder / "iwer.js").write_bytes(EMULATOR.read_bytes())
    browser = Browser(str(find_browser()), folder / "profile")
    made = browser.tab("about:blank")
    made.note_errors()
    made.go((folder / "page.html").as_uri())
    yield made
    assert made.errors() == []
    browser.close()


def test_both_eyes_stand_upright_where_the_camera_was_and_go_with_the_head(tab: Tab) -> None:
    tab.until("document.getElementById('headset') !== null")
    tab.value("document.getElementById('headset').click()")
    tab.until("viewer.headset.session && viewer.renderer.xr.getCamera().cameras.length === 2")
    assert tab.value("document.getElementById('headset').textContent") == "Leave headset"
    tab.value("window.drawn = viewer.frames")
    tab.until("viewer.frames > drawn + 2")
    camera = np.array(tab.value("viewer.rig.position.toArray()"))
    left, right = np.reshape(tab.value(EYES), (2, 4, 4))
    assert (left[3, :3] + right[3, :3]) / 2 == pytest.approx(camera, abs=1e-4)
    assert np.linalg.norm(right[3, :3] - left[3, :3]) == pytest.approx(0.064, abs=1e-4)
    assert left[1, :3] == pytest.approx([0, 0, 1], abs=1e-4)  # up is up
    towards = np.array([0, 0, 0.5]) - camera
    assert -left[2, :2] == pytest.approx(towards[:2] / np.linalg.norm(towards[:2]), abs=1e-3)
    tab.value("device.position.y += 0.3; window.drawn = viewer.frames")
    tab.until("viewer.frames > drawn + 2")
    assert np.reshape(tab.value(EYES), (2, 4, 4))[0, 3, :3] - left[3, :3] == pytest.approx([0, 0, 0.3], abs=1e-4)
    tab.value("document.getElementById('headset').click()")
    tab.until("!viewer.headset.session")
    assert tab.value("document.getElementById('headset').textContent") == "View in headset"
    tab.value("window.drawn = viewer.frames; viewer.draw()")
    tab.until("viewer.frames > drawn")  # the canvas is drawn again


def test_without_a_headset_none_is_offered(tab: Tab) -> None:
    tab.value(
        "navigator.xr.isSessionSupported = async () => false;"
        "contactViewer.makeViewControls(document.getElementById('panel'), viewer, true)"
    )
    tab.value("new Promise(done => setTimeout(done, 200))")
    assert tab.value("document.getElementById('headset') === null")
