"""Geometry of a robot description's links: primitives and mesh files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError
from lxml import etree

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.primitive_meshes import (
    Surface,
    along_z,
    box_surface,
    capsule_surface,
    cylinder_surface,
    sphere_surface,
)
from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.meshio.mesh_library import MeshLibrary, scaled
from cad2modelica.meshio.mesh_reference import MeshReferences
from cad2modelica.source.shape_lengths import require_lengths
from cad2modelica.urdf.elements import UrdfElements

DEFAULT_COLOR = (0.7, 0.7, 0.7)

_LENGTHS = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length"), "capsule": ("radius", "length")}


class UrdfGeometry:
    """Reads ``visual`` and ``collision`` elements of one robot.

    Args:
        root: the element ``robot``, which defines colours.
        elements: reads attributes.
        opened: folders that meshes may be read from beside the description's own.
    """

    def __init__(self, root: etree._Element, elements: UrdfElements, opened: Sequence[Path]) -> None:
        self._elements = elements
        self._library = MeshLibrary(MeshReferences(elements.file, opened))
        self._materials = {element.get("name"): element for element in root.iterchildren("material")}

    def mesh(self, element: etree._Element, link: str, inner: Pose) -> Mesh:
        """The geometry of one ``visual`` or ``collision``.

        Args:
            element: it.
            link: the link's name.
            inner: the link's pose in the part it belongs to.

        Returns:
            A mesh in the part's coordinates, m.

        Raises:
            UnreadableMesh: its file cannot be read.
            ImpossibleShape: its lengths are those of no shape.
            InputError: the geometry is missing, or of an unknown kind.
        """
        geometry = element.find("geometry")
        shape = next(iter(geometry), None) if geometry is not None else None
        if shape is None:
            raise InputError(
                "names no geometry", place=self._elements.place(element, link), remedy="Add box, sphere, ... or mesh."
            )
        vertices, triangles = self._surface(shape, link)
        pose = inner @ self._elements.origin(element)
        return Mesh(link, pose.point(vertices), triangles, self._color(element))

    def _surface(self, shape: etree._Element, link: str) -> Surface:
        kind = str(shape.tag)
        place = self._elements.place(shape, link)
        if kind == "mesh":
            surface = self._library.surface(shape.get("filename", ""), place)
            return scaled(surface, self._elements.numbers(shape, "scale", (1.0, 1.0, 1.0)), place)
        if kind not in _LENGTHS:
            remedy = f"Known: {', '.join(_LENGTHS)}, mesh."
            raise InputError(f"geometry of type {kind!r} is not known", place=place, remedy=remedy)
        values = [self._length(shape, key) for key in _LENGTHS[kind]]
        require_lengths(kind, np.concatenate(values), place)
        return _primitive(kind, values)

    def _length(self, shape: etree._Element, key: str) -> Array:
        if shape.get(key) is None:
            return np.array([np.nan])
        return self._elements.numbers(shape, key, (1.0, 1.0, 1.0) if key == "size" else (1.0,))

    def _color(self, element: etree._Element) -> tuple[float, float, float]:
        material = element.find("material")
        if material is None:
            return DEFAULT_COLOR
        if material.find("color") is None:
            material = self._materials.get(material.get("name"), material)
        color = material.find("color")
        red, green, blue, _ = np.clip(self._elements.numbers(color, "rgba", (*DEFAULT_COLOR, 1.0)), 0.0, 1.0)
        return float(red), float(green), float(blue)


def _primitive(kind: str, values: list[Array]) -> Surface:
    if kind == "box":
        return box_surface(values[0])
    radius = float(values[0][0])
    if kind == "sphere":
        return sphere_surface(radius)
    build = cylinder_surface if kind == "cylinder" else capsule_surface
    return along_z(build(radius, float(values[1][0])))
