"""Geoms: surfaces, masses in closed form, and what they collide with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from contact_foundation.errors import InputError

from cad2modelica.geometry.convex_hull import hull_surface
from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.primitive_integrals import shell_moments, solid_moments
from cad2modelica.geometry.primitive_meshes import (
    Surface,
    along_z,
    box_surface,
    capsule_surface,
    cylinder_surface,
    ellipsoid_surface,
    sphere_surface,
)
from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.mechanism.mass_properties import NO_MASS, placed
from cad2modelica.mechanism.model import MassProperties
from cad2modelica.mjcf.assets import MjcfAssets
from cad2modelica.mjcf.document import place_of
from cad2modelica.mjcf.elements import Item, MjcfElements, turn_of_z
from cad2modelica.source.number_limits import SMALLEST

DENSITY = 1000.0
SHOWN_GROUPS = 2  # geoms of higher groups are hidden unless one asks for them
LENGTHS = {"sphere": 1, "capsule": 2, "cylinder": 2, "ellipsoid": 3, "box": 3}
FROM_TO = ("capsule", "cylinder", "ellipsoid", "box")


@dataclass(frozen=True, eq=False)
class Geom:
    """A geom in the axes of the part it belongs to.

    Attributes:
        name: as given; empty if it has none.
        kind: sphere, capsule, cylinder, ellipsoid, box, mesh.
        shown: its surface.
        colliding: the surface that collides, the convex hull of a mesh; None if it collides with nothing.
        mass: of the geom; none where the model says so, or where nothing asks for it.
        masks: contype and conaffinity.
        friction: coefficient of sliding friction; 0 where it has none by condim 1.
        visible: whether it is shown by default.
    """

    name: str
    kind: str
    shown: Mesh
    colliding: Mesh | None
    mass: MassProperties
    masks: tuple[int, int]
    friction: float
    visible: bool

    def meets(self, other: Geom) -> bool:
        """Whether the masks of the two let them collide."""
        return bool(self.masks[0] & other.masks[1] or other.masks[0] & self.masks[1])


def masks_of(item: Item, elements: MjcfElements) -> tuple[int, int]:
    """Contype and conaffinity of a geom."""
    return elements.integer(item, "contype", 1), elements.integer(item, "conaffinity", 1)


def friction_of(item: Item, elements: MjcfElements) -> float:
    """Sliding friction of a geom."""
    value = float(elements.numbers(item, "friction", (1.0, 0.005, 0.0001))[0])
    return 0.0 if elements.integer(item, "condim", 3) == 1 else max(value, 0.0)


def read_geom(
    item: Item,
    inner: Pose,
    assets: MjcfAssets,
    elements: MjcfElements,
    *,
    in_pair: bool,
    with_mass: bool,
) -> Geom:
    """A geom that is no plane and no height field.

    Args:
        item: it.
        inner: the pose of the frame that it stands in, in the part's axes.
        assets: meshes and colours.
        elements: reads attributes.
        in_pair: whether an explicit pair names it, so that it collides whatever its masks are.
        with_mass: whether its mass counts.

    Raises:
        UnreadableMesh: the file of its mesh cannot be read.
        InputError: it is wrong.
    """
    kind = item.text("type", "mesh" if item.has("mesh") else "sphere")
    if kind == "mesh" or item.has("mesh"):
        pose = inner @ elements.pose(item)
        surface = assets.surface(item.text("mesh"), item)
        sizes = np.zeros(3)
        if kind != "mesh":
            elements.notes.append(
                f"{elements.place(item.element)}: the mesh {item.text('mesh')!r} stands for the {kind} that would be "
                "fitted to it"
            )
            kind = "mesh"
    elif kind in LENGTHS:
        sizes, local = _sizes(item, kind, elements)
        pose = inner @ local
        surface = _surface(kind, sizes)
    else:
        known = ", ".join(["plane", "hfield", *LENGTHS, "mesh"])
        raise InputError(
            f"geoms of type {kind!r} are not read", place=place_of(elements, item), remedy=f"Known: {known}."
        )
    masks = masks_of(item, elements)
    shown = _mesh(item.name or kind, surface, pose, assets.color(item))
    colliding: Mesh | None = None
    if any(masks) or in_pair:
        hull = hull_surface(surface[0]) if kind == "mesh" else surface
        colliding = _mesh(shown.name, hull or surface, pose, shown.color)
    mass = placed(_mass(item, kind, sizes, assets, elements), pose) if with_mass else NO_MASS
    group = elements.integer(item, "group", 0)
    return Geom(item.name, kind, shown, colliding, mass, masks, friction_of(item, elements), group <= SHOWN_GROUPS)


def _mesh(name: str, surface: Surface, pose: Pose, color: tuple[float, float, float]) -> Mesh:
    return Mesh(name, pose.point(surface[0]), surface[1], color)


def _sizes(item: Item, kind: str, elements: MjcfElements) -> tuple[Array, Pose]:
    """Sizes (radius, half lengths or semi-axes, m) and pose; from the ends of the z axis where these are given."""
    size = elements.numbers(item, "size", (0.0, 0.0, 0.0))
    if item.has("fromto") and kind in FROM_TO:
        ends = elements.numbers(item, "fromto", (0.0,) * 6)
        vector = ends[:3] - ends[3:]
        length = float(np.linalg.norm(vector))
        if not length > SMALLEST:
            raise InputError("fromto names the same point twice", place=place_of(elements, item))
        pose = Pose((ends[:3] + ends[3:]) / 2, turn_of_z(vector / length))
        thick = kind in ("ellipsoid", "box")
        size = np.array([size[0], size[0], length / 2] if thick else [size[0], length / 2, 0.0])
    else:
        pose = elements.pose(item)
    if not (size[: LENGTHS[kind]] > 0).all():
        raise InputError(
            f"a {kind} needs {LENGTHS[kind]} positive number{'s' if LENGTHS[kind] > 1 else ''} as its size",
            place=place_of(elements, item),
            remedy="Correct the size.",
        )
    return size, pose


def _surface(kind: str, size: Array) -> Surface:
    if kind == "box":
        return box_surface(2 * size)
    if kind == "sphere":
        return sphere_surface(float(size[0]))
    if kind == "ellipsoid":
        return ellipsoid_surface(size)
    build = cylinder_surface if kind == "cylinder" else capsule_surface
    return along_z(build(float(size[0]), 2 * float(size[1])))


def _mass(item: Item, kind: str, size: Array, assets: MjcfAssets, elements: MjcfElements) -> MassProperties:
    """Mass properties in the geom's own axes: its mass, or that of its volume (a shell's surface) by its density."""
    given = elements.number(item, "mass") if item.has("mass") else None
    density = elements.number(item, "density", DENSITY)
    if (given or 0.0) < 0 or density < 0:
        raise InputError("mass and density must not be negative", place=place_of(elements, item))
    if given == 0.0 or (given is None and density == 0.0):
        return NO_MASS
    if kind == "mesh":
        found = assets.integrals(item.text("mesh"), item)
        volume, center, inertia = found.volume, found.center, found.inertia
    else:
        volume, moments = (shell_moments if item.text("shellinertia") == "true" else solid_moments)(kind, size)
        center, inertia = np.zeros(3), np.diag(moments)
    factor = given / volume if given is not None else density
    return MassProperties(factor * volume, center, factor * inertia)
