"""Mesh files that a robot description names: each is read once, and those that cannot be read are reported together."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place

from cad2modelica.geometry.spatial import Array
from cad2modelica.meshio.mesh_files import Surface, read_mesh
from cad2modelica.meshio.mesh_reference import MeshReferences
from cad2modelica.source.number_limits import LARGEST, are_usable
from cad2modelica.source.problems import Problems
from cad2modelica.source.shape_lengths import ImpossibleShape


class UnreadableMesh(InputError):
    """A mesh file that is named, and is not there, must not be read, or holds no mesh."""


class MeshLibrary:
    """Reads mesh files.

    Args:
        references: finds the files that a description names.
    """

    def __init__(self, references: MeshReferences) -> None:
        self._references = references
        self._surfaces: dict[Path, Surface] = {}

    def surface(self, reference: str, place: Place) -> Surface:
        """The surface in a mesh file, read once.

        Raises:
            UnreadableMesh: there is no such file, it must not be read, or it holds no mesh.
        """
        try:
            file = self._references.find(reference, place)
            if file not in self._surfaces:
                self._surfaces[file] = read_mesh(file)
        except InputError as error:
            raise UnreadableMesh(error.message, place=error.place, remedy=error.remedy) from error
        return self._surfaces[file]


def scaled(surface: Surface, scale: Array, place: Place) -> Surface:
    """A surface stretched along its axes; where that mirrors it, its triangles are turned, so that they face outwards.

    Raises:
        ImpossibleShape: a factor is zero.
        InputError: the coordinates are too large then.
    """
    vertices, triangles = surface
    if not scale.all():
        raise ImpossibleShape("scale is zero", place=place, remedy="Correct the scale.")
    placed = vertices * scale
    if not are_usable(placed):
        message = f"scaled coordinates are beyond {LARGEST:g}"
        raise InputError(message, place=place, remedy="Correct the scale or the mesh.")
    return placed, triangles[:, ::-1] if np.prod(scale) < 0 else triangles


def report_unreadable(errors: Sequence[UnreadableMesh], problems: Problems) -> None:
    """Each mesh that cannot be read, or each package that is not there, becomes one problem."""
    by_message: dict[str, list[UnreadableMesh]] = {}
    for error in errors:
        by_message.setdefault(error.message, []).append(error)
    for message, same in by_message.items():
        more = f" ({len(same)} meshes)" if len(same) > 1 else ""
        remedy = f"{same[0].remedy or ''}\n  --allow-missing does without the geometry.".strip()
        problems.record(InputError(message + more, place=same[0].place, remedy=remedy))
