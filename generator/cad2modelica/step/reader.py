"""STEP assemblies to the model: parts from the file, bodies and joints from the joints file beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import networkx as nx
from contact_foundation.errors import InputError, Place
from contact_foundation.progress import Progress, silent

from cad2modelica.brep.step_model import Shape, read_step
from cad2modelica.geometry.mesh import Mesh
from cad2modelica.mechanism.description_defaults import DECOMPOSED_TRIANGLES
from cad2modelica.mechanism.mass_properties import NO_MASS, placed, solid_mass, together
from cad2modelica.mechanism.model import (
    GROUND,
    Assembly,
    CollisionChoice,
    ContactSettings,
    DecompositionLimits,
    Joint,
    JointType,
    MassProperties,
    Part,
)
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices
from cad2modelica.source.lost import Lost
from cad2modelica.step.joints_file import FileJoint, JointsFile, joints_file_of, read_joints_file
from cad2modelica.step.parts import NamedPart, named_parts

MILLIMETRE = 1e-3
DEFAULT_COLOR = (0.7, 0.7, 0.7)


def read_step_assembly(path: Path, progress: Progress = silent, choices: SourceChoices = DEFAULT_CHOICES) -> Assembly:
    """Reads a STEP file with the joints file beside it.

    Parts of one body become one part, with the name of the heaviest; parts that no body and no joint names move freely.

    Args:
        path: the STEP file.
        progress: is told what is being read.
        choices: density, tessellation.

    Raises:
        InputError: the input is wrong, the CAD kernel or the joints file is missing, or a part has no mass.
    """
    return _StepAssembly(path, progress, choices).read()


class _StepAssembly:
    def __init__(self, path: Path, progress: Progress, choices: SourceChoices) -> None:
        self._file = path
        self._progress = progress
        self._choices = choices
        self._notes: list[str] = []

    def read(self) -> Assembly:
        joints_path = joints_file_of(self._file)
        self._progress("read geometry", 0.0, self._file.name)
        model = read_step(self._file, self._choices.tessellation)
        parts = named_parts(model)
        if not parts:
            raise InputError("holds no surface", place=Place(file=self._file), remedy="Export solids.")
        if not joints_path.is_file():
            raise InputError(
                f"STEP says nothing about motion, and there is no {joints_path.name} beside it",
                place=Place(file=self._file),
                remedy=f"Have joints proposed from the faces, then correct them: cmb joints {self._file}",
            )
        given = read_joints_file(joints_path, [part.name for part in parts])
        kept = tuple(part for part in parts if part.name not in given.leave_out)
        hosts = self._hosts(kept, given)
        masses = {part.name: self._mass(part, given) for part in kept}
        bodies, names = self._bodies(kept, hosts, masses, given)
        joints = [self._joint(item, {name: names[hosts[name]] for name in hosts}, joints_path) for item in given.joints]
        return Assembly(
            name=model.name,
            source="STEP",
            file=self._file,
            parts=tuple(bodies),
            joints=tuple(joint for joint in joints if joint is not None),
            contacts=ContactSettings(decomposition=DecompositionLimits(triangles=DECOMPOSED_TRIANGLES)),
            notes=tuple(self._notes),
            length_unit=MILLIMETRE,
            limits_stop=False,
            aliases={part.name: names[hosts[part.name]] for part in kept},
        )

    def _hosts(self, parts: tuple[NamedPart, ...], given: JointsFile) -> dict[str, str]:
        """For every part one that stands for its body: ``GROUND`` for what stands in the world."""
        union: nx.utils.UnionFind[str] = nx.utils.UnionFind([GROUND, *(part.name for part in parts)])
        for group in given.bodies:
            for name in group[1:]:
                union.union(group[0], name)
        for name in given.ground:
            union.union(GROUND, name)
        for joint in given.joints:
            if joint.type is JointType.FIXED:
                union.union(joint.parent, joint.child)
        first: dict[str, str] = {union[GROUND]: GROUND}
        return {part.name: first.setdefault(union[part.name], part.name) for part in parts} | {GROUND: GROUND}

    def _mass(self, part: NamedPart, given: JointsFile) -> MassProperties:
        """By the part's own mass or density, else the file's or the one asked for."""
        shape = part.occurrence.shape
        density = given.densities.get(part.name, self._choices.density or given.density)
        unit, doubt = _unit_density(shape)
        wanted = given.masses.get(part.name)
        if wanted is not None:
            density = wanted / unit.mass if unit.mass > 0 else None
        if density is None or unit.mass <= 0:
            return NO_MASS
        if doubt:
            self._notes.append(f"part {part.name!r} has no solid: its mass is that of its surfaces' inside or hull")
        return MassProperties(density * unit.mass, unit.center_of_mass, density * unit.inertia)

    def _bodies(
        self,
        parts: tuple[NamedPart, ...],
        hosts: Mapping[str, str],
        masses: Mapping[str, MassProperties],
        given: JointsFile,
    ) -> tuple[list[Part], dict[str, str]]:
        """Parts of the model, and their names by the bodies' representatives."""
        members: dict[str, list[NamedPart]] = {}
        for part in parts:
            members.setdefault(hosts[part.name], []).append(part)
        joined = {hosts[name] for joint in given.joints for name in (joint.parent, joint.child)}
        bodies: list[Part] = []
        names = {GROUND: GROUND}
        for host, items in members.items():
            main = max(items, key=lambda item: (masses[item.name].mass, item.occurrence.shape.volume))
            axes = main.occurrence.pose.inverse()
            inner = [(axes @ item.occurrence.pose, item) for item in items]
            properties = together(placed(masses[item.name], pose) for pose, item in inner)
            if host != GROUND and properties.mass <= 0:
                raise InputError(
                    f"the part {main.name!r} would move, but has no mass",
                    place=Place(file=self._file, component=main.name),
                    remedy="Give a density: density = 2700.0 in the joints file, or --density 2700 (kg/m3, aluminium).",
                )
            others = [item.name for item in items if item is not main]
            if others:
                listed = ", ".join(repr(name) for name in others)
                self._notes.append(f"fixed to {main.name!r} and one body with it: {listed}")
            if host != GROUND and host not in joined:
                self._notes.append(f"part {main.name!r} is held by no joint: it moves freely")
            names[host] = main.name
            meshes = tuple(
                Mesh(
                    item.name,
                    pose.point(item.occurrence.shape.vertices),
                    item.occurrence.shape.triangles,
                    item.occurrence.color or item.occurrence.shape.color or DEFAULT_COLOR,
                )
                for pose, item in inner
            )
            bodies.append(
                Part(
                    name=main.name,
                    material=None,
                    pose=main.occurrence.pose,
                    mass_properties=NO_MASS if host == GROUND else properties,
                    meshes=meshes,
                    collision=CollisionChoice.AUTO,
                    grounded=host == GROUND,
                    place=Place(file=self._file, component=main.name),
                )
            )
        if not given.ground and not any(GROUND in (joint.parent, joint.child) for joint in given.joints):
            self._notes.append('nothing stands in the world; ground = ["PART"] in the joints file holds a part')
        return bodies, names

    def _joint(self, item: FileJoint, names: Mapping[str, str], file: Path) -> Joint | None:
        parent, child = names[item.parent], names[item.child]
        if item.type is JointType.FIXED:
            return None
        if parent == child:
            self._notes.append(Lost(f"joint {item.name!r} is between parts of one body: left out"))
            return None
        return Joint(
            name=item.name,
            type=item.type,
            parent=parent,
            child=child,
            origin=item.origin,
            axis=item.axis,
            second_axis=item.second_axis,
            place=Place(file=file, component=item.name),
            pitch=item.pitch,
            limits=item.limits,
        )


def _unit_density(shape: Shape) -> tuple[MassProperties, bool]:
    """Mass properties at a density of one, and whether they are those of surfaces, not solids."""
    if shape.volume > 0:
        return MassProperties(shape.volume, shape.center, shape.inertia), False
    return solid_mass([Mesh(shape.name, shape.vertices, shape.triangles, DEFAULT_COLOR)], 1.0)[0], True
