"""The picture in the report: what is in front hides what is behind, where things are, and that it is a PNG."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import generate, read_assembly
from cad2modelica.collision.collision_shapes import collision_geometry
from cad2modelica.report.mechanism_pictures import mechanism_pictures
from cad2modelica.report.picture import BACKGROUND, HEIGHT, WIDTH, Solid, draw, view_axes
from PIL import Image
from scipy.spatial import ConvexHull

RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
UP = np.array([0.0, 0.0, 1.0])
BOX = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def solid(points: np.ndarray, color: tuple[float, float, float]) -> Solid:
    hull = ConvexHull(points)
    corners = points[hull.simplices]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward = (normal * hull.equations[:, :3]).sum(axis=1) > 0
    return Solid(np.where(outward[:, None, None], corners, corners[:, ::-1]), color)


def pixels(png: bytes) -> np.ndarray:
    """Rows by columns by red, green, blue, as integers that can be subtracted."""
    with Image.open(io.BytesIO(png)) as image:
        assert (image.format, image.mode, image.size) == ("PNG", "RGB", (WIDTH, HEIGHT))
        return np.asarray(image).astype(int)


def where(image: np.ndarray, channel: int) -> np.ndarray:
    """Points of one pure colour."""
    others = [k for k in range(3) if k != channel]
    return (image[..., channel] > 40) & (image[..., others] < 5).all(axis=-1)


@pytest.mark.parametrize("up", [UP, np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, -2.0])])
def test_what_is_up_is_up_in_the_picture(up: np.ndarray) -> None:
    axes = view_axes(up)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    direction = up / np.linalg.norm(up)
    image = pixels(draw([solid(BOX + 2 * direction, RED), solid(BOX, BLUE)], up))
    red, blue = np.argwhere(where(image, 0)), np.argwhere(where(image, 2))
    assert red[:, 0].mean() < blue[:, 0].mean() - 50
    assert red[:, 1].mean() == pytest.approx(blue[:, 1].mean(), abs=3)


def test_what_is_nearer_hides_what_is_behind() -> None:
    towards = view_axes(UP)[2]
    behind, before = solid(BOX, RED), solid(0.5 * BOX + 2 * towards, BLUE)
    for order in ([behind, before], [before, behind]):
        image = pixels(draw(order, UP))
        assert where(image, 2)[HEIGHT // 2, WIDTH // 2]
        assert where(image, 0).any()
    hidden = pixels(draw([solid(0.5 * BOX - 2 * towards, BLUE), behind], UP))
    assert not where(hidden, 2).any()


def test_room_is_kept_on_every_side() -> None:
    image = pixels(draw([solid(BOX, RED)], UP))
    shown = np.argwhere((image != BACKGROUND).any(axis=-1))
    assert shown.min() > 0
    assert (shown.max(axis=0) < [HEIGHT - 1, WIDTH - 1]).all()
    assert shown[:, 0].max() - shown[:, 0].min() > 0.85 * HEIGHT


def test_many_triangles_are_coarsened_and_look_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    points = np.random.default_rng(0).normal(size=(3000, 3))
    ball = solid(points / np.linalg.norm(points, axis=1)[:, None], RED)
    fine = pixels(draw([ball], UP))
    monkeypatch.setattr("cad2modelica.report.picture.MOST_TRIANGLES", 500)
    coarse = pixels(draw([ball], UP))
    assert (where(fine, 0) != where(coarse, 0)).mean() < 0.1


def test_pictures_of_the_sample(hammer: Path, tmp_path: Path) -> None:
    assembly = read_assembly(hammer)
    pictures = mechanism_pictures(assembly, {part.name: collision_geometry(part) for part in assembly.parts})
    assert pictures is not None
    silhouettes = [(pixels(picture) != BACKGROUND).any(axis=-1) for picture in pictures]
    assert 0.05 < silhouettes[0].mean() < 0.8
    assert (silhouettes[0] != silhouettes[1]).mean() < 0.01  # shapes stand for the parts
    page = generate(hammer, tmp_path / "out").report.read_text()
    assert page.count('src="data:image/png;base64,') == 2
