"""The VRML reader: syntax, hierarchy, transforms and primitives, against closed forms and VTK's importer."""

from __future__ import annotations

import contextlib
import gzip
from pathlib import Path

import numpy as np
import pytest
from cad2modelica.geometry.mesh import is_closed, volume_integrals, weld
from cad2modelica.geometry.polygon import newell_normal, triangulate
from cad2modelica.meshio import vrml_scene
from cad2modelica.meshio.vrml_scene import read_scene
from cad2modelica.meshio.vrml_syntax import read_vrml
from contact_foundation.errors import InputError
from hypothesis import given, settings
from hypothesis import strategies as st
from vtk_oracle import distance_of_sets, vtk_points

HEADER = "#VRML V2.0 utf8\n"

TRANSFORMS = """
DEF outer Transform {
  translation 1 -2 3.5
  rotation 0.6 0 0.8 0.7
  center 0.5 0.25 -1
  scale 1.5 0.5 2
  scaleOrientation 0 0.6 0.8 -0.4
  children [
    DEF inner Transform {
      rotation 1 2 3 -1.1
      scale 1 -1 1
      children Shape {
        appearance Appearance { material Material { diffuseColor 0.1 0.2 0.3 } }
        geometry IndexedFaceSet {
          coord Coordinate { point [ 0 0 0, 1 0 0, 0 2 0, 0 0 3 ] }
          coordIndex [ 0 2 1 -1 0 1 3 -1 1 2 3 -1 0 3 2 -1 ]
        }
      }
    }
    Transform { translation 5 5 5 children [ Shape { geometry Box { size 1 2 3 } } ] }
  ]
}
"""


def scene(tmp_path: Path, text: str):
    file = tmp_path / "scene.wrl"
    file.write_text(HEADER + text)
    return read_scene(file, tmp_path)


# VTK's importer ignores center and scaleOrientation, applies the fields in the order of the text instead of the
# standard's, loses shear (a rotation below unequal scales), and cannot read numbers like .5; the oracle gets what it
# understands. test_transform_follows_the_standard covers the rest.
FOR_VTK = """
DEF outer Transform {
  translation 1 -2 3.5
  rotation 0.6 0 0.8 0.7
  scale 2 2 2
  children [
    Transform {
      translation 0 7 0
      rotation 1 2 3 -1.1
      scale 1.5 0.5 2
      children Shape {
        geometry IndexedFaceSet {
          coord Coordinate { point [ 0 0 0, 1 0 0, 0 2 0, 0 0 3 ] }
          coordIndex [ 0 2 1 -1 0 1 3 -1 1 2 3 -1 0 3 2 -1 ]
        }
      }
    }
    Transform { translation 5 5 5 children [ Shape { geometry Box { size 1 2 3 } } ] }
  ]
}
"""


def test_world_positions_agree_with_vtk(tmp_path: Path) -> None:
    pytest.importorskip("vtk", reason="VTK is the oracle for positions")
    file = tmp_path / "scene.wrl"
    file.write_text(HEADER + FOR_VTK)
    ours = np.concatenate([shape.placed()[0] for shape in read_scene(file, tmp_path).shapes])
    theirs = vtk_points(file, tmp_path)
    assert theirs is not None
    assert distance_of_sets(ours, theirs) < 1e-6  # VTK computes in single precision


def test_sample_agrees_with_vtk(hammer: Path, tmp_path: Path) -> None:
    pytest.importorskip("vtk", reason="VTK is the oracle for positions")
    file = hammer.parent / "hammer.wrl"
    shapes = read_scene(file, file.parent).shapes
    ours = np.concatenate([shape.placed()[0] for shape in shapes])
    theirs = vtk_points(file, tmp_path)
    assert theirs is not None
    assert distance_of_sets(ours, theirs) < 1e-3  # mm, single precision


def test_transform_follows_the_standard(tmp_path: Path) -> None:
    """The worked order T C R SR S -SR -C, written out with matrices of its own."""
    (first, *_) = scene(tmp_path, TRANSFORMS).shapes

    def turn(axis: list[float], angle: float) -> np.ndarray:
        from scipy.spatial.transform import Rotation

        return Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis)).as_matrix()

    center = np.array([0.5, 0.25, -1])
    orientation = turn([0, 0.6, 0.8], -0.4)
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], dtype=float)
    points = points * [1, -1, 1] @ turn([1, 2, 3], -1.1).T
    linear = turn([0.6, 0, 0.8], 0.7) @ orientation @ np.diag([1.5, 0.5, 2]) @ orientation.T
    points = (points - center) @ linear.T + center + [1, -2, 3.5]
    np.testing.assert_allclose(first.placed()[0], points, atol=1e-12)


def test_mirrored_shape_keeps_its_outside(tmp_path: Path) -> None:
    (first, *_) = scene(tmp_path, TRANSFORMS).shapes
    assert volume_integrals(*first.placed()).volume == pytest.approx(1.5, rel=1e-12)  # 1/6 * 1*2*3 * (1.5*0.5*2)
    assert volume_integrals(first.vertices, first.triangles).volume > 0


def test_names_and_colours_are_kept(tmp_path: Path) -> None:
    first, second = scene(tmp_path, TRANSFORMS).shapes
    assert first.path == "outer/inner"
    assert second.path == "outer"
    assert first.color == (0.1, 0.2, 0.3)


@pytest.mark.parametrize(
    ("geometry", "volume"),
    [
        ("Box { size 1 2 3 }", 6.0),
        ("Box { }", 8.0),
        ("Sphere { radius 2 }", None),
        ("Cylinder { radius 2 height 3 }", 0.5 * 32 * 4 * np.sin(2 * np.pi / 32) * 3),
        ("Cone { bottomRadius 2 height 3 }", 0.5 * 32 * 4 * np.sin(2 * np.pi / 32) * 3 / 3),
    ],
)
def test_primitives_are_closed_and_have_their_volume(tmp_path: Path, geometry: str, volume: float | None) -> None:
    (shape,) = scene(tmp_path, f"Shape {{ geometry {geometry} }}").shapes
    vertices, triangles = weld(shape.vertices, shape.triangles)
    assert is_closed(triangles)
    found = volume_integrals(vertices, triangles).volume
    if volume is None:
        assert 0.97 * 4 / 3 * np.pi * 8 < found < 4 / 3 * np.pi * 8
    else:
        assert found == pytest.approx(volume, rel=1e-12)


@pytest.mark.parametrize(("ccw", "sign"), [("TRUE", 1), ("FALSE", -1)])
def test_orientation_flag(tmp_path: Path, ccw: str, sign: int) -> None:
    text = f"""Shape {{ geometry IndexedFaceSet {{ ccw {ccw}
      coord Coordinate {{ point [ 0 0 0, 1 0 0, 0 1 0, 0 0 1 ] }}
      coordIndex [ 0 2 1 -1 0 1 3 -1 1 2 3 -1 0 3 2 ] }} }}"""
    (shape,) = scene(tmp_path, text).shapes
    assert volume_integrals(shape.vertices, shape.triangles).volume == pytest.approx(sign / 6)


def test_concave_face_is_triangulated_inside(tmp_path: Path) -> None:
    """An L-shaped prism with one face an end: volume by hand 3 x 2 units."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    points = ", ".join(f"{x} {y} {z}" for z in (0, 2) for x, y in outline)
    sides = " -1 ".join(f"{k} {(k + 1) % 6} {(k + 1) % 6 + 6} {k + 6}" for k in range(6))
    text = f"""Shape {{ geometry IndexedFaceSet {{ convex FALSE
      coord Coordinate {{ point [ {points} ] }}
      coordIndex [ 5 4 3 2 1 0 -1 6 7 8 9 10 11 -1 {sides} -1 ] }} }}"""
    (shape,) = scene(tmp_path, text).shapes
    assert is_closed(shape.triangles)
    assert volume_integrals(shape.vertices, shape.triangles).volume == pytest.approx(6.0)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(0.2, 1.0), min_size=3, max_size=12), st.floats(0, 6), st.floats(-3, 3), st.floats(-3, 3))
def test_star_shaped_polygons_keep_their_area(radii: list[float], turn: float, tilt: float, other: float) -> None:
    """Polygons star-shaped about a point, in any plane: the triangles' areas add up to that of the polygon."""
    from scipy.spatial.transform import Rotation

    angles = turn + 2 * np.pi * np.arange(len(radii)) / len(radii)
    flat = np.column_stack([radii * np.cos(angles), radii * np.sin(angles), np.zeros(len(radii))])
    points = flat @ Rotation.from_euler("xy", [tilt, other]).as_matrix().T
    normal = newell_normal(points) / 2
    triangles = np.array(triangulate(points))
    corners = points[triangles]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    signed = areas @ (normal / np.linalg.norm(normal))
    assert signed.min() > -1e-12
    assert signed.sum() == pytest.approx(np.linalg.norm(normal), rel=1e-9)


def test_outline_of_a_gear_with_thousands_of_corners() -> None:
    """Ears that are looked at anew only where something changed: without that, a minute and more."""
    teeth = 700
    angles = 2 * np.pi * np.arange(4 * teeth) / (4 * teeth)
    radii = np.tile([1.0, 1.0, 1.1, 1.1], teeth)
    points = np.column_stack([radii * np.cos(angles), radii * np.sin(angles), np.full(4 * teeth, 5.0)])
    triangles = np.array(triangulate(points))
    assert len(triangles) == 4 * teeth - 2
    edges = points[triangles[:, 1:]] - points[triangles[:, :1]]
    areas = np.linalg.det(edges[:, :, :2]) / 2
    x, y = points[:, 0], points[:, 1]
    assert areas.min() > 0
    assert areas.sum() == pytest.approx((x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2, rel=1e-12)


def test_use_shows_the_same_node_twice(tmp_path: Path) -> None:
    text = "DEF a Shape { geometry Sphere {} } Transform { translation 9 0 0 children USE a }"
    first, second = scene(tmp_path, text).shapes
    np.testing.assert_allclose(second.placed()[0] - first.placed()[0], [[9, 0, 0]] * len(first.vertices))


def test_latest_definition_counts(tmp_path: Path) -> None:
    text = "DEF a Shape { geometry Box {} } DEF a Shape { geometry Box { size 4 4 4 } } USE a"
    assert [np.ptp(shape.vertices) for shape in scene(tmp_path, text).shapes] == [2, 4, 4]


def test_switch_and_level_of_detail(tmp_path: Path) -> None:
    text = """Switch { whichChoice 1 choice [ Shape { geometry Box { } } Shape { geometry Box { size 6 6 6 } } ] }
    Switch { choice Shape { geometry Box { } } }
    LOD { range [ 10 ] level [ Shape { geometry Box { size 1 1 1 } } Shape { geometry Box { } } ] }"""
    assert [np.ptp(shape.vertices) for shape in scene(tmp_path, text).shapes] == [6, 1]


def test_prototypes(tmp_path: Path) -> None:
    text = """PROTO Bar [ field SFVec3f size 1 1 1 field SFColor tint 1 0 0 eventIn SFBool on ]
    { DEF body Transform { children Shape {
        appearance Appearance { material Material { diffuseColor IS tint } } geometry Box { size IS size } } } }
    DEF first Bar { size 2 4 6 } Bar { tint 0 1 0 }"""
    first, second = scene(tmp_path, text).shapes
    np.testing.assert_allclose(np.ptp(first.vertices, axis=0), [2, 4, 6])
    np.testing.assert_allclose(np.ptp(second.vertices, axis=0), [1, 1, 1])
    assert (first.path, second.color) == ("first", (0.0, 1.0, 0.0))


def test_prototype_inside_an_instance_of_itself(tmp_path: Path) -> None:
    """Nested by a field, as exporters write chains; only a body that holds its own prototype is a circle."""
    text = """PROTO Joint [ field SFVec3f at 0 0 0 field MFNode children [] ]
    { Transform { translation IS at children IS children } }
    DEF a Joint { at 1 0 0 children DEF b Joint { at 0 2 0 children Shape { geometry Box {} } } }"""
    (shape,) = scene(tmp_path, text).shapes
    assert shape.path == "a/b"
    np.testing.assert_allclose(shape.placed()[0].mean(axis=0), [1, 2, 0])


def test_own_prototypes_inside_an_external_one(tmp_path: Path) -> None:
    """What an instance is given belongs to the file that gives it, not to the one that defines the prototype."""
    (tmp_path / "frame.wrl").write_text(
        HEADER + "PROTO Bolt [] { Shape { geometry Sphere {} } } PROTO Frame [ field MFNode children [] ]"
        " { Group { children IS children } }"
    )
    text = """EXTERNPROTO Frame [ field MFNode children ] "frame.wrl#Frame"
    PROTO Bolt [] { Shape { geometry Box { size 4 4 4 } } } Frame { children Bolt {} }"""
    (shape,) = scene(tmp_path, text).shapes
    assert np.ptp(shape.vertices) == 4


@pytest.mark.parametrize("body", ["A {}", "Group { children B {} }", "Group { children [ E {} E {} ] }"])
def test_prototype_that_contains_itself_is_refused(tmp_path: Path, body: str) -> None:
    (tmp_path / "other.wrl").write_text(
        HEADER + 'EXTERNPROTO A [] "scene.wrl#A"\nPROTO E [] { Group { children [ A {} A {} ] } }'
    )
    text = f'EXTERNPROTO E [] "other.wrl#E"\nPROTO A [] {{ {body} }} PROTO B [] {{ A {{}} }} A {{}}'
    with pytest.raises(InputError, match=r"prototype [ABE] contains itself"):
        scene(tmp_path, text)


def test_deep_prototype_is_stopped(tmp_path: Path) -> None:
    deep = "Group { children [ " * 5000 + "Shape { geometry Box {} }" + " ] }" * 5000
    with pytest.raises(InputError, match="nested deeper"):
        scene(tmp_path, f"PROTO A [] {{ {deep} }} A {{}}")


@pytest.mark.full
def test_prototype_that_multiplies_is_stopped(tmp_path: Path) -> None:
    """Ten groups in a prototype's body that each use the one before ten times would be 10^10 boxes."""
    groups = [f"DEF g{n} Group {{ children [ {f'USE g{n - 1} ' * 10} ] }}" for n in range(1, 11)]
    body = "Group { children [ DEF g0 Shape { geometry Box {} } " + " ".join(groups) + " ] }"
    with pytest.raises(InputError, match=r"more than|too many"):
        scene(tmp_path, f"PROTO A [] {{ {body} }} A {{}}")


def test_inlined_files_are_read_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[Path] = []
    monkeypatch.setattr(vrml_scene, "read_vrml", lambda file: read.append(file) or read_vrml(file))
    (tmp_path / "leaf.wrl").write_text(HEADER + "Shape { geometry Box {} }")
    (tmp_path / "twig.wrl").write_text(HEADER + 'Inline { url "leaf.wrl" } ' * 5)
    assert len(scene(tmp_path, 'Inline { url "twig.wrl" } ' * 5).shapes) == 25
    assert [file.name for file in read] == ["scene.wrl", "twig.wrl", "leaf.wrl"]


@pytest.mark.parametrize("number", ["1e300", "1e999", "0x" + "f" * 400])
def test_numbers_beyond_all_measure_are_named(tmp_path: Path, number: str) -> None:
    with pytest.raises(InputError, match="Box: field size needs 3 finite numbers, of at most 1e\\+30"):
        scene(tmp_path, f"Shape {{ geometry Box {{ size {number} 1 1 }} }}")


@pytest.mark.parametrize("length", [1e-200, 1e25])
def test_rotations_about_axes_of_any_length(tmp_path: Path, length: float) -> None:
    text = (
        f"Transform {{ rotation 0 0 {length} 1.5707963267948966 children Shape {{ geometry Box {{ size 2 4 6 }} }} }}"
    )
    (shape,) = scene(tmp_path, text).shapes
    np.testing.assert_allclose(np.ptp(shape.placed()[0], axis=0), [4, 2, 6], atol=1e-12)


def test_inline_and_external_prototype(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "box.wrl").write_text(
        HEADER + 'Inline { url "more/small.wrl" } DEF big Shape { geometry Box {} }'
    )
    (tmp_path / "parts" / "more").mkdir()
    (tmp_path / "parts" / "more" / "small.wrl").write_text(HEADER + "DEF small Shape { geometry Box { size 1 1 1 } }")
    (tmp_path / "proto.wrl").write_text(
        HEADER + "PROTO P [ field SFVec3f s 3 3 3 ] { Shape { geometry Box { size IS s } } }"
    )
    text = 'EXTERNPROTO Q [ field SFVec3f s ] "proto.wrl#P" DEF all Inline { url [ "parts/box.wrl" ] } Q { s 5 5 5 }'
    found = scene(tmp_path, text).shapes
    assert [shape.path for shape in found] == ["all/small", "all/big", "shape at line 2"]
    assert [np.ptp(shape.vertices) for shape in found] == [1, 2, 5]


def test_index_beyond_all_numbers_is_named(tmp_path: Path) -> None:
    text = """Shape { geometry IndexedFaceSet {
        coord Coordinate { point [ 0 0 0, 1 0 0, 0 2 0 ] } coordIndex [ 0 1 1e999 -1 ] } }"""
    with pytest.raises(InputError, match="names point inf, but there are 3 points"):
        scene(tmp_path, text)


def test_external_prototype_that_names_no_file_is_reported(tmp_path: Path) -> None:
    text = 'EXTERNPROTO N [ field SFVec3f s ] [ "urn:web3d:vrml97:node:N" ] N { } Shape { geometry Box { } }'
    found = scene(tmp_path, text)
    assert len(found.shapes) == 1
    assert found.notes == ("scene.wrl: EXTERNPROTO N names no file: its nodes were left out",)


def test_external_prototype_takes_the_first_file(tmp_path: Path) -> None:
    (tmp_path / "proto.wrl").write_text(HEADER + "PROTO P [ ] { Shape { geometry Box { size 3 3 3 } } }")
    found = scene(tmp_path, 'EXTERNPROTO P [ ] [ "urn:node:P" "http://place/P.wrl" "proto.wrl" ] P { }').shapes
    assert [np.ptp(shape.vertices) for shape in found] == [3]


def test_hidden_by_scale_zero_is_reported(tmp_path: Path) -> None:
    found = scene(tmp_path, "Shape { geometry Box { } }\nTransform { scale 0 0 0 children Shape { geometry Box { } } }")
    assert len(found.shapes) == 1
    assert found.notes == ("scene.wrl: Transform in line 3 has scale 0: what is below it was left out",)


def test_lexical_corners(tmp_path: Path) -> None:
    """Comments, commas, hexadecimal numbers, names with dots and leading digits, strings with braces, routes."""
    text = """# a comment { [
    WorldInfo { title "a } string \\" with # all" info [ "x", "y" ] }
    DEF 1.Part-No._1 Transform { translation +1,-.5e1,0x10 # here too
      children [ DEF s Shape{geometry Box{size 1,1,1}}, ] }
    DEF t TimeSensor { loop TRUE } DEF i PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0, 1 1 1 ] }
    Script { field SFInt32 n 3 eventIn SFTime when eventOut SFBool done url "javascript: { }" }
    ROUTE t.fraction_changed TO i.set_fraction
    """
    (shape,) = scene(tmp_path, text).shapes
    np.testing.assert_allclose(shape.placed()[0].mean(axis=0), [1, -5, 16])
    assert shape.path == "1.Part-No._1/s"


def test_compressed_file(tmp_path: Path) -> None:
    file = tmp_path / "scene.wrl"
    file.write_bytes(gzip.compress((HEADER + TRANSFORMS).encode()))
    assert len(read_scene(file, tmp_path).shapes) == 2


def test_unknown_nodes_are_reported(tmp_path: Path) -> None:
    found = scene(
        tmp_path, "NurbsSurface { } Shape { geometry IndexedLineSet { } } Viewpoint { } Shape { geometry Box {} }"
    )
    assert len(found.shapes) == 1
    assert any("NurbsSurface" in note for note in found.notes)
    assert any("without a surface" in note for note in found.notes)
    assert not any("Viewpoint" in note for note in found.notes)


@settings(max_examples=50, deadline=None)
@given(data=st.data())
def test_damaged_text_never_fails_unexpectedly(data: st.DataObject, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Any cut, insertion or replacement either reads or gives an InputError."""
    text = HEADER + TRANSFORMS
    position = data.draw(st.integers(len(HEADER), len(text)))
    length = data.draw(st.integers(0, 30))
    piece = data.draw(
        st.sampled_from(["", "{", "}", "[", "]", '"', "DEF", "USE x", "-", "1e999", "TRUE", "\x00", "é", "#"])
    )
    folder = tmp_path_factory.getbasetemp() / "damaged"
    folder.mkdir(exist_ok=True)
    file = folder / "scene.wrl"
    file.write_text(text[:position] + piece + text[position + length :])
    with contextlib.suppress(InputError):
        read_scene(file, folder)
