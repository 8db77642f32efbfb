"""PLY and glTF meshes, and VRML as a mesh file: known solids in every form of the formats, and broken ones."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path

import numpy as np
import pytest
from cad2modelica.geometry.mesh import is_closed, volume_integrals, weld
from cad2modelica.geometry.primitive_meshes import box_surface
from cad2modelica.meshio.mesh_files import read_mesh
from contact_foundation.errors import InputError

SIZE = np.array([1.0, 2.0, 3.0])
QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def ply(order: str) -> bytes:
    """A box of quadrangles with normals beside the corners, as many programs write them."""
    vertices, _ = box_surface(SIZE)
    name = {"": "ascii", "<": "binary_little_endian", ">": "binary_big_endian"}[order]
    header = [
        "ply",
        f"format {name} 1.0",
        "comment made by a test",
        "element vertex 8",
        *(f"property float {axis}" for axis in ("x", "y", "z", "nx")),
        "element face 6",
        "property list uchar int vertex_indices",
        "property uchar red",
        "end_header\n",
    ]
    if order == "":
        rows = [" ".join(map(str, [*vertex, 0.5])) for vertex in vertices]
        rows += [f"4 {' '.join(map(str, quad))} 255" for quad in QUADS]
        return ("\n".join(header) + "\n".join(rows) + "\n").encode()
    body = b"".join(struct.pack(f"{order}4f", *vertex, 0.5) for vertex in vertices)
    body += b"".join(struct.pack(f"{order}B4iB", 4, *quad, 255) for quad in QUADS)
    return "\n".join(header).encode() + body


def gltf(*, binary: bool, node: dict[str, object]) -> bytes:
    vertices, triangles = box_surface(SIZE)
    data = vertices.astype("<f4").tobytes() + triangles.astype("<u2").tobytes()
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1], "translation": [10, 0, 0]}, {"mesh": 0, **node}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(vertices), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": triangles.size, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": vertices.size * 4},
            {"buffer": 0, "byteOffset": vertices.size * 4, "byteLength": triangles.size * 2},
        ],
        "buffers": [{"byteLength": len(data)}],
    }
    if not binary:
        document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        return json.dumps(document).encode()
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def solid(file: Path):
    vertices, triangles = weld(*read_mesh(file))
    assert is_closed(triangles)
    return volume_integrals(vertices, triangles)


@pytest.mark.parametrize("order", ["", "<", ">"])
def test_ply(tmp_path: Path, order: str) -> None:
    (tmp_path / "a.ply").write_bytes(ply(order))
    found = solid(tmp_path / "a.ply")
    assert found.volume == pytest.approx(6.0)
    np.testing.assert_allclose(found.center, 0, atol=1e-12)


@pytest.mark.parametrize("order", ["", "<", ">"])
def test_every_cut_of_a_ply_file_is_told(tmp_path: Path, order: str) -> None:
    whole = ply(order).rstrip()
    for end in range(0, len(whole) - 4, 7):
        (tmp_path / "a.ply").write_bytes(whole[:end])
        with pytest.raises(InputError, match=r"a\.ply"):
            read_mesh(tmp_path / "a.ply")


@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize(
    ("node", "center"),
    [
        ({}, (10, 0, 0)),
        ({"rotation": [0, 0, np.sqrt(0.5), np.sqrt(0.5)], "translation": [0, 1, 0]}, (10, 1, 0)),
        ({"scale": [-1, 1, 1], "translation": [1, 0, 0]}, (11, 0, 0)),
        ({"matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2, 1]}, (10, 0, 2)),
    ],
)
def test_gltf(tmp_path: Path, binary: bool, node: dict[str, object], center: tuple[float, float, float]) -> None:
    """A mirrored solid keeps its outside: the volume stays positive."""
    file = tmp_path / ("a.glb" if binary else "a.gltf")
    file.write_bytes(gltf(binary=binary, node=node))
    found = solid(file)
    assert found.volume == pytest.approx(6.0)
    np.testing.assert_allclose(found.center, center, atol=1e-6)


def test_every_cut_of_a_glb_file_is_told(tmp_path: Path) -> None:
    whole = gltf(binary=True, node={})
    for end in range(0, len(whole) - 4, 13):
        (tmp_path / "a.glb").write_bytes(whole[:end])
        with pytest.raises(InputError, match=r"a\.glb"):
            read_mesh(tmp_path / "a.glb")


def test_bytes_changed_at_random_end_in_a_mesh_or_in_one_message(tmp_path: Path) -> None:
    generator = np.random.default_rng(3)
    refusals = []
    for name, whole in (
        ("a.glb", gltf(binary=True, node={})),
        ("a.ply", ply("<")),
        ("a.gltf", gltf(binary=False, node={})),
    ):
        for _ in range(150):
            data = bytearray(whole)
            for place in generator.integers(0, len(data), 3):
                data[place] = generator.integers(0, 256)
            (tmp_path / name).write_bytes(data)
            try:
                vertices, triangles = read_mesh(tmp_path / name)
            except InputError as error:
                refusals.append(str(error))
            else:
                assert triangles.max() < len(vertices)
    assert refusals
    assert all("/a." in refusal for refusal in refusals)


def test_gltf_does_not_leave_its_folder(tmp_path: Path) -> None:
    (tmp_path / "secret.bin").write_bytes(b"\0" * 10_000)
    (tmp_path / "inside").mkdir()
    document = json.loads(gltf(binary=False, node={}))
    document["buffers"][0]["uri"] = "../secret.bin"
    (tmp_path / "inside" / "a.gltf").write_text(json.dumps(document))
    with pytest.raises(InputError, match="leaves"):
        read_mesh(tmp_path / "inside" / "a.gltf")


def test_vrml_as_a_mesh(tmp_path: Path) -> None:
    text = "#VRML V2.0 utf8\nTransform { translation 1 0 0 children Shape { geometry Box { size 1 2 3 } } }"
    (tmp_path / "a.wrl").write_text(text)
    found = solid(tmp_path / "a.wrl")
    assert found.volume == pytest.approx(6.0)
    np.testing.assert_allclose(found.center, [1, 0, 0], atol=1e-9)
