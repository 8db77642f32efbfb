"""The viewer's pictures in a real browser: disparities to a tenth of a pixel, outputs, cues of depth."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from headless_browser import Browser, Tab, find_browser, needs_pages
from lines_of_sight import FloatArray, Lengths, seen
from scene_viewer.bundle import bundled

pytestmark = needs_pages
WIDTH, HEIGHT = 960, 540
VIEW_ANGLE = 0.6  # rad, of the viewer's central camera, from below to above
BACKGROUND = [0.1, 0.1, 0.1]
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
TRIANGLES = [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3]
PLAIN = {"edges": False, "floor": False, "shading": False, "shadows": False}


@pytest.fixture(scope="module")
def tab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tab]:
    """A page with a canvas and the viewer."""
    folder = tmp_path_factory.mktemp("viewer")
    page = folder / "page.html"
    style = f"position: fixed; left: 0; top: 0; width: {WIDTH}px; height: {HEIGHT}px"
    script = bundled("viewer.js").replace("</script", "<\\/script")
    page.write_text(f'<canvas id="canvas" style="{style}"></canvas><script>{script}</script>', encoding="utf-8")
    browser = Browser(str(find_browser()), folder / "profile")
    made = browser.tab("about:blank")
    made.note_errors()
    made.go(page.as_uri())
    yield made
    assert made.errors() == []
    browser.close()


def box(center: Any, size: Any, color: Any = (1, 1, 1)) -> dict[str, Any]:
    """A mesh for the viewer."""

    def encoded(values: Any, kind: str) -> str:
        return base64.b64encode(np.asarray(values, kind).tobytes()).decode()

    corners = np.array(center) + CORNERS * np.array(size) / 2
    return {"vertices": encoded(corners, "<f4"), "triangles": encoded(TRIANGLES, "<u4"), "color": list(color)}


def make(tab: Tab, meshes: list[dict[str, Any]], **more: Any) -> None:
    """A viewer in the origin that looks along -z."""
    data = {
        "up": [0, 1, 0],
        "center": [0, 0, -2],
        "radius": 1,
        "floor": -0.5,
        "follow": False,
        "largestForce": 1,
        "background": BACKGROUND,
        "stand": {"eye": [0, 0, 0], "target": [0, 0, -2]},
        "bodies": [{"meshes": meshes}],
        **more,
    }
    tab.value(
        "if (window.viewer) viewer.renderer.dispose();"
        f"window.viewer = new contactViewer.Viewer(document.getElementById('canvas'), {json.dumps(data)}); true"
    )


def picture(tab: Tab, shown: dict[str, Any] | None = None, **view: Any) -> FloatArray:
    """Red, green, blue and alpha, 0 to 255, rows from above; shape (height, width, 4) of what is drawn."""
    values, width, height = tab.value(
        f"Object.assign(viewer.shown, {json.dumps(shown or {})}); Object.assign(viewer.view, {json.dumps(view)});"
        """(() => {
          viewer.paint();
          const gl = viewer.renderer.getContext(), {width, height} = viewer.canvas;
          const pixels = new Uint8Array(4 * width * height), parts = [];
          gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          const text = part => String.fromCharCode(...part);
          for (let k = 0; k < pixels.length; k += 32768) parts.push(text(pixels.subarray(k, k + 32768)));
          return [btoa(parts.join("")), width, height];
        })()"""
    )
    return np.frombuffer(base64.b64decode(values), np.uint8).astype(float).reshape(height, width, 4)[::-1]


def eye(tab: Tab, which: str, **view: Any) -> FloatArray:
    """What one eye sees: the next frame of frames in turn."""
    frame = 0 if which == "left" else 1
    tab.value(f"viewer.outputs.frame = {frame}; true")
    made = picture(tab, output="shutter", **view)
    tab.value("cancelAnimationFrame(viewer.pending); viewer.pending = null; true")
    return made


def linear(pixels: FloatArray) -> FloatArray:
    """Linear light, 0 to 1, of sRGB, 0 to 255."""
    return np.where(pixels <= 0.04045 * 255, pixels / 255 / 12.92, ((pixels / 255 + 0.055) / 1.055) ** 2.4)


def middle(pixels: FloatArray) -> FloatArray:
    """Mean place of what is not background, in pixels to the right and down."""
    light = linear(pixels[..., :3])
    weight = np.abs(light - light[0, 0]).sum(-1)
    rows, columns = np.indices(weight.shape)
    return np.array([(weight * columns).sum(), (weight * rows).sum()]) / weight.sum()


@pytest.mark.parametrize("camera", ["parallel", "convergent"])
@pytest.mark.parametrize("depth", [1.2, 2.0, 4.0])
def test_a_point_of_known_depth_has_the_pixel_disparity_that_geometry_says(tab: Tab, camera: str, depth: float) -> None:
    place, lengths = [0.1, 0.05, -depth], Lengths()
    make(tab, [box(place, [0.02 * depth, 0.02 * depth, 1e-6])])
    view = {"camera": camera, "lengths": lengths.as_page()}
    picture(tab, PLAIN)
    left, right = middle(eye(tab, "left", **view)), middle(eye(tab, "right", **view))
    wanted = seen(np.array([place]), camera, lengths, WIDTH / HEIGHT)[:, 0] * [WIDTH / 2, -HEIGHT / 2]
    assert right - left == pytest.approx(wanted[1] - wanted[0], abs=0.1)
    assert left == pytest.approx(
        wanted[0] + [(WIDTH - 1) / 2, (HEIGHT - 1) / 2], abs=0.15
    )  # edges have four samples a pixel


@pytest.mark.parametrize("away", [0.0, 1e6])
def test_each_body_is_where_it_was_put_however_far_from_the_origin(tab: Tab, away: float) -> None:
    """Red to the left and turned upright, green to the right."""
    place = np.array([away, 0, -away])
    ahead = place + np.array([0, 0, -2])
    bodies = [{"meshes": [box([0, 0, 0], [0.1, 0.02, 0.02], color)]} for color in ([1, 0, 0], [0, 1, 0])]
    stand = {"eye": place.tolist(), "target": ahead.tolist()}
    make(tab, [], bodies=bodies, center=ahead.tolist(), stand=stand, background=[0, 0, 0])
    places, turns = [[-0.3, 0.1, -2], [0.3, -0.1, -2]], [[0, 0, 0.5**0.5, 0.5**0.5], [0, 0, 0, 1]]
    for body in (0, 1):
        pose = [*(place + places[body]).tolist(), *turns[body]]
        tab.value(f"viewer.place({body}, {pose}); true")
    drawn = linear(picture(tab, PLAIN, output="plain", camera="central")[..., :3])
    pixels = HEIGHT / 2 / np.tan(VIEW_ANGLE / 2) / 2  # a metre at the depth of 2 m
    for body, size in enumerate([(0.02, 0.1), (0.1, 0.02)]):
        rows, columns = np.nonzero(drawn[..., body] > 0.5)
        center = np.array([columns.mean() - (WIDTH - 1) / 2, (HEIGHT - 1) / 2 - rows.mean()])
        assert center == pytest.approx(pixels * np.array(places[body][:2]), abs=0.6)
        assert (np.ptp(columns), np.ptp(rows)) == pytest.approx(pixels * np.array(size), abs=2)


def test_pictures_that_take_long_are_drawn_coarser_and_quick_ones_sharper_again(tab: Tab) -> None:
    make(tab, [box([0, 0, -2], [0.4] * 3)])
    tab.value("window.detail = new contactViewer.Detail(viewer); true")

    def after(count: int, milliseconds: float) -> float:
        wide = f"for (let k = 0; k < {count}; k++) detail.note({milliseconds}); viewer.paint(); viewer.canvas.width"
        return float(tab.value(wide)) / WIDTH

    assert after(4, 60) == 1
    assert after(1, 60) == pytest.approx(0.7)
    assert not tab.value("viewer.coarse")
    assert after(100, 60) == pytest.approx(0.25)
    assert after(1000, 15) == pytest.approx(0.25)  # neither slow nor quick
    assert after(90, 3) == pytest.approx(0.35, abs=1e-3)
    assert tab.value("viewer.coarse")
    # A step that was tried and proved slow is tried again four times later.
    assert after(5, 60) == pytest.approx(0.25)
    assert after(359, 3) == pytest.approx(0.25)
    assert after(1, 3) == pytest.approx(0.35, abs=1e-3)
    tab.value("viewer.view.output = 'polarised'; true")
    assert after(0, 0) == 1  # its rows are the screen's
    tab.value("viewer.view.output = 'plain'; detail.begin(0); true")
    assert after(0, 0) == 1
    assert tab.value("viewer.show()") > 0


@pytest.mark.parametrize("background", [BACKGROUND, None])
def test_pictures_that_must_keep_up_look_like_sharp_ones(tab: Tab, background: list[float] | None) -> None:
    """Half the resolution, not smoothed: apart from edges, each pixel is the average of four sharp ones."""
    make(tab, [box([0, -0.1, -2], [0.4] * 3, [0.9, 0.6, 0.2])], background=background)
    shown = {"edges": False, "floor": True, "shading": True, "shadows": True}
    sharp = picture(tab, shown, output="plain", camera="central").reshape(HEIGHT // 2, 2, WIDTH // 2, 2, 4)
    tab.value("viewer.detail = 0.5; true")
    try:
        quick = picture(tab)
    finally:
        tab.value("viewer.detail = 1; true")
    difference = np.abs(quick - sharp.mean(axis=(1, 3)))
    assert np.quantile(difference, 0.9) <= 2
    assert difference.mean() < 1.5
    assert len(np.unique(quick[..., :3].round(-1).reshape(-1, 3), axis=0)) > 5  # box, floor, shadow


def test_bodies_of_few_triangles_look_like_those_of_many(tab: Tab) -> None:
    """A sphere of 20 000 triangles and a box: a seventh of the triangles, and few pixels differ."""
    around, down = np.meshgrid(np.linspace(0, 2 * np.pi, 101), np.linspace(0, np.pi, 101))
    points = np.stack([np.cos(around) * np.sin(down), np.sin(around) * np.sin(down), np.cos(down)], -1).reshape(-1, 3)
    corner = (np.arange(100)[:, None] * 101 + np.arange(100)).ravel()
    triangles = np.concatenate([corner, corner + 101, corner + 1, corner + 1, corner + 101, corner + 102])
    sphere = {
        "vertices": base64.b64encode((0.25 * points + [0.3, 0, -2]).astype("<f4").tobytes()).decode(),
        "triangles": base64.b64encode(triangles.reshape(2, 3, -1).transpose(0, 2, 1).astype("<u4").tobytes()).decode(),
        "color": [0.9, 0.6, 0.2],
    }
    make(tab, [box([-0.3, 0, -2], [0.3] * 3), sphere])
    many = picture(tab, {**PLAIN, "shading": True}, output="plain", camera="central")
    drawn = int(tab.value("viewer.renderer.info.render.triangles"))
    tab.value("viewer.coarse = true; true")
    few = picture(tab)
    assert tab.value("viewer.renderer.info.render.triangles") < drawn / 6
    tab.value("viewer.coarse = false; true")
    np.testing.assert_array_equal(picture(tab), many)
    assert (np.abs(few - many).max(axis=-1) > 40).mean() < 2e-3
    inside = (many[..., :3] != many[0, 0, :3]).any(axis=-1)
    assert inside.sum() > 2e4
    assert np.abs(few - many)[inside].mean() < 6


def test_shadows_of_pictures_that_must_keep_up_are_three_pictures_old_at_most(tab: Tab) -> None:
    shown = {"edges": False, "floor": True, "shading": True, "shadows": True}
    make(tab, [box([0, 0, 0], [0.3] * 3)], stand={"eye": [0, 1, 0], "target": [0, -0.5, -2]})
    tab.value("viewer.detail = 0.5; true")
    poses = [[-0.4, 0, -2, 0, 0, 0, 1], [0.4, 0, -2, 0, 0, 0, 1]]
    drawn = []
    for start in poses[::-1]:
        tab.value(f"viewer.place(0, {start}); true")
        for _ in range(3):
            picture(tab, shown, output="plain", camera="central")
        tab.value(f"viewer.place(0, {poses[0]}); viewer.frames = 1; true")
        drawn.append([picture(tab) for _ in range(4)])
    tab.value("viewer.detail = 1; true")
    assert (np.abs(drawn[0][0] - drawn[1][0]) > 2).sum() > 1000  # the shadow is still where the box was
    np.testing.assert_array_equal(drawn[0][3], drawn[1][3])


@pytest.fixture
def pair(tab: Tab) -> dict[str, FloatArray]:
    """Pictures of both eyes of a coloured box before the screen."""
    make(tab, [box([0.1, 0, -1.2], [0.2, 0.2, 0.2], [0.9, 0.7, 0.4])])
    view = {"camera": "parallel", "lengths": Lengths().as_page(), "swapped": False}
    picture(tab, {**PLAIN, "shading": True})
    return {which: eye(tab, which, **view) for which in ("left", "right")}


def test_outputs_are_made_of_the_left_and_the_right_eyes_pictures(tab: Tab, pair: dict[str, FloatArray]) -> None:
    left, right = pair["left"], pair["right"]
    assert np.abs(left - right).max() > 50
    rows = picture(tab, output="polarised")
    first = tab.value("contactViewer.firstRightRow(viewer.canvas)")
    np.testing.assert_array_equal(rows[first::2], right[first::2])
    np.testing.assert_array_equal(rows[1 - first :: 2], left[1 - first :: 2])
    for output, parts, scale in (
        ("side-by-side", (np.s_[:, : WIDTH // 2], np.s_[:, WIDTH // 2 :]), [2, 1]),
        ("top-and-bottom", (np.s_[: HEIGHT // 2], np.s_[HEIGHT // 2 :]), [1, 2]),
    ):
        both = picture(tab, output=output)
        for part, whole in zip(parts, (left, right), strict=True):
            assert middle(both[part]) == pytest.approx(middle(whole) / scale, abs=0.5)


def test_an_anaglyph_mixes_linear_colours(tab: Tab, pair: dict[str, FloatArray]) -> None:
    shown = picture(tab, output="anaglyph")
    matrices = tab.value(
        "['fromLeft', 'fromRight'].map(name => viewer.outputs.uniforms[name].value.clone().transpose().elements)"
    )
    pictures = (linear(pair[which][..., :3]) for which in ("left", "right"))
    mixed = sum(light @ np.reshape(matrix, (3, 3)).T for light, matrix in zip(pictures, matrices, strict=True))
    mixed = np.clip(mixed, 0, 1)
    wanted = 255 * np.where(mixed <= 0.0031308, 12.92 * mixed, 1.055 * mixed ** (1 / 2.4) - 0.055)
    assert np.abs(shown[..., :3] - wanted).max() <= 3  # eyes' pictures were read as whole numbers


def test_swapped_eyes_are_swapped(tab: Tab, pair: dict[str, FloatArray]) -> None:
    np.testing.assert_array_equal(eye(tab, "left", swapped=True), pair["right"])


def test_frames_in_turn_go_on_by_themselves(tab: Tab) -> None:
    make(tab, [box([0, 0, -2], [0.1, 0.1, 0.1])])
    tab.value("viewer.view.output = 'shutter'; window.first = viewer.frames; viewer.draw()")
    tab.until("viewer.frames > first + 4")
    tab.value("viewer.view.output = 'plain'; true")


def test_a_picture_without_background_is_transparent_and_with_two_eyes_opaque(tab: Tab) -> None:
    make(tab, [box([0, 0, -2], [0.1, 0.1, 0.1])], background=None)
    assert picture(tab, PLAIN, output="plain")[0, 0, 3] == 0
    assert (picture(tab, output="anaglyph")[..., 3] == 255).all()


class TestCues:
    """Each cue of depth changes what it should and can be taken away."""

    def test_shading_and_haze(self, tab: Tab) -> None:
        make(tab, [box([0, 0, -1.2], [0.3] * 3, [1, 0.5, 0]), box([1.2, 0, -4], [0.6] * 3, [1, 0.5, 0])])

        def colours(**shown: bool) -> set[tuple[float, ...]]:
            found, counts = np.unique(picture(tab, {**PLAIN, **shown}).reshape(-1, 4), axis=0, return_counts=True)
            return {tuple(row[:3]) for row, count in zip(found, counts, strict=True) if count > 5000}

        background = tuple(round(255 * value) for value in BACKGROUND)
        assert colours() == {background, (255, 128, 0)}
        assert len(colours(shading=True)) > 2
        hazy = picture(tab, {**PLAIN, "aerial": True}, lengths=Lengths().as_page())
        row, aside = hazy[HEIGHT // 2, :, :3], round(1.2 / 4 * WIDTH * 0.6 / 0.52)
        near, far = row[WIDTH // 2], row[WIDTH // 2 + aside]
        assert far[2] > near[2] + 50  # what is far pales
        assert far[0] < near[0]

    def test_shadows_lie_on_the_floor(self, tab: Tab) -> None:
        make(tab, [box([0, 0, -2], [0.4] * 3)], stand={"eye": [0, 1, 0], "target": [0, -0.5, -2]})
        floor = {**PLAIN, "floor": True, "texture": False}
        without, with_shadow = picture(tab, floor), picture(tab, {**floor, "shadows": True})
        darker = (with_shadow - without)[..., :3].sum(-1) < -5
        assert 500 < darker.sum() < WIDTH * HEIGHT / 4

    def test_texture_grows_denser_with_distance(self, tab: Tab) -> None:
        make(tab, [box([0, 0, -2], [0.4] * 3)], background=[1, 1, 1], stand={"eye": [0, 0.5, 2], "target": [0, 0, -2]})
        shown = picture(tab, {**PLAIN, "floor": True, "texture": True, "shadows": False})
        dark = shown[..., :3].sum(-1) < 740

        def lines(row: int) -> int:
            return int(np.diff(dark[row].astype(int)).clip(0).sum())

        horizon = int(np.flatnonzero(dark.any(axis=1))[0])
        assert lines(horizon + 60) > lines(HEIGHT - 30) > 2

    def test_objects_of_known_size_have_that_size(self, tab: Tab) -> None:
        make(
            tab, [box([0, 0, -2], [0.01] * 3)], radius=0.36, stand={"eye": [0, 0, 0], "target": [0, 0, -2]}, floor=-0.11
        )
        assert tab.value("viewer.world.known.name") == "football, 22 cm"
        size = tab.value(
            "(() => { const ball = viewer.world.known.object.children[0]; ball.geometry.computeBoundingSphere();"
            "return ball.geometry.boundingSphere.radius; })()"
        )
        assert size == pytest.approx(0.11)
        before, after = picture(tab, {**PLAIN, "knownSizes": False}), picture(tab, {"knownSizes": True})
        assert (before != after).any()

    @pytest.mark.full
    def test_the_observers_mouse_moves_what_is_near_against_what_is_far(self, tab: Tab) -> None:
        make(tab, [box([0, 0, -1.5], [0.02, 0.02, 1e-6]), box([0, 0, -2], [0.02, 0.02, 1e-6])])
        picture(tab, {**PLAIN, "headMotion": True}, output="plain", camera="central")

        def places(x: float) -> tuple[float, float]:
            tab.value(
                f"window.move = new PointerEvent('pointermove', {{clientX: {x}, clientY: {HEIGHT / 2}}});"
                "viewer.canvas.dispatchEvent(move); true"
            )
            shown = picture(tab)
            columns = np.flatnonzero((shown[..., 0] > 100).any(axis=0))
            return float(columns[0]), float(columns[-1])

        left, right = places(0), places(WIDTH - 1)
        assert left[1] - left[0] > 40
        assert right[1] - right[0] > 40
        # With the head to the left what is near moves to the right, against the screen's middle.
        assert left[1] > WIDTH / 2 + 30
        assert right[0] < WIDTH / 2 - 30
