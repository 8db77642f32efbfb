"""The page in a real browser: a whole session, two tabs, a program that ends; and what is drawn against geometry."""

from __future__ import annotations

import base64
import json

import numpy as np
import pytest
from depth_study.page.scene import view_of
from headless_browser import Browser, find_browser
from stereo_views.anaglyph import anaglyph_matrices
from stereo_views.cameras import CameraModel
from stereo_views.disparity import disparity
from stereo_views.viewing import Viewing
from test_page_server import RunningStudy

pytestmark = pytest.mark.skipif(find_browser() is None, reason="no Chromium is installed (Debian package chromium)")

CHOOSE = "document.querySelector('input[name={0}][value=\"{1}\"]').click()"
WIDTH, HEIGHT = 960, 540
VIEWING = Viewing(pixels=WIDTH)


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


def drawn(browser, study, view, boxes, expression):
    """Pixels that a view draws of boxes alone; shape (height, width, 3)."""
    tab = browser.tab(study.server.address)
    tab.until("!document.getElementById('welcome').hidden")
    scene = {"boxes": boxes, "floor": {"height": -0.3, "tile": 1, "near": 0, "far": 0, "half": 0}}
    scene["swing"] = {"angle": 0.3, "period": 4, "depth": -2}
    values = tab.value(
        f"""(() => {{
          const canvas = document.createElement('canvas');
          canvas.width = {WIDTH}; canvas.height = {HEIGHT};
          const context = canvas.getContext('2d'), view = {json.dumps(view)}, scene = {json.dumps(scene)};
          {expression};
          const pixels = context.getImageData(0, 0, {WIDTH}, {HEIGHT}).data;
          return btoa(Array.from(pixels, value => String.fromCharCode(value)).join(''));
        }})()"""
    )
    return np.frombuffer(base64.b64decode(values), dtype=np.uint8).astype(float).reshape(HEIGHT, WIDTH, 4)[..., :3]


def middle(picture):
    """Mean place of what is not background, in pixels to the right and down."""
    weight = np.abs(picture - picture[0, 0]).sum(-1)
    rows, columns = np.indices(weight.shape)
    return np.array([(weight * columns).sum(), (weight * rows).sum()]) / weight.sum()


@pytest.mark.parametrize("camera", ["parallel", "convergent"])
@pytest.mark.parametrize("depth", [1.2, 2.0, 4.0])
def test_a_point_of_known_depth_has_the_pixel_disparity_that_geometry_says(browser, study, camera, depth):
    view = view_of({"technique": "shutter", "camera": camera, "scene": "still"}, VIEWING)
    place = [0.1, 0.05, -depth]
    box = [{"center": place, "size": [0.02 * depth, 0.02 * depth, 1e-6], "color": [255, 255, 255]}]
    left, right = (
        middle(drawn(browser, study, view, box, f"drawEye(context, view.{eye}, scene, 0)")) for eye in ("left", "right")
    )
    wanted = disparity(np.array(place), CameraModel(camera), VIEWING)
    assert right - left == pytest.approx([wanted[0], -wanted[1]], abs=0.1)


def test_outputs_are_made_of_the_left_and_the_right_eye_s_pictures(browser, study):
    box = [{"center": [0.1, 0.0, -1.2], "size": [0.2, 0.2, 0.2], "color": [240, 200, 120]}]
    levels = {"camera": "parallel", "scene": "still"}

    def shown(technique):
        view = view_of({"technique": technique, **levels}, VIEWING)
        return drawn(browser, study, view, box, "showView(canvas, view, scene)")

    view = view_of({"technique": "shutter", **levels}, VIEWING)
    left, right = (
        drawn(browser, study, view, box, f"drawEye(context, view.{eye}, scene, 0)") for eye in ("left", "right")
    )
    assert np.abs(left - right).max() > 50
    rows = shown("polarised")
    np.testing.assert_array_equal(rows[0::2], left[0::2])
    np.testing.assert_array_equal(rows[1::2], right[1::2])
    np.testing.assert_array_equal(shown("shutter"), left)
    for technique, first, last in (
        ("side-by-side", np.s_[:, : WIDTH // 2], np.s_[:, WIDTH // 2 :]),
        ("top-and-bottom", np.s_[: HEIGHT // 2], np.s_[HEIGHT // 2 :]),
    ):
        both, shape = (
            shown(technique),
            (1 if technique == "top-and-bottom" else 2, 2 if technique == "top-and-bottom" else 1),
        )
        for part, whole in ((both[first], left), (both[last], right)):
            wanted = middle(whole) / np.array([shape[0], shape[1]])
            assert middle(part) == pytest.approx(wanted, abs=0.5)
    linear = [np.where(p <= 0.04045 * 255, p / 255 / 12.92, ((p / 255 + 0.055) / 1.055) ** 2.4) for p in (left, right)]
    mixed = anaglyph_matrices().displayed(*linear)
    wanted = 255 * np.where(mixed <= 0.0031308, 12.92 * mixed, 1.055 * mixed ** (1 / 2.4) - 0.055)
    assert np.abs(shown("anaglyph") - wanted).max() <= 1.5


def test_a_moving_scene_moves_and_a_still_one_does_not(browser, study):
    tab = browser.tab(study.server.address)
    tab.until("!document.getElementById('welcome').hidden")
    for scene, least, most in (("moving", 5, 10**6), ("still", 1, 1)):
        view = view_of({"technique": "plain", "camera": "central", "scene": scene}, VIEWING)
        tab.value(
            "window.shownOn = document.createElement('canvas'); document.body.append(window.shownOn);"
            f"window.stopped = showView(window.shownOn, {json.dumps(view)}, scene)"
        )
        tab.value("new Promise(done => setTimeout(done, 500))")
        assert least <= int(tab.value("window.shownOn.dataset.frames")) <= most
        tab.value("window.stopped()")


def test_rows_for_polarised_displays_are_counted_on_the_screen(browser, study):
    tab = browser.tab(study.server.address)
    tab.until("!document.getElementById('welcome').hidden")
    tab.value(
        "window.lone = document.createElement('canvas'); document.body.append(window.lone);"
        "window.lone.style.position = 'fixed'; window.above = () => window.screenY + outerHeight - innerHeight"
    )
    for top in (10, 11):
        tab.value(f"window.lone.style.top = '{top}px'")
        even = (int(tab.value("window.above()")) + top) % 2 == 0
        assert tab.value("firstRightRow(window.lone)") == (1 if even else 0)


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
