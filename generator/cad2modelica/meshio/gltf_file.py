"""glTF 2.0 meshes (.glb, .gltf): triangles of the default scene, placed by their nodes (Khronos Group, glTF 2.0)."""

from __future__ import annotations

import base64
import binascii
import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.errors import CmbError, InputError, Place

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array
from cad2modelica.source.file_reference import resolve_inside

MAXIMUM_DEPTH = 64
MAXIMUM_TRIANGLES = 5_000_000
MAXIMUM_BUFFER = 256 * 2**20

_MAGIC, _JSON, _BINARY = 0x46546C67, 0x4E4F534A, 0x004E4942
_COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_NEEDED_EXTENSIONS = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")


def read_gltf(data: bytes, file: Path) -> tuple[Array, Indices]:
    """Vertices, m, shape (n, 3), and triangles, shape (m, 3), in the file's axes (glTF's y points up).

    Raises:
        InputError: the data breaks the format, is compressed, or names files outside its own folder.
    """
    try:
        document, binary = _parts(data)
        return _Gltf(document, binary, file).surface()
    except CmbError:
        raise
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, struct.error, RecursionError) as error:
        raise InputError(
            f"is no glTF mesh that can be read: {error}",
            place=Place(file=file),
            remedy="Export the mesh again, as glTF 2.0 without compression, or as STL or OBJ.",
        ) from error


def _parts(data: bytes) -> tuple[dict[str, Any], bytes | None]:
    """The document, and the binary chunk of a .glb file."""
    if not data.startswith(b"glTF"):
        return json.loads(data.decode("utf-8")), None
    _, version, _ = struct.unpack_from("<III", data)
    if version != 2:
        raise ValueError(f"version {version}, not 2")
    document, binary, at = None, None, 12
    while at + 8 <= len(data):
        length, kind = struct.unpack_from("<II", data, at)
        chunk = data[at + 8 : at + 8 + length]
        if len(chunk) < length:
            raise ValueError("the file ends too early")
        if kind == _JSON:
            document = json.loads(chunk.decode("utf-8"))
        elif kind == _BINARY and binary is None:
            binary = chunk
        at += 8 + length
    if not isinstance(document, dict):
        raise ValueError("it holds no document")
    return document, binary


class _Gltf:
    def __init__(self, document: dict[str, Any], binary: bytes | None, file: Path) -> None:
        self._document = document
        self._binary = binary
        self._file = file
        self._buffers: dict[int, bytes] = {}
        packed = set(document.get("extensionsRequired", ())) & set(_NEEDED_EXTENSIONS)
        if packed:
            raise ValueError(f"it is compressed by {', '.join(sorted(packed))}")

    def surface(self) -> tuple[Array, Indices]:
        """All triangles of the default scene."""
        vertices, triangles, count = [np.zeros((0, 3))], [np.zeros((0, 3), dtype=np.int64)], 0
        for mesh, matrix in self._placed():
            for primitive in self._list("meshes")[mesh]["primitives"]:
                own = self._triangles(primitive)
                if own is None:
                    continue
                points = self._accessor(primitive["attributes"]["POSITION"], 3)
                if len(own) and int(own.max()) >= len(points):
                    raise ValueError("a triangle names a vertex that does not exist")
                mirrored = np.linalg.det(matrix[:3, :3]) < 0
                vertices.append(points @ matrix[:3, :3].T + matrix[:3, 3])
                triangles.append((own[:, ::-1] if mirrored else own) + count)
                count += len(points)
                if sum(len(item) for item in triangles) > MAXIMUM_TRIANGLES:
                    raise ValueError("it holds too many triangles")
        return np.concatenate(vertices), np.concatenate(triangles)

    def _list(self, key: str) -> list[Any]:
        found = self._document.get(key, [])
        if not isinstance(found, list):
            raise ValueError(f"{key} is no list")
        return found

    def _placed(self) -> Iterator[tuple[int, Array]]:
        """Meshes with their transforms to the scene; all meshes as they are where there is no scene."""
        scenes = self._list("scenes")
        if not scenes:
            yield from ((index, np.eye(4)) for index in range(len(self._list("meshes"))))
            return
        roots = scenes[self._document.get("scene", 0)].get("nodes", [])
        waiting = [(int(node), np.eye(4), 0) for node in reversed(roots)]
        while waiting:
            index, above, depth = waiting.pop()
            if depth > MAXIMUM_DEPTH:
                raise ValueError(f"nodes are nested deeper than {MAXIMUM_DEPTH}")
            node = self._list("nodes")[index]
            matrix = above @ _transform(node)
            if "mesh" in node:
                yield int(node["mesh"]), matrix
            waiting += [(int(child), matrix, depth + 1) for child in reversed(node.get("children", []))]

    def _triangles(self, primitive: dict[str, Any]) -> Indices | None:
        """Corners of a primitive's triangles; None for points and lines."""
        mode = primitive.get("mode", _TRIANGLES)
        if mode not in (_TRIANGLES, _STRIP, _FAN):
            return None
        if "indices" in primitive:
            corners = self._accessor(primitive["indices"], 1).astype(np.int64).ravel()
        else:
            corners = np.arange(len(self._accessor(primitive["attributes"]["POSITION"], 3)), dtype=np.int64)
        if mode == _TRIANGLES:
            return corners[: len(corners) // 3 * 3].reshape(-1, 3)
        steps = np.arange(max(len(corners) - 2, 0))
        if mode == _FAN:
            return np.column_stack([np.full(len(steps), corners[0]), corners[steps + 1], corners[steps + 2]])
        odd = steps % 2
        return np.column_stack([corners[steps], corners[steps + 1 + odd], corners[steps + 2 - odd]])

    def _accessor(self, index: int, width: int) -> Array:
        """Values of an accessor, shape (count, width)."""
        accessor = self._list("accessors")[index]
        kind = np.dtype(_COMPONENTS[accessor["componentType"]])
        if {"SCALAR": 1, "VEC3": 3}.get(accessor["type"]) != width or "sparse" in accessor:
            raise ValueError(f"accessor {index} is of a kind that is not read")
        count = int(accessor["count"])
        view = self._list("bufferViews")[accessor["bufferView"]]
        start = int(view.get("byteOffset", 0)) + int(accessor.get("byteOffset", 0))
        stride = int(view.get("byteStride", 0)) or kind.itemsize * width
        data = self._buffer(view["buffer"])
        if min(count, start) < 0 or stride < kind.itemsize * width:
            raise ValueError(f"accessor {index} is out of range")
        if count and start + (count - 1) * stride + kind.itemsize * width > len(data):
            raise ValueError("the file ends too early")
        values = np.ndarray((count, width), kind, data, start, (stride, kind.itemsize))
        return values.astype(np.float64)

    def _buffer(self, index: int) -> bytes:
        if index not in self._buffers:
            uri = self._list("buffers")[index].get("uri")
            if uri is None:
                if self._binary is None:
                    raise ValueError("it names a binary part that is not there")
                self._buffers[index] = self._binary
            elif uri.startswith("data:"):
                try:
                    self._buffers[index] = base64.b64decode(uri.partition(",")[2], validate=True)
                except binascii.Error as error:
                    raise ValueError(f"embedded data cannot be decoded: {error}") from error
            else:
                target = resolve_inside(self._file.parent, uri, Place(file=self._file))
                with target.open("rb") as stream:
                    self._buffers[index] = stream.read(MAXIMUM_BUFFER)
        return self._buffers[index]


def _transform(node: dict[str, Any]) -> Array:
    """A node's transform to its parent, shape (4, 4)."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    x, y, z, w = (float(value) for value in node.get("rotation", (0, 0, 0, 1)))
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)), dtype=np.float64)
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix
