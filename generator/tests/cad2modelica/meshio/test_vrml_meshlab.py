"""Nodes that only MeshLab's importer knows beside this one: every field of Transform, prototypes, included files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cad2modelica.meshio.vrml_scene import read_scene
from meshlab_oracle import distances, meshlab_triangles, round_error, with_faces
from vrml_collection import SINGLE

pytest.importorskip("pymeshlab", reason="MeshLab is the oracle for positions")

WEDGE = """Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 2 0 0, 0 1 0, 0 0 3 ] }
  coordIndex [ 0 2 1 -1, 0 1 3 -1, 1 2 3 -1, 2 0 3 -1 ] } }"""
PLACE = "translation 4 -5 6 center 1 2 3 rotation 1 2 -1 0.8 scale 2 0.5 1.5 scaleOrientation 0 1 1 0.7"
# Of several instances MeshLab shows the last, and on one of all defaults it crashes.
ARM = """PROTO Arm [ field SFVec3f at 1 2 3 field MFNode load [] ] {
  Transform { translation IS at rotation 0 0 1 0.5 children IS load } }"""
SCENES = {
    "transform": f"Transform {{ {PLACE} children {WEDGE} }}",
    "nested": f"Transform {{ {PLACE} children Transform {{ {PLACE} children [ {WEDGE} ] }} }}",
    "prototype": f"""{ARM} Transform {{ {PLACE} children Arm {{ at 7 8 9 load Group {{ children {WEDGE} }} }} }}""",
    "use": f"""DEF A Transform {{ {PLACE} children {WEDGE} }}
      Transform {{ translation 9 9 9 scale 1 2 3 children USE A }}""",
    "elevation grid": f"""Transform {{ {PLACE} children Shape {{ geometry ElevationGrid {{
      xDimension 4 zDimension 3 xSpacing 0.5 zSpacing 2 height [ 0 1 0 2, 1 1 3 1, 0 2 0 0.5 ] }} }} }}""",
    "inline": f'Transform {{ {PLACE} children Inline {{ url "wedge.wrl" }} }}',
    "switch": f"Switch {{ whichChoice 1 choice [ Group {{ }} Transform {{ {PLACE} children {WEDGE} }} ] }}",
    "sphere": f"Transform {{ {PLACE} children Shape {{ geometry Sphere {{ radius 1.5 }} }} }}",
    "box": f"Transform {{ {PLACE} children Shape {{ geometry Box {{ size 1 .5 3 }} }} }}",
    "cone": f"Transform {{ {PLACE} children Shape {{ geometry Cone {{ height 4 bottomRadius 0.5 }} }} }}",
    "cylinder": f"Transform {{ {PLACE} children Shape {{ geometry Cylinder {{ radius 0.5 height 4 }} }} }}",
}
ROUND = ("sphere", "cone", "cylinder")


@pytest.mark.parametrize("name", SCENES)
def test_world_positions(tmp_path: Path, name: str) -> None:
    """Surfaces of both agree in both directions: to single precision, and round ones to the error of our polygons."""
    (tmp_path / "wedge.wrl").write_text(f"#VRML V2.0 utf8\n{WEDGE}\n")
    file = tmp_path / "scene.wrl"
    file.write_text(f"#VRML V2.0 utf8\n{SCENES[name]}\n")
    placed = [shape.placed() for shape in read_scene(file, tmp_path).shapes]
    ours = np.concatenate([vertices[triangles] for vertices, triangles in placed])
    file.write_text(with_faces(file.read_text()))
    theirs = meshlab_triangles(file, tmp_path)
    assert theirs is not None
    size = float(np.ptp(ours.reshape(-1, 3), axis=0).max())
    tolerance = SINGLE * size + (round_error(size) if name in ROUND else 0.0)
    assert max(distances(ours, theirs)) <= tolerance
    if name not in ROUND:
        corners = [np.unique(surface.reshape(-1, 3).round(4), axis=0) for surface in (ours, theirs)]
        assert len(corners[0]) == len(corners[1])
