"""The hierarchy of a VRML97 file: every shape with the named nodes above it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.errors import InputError, Place

from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array, rotation_about
from cad2modelica.meshio.vrml_prototypes import instance_of
from cad2modelica.meshio.vrml_shapes import WITHOUT_SURFACE, number_field, surface_of
from cad2modelica.meshio.vrml_syntax import ExternalPrototype, Node, Prototype, VrmlDocument, read_vrml
from cad2modelica.source.file_reference import resolve_inside
from cad2modelica.source.lost import Lost

MAXIMUM_DEPTH = 200
MAXIMUM_SHAPES = 200_000
MAXIMUM_TRIANGLES = 5_000_000

DEFAULT_COLOR = (0.8, 0.8, 0.8)

_GROUPS = frozenset({"Group", "Collision", "Anchor", "Billboard"})
_WITHOUT_GEOMETRY_TEXT = """
AudioClip Background ColorInterpolator CoordinateInterpolator CylinderSensor DirectionalLight Fog
NavigationInfo NormalInterpolator OrientationInterpolator PlaneSensor PointLight PositionInterpolator
ProximitySensor ScalarInterpolator Script Sound SphereSensor SpotLight TimeSensor TouchSensor Viewpoint
VisibilitySensor WorldInfo
"""
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:")
_WITHOUT_GEOMETRY = frozenset(_WITHOUT_GEOMETRY_TEXT.split())


@dataclass(frozen=True, eq=False)
class Level:
    """One node on the way from the root to a shape: its DEF name, if any, and its transform (4 x 4) to its parent."""

    name: str | None
    matrix: Array | None


@dataclass(frozen=True, eq=False)
class ShapeInstance:
    """One shape where it stands in the scene.

    Attributes:
        levels: nodes from the root down to the shape itself.
        vertices: in the shape's own coordinates, in the file's unit of length, shape (n, 3).
        triangles: shape (m, 3).
        color: diffuse colour.
        line: where the shape begins in the file that holds it.
    """

    levels: tuple[Level, ...]
    vertices: Array
    triangles: Indices
    color: tuple[float, float, float]
    line: int

    @property
    def path(self) -> str:
        """The DEF names above the shape, joined by slashes."""
        return "/".join(level.name for level in self.levels if level.name) or f"shape at line {self.line}"

    def depth_of(self, name: str) -> int | None:
        """Position in ``levels`` of the outermost node of that DEF name."""
        for depth, level in enumerate(self.levels):
            if level.name == name:
                return depth
        return None

    def placed(self, below: int = -1) -> tuple[Array, Indices]:
        """Vertices and triangles in the coordinates inside the node ``levels[below]``; of the root for -1.

        A transform that mirrors turns the triangles, so that they stay counter-clockwise from outside.
        """
        matrix = np.eye(4)
        for level in self.levels[below + 1 :]:
            if level.matrix is not None:
                matrix = matrix @ level.matrix
        vertices = self.vertices @ matrix[:3, :3].T + matrix[:3, 3]
        mirrored = np.linalg.det(matrix[:3, :3]) < 0
        return vertices, self.triangles[:, ::-1] if mirrored else self.triangles


@dataclass(frozen=True, eq=False)
class VrmlScene:
    """All shapes of a file, those of inlined files included, in the order of the text, and remarks on the reading."""

    file: Path
    shapes: tuple[ShapeInstance, ...]
    notes: tuple[str, ...]


def read_scene(file: Path, folder: Path) -> VrmlScene:
    """Reads a VRML97 file and those it inlines.

    Args:
        file: the VRML file.
        folder: the assembly's folder, which inlined files must not leave.

    Raises:
        InputError: a file cannot be read, inlines itself, is nested too deep or too large.
    """
    walker = _Walker(folder)
    walker.walk_file(file, (), ())
    unknown = [f"node type {name} is not known and was left out" for name in sorted(walker.unknown)]
    notes: list[str] = [Lost(f"{file.name}: {note}") for note in dict.fromkeys((*unknown, *walker.left_out))]
    if walker.curves:
        notes.append(f"{file.name}: {walker.curves} shapes without a surface (lines, points, text) were left out")
    return VrmlScene(file, tuple(walker.shapes), tuple(notes))


class _Walker:
    """Collects shapes top-down."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.shapes: list[ShapeInstance] = []
        self.unknown: set[str] = set()
        self.curves = 0
        self.left_out: list[str] = []
        self._triangles = 0
        self._visits = 0
        self._surfaces: dict[int, tuple[Node, Any]] = {}
        self._documents: dict[Path, VrmlDocument] = {}

    def walk_file(self, file: Path, levels: tuple[Level, ...], files: tuple[Path, ...]) -> None:
        """Collects a file's shapes below ``levels``; ``files`` are those that inline it."""
        for root in self._document(file).roots:
            self._walk(root, levels, (*files, file.resolve()))

    def _document(self, file: Path) -> VrmlDocument:
        if file not in self._documents:
            self._documents[file] = read_vrml(file)
        return self._documents[file]

    def _walk(self, node: Node, levels: tuple[Level, ...], files: tuple[Path, ...]) -> None:
        place = Place(file=node.document.file, line=node.line)
        self._visits += 1
        if len(levels) > MAXIMUM_DEPTH:
            raise InputError(
                f"nodes are nested deeper than {MAXIMUM_DEPTH}", place=place, remedy="Export a flatter scene."
            )
        if self._visits > 10 * MAXIMUM_SHAPES:
            raise InputError("the scene unfolds to too many nodes", place=place, remedy="Export fewer copies (USE).")
        if node.type in node.document.prototypes:
            self._walk_prototype(node, levels, files)
        elif node.type == "Transform":
            matrix = _transform(node, node.document.file)
            if matrix is None:
                self.left_out.append(f"Transform in line {node.line} has scale 0: what is below it was left out")
                return
            self._walk_children(node, (*levels, Level(node.name, matrix)), files)
        elif node.type in _GROUPS:
            self._walk_children(node, (*levels, Level(node.name, None)), files)
        elif node.type == "Switch":
            self._walk_choice(node, levels, files)
        elif node.type == "LOD":
            for child in _nodes(node, "level")[:1]:
                self._walk(child, (*levels, Level(node.name, None)), files)
        elif node.type == "Inline":
            self._walk_inline(node, (*levels, Level(node.name, None)), files)
        elif node.type == "Shape":
            self._add_shape(node, (*levels, Level(node.name, None)))
        elif node.type not in _WITHOUT_GEOMETRY:
            self.unknown.add(node.type)

    def _walk_children(self, node: Node, levels: tuple[Level, ...], files: tuple[Path, ...]) -> None:
        for child in _nodes(node, "children"):
            self._walk(child, levels, files)

    def _walk_choice(self, node: Node, levels: tuple[Level, ...], files: tuple[Path, ...]) -> None:
        which = int(number_field(node, "whichChoice", (-1.0,), node.document.file)[0])
        choices = _nodes(node, "choice")
        if 0 <= which < len(choices):
            self._walk(choices[which], (*levels, Level(node.name, None)), files)

    def _walk_inline(self, node: Node, levels: tuple[Level, ...], files: tuple[Path, ...]) -> None:
        place = Place(file=node.document.file, line=node.line, component="Inline")
        urls = [url for url in _items(node.fields.get("url")) if isinstance(url, str)]
        if not urls:
            return
        target = self._file(urls[0], node.document, place)
        if target.resolve() in files:
            raise InputError(f"{urls[0]!r} inlines itself", place=place, remedy="Remove the circle of Inline nodes.")
        self.walk_file(target, levels, files)

    def _file(self, reference: str, document: VrmlDocument, place: Place) -> Path:
        """The file that a reference in a document means, which lies in the assembly's folder."""
        relative_folder = document.file.parent.relative_to(self._folder)
        return resolve_inside(self._folder, (relative_folder / reference).as_posix() if reference else "", place)

    def _walk_prototype(self, node: Node, levels: tuple[Level, ...], files: tuple[Path, ...]) -> None:
        prototype = node.document.prototypes[node.type]
        if isinstance(prototype, ExternalPrototype):
            loaded = self._load_prototype(prototype, node.document)
            if loaded is None:
                return
            prototype = loaded
        instance = instance_of(prototype, node)
        if instance is not None:
            # A level of its own bounds how deep prototypes of prototypes go.
            self._walk(instance, (*levels, Level(None, None)), files)

    def _load_prototype(self, external: ExternalPrototype, document: VrmlDocument) -> Prototype | None:
        """The prototype in the first file that is named; None where only other places than files are."""
        place = Place(file=document.file, line=external.line, component=f"EXTERNPROTO {external.name}")
        files = [url for url in external.urls if not _SCHEME.match(url)]
        if external.urls and not files:
            self.left_out.append(f"EXTERNPROTO {external.name} names no file: its nodes were left out")
            return None
        reference, _, name = (files[0] if files else "").partition("#")
        target = self._file(reference, document, place)
        found = [item for item in self._document(target).prototypes.values() if isinstance(item, Prototype)]
        matching = [item for item in found if item.name == name] if name else found[:1]
        if not matching:
            raise InputError(
                f"{target.name} defines no PROTO {name or external.name}", place=place, remedy="Correct the reference."
            )
        return matching[0]

    def _add_shape(self, node: Node, levels: tuple[Level, ...]) -> None:
        geometry = node.fields.get("geometry")
        if not isinstance(geometry, Node):
            return
        if geometry.type in WITHOUT_SURFACE:
            self.curves += 1
            return
        # Nodes that USE the same geometry share its surface; the entry keeps the node, and so its id, alive.
        if id(geometry) not in self._surfaces:
            self._surfaces[id(geometry)] = (geometry, surface_of(geometry, geometry.document.file))
        surface = self._surfaces[id(geometry)][1]
        if surface is None:
            self.unknown.add(geometry.type)
            return
        vertices, triangles = surface
        self._triangles += len(triangles)
        if len(self.shapes) >= MAXIMUM_SHAPES or self._triangles > MAXIMUM_TRIANGLES:
            raise InputError(
                f"the scene holds more than {MAXIMUM_SHAPES} shapes or {MAXIMUM_TRIANGLES} triangles",
                place=Place(file=node.document.file, line=node.line),
                remedy="Export with a coarser tessellation.",
            )
        if len(triangles):
            self.shapes.append(ShapeInstance(levels, vertices, triangles, _color(node), node.line))


def _transform(node: Node, file: Path) -> Array | None:
    """T x C x R x SR x S x -SR x -C (ISO/IEC 14772-1, 6.52); None if it hides what is below it (scale 0 0 0)."""
    center = number_field(node, "center", (0.0, 0.0, 0.0), file)
    rotation = _rotation(number_field(node, "rotation", (0.0, 0.0, 1.0, 0.0), file))
    scale = number_field(node, "scale", (1.0, 1.0, 1.0), file)
    orientation = _rotation(number_field(node, "scaleOrientation", (0.0, 0.0, 1.0, 0.0), file))
    translation = number_field(node, "translation", (0.0, 0.0, 0.0), file)
    if not scale.any():
        return None
    if (scale == 0).any():
        raise InputError(
            "Transform: scale is zero in one direction",
            place=Place(file=file, line=node.line),
            remedy="Correct the scale.",
        )
    linear = rotation if (scale == 1).all() else rotation @ orientation @ np.diag(scale) @ orientation.T
    matrix = np.eye(4)
    matrix[:3, :3] = linear
    matrix[:3, 3] = translation + center - linear @ center
    return matrix


def _rotation(values: Array) -> Array:
    if values[3] == 0.0 or not values[:3].any():
        return np.eye(3)
    return rotation_about(values[:3], float(values[3]))


def _color(shape: Node) -> tuple[float, float, float]:
    appearance = shape.fields.get("appearance")
    material = appearance.fields.get("material") if isinstance(appearance, Node) else None
    if not isinstance(material, Node):
        return DEFAULT_COLOR
    red, green, blue = np.clip(number_field(material, "diffuseColor", DEFAULT_COLOR, material.document.file), 0.0, 1.0)
    return float(red), float(green), float(blue)


def _items(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def _nodes(node: Node, name: str) -> list[Node]:
    return [item for item in _items(node.fields.get(name)) if isinstance(item, Node)]
