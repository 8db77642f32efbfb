"""Links as parts: those that fixed joints hold together are one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from contact_foundation.errors import CmbError
from contact_foundation.progress import Progress
from lxml import etree

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import Pose
from cad2modelica.mechanism.mass_properties import placed, together
from cad2modelica.mechanism.model import GROUND, MassProperties, Material, Part, Plane
from cad2modelica.mechanism.rigid_part import Member, rigid_part
from cad2modelica.meshio.mesh_library import UnreadableMesh, report_unreadable
from cad2modelica.sdf.scopes import Link
from cad2modelica.sdf.shapes import (
    PLANE,
    SurfaceParameters,
    color_of,
    geometry_of,
    placed_mass,
    placed_mesh,
    read_solid,
    surface_parameters,
)
from cad2modelica.source.choices import SourceChoices
from cad2modelica.source.lost import Lost
from cad2modelica.source.number_limits import SMALLEST, plain_number
from cad2modelica.source.problems import Problems
from cad2modelica.source.shape_lengths import ImpossibleShape

DENSITY = 1000.0


@dataclass(frozen=True, eq=False)
class Host:
    """The part (or ``GROUND``) that a link belongs to, and the link's pose in it and in the world."""

    part: str
    inner: Pose
    world: Pose


@dataclass
class SdfParts:
    """All that has geometry or mass.

    Attributes:
        parts: by name.
        planes: of bodies that stand.
        materials: by name.
        surfaces: surface parameters of the collisions of parts and planes.
        names: part names of static links without geometry are ``GROUND``.
    """

    parts: dict[str, Part] = field(default_factory=dict)
    planes: list[Plane] = field(default_factory=list)
    materials: dict[str, Material] = field(default_factory=dict)
    surfaces: dict[str, list[SurfaceParameters]] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)


class PartReader:
    """Reads geometry and masses of links.

    Args:
        links: all of them.
        hosts: where each belongs.
        problems: receives what is wrong.
        notes: receives what was left out.
        choices: what becomes of meshes that cannot be read.
    """

    def __init__(
        self,
        links: Sequence[Link],
        hosts: Mapping[str, Host],
        problems: Problems,
        notes: list[str],
        choices: SourceChoices,
    ) -> None:
        self._links = links
        self._hosts = hosts
        self._problems = problems
        self._notes = notes
        self._allow_missing = choices.allow_missing
        self._unreadable: list[UnreadableMesh] = []
        self._found = SdfParts()

    def read(self, standing: set[str], progress: Progress) -> SdfParts:
        """All parts.

        Args:
            standing: names of parts that stand in the world.
            progress: is told which link is being read.
        """
        members: dict[str, list[Member]] = {}
        first: dict[str, Link] = {}
        for number, link in enumerate(self._links, start=1):
            progress("read geometry", number / len(self._links), link.name)
            host = self._hosts[link.name]
            first.setdefault(host.part, link)
            members.setdefault(host.part, []).append(self._member(link, host, host.part in standing))
        report_unreadable(self._unreadable, self._problems)
        for name, link in first.items():
            self._add_part(name, link, members[name], name in standing)
        return self._found

    def _add_part(self, name: str, link: Link, members: Sequence[Member], grounded: bool) -> None:
        if grounded and not any(member.shown or member.colliding for member in members):
            self._found.names[name] = GROUND
            return
        surfaces = self._found.surfaces.get(name, [])
        place = link.scope.elements.place(link.element, name)
        pose = self._hosts[link.name].world
        part, notes = rigid_part(name, pose, members, place, grounded=grounded, material=self._material(name, surfaces))
        self._notes += notes
        self._found.parts[name] = part
        self._found.names[name] = name

    def _material(self, name: str, surfaces: Sequence[SurfaceParameters]) -> str | None:
        if not surfaces:
            return None
        frictions = sorted({surface.friction for surface in surfaces})
        given = sorted({surface.restitution for surface in surfaces if surface.restitution is not None})
        if len(frictions) > 1 or len(given) > 1:
            self._notes.append(
                f"body {name!r} has collisions of different friction or restitution; the smallest counts for all of it"
            )
        friction, restitution = frictions[0], given[0] if given else None
        label = f"friction {friction:g}" + (f" restitution {restitution:g}" if restitution is not None else "")
        self._found.materials[label] = Material(
            label, static_friction=friction, dynamic_friction=friction, restitution=restitution
        )
        return label

    # ----- one link -----

    def _member(self, link: Link, host: Host, grounded: bool) -> Member:
        elements = link.scope.elements
        shown = [mesh for element in link.element.iterchildren("visual") for mesh in self._visual(link, element, host)]
        colliding: list[Mesh] = []
        masses: list[MassProperties] = []
        inertial = link.element.find("inertial")
        by_density = inertial is not None and inertial.get("auto", "false") in ("true", "1")
        for element in link.element.iterchildren("collision"):
            mesh, mass = self._collision(link, element, host, grounded, by_density)
            colliding += mesh
            masses += mass
        if grounded:
            return Member(link.name, shown, colliding)
        for flag in ("gravity", "kinematic"):
            if elements.flag(link.element, flag, flag == "gravity") != (flag == "gravity"):
                text = "gravity is switched off for it" if flag == "gravity" else "it is kinematic"
                self._notes.append(Lost(f"link {link.name!r}: {text}, which is left out: it moves by its mass"))
        lost = {"velocity_decay": "its velocity_decay", "inertial/fluid_added_mass": "the mass that a fluid adds to it"}
        for path, text in lost.items():
            found = link.element.find(path)
            if found is not None and any(any(_numbers_of(item)) for item in found):
                self._notes.append(Lost(f"link {link.name!r}: {text} is left out"))
        if by_density:
            if not masses:
                message = "its mass is to come from its collisions, and there are none"
                self._problems.add(message, elements.place(link.element), "Give a mass.")
            return Member(link.name, shown, colliding, together(masses))
        return Member(link.name, shown, colliding, placed(self._mass(link, inertial), host.inner))

    def _mass(self, link: Link, inertial: etree._Element | None) -> MassProperties:
        """Mass properties in the link's axes; the format's default is 1 kg with unit inertia."""
        elements = link.scope.elements
        if inertial is None:
            self._notes.append(f"link {link.name!r} has no inertial: 1 kg and 1 kg.m2, the format's default")
            return MassProperties(1.0, np.zeros(3), np.eye(3))
        mass = elements.number(inertial, "mass", 1.0)
        if not mass >= SMALLEST:
            message = f"mass is {mass:g} kg, but must be positive"
            self._problems.add(message, elements.place(inertial, link.name), "Correct the inertial.")
            mass = 1.0
        xx, yy, zz = (elements.number(inertial, f"inertia/i{key}", 1.0) for key in ("xx", "yy", "zz"))
        xy, xz, yz = (elements.number(inertial, f"inertia/i{key}", 0.0) for key in ("xy", "xz", "yz"))
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        pose = self._pose(link, inertial)
        return placed(MassProperties(mass, np.zeros(3), tensor), pose)

    def _pose(self, link: Link, element: etree._Element) -> Pose:
        """The pose of something in a link's axes."""
        elements = link.scope.elements
        frame = elements.relative_to(element)
        own = elements.pose(element)
        if not frame:
            return own
        name = link.element.get("name", "")
        return link.scope.frame(name).inverse() @ link.scope.frame(frame) @ own

    def _visual(self, link: Link, element: etree._Element, host: Host) -> list[Mesh]:
        shape = geometry_of(element)
        if shape is None or shape.tag == PLANE:
            return []
        elements = link.scope.elements
        try:
            solid = read_solid(shape, elements, link.scope.library)
        except CmbError as error:
            self._without(link, error)
            return []
        pose = host.inner @ self._pose(link, element)
        return [placed_mesh(link.name, solid, pose, color_of(element, elements))]

    def _collision(
        self, link: Link, element: etree._Element, host: Host, grounded: bool, by_density: bool
    ) -> tuple[list[Mesh], list[MassProperties]]:
        shape = geometry_of(element)
        if shape is None:
            return [], []
        elements = link.scope.elements
        surface = surface_parameters(element, elements)
        if shape.tag == PLANE:
            self._plane(link, element, shape, surface, grounded)
            return [], []
        try:
            solid = read_solid(shape, elements, link.scope.library)
        except CmbError as error:
            self._without(link, error)
            return [], []
        pose = host.inner @ self._pose(link, element)
        masses: list[MassProperties] = []
        if by_density and not grounded:
            fallback = elements.number(link.element, "inertial/density", DENSITY)
            mass, exact = placed_mass(solid, elements.number(element, "density", fallback), pose)
            if not exact:
                self._notes.append(f"link {link.name!r}: a mesh is not closed; its mass is that of its hull")
            masses.append(mass)
        if surface.bits == 0:
            return [], masses
        self._found.surfaces.setdefault(host.part, []).append(surface)
        return [placed_mesh(link.name, solid, pose, color_of(element, elements))], masses

    def _plane(
        self, link: Link, element: etree._Element, shape: etree._Element, surface: SurfaceParameters, grounded: bool
    ) -> None:
        elements = link.scope.elements
        if not grounded:
            self._notes.append(Lost(f"link {link.name!r}: a plane that moves is left out"))
            return
        normal = elements.numbers(shape, "normal", (0.0, 0.0, 1.0))
        length = float(np.linalg.norm(normal))
        if not length > 0:
            self._problems.add("the normal is zero", elements.place(shape), "Give a direction.")
            return
        pose = self._hosts[link.name].world @ self._pose(link, element)
        taken = {*self._hosts, *(plane.name for plane in self._found.planes)}
        name = f"{link.name} plane"
        while name in taken:
            name += " plane"
        self._found.surfaces[name] = [surface]
        material = self._material(name, [surface])
        place = elements.place(shape)
        self._found.planes.append(Plane(name, material, pose.position, pose.direction(normal / length), place))

    def _without(self, link: Link, error: CmbError) -> None:
        """Geometry that cannot be read: an error if it is a mesh's file or impossible, else a note."""
        if isinstance(error, ImpossibleShape):
            self._problems.record(error)
            return
        if isinstance(error, UnreadableMesh) and not self._allow_missing:
            self._unreadable.append(error)
            return
        reason = ". ".join(line.strip().rstrip(".") for line in str(error).splitlines())
        self._notes.append(Lost(f"link {link.name!r}: geometry left out: {reason}"))


def _numbers_of(element: etree._Element) -> list[float]:
    """The numbers in an element's text that are some."""
    found = []
    for word in (element.text or "").split():
        try:
            found.append(plain_number(word))
        except ValueError:
            continue
    return found
