"""Bodies of the tree as parts: geometry, mass and material of all that is fixed to each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from contact_foundation.errors import CmbError
from contact_foundation.progress import Progress

from cad2modelica.geometry.spatial import Pose
from cad2modelica.mechanism.mass_properties import NO_MASS, placed, together
from cad2modelica.mechanism.model import GROUND, MassProperties, Material, Part, Plane
from cad2modelica.mechanism.rigid_part import Member, rigid_part
from cad2modelica.meshio.mesh_library import UnreadableMesh, report_unreadable
from cad2modelica.mjcf.assets import MjcfAssets
from cad2modelica.mjcf.bodies import Body, BodyTree, PlacedItem
from cad2modelica.mjcf.document import place_of
from cad2modelica.mjcf.elements import Compiler, Item, MjcfElements
from cad2modelica.mjcf.geoms import Geom, friction_of, masks_of, read_geom
from cad2modelica.source.choices import SourceChoices
from cad2modelica.source.lost import Lost
from cad2modelica.source.number_limits import SMALLEST


@dataclass
class MjcfParts:
    """All that has geometry or mass.

    Attributes:
        parts: by name, in the order of the bodies.
        hosts: the part (or ``GROUND``) that each body belongs to.
        geoms: that collide, by part.
        planes: of the world, with their masks.
        of_geom: the part or plane of every geom that has a name.
        materials: one for each coefficient of friction.
    """

    parts: dict[str, Part] = field(default_factory=dict)
    hosts: dict[str, str] = field(default_factory=dict)
    geoms: dict[str, list[Geom]] = field(default_factory=dict)
    planes: list[tuple[Plane, tuple[int, int]]] = field(default_factory=list)
    of_geom: dict[str, str] = field(default_factory=dict)
    materials: dict[str, Material] = field(default_factory=dict)


class PartReader:
    """Reads geoms and masses.

    Args:
        tree: the bodies.
        elements: reads attributes.
        assets: meshes and colours.
        in_pairs: names of geoms in explicit contact pairs.
        choices: what becomes of meshes that cannot be read.
    """

    def __init__(
        self, tree: BodyTree, elements: MjcfElements, assets: MjcfAssets, in_pairs: set[str], choices: SourceChoices
    ) -> None:
        self._tree = tree
        self._elements = elements
        self._assets = assets
        self._in_pairs = in_pairs
        self._allow_missing = choices.allow_missing
        self._unreadable: list[UnreadableMesh] = []
        self._found = MjcfParts()
        self._height_fields = 0
        self._standing_mass = 0.0  # of bodies that stand in the world, where a total mass is asked for

    def read(self, progress: Progress) -> MjcfParts:
        """All parts of the tree."""
        bodies = list(self._tree.bodies.values())
        members: dict[str, list[Member]] = {}
        for number, body in enumerate(bodies, start=1):
            progress("read geometry", number / len(bodies), body.name)
            member, geoms = self._member(body)
            members.setdefault(body.host, []).append(member)
            self._found.geoms.setdefault(body.host, []).extend(geom for geom in geoms if geom.colliding is not None)
        report_unreadable(self._unreadable, self._elements.problems)
        if self._height_fields:
            note = f"{self._height_fields} height field{'s are' if self._height_fields > 1 else ' is'} left out"
            self._elements.notes.append(Lost(f"{note}: shapes of ground here are planes and bodies"))
        members = self._scaled(members)
        for body in bodies:
            if body.host == body.name:
                self._add_part(body, members[body.name])
        for body in bodies:
            self._found.hosts[body.name] = body.host if body.host in self._found.parts else GROUND
        return self._found

    # ----- geometry -----

    def _member(self, body: Body) -> tuple[Member, list[Geom]]:
        compiler = self._elements.compiler
        from_geoms = compiler.from_geometry == "true" or (compiler.from_geometry == "auto" and body.inertial is None)
        geoms: list[Geom] = []
        lightest = NO_MASS
        for entry in body.geoms:
            geom = self._geom(body, entry, from_geoms and self._weighs(body))
            if geom is not None:
                geoms.append(geom)
        if from_geoms:
            lightest = together(geom.mass for geom in geoms)
        if body.inertial is not None and not lightest.mass > 0:  # it also counts where no geom weighs anything
            lightest = self._inertial(body.inertial)
        mass = self._bounded(lightest) if self._weighs(body) else NO_MASS
        if mass.mass > 0 and not lightest.mass > 0 and body.inertial is None:
            mass = self._without_geoms(body, mass)
        if body.is_static:
            self._standing_mass += mass.mass
        return (
            Member(
                body.name,
                [geom.shown for geom in geoms if geom.visible],
                [geom.colliding for geom in geoms if geom.colliding is not None],
                mass if not body.is_static else NO_MASS,
            ),
            geoms,
        )

    def _weighs(self, body: Body) -> bool:
        """Whether the mass of a body counts: it moves, or has a share in the total mass that is asked for."""
        return not body.is_static or (self._elements.compiler.total_mass > 0 and body.parent is not None)

    def _geom(self, body: Body, entry: PlacedItem, with_mass: bool) -> Geom | None:
        item = entry.item
        kind = item.text("type")
        if kind == "plane":
            self._plane(body, entry)
            return None
        if kind == "hfield":
            self._height_fields += 1
            return None
        low, high = self._elements.compiler.groups
        counts = low <= self._elements.integer(item, "group", 0) <= high
        try:
            geom = read_geom(
                item,
                entry.inner,
                self._assets,
                self._elements,
                in_pair=item.name in self._in_pairs,
                with_mass=with_mass and counts,
            )
        except UnreadableMesh as error:
            if self._allow_missing:
                reason = ". ".join(line.strip().rstrip(".") for line in str(error).splitlines())
                self._elements.notes.append(Lost(f"body {body.name!r}: geometry left out: {reason}"))
            else:
                self._unreadable.append(error)
            return None
        except CmbError as error:
            self._elements.problems.record(error)
            return None
        if item.name:
            self._found.of_geom[item.name] = body.host
        return geom

    def _plane(self, body: Body, entry: PlacedItem) -> None:
        """A plane of the world; those of bodies are left out, for they would have to move."""
        item = entry.item
        masks = masks_of(item, self._elements)
        if not any(masks) and item.name not in self._in_pairs:
            return
        if not body.is_static:
            self._elements.notes.append(Lost(f"body {body.name!r}: a plane that moves is left out"))
            return
        pose = self._tree.bodies[body.host].world @ entry.inner @ self._elements.pose(item)
        taken = {*self._tree.bodies, *(plane.name for plane, _ in self._found.planes)}
        name = item.name or "floor"
        while name in taken or name == GROUND:
            name += " plane"
        material = self._material([friction_of(item, self._elements)])
        plane = Plane(name, material, pose.position, pose.rotation[:, 2].copy(), place_of(self._elements, item))
        self._found.planes.append((plane, masks))
        if item.name:
            self._found.of_geom[item.name] = name

    def _material(self, coefficients: Sequence[float]) -> str | None:
        """The material of the largest of these coefficients of friction; None if there are none."""
        if not coefficients:
            return None
        value = max(coefficients)
        name = f"friction {value:g}"
        self._found.materials[name] = Material(name, static_friction=value, dynamic_friction=value)
        return name

    # ----- mass -----

    def _inertial(self, entry: PlacedItem) -> MassProperties:
        item = entry.item
        mass = self._elements.number(item, "mass")
        place = place_of(self._elements, item)
        if mass < 0 or (0 < mass < SMALLEST):
            self._elements.problems.add(f"mass is {mass:g} kg, but must be positive", place, "Correct the inertial.")
            return NO_MASS
        pose = self._elements.pose(item)
        if item.has("fullinertia"):
            xx, yy, zz, xy, xz, yz = self._elements.numbers(item, "fullinertia", (0.0,) * 6)
            tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        else:
            tensor = np.diag(self._elements.numbers(item, "diaginertia", (0.0, 0.0, 0.0)))
        own = MassProperties(mass, np.zeros(3), tensor)
        return placed(own, entry.inner @ Pose(pose.position, pose.rotation))

    def _bounded(self, properties: MassProperties) -> MassProperties:
        """The mass properties by the compiler's lower bounds."""
        compiler: Compiler = self._elements.compiler
        if compiler.least_mass <= 0 and compiler.least_inertia <= 0 and not compiler.balance:
            return properties
        moments, axes = np.linalg.eigh(properties.inertia)
        moments = np.maximum(moments, compiler.least_inertia)
        if compiler.balance and moments[0] + moments[1] < moments[2]:
            moments = np.full(3, moments.mean())
        mass = max(properties.mass, compiler.least_mass)
        return MassProperties(mass, properties.center_of_mass, (axes * moments) @ axes.T)

    def _without_geoms(self, body: Body, properties: MassProperties) -> MassProperties:
        """The least mass of a body that nothing else gives one, where MuJoCo puts it: at ``pos`` and ``quat`` again."""
        item = Item(body.element, {str(k): str(v) for k, v in body.element.items()})
        pose = self._elements.pose(item)
        if pose.position.any():
            x, y, z = pose.position
            self._elements.notes.append(
                f"body {body.name!r}: no geom gives it a mass; that of boundmass stands at its pos once more, "
                f"({x:g}, {y:g}, {z:g}) in its own axes, as in MuJoCo; an inertial would say where it is meant to be"
            )
        return placed(properties, body.inner @ pose)

    def _scaled(self, members: dict[str, list[Member]]) -> dict[str, list[Member]]:
        """Masses by the total mass that the compiler asks for."""
        wanted = self._elements.compiler.total_mass
        total = self._standing_mass + sum(member.mass.mass for group in members.values() for member in group)
        if wanted <= 0 or total <= 0:
            return members
        factor = wanted / total

        def lighter(mass: MassProperties) -> MassProperties:
            return MassProperties(factor * mass.mass, mass.center_of_mass, factor * mass.inertia)

        return {
            host: [replace(member, mass=lighter(member.mass)) for member in group] for host, group in members.items()
        }

    # ----- parts -----

    def _add_part(self, body: Body, members: Sequence[Member]) -> None:
        geoms = self._found.geoms[body.name]
        has_geometry = any(member.shown or member.colliding for member in members)
        if body.is_static and not has_geometry:
            return
        coefficients = sorted({geom.friction for geom in geoms})
        if len(coefficients) > 1:
            listed = ", ".join(f"{value:g}" for value in coefficients)
            self._elements.notes.append(
                f"body {body.name!r} has geoms of different friction ({listed}); the largest counts for all of it"
            )
        place = self._elements.place(body.element, body.name)
        part, notes = rigid_part(
            body.name, body.world, members, place, grounded=body.is_static, material=self._material(coefficients)
        )
        self._elements.notes += notes
        if not body.is_static and not part.mass_properties.mass > 0 and not self._carries(body):
            self._elements.problems.add(
                f"the body {body.name!r} moves and has no mass", place, "Add an inertial, or geoms with mass."
            )
        if body.weightless and not body.is_static:
            self._elements.notes.append(Lost(f"body {body.name!r}: gravcomp is left out: it feels all of its weight"))
        self._found.parts[body.name] = part

    def _carries(self, body: Body) -> bool:
        """Whether other bodies hang on a body."""
        others = (other for other in self._tree.bodies.values() if other.host != body.name)
        return any(other.parent is not None and other.parent.host == body.name for other in others)
