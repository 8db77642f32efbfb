"""Geometry of a robot description's links: primitives and mesh files."""

from __future__ import annotations

import os.path
from pathlib import Path, PurePosixPath

import numpy as np
from contact_foundation.errors import InputError, Place
from lxml import etree

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.primitive_meshes import (
    Surface,
    box_surface,
    capsule_surface,
    cylinder_surface,
    sphere_surface,
)
from cad2modelica.geometry.spatial import Array, Pose, rotation_about
from cad2modelica.meshio.mesh_files import read_mesh
from cad2modelica.source.file_reference import resolve_inside
from cad2modelica.source.number_limits import LARGEST, are_usable
from cad2modelica.urdf.elements import UrdfElements

DEFAULT_COLOR = (0.7, 0.7, 0.7)
PACKAGE = "package://"
PACKAGE_FILE = "package.xml"
LEVELS_OF_PACKAGES = 5

_LENGTHS = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length"), "capsule": ("radius", "length")}


class UrdfGeometry:
    """Reads ``visual`` and ``collision`` elements of one robot.

    Args:
        root: the element ``robot``, which defines colours.
        elements: reads attributes.
    """

    def __init__(self, root: etree._Element, elements: UrdfElements) -> None:
        self._elements = elements
        self._materials = {element.get("name"): element for element in root.iterchildren("material")}
        self._surfaces: dict[Path, Surface] = {}

    def mesh(self, element: etree._Element, link: str, inner: Pose) -> Mesh:
        """The geometry of one ``visual`` or ``collision``.

        Args:
            element: it.
            link: the link's name.
            inner: the link's pose in the part it belongs to.

        Returns:
            A mesh in the part's coordinates, m.

        Raises:
            InputError: the geometry is missing, of an unknown kind, or its file cannot be read.
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
            file = self._file(shape, link)
            if file not in self._surfaces:
                self._surfaces[file] = read_mesh(file)
            vertices, triangles = self._surfaces[file]
            scale = self._elements.numbers(shape, "scale", (1.0, 1.0, 1.0))
            if not scale.all():
                raise InputError("scale is zero", place=place, remedy="Correct the scale.")
            placed = vertices * scale
            if not are_usable(placed):
                message = f"scaled coordinates are beyond {LARGEST:g}"
                raise InputError(message, place=place, remedy="Correct the scale or the mesh.")
            return placed, triangles[:, ::-1] if np.prod(scale) < 0 else triangles
        if kind not in _LENGTHS:
            remedy = f"Known: {', '.join(_LENGTHS)}, mesh."
            raise InputError(f"geometry of type {kind!r} is not known", place=place, remedy=remedy)
        values = [
            self._elements.numbers(shape, key, (0.0, 0.0, 0.0) if key == "size" else (0.0,)) for key in _LENGTHS[kind]
        ]
        if any((value <= 0).any() for value in values):
            raise InputError(f"a {kind} needs positive lengths", place=place, remedy="Correct them.")
        return _primitive(kind, values)

    def _file(self, shape: etree._Element, link: str) -> Path:
        reference = shape.get("filename", "")
        description = self._elements.file
        folder = description.parent
        place = self._elements.place(shape, link)
        if reference.startswith(PACKAGE):
            folder, reference = _in_package(description, reference, place)
        elif ".." in PurePosixPath(reference).parts:
            folder, reference = _inside_package(description, reference)
        return resolve_inside(folder, reference, place)

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
    vertices, triangles = build(radius, float(values[1][0]))
    # URDF's axis lies along z, the mesh's along y.
    return vertices @ rotation_about([1, 0, 0], np.pi / 2).T, triangles


def _in_package(description: Path, reference: str, place: Place) -> tuple[Path, str]:
    """Folder and reference in it, for one that names its ROS package.

    Raises:
        InputError: there is no folder of the package's name, nor such a file beside the description.
    """
    package, _, inner = reference.removeprefix(PACKAGE).partition("/")
    if package in ("", ".", "..") or "\\" in package or "\0" in package:
        raise InputError(f"{reference!r} names no package", place=place, remedy=f"Write {PACKAGE}NAME/FILE.")
    resolved = description.resolve()
    above = resolved.parents[:LEVELS_OF_PACKAGES]
    # The package's own folder if the description lies in it, else one beside.
    candidates = [ancestor for ancestor in resolved.parents if ancestor.name == package]
    candidates += [ancestor / package for ancestor in above if os.path.isdir(ancestor / package)]
    leaves = ".." in PurePosixPath(inner).parts
    holding = [candidate for candidate in candidates if not leaves and os.path.isfile(candidate / inner)]
    if not candidates and not leaves and not os.path.isfile(description.parent / inner):
        raise InputError(
            f"names the package {package!r}, which does not exist: no folder of that name holds {description.name}, or "
            f"lies beside it or one of the {LEVELS_OF_PACKAGES} folders above",
            place=place,
            remedy="Copy the package's folder there.",
        )
    return next(iter(holding + candidates), description.parent), inner


def _inside_package(description: Path, reference: str) -> tuple[Path, str]:
    """Folder and reference in it, for one that climbs but stays in the ROS package that the description lies in."""
    above = description.resolve().parents[:LEVELS_OF_PACKAGES]
    package = next((folder for folder in above if (folder / PACKAGE_FILE).is_file()), None)
    target = Path(os.path.normpath(above[0] / reference))
    if package is None or not target.is_relative_to(package):
        return description.parent, reference
    return package, target.relative_to(package).as_posix()
