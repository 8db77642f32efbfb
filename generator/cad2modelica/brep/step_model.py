"""What a STEP file holds: shapes with their meshes and faces, and where each occurs; lengths in m."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.errors import InputError

from cad2modelica.brep.kernel_run import run_kernel
from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array, Pose, nearest_rotation

MILLIMETRE = 1e-3


@dataclass(frozen=True, eq=False)
class Face:
    """A face of a shape, in the shape's axes.

    Attributes:
        kind: "plane", "cylinder", "cone", "sphere" or "other".
        point: of the plane or the axis, or the centre, shape (3,), m.
        axis: unit vector of the axis or (either way) the plane's normal, shape (3,).
        radius: of a cylinder or sphere, or a cone's at its point, m.
        triangles: first and last but one of the shape's triangles that the face has.
    """

    kind: str
    point: Array
    axis: Array
    radius: float
    triangles: tuple[int, int]


@dataclass(frozen=True, eq=False)
class Shape:
    """A body or several that are one product.

    Attributes:
        vertices: shape (n, 3), m.
        triangles: shape (m, 3), counter-clockwise seen from outside.
        color: red, green, blue from 0 to 1; None where the file has none.
        volume: of its solids, m3; 0 of surfaces alone.
        center: of the volume, shape (3,), m.
        inertia: about the centre at density 1, shape (3, 3), m5.
    """

    name: str
    vertices: Array
    triangles: Indices
    color: tuple[float, float, float] | None
    volume: float
    center: Array
    inertia: Array
    faces: tuple[Face, ...]


@dataclass(frozen=True, eq=False)
class Occurrence:
    """A shape in the assembly.

    Attributes:
        path: for every level, from the top, the name of the instance and that of its product.
        pose: of the shape in the file's coordinates.
        color: of the instance, where it has one.
    """

    path: tuple[tuple[str, str], ...]
    shape: Shape
    pose: Pose
    color: tuple[float, float, float] | None


@dataclass(frozen=True, eq=False)
class StepModel:
    """All that a STEP file places; ``name`` is its root product's."""

    name: str
    occurrences: tuple[Occurrence, ...]


def read_step(file: Path, deflection: float | None = None) -> StepModel:
    """Reads a STEP file.

    Args:
        file: the file.
        deflection: largest distance of the triangles from the faces, m; None: a thousandth of each part's size.

    Raises:
        InputError: the kernel is not installed, the file is none that it reads, or reading takes too long.
    """
    found = read_step_files([file], deflection)[file]
    if isinstance(found, InputError):
        raise found
    return found


def read_step_files(files: Sequence[Path], deflection: float | None = None) -> dict[Path, StepModel | InputError]:
    """Reads several files in one run of the kernel; each gives a model or the error that ``read_step`` raises."""
    distinct = list(dict.fromkeys(files))
    results = run_kernel(distinct, deflection / MILLIMETRE if deflection is not None else None)
    return {
        file: result if isinstance(result, InputError) else _model(file, *result)
        for file, result in zip(distinct, results, strict=True)
    }


def _model(file: Path, manifest: dict[str, Any], arrays: dict[str, Any]) -> StepModel:
    shapes = [
        _shape(item, arrays[f"vertices {number}"], arrays[f"triangles {number}"])
        for number, item in enumerate(manifest["shapes"])
    ]
    occurrences = tuple(
        Occurrence(
            tuple((instance, product) for instance, product in item["path"]),
            shapes[item["shape"]],
            _pose(item["pose"]),
            _color(item["color"]),
        )
        for item in manifest["occurrences"]
    )
    return StepModel(next((name for name in manifest["roots"] if name), file.stem), occurrences)


def _shape(item: dict[str, Any], vertices: Array, triangles: Indices) -> Shape:
    return Shape(
        name=item["name"],
        vertices=vertices * MILLIMETRE,
        triangles=triangles,
        color=_color(item["color"]),
        volume=item["volume"] * MILLIMETRE**3,
        center=np.array(item["center"]) * MILLIMETRE,
        inertia=np.array(item["inertia"]).reshape(3, 3) * MILLIMETRE**5,
        faces=tuple(_face(face) for face in item["faces"]),
    )


def _face(item: dict[str, Any]) -> Face:
    return Face(
        kind=item["kind"],
        point=np.array(item["point"]) * MILLIMETRE,
        axis=np.array(item["axis"]),
        radius=item["radius"] * MILLIMETRE,
        triangles=(item["triangles"][0], item["triangles"][1]),
    )


def _pose(rows: list[list[float]]) -> Pose:
    matrix = np.array(rows)
    return Pose(matrix[:, 3] * MILLIMETRE, nearest_rotation(matrix[:, :3])[0])


def _color(values: list[float] | None) -> tuple[float, float, float] | None:
    if values is None:
        return None
    red, green, blue = np.clip(values, 0.0, 1.0)
    return float(red), float(green), float(blue)
