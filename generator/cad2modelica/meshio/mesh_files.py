"""Mesh files: STL (text and binary) and Wavefront OBJ; COLLADA, PLY, glTF and VRML by modules of their own."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final

import numpy as np
from contact_foundation.errors import InputError, Place
from numpy.typing import NDArray

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.polygon import split
from cad2modelica.geometry.spatial import Array
from cad2modelica.meshio.collada_file import read_collada
from cad2modelica.meshio.gltf_file import read_gltf
from cad2modelica.meshio.msh_file import read_msh
from cad2modelica.meshio.ply_file import read_ply
from cad2modelica.meshio.vrml_scene import read_scene
from cad2modelica.source.number_limits import LARGEST, are_usable, is_usable

MAXIMUM_BYTES = 256 * 2**20
STL_HEADER = 84
STL_RECORD = 50

Surface = tuple[Array, Indices]


def read_mesh(file: Path) -> Surface:
    """Vertices and triangles of a mesh file, in the file's unit of length.

    Raises:
        InputError: the file is too large, of another type, broken, or ends too early.
    """
    kind = file.suffix.lower()
    if kind == ".dae":
        return _checked(*read_collada(file), file)
    if kind == ".wrl":
        return _checked(*_read_vrml(file), file)
    reader = _READERS.get(kind)
    if reader is None:
        raise InputError(
            f"meshes of type {file.suffix!r} are not read",
            place=Place(file=file),
            remedy="Convert the mesh to STL, OBJ, PLY, glTF, COLLADA or VRML97.",
        )
    with file.open("rb") as stream:
        data = stream.read(MAXIMUM_BYTES + 1)
    if len(data) > MAXIMUM_BYTES:
        raise InputError(
            f"is larger than {MAXIMUM_BYTES // 2**20} MiB", place=Place(file=file), remedy="Export coarser."
        )
    return _checked(*reader(data, file), file)


def _read_vrml(file: Path) -> Surface:
    """All shapes of a VRML97 file in the scene's axes."""
    placed = [shape.placed() for shape in read_scene(file, file.parent).shapes]
    offsets = np.cumsum([0, *(len(vertices) for vertices, _ in placed)])
    vertices = [np.zeros((0, 3)), *(vertices for vertices, _ in placed)]
    triangles = [triangles + offset for (_, triangles), offset in zip(placed, offsets[:-1], strict=True)]
    return np.concatenate(vertices), np.concatenate([np.zeros((0, 3), dtype=np.int64), *triangles])


def _checked(vertices: Array, triangles: Indices, file: Path) -> Surface:
    if not len(triangles):
        raise InputError("holds no triangle", place=Place(file=file), remedy="Export the mesh again.")
    if not are_usable(vertices):
        raise InputError(
            f"holds coordinates that are no finite numbers of at most {LARGEST:g}",
            place=Place(file=file),
            remedy="Export the mesh again.",
        )
    return vertices, triangles


def _read_stl(data: bytes, file: Path) -> Surface:
    count = struct.unpack_from("<I", data, STL_HEADER - 4)[0] if len(data) >= STL_HEADER else -1
    size = STL_HEADER + STL_RECORD * count
    # Binary files may begin with the word "solid" too, so the size decides.
    if count >= 0 and (len(data) == size or not data.lstrip().startswith(b"solid")):
        if len(data) < size:
            raise _truncated(
                file, None, f"{count} triangles announced, {(len(data) - STL_HEADER) // STL_RECORD} present"
            )
        record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        corners = np.frombuffer(data, record, count, STL_HEADER)["corners"].astype(np.float64).reshape(-1, 3)
        return corners, np.arange(3 * count, dtype=np.int64).reshape(-1, 3)
    return _read_stl_text(data.decode("utf-8", errors="replace"), file)


def _read_stl_text(text: str, file: Path) -> Surface:
    corners: list[list[float]] = []
    closed = False
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split()
        if not words:
            continue
        if words[0] == "vertex":
            corners.append(_floats(words[1:4], 3, file, number))
        closed = words[0] == "endsolid"
    if not closed or len(corners) % 3:
        raise _truncated(file, text.count("\n") + 1, "no 'endsolid' at the end")
    vertices = np.array(corners, dtype=np.float64).reshape(-1, 3)
    return vertices, np.arange(len(vertices), dtype=np.int64).reshape(-1, 3)


def _read_obj(data: bytes, file: Path) -> Surface:
    points: list[list[float]] = []
    faces: list[tuple[int, list[int]]] = []
    for number, line in enumerate(data.decode("utf-8", errors="replace").splitlines(), start=1):
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append(_floats(words[1:4], 3, file, number))
        elif words[0] == "f":
            faces.append((number, [_obj_index(word, len(points), file, number) for word in words[1:]]))
    vertices = np.array(points, dtype=np.float64).reshape(-1, 3)
    triangles: list[tuple[int, int, int]] = []
    for number, face in faces:
        if max(face, default=0) >= len(vertices):
            raise _wrong_line(file, number, "a face needs vertices that exist")
        if len(face) < 3:  # edges that some programs leave behind
            continue
        if len(face) == 3:
            triangles.append((face[0], face[1], face[2]))
        else:
            triangles += split(vertices, face)
    indices = np.array(triangles, dtype=np.int64).reshape(-1, 3)
    return vertices, indices[_with_area(vertices[indices])]


def _with_area(corners: Array) -> NDArray[np.bool_]:
    """Which triangles are none of points or lines; corners of shape (n, 3, 3)."""
    sides = corners[:, 1:] - corners[:, :1]
    doubled = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return np.asarray(doubled > 1e-14 * np.square(sides).sum(axis=2).max(axis=1, initial=0.0))


def _obj_index(word: str, count: int, file: Path, line: int) -> int:
    try:
        index = int(word.partition("/")[0])
    except ValueError:
        raise _wrong_line(file, line, f"{word!r} is no vertex") from None
    # Counted from 1; negative numbers count back from the vertex defined last.
    resolved = index - 1 if index > 0 else count + index
    if index == 0 or resolved < 0:
        raise _wrong_line(file, line, f"{word!r} is no vertex")
    return resolved


def _floats(words: list[str], count: int, file: Path, line: int) -> list[float]:
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if len(values) != count or not all(map(is_usable, values)):
        raise _wrong_line(file, line, f"{count} finite numbers expected, of at most {LARGEST:g}")
    return values


def _wrong_line(file: Path, line: int, message: str) -> InputError:
    return InputError(message, place=Place(file=file, line=line), remedy="Export the mesh again.")


def _truncated(file: Path, line: int | None, detail: str) -> InputError:
    return InputError(
        f"the file ends too early ({detail})", place=Place(file=file, line=line), remedy="Export or copy it again."
    )


_READERS: Final[Mapping[str, Callable[[bytes, Path], Surface]]] = {
    ".stl": _read_stl,
    ".obj": _read_obj,
    ".ply": read_ply,
    ".msh": read_msh,
    ".glb": read_gltf,
    ".gltf": read_gltf,
}
"""Readers of files by their ending."""
