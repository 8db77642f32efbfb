"""VRML's Extrusion and ElevationGrid against closed forms (VTK's importer reads neither)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cad2modelica.geometry.mesh import is_closed, volume_integrals, weld
from cad2modelica.meshio.vrml_extrusion import spine_frames
from cad2modelica.meshio.vrml_scene import read_scene
from contact_foundation.errors import InputError
from hypothesis import given, settings
from hypothesis import strategies as st

HEADER = "#VRML V2.0 utf8\n"
SQUARE = "1 1, 1 -1, -1 -1, -1 1, 1 1"


def surface(folder: Path, geometry: str) -> tuple[np.ndarray, np.ndarray]:
    file = folder / "scene.wrl"
    file.write_text(f"{HEADER}Shape {{ geometry {geometry} }}")
    (shape,) = read_scene(file, folder).shapes
    return weld(shape.vertices, shape.triangles)


def volume(vertices: np.ndarray, triangles: np.ndarray) -> float:
    assert is_closed(triangles)
    return volume_integrals(vertices, triangles).volume


def text(rows: np.ndarray) -> str:
    return ", ".join(" ".join(repr(float(value)) for value in row) for row in np.atleast_2d(rows))


def test_default_extrusion_is_a_block(tmp_path: Path) -> None:
    vertices, triangles = surface(tmp_path, "Extrusion { }")
    assert volume(vertices, triangles) == pytest.approx(4.0)
    np.testing.assert_allclose([vertices.min(axis=0), vertices.max(axis=0)], [[-1, 0, -1], [1, 1, 1]])


def test_clockwise(tmp_path: Path) -> None:
    assert volume(*surface(tmp_path, "Extrusion { ccw FALSE }")) == pytest.approx(-4.0)


def test_without_caps_it_is_open(tmp_path: Path) -> None:
    for caps, count in (("", 12), ("beginCap FALSE", 10), ("endCap FALSE", 10), ("beginCap FALSE endCap FALSE", 8)):
        _, triangles = surface(tmp_path, f"Extrusion {{ {caps} }}")
        assert len(triangles) == count
        assert is_closed(triangles) is (not caps)


def test_scale_makes_a_frustum(tmp_path: Path) -> None:
    """Prismatoid: h/3 (A1 + A2 + sqrt(A1 A2))."""
    vertices, triangles = surface(tmp_path, "Extrusion { spine [ 0 0 0, 0 3 0 ] scale [ 1 1, 0.5 0.5 ] }")
    assert volume(vertices, triangles) == pytest.approx(3 / 3 * (4 + 1 + 2))


def test_concave_cross_section(tmp_path: Path) -> None:
    section = "0 0, 0 2, 1 2, 1 1, 2 1, 2 0, 0 0"
    vertices, triangles = surface(tmp_path, f"Extrusion {{ convex FALSE crossSection [ {section} ] }}")
    assert volume(vertices, triangles) == pytest.approx(3.0)


def test_orientation_turns_about_the_spine(tmp_path: Path) -> None:
    """A rectangle 2 x 1 (x times z), turned by a right angle about y at both ends: 1 x 2; by right-hand rule."""
    given_ = "Extrusion { crossSection [ 2 1, 2 0, 0 0, 0 1, 2 1 ] orientation 0 1 0 1.5707963267948966 }"
    vertices, triangles = surface(tmp_path, given_)
    np.testing.assert_allclose([vertices.min(axis=0), vertices.max(axis=0)], [[0, 0, -2], [1, 1, 0]], atol=1e-12)
    assert volume(vertices, triangles) == pytest.approx(2.0)


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(-1, 1), min_size=3, max_size=3), st.floats(0.5, 3))
def test_straight_spine_in_any_direction(
    tmp_path_factory: pytest.TempPathFactory, direction: list[float], length: float
) -> None:
    size = np.linalg.norm(direction)
    if size < 0.1:
        return
    end = np.array(direction) / size * length
    spine = np.array([[0, 0, 0], end / 3, end / 3, end])  # collinear and coincident points
    vertices, triangles = surface(tmp_path_factory.mktemp("s"), f"Extrusion {{ spine [ {text(spine)} ] }}")
    assert volume_integrals(vertices, triangles).volume == pytest.approx(4.0 * length)
    along = vertices @ end / length
    assert (along.min(), along.max()) == pytest.approx((0.0, length), abs=1e-9)


def test_bend_is_mitred(tmp_path: Path) -> None:
    """At a right-angled bend the section stands in the bisecting plane.

    The standard does not stretch it there: of the edges at distance 1 from the spine, those in the bend's plane come
    to (1, 1, 0) -+ (1, -1, 0)/sqrt(2).
    """
    vertices, _ = surface(tmp_path, f"Extrusion {{ crossSection [ {SQUARE} ] spine [ 0 -9 0, 0 0 0, 9 0 0 ] }}")
    corner = vertices[4:8]
    half = np.sqrt(0.5)
    found = {tuple(row) for row in np.round(corner, 9)}
    expected = {(side * half, -side * half, z) for side in (1, -1) for z in (-1.0, 1.0)}
    assert found == {tuple(np.round(row, 9)) for row in expected}


def test_torus_against_pappus(tmp_path: Path) -> None:
    """Square section swept on a regular polygon: area x length of the path of its centroid, mitres not stretched.

    With N corners on a circle of radius R and half width w, ring k lies in the plane through the axis; the body is
    N prismatoids: the volume is that of the polygonal ring between radii R - w and R + w.
    """
    count, radius, half = 24, 5.0, 1.0
    angles = 2 * np.pi * np.arange(count + 1) / count
    spine = radius * np.column_stack([np.cos(angles), np.zeros(count + 1), np.sin(angles)])
    spine[-1] = spine[0]
    section = half * np.array([[1, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]])
    vertices, triangles = surface(tmp_path, f"Extrusion {{ crossSection [ {text(section)} ] spine [ {text(spine)} ] }}")
    ring = 0.5 * count * np.sin(2 * np.pi / count) * ((radius + half) ** 2 - (radius - half) ** 2) * 2 * half
    assert volume(vertices, triangles) == pytest.approx(ring, rel=1e-9)


def test_frames_do_not_flip_at_an_inflexion() -> None:
    """Along an S the normals of the bends point to opposite sides; the frames must not turn over."""
    x = np.linspace(0, 2 * np.pi, 41)
    frames = spine_frames(np.column_stack([x, np.sin(x), 0 * x]))
    assert (np.einsum("ij,ij->i", frames[1:, :, 2], frames[:-1, :, 2]) > 0.9).all()
    np.testing.assert_allclose(np.einsum("nji,njk->nik", frames, frames), np.tile(np.eye(3), (41, 1, 1)), atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(frames), 1.0)


def test_spine_that_turns_back_keeps_right_handed_frames() -> None:
    spine = np.array([[0, 0, 0], [0, 1, 0], [1, 1, 0], [0, 1, 0], [0, 1, 5.0], [0, 1, 5.0]])
    frames = spine_frames(spine)
    np.testing.assert_allclose(np.linalg.det(frames), 1.0)


@pytest.mark.parametrize(
    "geometry",
    [
        "Extrusion { crossSection [ 1 1, 1 ] }",
        "Extrusion { spine [ 0 0 0, 1 ] }",
        "Extrusion { spine [ 0 0 0, 0 1 0, 0 2 0 ] scale [ 1 1, 2 2 ] }",
        "Extrusion { orientation [ 0 0 1 ] }",
        "ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 ] }",
        "ElevationGrid { xDimension 2.5 zDimension 2 height [ 0 0 0 0 0 ] }",
        "ElevationGrid { xDimension -1 zDimension -1 height [ 0 ] }",
        "ElevationGrid { xDimension 2 zDimension 2 xSpacing 0 height [ 0 0 0 0 ] }",
        f"Extrusion {{ spine [ {'0 0 0, ' * 1100} ] crossSection [ {'0 0, ' * 1100} ] }}",
    ],
)
def test_wrong_fields_are_refused(tmp_path: Path, geometry: str) -> None:
    with pytest.raises(InputError):
        surface(tmp_path, geometry)


def test_elevation_grid_is_a_height_field(tmp_path: Path) -> None:
    """A plane y = 1 + x + 2 z: area of the rectangle times sqrt(1 + 1 + 4), normals upwards."""
    heights = " ".join(str(1 + 0.5 * i + 2 * 0.25 * j) for j in range(3) for i in range(4))
    grid = f"xDimension 4 zDimension 3 xSpacing 0.5 zSpacing 0.25 height [ {heights} ]"
    vertices, triangles = surface(tmp_path, f"ElevationGrid {{ {grid} }}")
    assert len(vertices) == 12
    np.testing.assert_allclose(vertices[:, 1], 1 + vertices[:, 0] + 2 * vertices[:, 2])
    np.testing.assert_allclose(vertices.max(axis=0), [1.5, 3.5, 0.5])
    corners = vertices[triangles]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    np.testing.assert_allclose(areas.sum(axis=0), 1.5 * 0.5 * np.array([-1, 1, -2]), rtol=1e-12)
    assert (areas[:, 1] > 0).all()
    _, turned = surface(tmp_path, f"ElevationGrid {{ ccw FALSE {grid} }}")
    corners = vertices[turned]
    assert (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 1] < 0).all()
