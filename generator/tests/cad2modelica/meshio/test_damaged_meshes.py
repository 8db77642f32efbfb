"""Meshes cut anywhere or with bytes changed at random end in a mesh, or in one message that names the file.

``CMB_MUTATIONS=N`` draws N of each kind and way.
"""

from __future__ import annotations

import os
import random
import struct
from pathlib import Path

import numpy as np
import pytest
from cad2modelica.meshio.mesh_files import read_mesh
from contact_foundation.errors import InputError
from damage import CHANGES

COUNT = int(os.environ.get("CMB_MUTATIONS", "100"))
CORNERS = ((0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.1))
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))


def words(values: object) -> str:
    return " ".join(str(value) for value in np.ravel(np.array(values)))


def binary_stl() -> bytes:
    faces = b"".join(
        struct.pack("<12fH", 0.0, 0.0, 0.0, *(x for corner in face for x in CORNERS[corner]), 0) for face in FACES
    )
    return b"solid by chance".ljust(80) + struct.pack("<I", len(FACES)) + faces


def text_stl() -> bytes:
    lines = ["solid t"]
    for face in FACES:
        vertices = "\n".join(f"vertex {words(CORNERS[corner])}" for corner in face)
        lines.append(f"facet normal 0 0 0\nouter loop\n{vertices}\nendloop\nendfacet")
    return "\n".join([*lines, "endsolid t\n"]).encode()


def obj() -> bytes:
    lines = [f"v {words(corner)}" for corner in CORNERS] + ["vn 0 0 1", "usemtl steel"]
    lines += [f"f {' '.join(f'{corner + 1}//1' for corner in face)}" for face in FACES]
    return "\n".join([*lines, ""]).encode()


def collada() -> bytes:
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">{words(CORNERS)}</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>{words(FACES)}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><matrix>{words(np.eye(4))}</matrix>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
""".encode()


def vrml() -> bytes:
    points = ", ".join(words(corner) for corner in CORNERS)
    faces = " ".join(f"{words(face)} -1" for face in FACES)
    return (
        "#VRML V2.0 utf8\nDEF t Transform { translation 0 0 0 children [ Shape { geometry IndexedFaceSet {\n"
        f"coord Coordinate {{ point [ {points} ] }} coordIndex [ {faces} ] }} }} ] }}\n"
    ).encode()


KINDS = {
    "binary.stl": binary_stl(),
    "text.stl": text_stl(),
    "mesh.obj": obj(),
    "mesh.dae": collada(),
    "mesh.wrl": vrml(),
}


@pytest.mark.parametrize("name", KINDS)
def test_whole_mesh(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_bytes(KINDS[name])
    vertices, triangles = read_mesh(tmp_path / name)
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(1e-3 / 6, rel=1e-6)


@pytest.mark.filterwarnings("error::RuntimeWarning")
@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("name", KINDS)
def test_damaged_mesh(tmp_path: Path, name: str, change: object) -> None:
    assert callable(change)
    refusals = []
    for seed in range(COUNT):
        (tmp_path / name).write_bytes(change(KINDS[name], random.Random(f"{name} {seed}")))
        try:
            vertices, triangles = read_mesh(tmp_path / name)
        except InputError as error:
            refusals.append(str(error))
        else:
            assert np.isfinite(vertices).all(), seed
            assert len(triangles) > 0, seed
            assert triangles.min() >= 0, seed
            assert triangles.max() < len(vertices), seed
    assert refusals
    assert all(name in refusal for refusal in refusals)
