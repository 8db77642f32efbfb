"""Finds each part's geometry in VRML files, and geometry that belongs to no part."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from contact_foundation.errors import CmbError, InputError, Place

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import Pose
from cad2modelica.meshio.vrml_scene import ShapeInstance, VrmlScene, read_scene
from cad2modelica.source.file_reference import resolve_inside
from cad2modelica.source.lost import Lost
from cad2modelica.source.number_limits import LARGEST, are_usable
from cad2modelica.source.units import to_si


@dataclass(frozen=True)
class GeometryReference:
    """What the assembly says about a part's geometry.

    Attributes:
        node: DEF name; None for the whole file.
        coordinates: "node", "file" or "assembly".
        length: factor from the file's unit to metres.
    """

    file: str
    node: str | None
    coordinates: str
    length: float
    place: Place


@dataclass
class GeometryReader:
    """Reads VRML files once each and remembers which shapes found their part.

    Attributes:
        folder: the assembly's folder.
    """

    folder: Path
    _scenes: dict[Path, VrmlScene] = field(default_factory=dict)
    _broken: dict[Path, CmbError] = field(default_factory=dict)
    _matched: dict[Path, set[int]] = field(default_factory=dict)

    def meshes(self, reference: GeometryReference, pose_in_assembly: Pose) -> tuple[Mesh, ...]:
        """The geometry a reference means, in the part's coordinate system, m; one mesh for each named node and colour.

        Raises:
            InputError: the file is missing or broken, or holds no such node, or the node no surface.
        """
        file = resolve_inside(self.folder, reference.file, reference.place)
        scene = self._scene(file)
        chosen = self._choose(scene, reference)
        blocks: dict[tuple[str, tuple[float, float, float]], list[Mesh]] = {}
        for shape, depth in chosen:
            vertices, triangles = shape.placed(depth if reference.coordinates == "node" else -1)
            vertices = to_si(vertices, reference.length)
            if not are_usable(vertices):
                raise InputError(
                    f"{shape.path!r} of {reference.file} reaches farther than {LARGEST:g} m",
                    place=reference.place,
                    remedy="Correct the scales and translations of the Transform nodes above it.",
                )
            if reference.coordinates == "assembly":
                vertices = pose_in_assembly.inverse().point(vertices)
            name = next((level.name for level in reversed(shape.levels) if level.name), file.stem)
            blocks.setdefault((name, shape.color), []).append(Mesh(name, vertices, triangles, shape.color))
        return tuple(_merge(meshes) for meshes in blocks.values())

    def _scene(self, file: Path) -> VrmlScene:
        if file in self._broken:
            raise self._broken[file]
        if file not in self._scenes:
            try:
                self._scenes[file] = read_scene(file, self.folder)
            except CmbError as error:
                self._broken[file] = error
                raise
            self._matched[file] = set()
        return self._scenes[file]

    def notes(self) -> list[str]:
        """Remarks on the reading, and every piece of geometry that no part asked for."""
        notes: list[str] = []
        for file, scene in self._scenes.items():
            notes += scene.notes
            left: dict[str, int] = {}
            for index, shape in enumerate(scene.shapes):
                if index not in self._matched[file]:
                    left[shape.path] = left.get(shape.path, 0) + 1
            notes += [
                Lost(
                    f"{file.name}: geometry {path!r} ({count} shape{'s' if count > 1 else ''}) "
                    "belongs to no part and was left out"
                )
                for path, count in left.items()
            ]
        return notes

    def _choose(self, scene: VrmlScene, reference: GeometryReference) -> list[tuple[ShapeInstance, int]]:
        """Shapes below the named node with the node's depth; of several nodes of that name the first occurrence."""
        matched = self._matched[scene.file]
        if reference.node is None:
            matched.update(range(len(scene.shapes)))
            chosen = [(shape, -1) for shape in scene.shapes]
        else:
            chosen = []
            first: tuple[int, ...] | None = None
            for index, shape in enumerate(scene.shapes):
                depth = shape.depth_of(reference.node)
                if depth is None:
                    continue
                matched.add(index)
                occurrence = tuple(id(level) for level in shape.levels[:depth])
                if first is None:
                    first = occurrence
                if occurrence == first:
                    chosen.append((shape, depth))
        if not chosen:
            names = sorted({level.name for shape in scene.shapes for level in shape.levels if level.name})
            raise InputError(
                f"{reference.file} holds no surface below a node named {reference.node!r}"
                if reference.node is not None
                else f"{reference.file} holds no surface",
                place=reference.place,
                remedy=f"Nodes with surfaces are: {', '.join(names[:30])}." if names else "Export the geometry again.",
            )
        return chosen


def _merge(meshes: list[Mesh]) -> Mesh:
    offsets = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])[:-1]
    vertices = np.concatenate([mesh.vertices for mesh in meshes])
    triangles = np.concatenate([mesh.triangles + offset for mesh, offset in zip(meshes, offsets, strict=True)])
    return Mesh(meshes[0].name, vertices, triangles, meshes[0].color)
