"""Visuals and collisions of links: surfaces, solids, surface parameters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from contact_foundation.errors import InputError
from lxml import etree

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.primitive_integrals import solid_moments
from cad2modelica.geometry.primitive_meshes import (
    Surface,
    along_z,
    box_surface,
    capsule_surface,
    cone_surface,
    cylinder_surface,
    ellipsoid_surface,
    sphere_surface,
)
from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.mechanism.mass_properties import placed, solid_mass
from cad2modelica.mechanism.model import MassProperties
from cad2modelica.meshio.mesh_library import MeshLibrary, scaled
from cad2modelica.sdf.elements import SdfElements
from cad2modelica.source.shape_lengths import require_lengths

DEFAULT_COLOR = (0.7, 0.7, 0.7)
PLANE = "plane"
KINDS = ("box", "sphere", "cylinder", "capsule", "ellipsoid", "cone", "mesh")
LENGTHS = {"sphere": 1, "box": 3, "ellipsoid": 3}
"""Numbers that give a shape's size; those of other shapes are two."""
ALL_BITS = 0xFFFF


@dataclass(frozen=True, eq=False)
class Solid:
    """A shape in its own axes.

    Attributes:
        size: half lengths, radius and half length, or semi-axes, m; of a mesh nothing.
    """

    kind: str
    surface: Surface
    size: Array

    def mass(self, density: float) -> tuple[MassProperties, bool]:
        """Mass properties at a density (kg/m3), and whether they are the solid's own, not those of its hull."""
        if self.kind == "mesh":
            return solid_mass([Mesh("", *self.surface, DEFAULT_COLOR)], density)
        volume, moments = solid_moments(self.kind, self.size)
        center = np.array([0.0, 0.0, -self.size[1] / 2 if self.kind == "cone" else 0.0])
        return MassProperties(density * volume, center, density * np.diag(moments)), True


@dataclass(frozen=True)
class SurfaceParameters:
    """What a collision says about contact: friction, restitution (None: nothing), and its bits."""

    friction: float = 1.0
    restitution: float | None = None
    bits: int = ALL_BITS


def geometry_of(element: etree._Element) -> etree._Element | None:
    """The one shape in a visual or collision; None if there is none, or ``empty``."""
    geometry = element.find("geometry")
    shape = next((child for child in geometry if isinstance(child.tag, str)), None) if geometry is not None else None
    return None if shape is None or shape.tag == "empty" else shape


def read_solid(shape: etree._Element, elements: SdfElements, library: MeshLibrary) -> Solid:
    """A shape, but no plane.

    Raises:
        UnreadableMesh: the file of a mesh cannot be read.
        ImpossibleShape: its lengths are those of no shape.
        InputError: it is of another kind, or wrong.
    """
    kind = str(shape.tag)
    place = elements.place(shape)
    if kind == "mesh":
        if shape.find("submesh") is not None:
            name = elements.text(shape, "submesh/name")
            elements.notes.append(f"{place}: the whole mesh stands for its part {name!r}")
        surface = library.surface(elements.text(shape, "uri"), place)
        scale = elements.numbers(shape, "scale", (1.0, 1.0, 1.0))
        return Solid(kind, scaled(surface, scale, place), np.zeros(3))
    if kind not in KINDS:
        raise InputError(
            f"geometry of kind {kind!r} is not read", place=place, remedy=f"Known: {PLANE}, {', '.join(KINDS)}."
        )
    size = _size(shape, kind, elements)
    require_lengths(kind, size[: LENGTHS.get(kind, 2)], place)
    return Solid(kind, _surface(kind, size), size)


def _size(shape: etree._Element, kind: str, elements: SdfElements) -> Array:
    if kind == "box":
        return elements.numbers(shape, "size", (1.0, 1.0, 1.0)) / 2
    if kind == "ellipsoid":
        return elements.numbers(shape, "radii", (1.0, 1.0, 1.0))
    radius = elements.number(shape, "radius", 0.5 if kind in ("capsule", "cone") else 1.0)
    return np.array([radius, 1.0 if kind == "sphere" else elements.number(shape, "length", 1.0) / 2, 1.0])


def _surface(kind: str, size: Array) -> Surface:
    radius, half = float(size[0]), float(size[1])
    if kind == "box":
        return box_surface(2 * size)
    if kind == "ellipsoid":
        return ellipsoid_surface(size)
    if kind == "sphere":
        return sphere_surface(radius)
    build = {"cylinder": cylinder_surface, "capsule": capsule_surface, "cone": cone_surface}[kind]
    return along_z(build(radius, 2 * half))


def placed_mesh(name: str, solid: Solid, pose: Pose, color: tuple[float, float, float]) -> Mesh:
    """A solid's surface at a pose."""
    return Mesh(name, pose.point(solid.surface[0]), solid.surface[1], color)


def placed_mass(solid: Solid, density: float, pose: Pose) -> tuple[MassProperties, bool]:
    """A solid's mass properties at a pose."""
    own, exact = solid.mass(density)
    return placed(own, pose), exact


def color_of(element: etree._Element, elements: SdfElements) -> tuple[float, float, float]:
    """The diffuse colour of a visual."""
    material = element.find("material")
    if material is None or material.find("diffuse") is None:
        return DEFAULT_COLOR
    text = elements.text(material, "diffuse").split()
    default = (*DEFAULT_COLOR, 1.0) if len(text) == 4 else DEFAULT_COLOR
    values = np.clip(elements.numbers(material, "diffuse", default), 0.0, 1.0)
    return float(values[0]), float(values[1]), float(values[2])


def surface_parameters(element: etree._Element, elements: SdfElements) -> SurfaceParameters:
    """Friction, restitution and bits of a collision."""
    surface = element.find("surface")
    if surface is None:
        return SurfaceParameters()
    mu = elements.number(surface, "friction/ode/mu", np.nan)
    if np.isnan(mu):
        mu = elements.number(surface, "friction/bullet/friction", 1.0)
    restitution = None
    if surface.find("bounce/restitution_coefficient") is not None:
        restitution = float(np.clip(elements.number(surface, "bounce/restitution_coefficient", 0.0), 0.0, 1.0))
    text = elements.text(surface, "contact/collide_bitmask") or str(ALL_BITS)
    try:
        bits = int(text, 0)
    except ValueError:
        bits = ALL_BITS
    if elements.flag(surface, "contact/collide_without_contact"):
        bits = 0
    return SurfaceParameters(max(mu, 0.0), restitution, bits)
