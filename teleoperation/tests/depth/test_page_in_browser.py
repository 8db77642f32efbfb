"""The page in a real browser: a whole session, two tabs, a program that ends, the test of goggles."""

from __future__ import annotations

import base64
import json

import numpy as np
import pytest
from depth_study.page.scene import view_of
from depth_study.page.viewing import Viewing
from headless_browser import Browser, find_browser, needs_pages
from test_page_server import RunningStudy

pytestmark = needs_pages

CHOOSE = "document.querySelector('input[name={0}][value=\"{1}\"]').click()"


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    running = Browser(find_browser(), tmp_path_factory.mktemp("profile"))
    yield running
    running.close()


@pytest.fixture
def study(tmp_path):
    running = RunningStudy(tmp_path / "study.db")
    yield running
    running.stop()


def begin(tab, observer):
    tab.until("!document.getElementById('welcome').hidden")
    tab.value(f"document.getElementById('observer').value = {observer}")
    tab.value("document.querySelector('#begin button').click()")
    tab.until("!document.getElementById('show').hidden")


def give(tab, absolute, relative=None):
    tab.value(CHOOSE.format("absolute", absolute))
    if relative is not None:
        tab.value(CHOOSE.format("relative", relative))
    tab.value("document.getElementById('next').click()")


def test_an_observer_answers_everything(browser, study):
    tab = browser.tab(study.server.address)
    begin(tab, 3)
    for position in range(20):
        tab.until(f"document.getElementById('progress').textContent === 'Picture {position + 1} of 20'")
        assert tab.value("document.getElementById('next').disabled")
        assert tab.value("document.getElementById('relative').hidden") == (position == 0)
        assert int(tab.value("document.getElementById('picture').dataset.frames")) > 0
        give(tab, 1 + position % 9, None if position == 0 else 9 - position % 9)
    tab.until("!document.getElementById('end').hidden")
    stored = study.database.answers_of(3)
    assert [a.absolute for a in stored] == [1 + k % 9 for k in range(20)]
    assert [a.relative for a in stored] == [None, *(9 - k % 9 for k in range(1, 20))]
    assert all(0 < a.seconds < 60 for a in stored)


def test_a_second_tab_takes_the_session_over_and_the_first_says_so(browser, study):
    first = browser.tab(study.server.address)
    begin(first, 1)
    give(first, 5)
    first.until("document.getElementById('progress').textContent.startsWith('Picture 2')")
    second = browser.tab(study.server.address + "#1")
    second.until("document.getElementById('progress').textContent.startsWith('Picture 2')")
    give(first, 4, 4)
    first.until("document.getElementById('trouble').textContent.includes('goes on in another tab')")
    give(second, 6, 6)
    second.until("document.getElementById('progress').textContent.startsWith('Picture 3')")
    assert [a.absolute for a in study.database.answers_of(1)] == [5, 6]


def test_an_answer_waits_until_the_program_is_there_again(browser, tmp_path):
    study = RunningStudy(tmp_path / "study.db")
    tab = browser.tab(study.server.address)
    begin(tab, 1)
    port = study.server.server_port
    study.stop()
    give(tab, 7)
    tab.until("document.getElementById('trouble').textContent.includes('does not answer')")
    again = RunningStudy(tmp_path / "study.db", port)
    try:
        tab.value("document.getElementById('next').click()")
        tab.until("document.getElementById('progress').textContent.startsWith('Picture 2')")
        assert [a.absolute for a in again.database.answers_of(1)] == [7]
        assert tab.value("document.getElementById('trouble').hidden")
    finally:
        again.stop()


def test_answers_are_deleted_from_the_page(browser, study):
    tab = browser.tab(study.server.address)
    begin(tab, 1)
    give(tab, 7)
    tab.until("document.getElementById('progress').textContent.startsWith('Picture 2')")
    tab.go("about:blank")
    tab.go(study.server.address)
    tab.until("!document.getElementById('welcome').hidden")
    assert tab.value("document.getElementById('unfinished').textContent") == "Not finished yet: observer 1."
    tab.value("document.getElementById('deleted').value = 1; document.getElementById('sure').checked = true")
    tab.value("document.querySelector('#delete button').click()")
    tab.until("document.getElementById('done').textContent.includes('are deleted')")
    assert study.database.observers() == {}


@pytest.mark.parametrize("motion", ["moving", "still"])
def test_a_moving_scene_moves_and_a_still_one_does_not(browser, study, motion):
    tab = browser.tab(study.server.address)
    begin(tab, 1)
    view = view_of({"technique": "plain", "camera": "central", "scene": motion}, Viewing())
    tab.value(f"stop(); stop = showView(viewer, {json.dumps(view)}, scene)")
    turn = "viewer.world.machine.places[0].turn.y"
    tab.value("new Promise(done => setTimeout(done, 300))")
    first, frames = tab.value(turn), tab.value("viewer.frames")
    if motion == "moving":
        tab.until(f"viewer.frames > {frames} + 3 && Math.abs({turn} - {first}) > 1e-4")
    else:
        tab.value("new Promise(done => setTimeout(done, 300))")
        assert (tab.value(turn), tab.value("viewer.frames")) == (0, frames)


@pytest.mark.parametrize("camera", ["central", "parallel", "convergent"])
def test_a_constellation_is_shown_with_its_camera_its_technique_and_the_study_s_lengths(browser, study, camera):
    tab = browser.tab(study.server.address)
    begin(tab, 1)
    view = view_of({"technique": "anaglyph", "camera": camera, "scene": "still"}, Viewing())
    tab.value(f"stop(); stop = showView(viewer, {json.dumps(view)}, scene)")
    assert tab.value("[viewer.view.camera, viewer.view.output]") == [camera, "anaglyph"]
    assert list(tab.value("viewer.view.lengths").values()) == [0.065, 2, 0.52, 0.6]
    apart = tab.value("viewer.paint(); viewer.eyes.right.position.x - viewer.eyes.left.position.x")
    assert apart == pytest.approx(0 if camera == "central" else 0.065)


@pytest.mark.parametrize(
    ("sign", "told", "swapped"),
    [
        (1, "left and right are as they should be", False),
        (-1, "Left and right are swapped", True),
        (0, "not seen", False),
    ],
)
def test_the_goggles_test_recognises_crossed_eyes(browser, study, sign, told, swapped):
    tab = browser.tab(study.server.address)
    tab.until("!document.getElementById('welcome').hidden")
    tab.value("sessionStorage.clear()")
    assert tab.value("Array.from(document.querySelectorAll('#technique option'), o => o.value)") == [
        "anaglyph",
        "shutter",
        "polarised",
    ]
    tab.value("document.querySelector('#goggles-test button').click()")
    tab.until("!document.getElementById('test').hidden")
    assert sorted(tab.value("trial.truths")) == [-1, -1, -1, 1, 1, 1]
    for _ in range(6):
        truth = tab.value("trial.truths[trial.answers.length]")
        tab.value(f"document.querySelector('#choices [data-answer=\"{sign * truth}\"]').click()")
    assert told in tab.value("document.getElementById('verdict').textContent")
    assert tab.value("swapped('anaglyph')") == swapped
    tab.value("sessionStorage.clear()")


def test_what_is_nearer_among_the_dots_is_farther_left_for_the_right_eye(browser, study):
    """The square's dots are the same for both eyes, shifted by the disparity; all around there is none."""
    for disparity_dots in (-2, 2):
        pictures = drawn_dots(browser, study, disparity_dots)
        left, right = (pictures[eye][4::8, 4::8] for eye in ("left", "right"))
        rows, columns = left.shape
        inner = np.s_[rows // 4 + 1 : rows // 4 + rows // 2 - 1, columns // 2 - rows // 8 : columns // 2 + rows // 8]
        shifted = np.roll(right, -disparity_dots, axis=1)
        np.testing.assert_array_equal(left[inner], shifted[inner])
        np.testing.assert_array_equal(left[: rows // 4 - 1], right[: rows // 4 - 1])
        assert (left[inner] != right[inner]).mean() > 0.3


@pytest.mark.full
def test_dots_are_shown_by_the_technique(browser, study):
    """Rows in turn: those of either eye are that eye's dots."""
    tab = browser.tab(study.server.address)
    tab.until("!document.getElementById('welcome').hidden")
    tab.value("document.getElementById('technique').value = 'polarised'")
    tab.value("document.querySelector('#goggles-test button').click()")
    tab.until("!document.getElementById('test').hidden")
    rows = tab.value(
        """(() => {
          const gl = dots.renderer.getContext(), {width, height} = dots.canvas;
          const pixels = new Uint8Array(4 * width * height);
          gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          const row = y => Array.from({length: width}, (_, x) => pixels[4 * ((height - 1 - y) * width + x)]);
          return [row(270), row(271), row(2), row(3)];
        })()"""
    )
    assert {value for row in rows for value in row} <= {39, 40, 41, 214, 215, 216}
    assert rows[0] != rows[1]  # the square's dots are shifted
    assert rows[2] == rows[3]  # outside it both eyes see the same


def drawn_dots(browser, study, disparity_dots):
    tab = browser.tab(study.server.address)
    tab.until("!document.getElementById('welcome').hidden")
    values = tab.value(
        f"""(() => {{
          const canvas = document.createElement('canvas'), found = {{}};
          canvas.width = 640; canvas.height = 320;
          const context = canvas.getContext('2d'), draw = dotPictures(640, 320, {disparity_dots}, 8);
          for (const eye of ['left', 'right']) {{
            draw(context, eye);
            const pixels = context.getImageData(0, 0, 640, 320).data;
            found[eye] = btoa(Array.from(pixels, value => String.fromCharCode(value)).join(''));
          }}
          return found;
        }})()"""
    )
    return {
        eye: np.frombuffer(base64.b64decode(text), dtype=np.uint8).astype(float).reshape(320, 640, 4)[..., 0]
        for eye, text in values.items()
    }
