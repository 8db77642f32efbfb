"""Simscape Multibody import files to the model.

The format that Simscape Multibody Link writes for SolidWorks, Creo and Inventor, and MathWorks' exporter for Onshape
(``SimscapeMultibodyImportXML``, version 2.0), as its documentation and public exports show it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place
from contact_foundation.progress import Progress, silent
from lxml import etree

from cad2modelica.geometry.spatial import IDENTITY, Pose
from cad2modelica.mates.joint_chains import Chain
from cad2modelica.mechanism.description_defaults import DECOMPOSED_TRIANGLES
from cad2modelica.mechanism.mass_properties import NO_MASS, placed, together
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
from cad2modelica.mechanism.rigid_part import part_between
from cad2modelica.simscape import document as tree
from cad2modelica.simscape.bodies import ROOT, Bodies, find_bodies
from cad2modelica.simscape.elements import Elements, read_units
from cad2modelica.simscape.frame_joints import FREE_KINDS, coordinate, frame_chain, second_axis
from cad2modelica.simscape.part_content import PartContent, PartReader, placed_meshes
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices
from cad2modelica.source.lost import Lost
from cad2modelica.source.problems import Problems
from cad2modelica.source.xml_document import line_of

VERSION = "2.0"


def read_simscape(
    root: etree._Element, path: Path, progress: Progress = silent, choices: SourceChoices = DEFAULT_CHOICES
) -> Assembly:
    """Reads an import file.

    Parts that are fixed to each other are one part, with the name of the heaviest. Mates become joints between them.

    Args:
        root: the element ``SimscapeMultibodyImportXML``.
        path: the file.
        progress: is told what is being read.
        choices: where geometry may lie; what becomes of parts without geometry or mass, and of mates that no joint
            stands for.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    if root.get("version", "") != VERSION or etree.QName(root).localname != "SimscapeMultibodyImportXML":
        raise InputError(
            f"is a Simscape Multibody import file of version {root.get('version', '') or '1.0'!r}",
            place=Place(file=path, line=line_of(root)),
            remedy=f"Version {VERSION} is read: export with Simscape Multibody Link 4.8 (R2016a) or later.",
        )
    return _SimscapeReader(root, path, progress, choices).read()


class _SimscapeReader:
    def __init__(self, root: etree._Element, path: Path, progress: Progress, choices: SourceChoices) -> None:
        self._root = root
        self._file = path
        self._progress = progress
        self._choices = choices
        self._problems = Problems(str(path))
        self._notes: list[str] = []
        self._elements = Elements(path, read_units(root, path, self._problems), self._problems)
        self._problems.raise_if_any()
        self._joints: list[Joint] = []
        self._parts: list[Part] = []
        self._names: set[str] = {GROUND}

    def read(self) -> Assembly:
        document = tree.read_document(self._root, self._elements)
        self._progress("read geometry", 0.0, document.name)
        contents = PartReader(self._elements, self._notes, self._choices).read(
            item.part for item in document.instances.values()
        )
        bodies = find_bodies(document, self._elements, self._notes, self._choices.allow_missing)
        self._problems.raise_if_any()
        hosts = self._make_parts(document, bodies, contents)
        self._make_joints(document, bodies, hosts)
        self._leave_out_loose()
        self._problems.raise_if_any()
        created = self._root.find("{*}Created")
        return Assembly(
            name=document.name or self._file.stem,
            source=(created.get("from", "") if created is not None else "") or "Simscape Multibody import file",
            file=self._file,
            parts=tuple(self._parts),
            joints=tuple(self._joints),
            contacts=ContactSettings(decomposition=DecompositionLimits(triangles=DECOMPOSED_TRIANGLES)),
            notes=tuple(self._notes),
            limits_stop=False,
            aliases={item.name: hosts[bodies.groups[path]] for path, item in document.instances.items()},
        )

    # ----- parts -----

    def _make_parts(
        self, document: tree.Document, bodies: Bodies, contents: Mapping[etree._Element, PartContent]
    ) -> dict[tree.Path, str]:
        """One part for each group; the names of the parts by the groups' first members."""
        members: dict[tree.Path, list[tree.Instance]] = {}
        for path, item in document.instances.items():
            members.setdefault(bodies.groups[path], []).append(item)
        hosts: dict[tree.Path, str] = {ROOT: GROUND}
        for group, items in members.items():
            main = max(items, key=lambda item: contents[item.part].mass.mass)
            grounded = group == ROOT
            axes = main.pose.inverse()
            inner = [(axes @ item.pose, contents[item.part]) for item in items]
            mass = together(placed(content.mass, pose) for pose, content in inner)
            meshes = tuple(
                mesh for pose, content in inner for mesh in placed_meshes(content.meshes, pose.position, pose.rotation)
            )
            if not meshes and all(item.part.find("{*}GeometryFile") is None for item in items):
                self._notes.append(
                    f"part {main.name!r} has no geometry: it moves, but does not collide and is not shown"
                )
            others = [item.name for item in items if item is not main]
            if others:
                listed = ", ".join(repr(name) for name in others)
                self._notes.append(f"fixed to {main.name!r} and one body with it: {listed}")
            self._names.add(main.name)
            hosts[group] = main.name
            part = self._part(main.name, main.pose, mass if not grounded else NO_MASS, grounded, main.part)
            self._parts.append(replace(part, meshes=meshes))
        if not any(part.grounded for part in self._parts):
            self._notes.append("nothing is grounded, so that all moves freely; --ground PART holds a part in the world")
        return hosts

    def _part(self, name: str, pose: Pose, mass: MassProperties, grounded: bool, element: etree._Element) -> Part:
        return Part(
            name=name,
            material=None,
            pose=pose,
            mass_properties=mass,
            meshes=(),
            collision=CollisionChoice.AUTO,
            grounded=grounded,
            place=self._elements.place(element, name),
        )

    def _leave_out_loose(self) -> None:
        """Parts without mass that nothing holds cannot move: they are left out (skeletons, sketches)."""
        held = {name for joint in self._joints for name in (joint.parent, joint.child)}
        for part in list(self._parts):
            if part.mass_properties.mass > 0 or part.grounded or part.name in held:
                continue
            self._parts.remove(part)
            self._notes.append(Lost(f"part {part.name!r} has no mass and no joint holds it: left out"))
        if not any(part.mass_properties.mass > 0 for part in self._parts):
            self._problems.add(
                "no part that could move has mass",
                self._elements.place(self._root),
                "Assign materials in the CAD system, or have masses made from the geometry: --density 2700 (kg/m3).",
            )

    # ----- joints -----

    def _make_joints(self, document: tree.Document, bodies: Bodies, hosts: Mapping[tree.Path, str]) -> None:
        for item in bodies.joints:
            base = document_pose(document, item.base) @ item.base_frame
            follower = document_pose(document, item.follower) @ item.follower_frame
            ends = hosts[bodies.groups[item.base]], hosts[bodies.groups[item.follower]]
            if item.kind in FREE_KINDS:
                self._notes.append(f"joint {item.name!r} ({item.kind}) leaves all freedoms: no joint is made of it")
                continue
            chain = frame_chain(item.kind, base, follower)
            if chain is None:
                self._problems.add(
                    f"joints of the kind {item.kind!r} are not known",
                    self._elements.place(item.element),
                    "Use another mate in the CAD system.",
                )
                continue
            name = self._unique(item.name)
            first = len(self._joints)
            self._add_chain(name, ends, chain, item.element)
            if len(chain) == 1:
                self._joints[first] = _with_sides(self._joints[first], item, base, follower)
        for mated in bodies.mated:
            ends = hosts[mated.first], hosts[mated.second]
            name = self._unique(f"{ends[1]} to {ends[0]}")
            kinds = ", ".join(joint.type.value for joint in mated.chain)
            self._notes.append(f"joint {name!r} ({kinds}) stands for {', '.join(mated.mates)}")
            self._add_chain(name, ends, mated.chain, None)

    def _add_chain(self, name: str, ends: tuple[str, str], chain: Chain, element: etree._Element | None) -> None:
        """Joints in a row, with parts without mass between them."""
        before = ends[0]
        for number, item in enumerate(chain, start=1):
            last = number == len(chain)
            own = name if len(chain) == 1 else self._unique(f"{name} {number}")
            after = ends[1] if last else self._unique(f"{name} carrier {number}")
            if not last:
                place = self._elements.place(self._root, after)
                self._parts.append(part_between(after, Pose(item.point, np.eye(3)), place))
            self._joints.append(
                Joint(
                    name=own,
                    type=item.type,
                    parent=before,
                    child=after,
                    origin=item.point,
                    axis=item.axis if item.type.needs_axis else None,
                    place=self._elements.place(element, own) if element is not None else Place(self._file, None, own),
                )
            )
            before = after

    def _unique(self, name: str) -> str:
        unique, number = name, 2
        while unique in self._names:
            unique, number = f"{name} {number}", number + 1
        self._names.add(unique)
        return unique


def document_pose(document: tree.Document, path: tree.Path) -> Pose:
    """Of a part, or of the world."""
    return IDENTITY if path == ROOT else document.instances[path].pose


def _with_sides(joint: Joint, item: tree.FrameJoint, base: Pose, follower: Pose) -> Joint:
    turns = joint.type in (JointType.REVOLUTE, JointType.PRISMATIC, JointType.CYLINDRICAL, JointType.PLANAR)
    return replace(
        joint,
        position=coordinate(item.kind, base, follower),
        second_axis=second_axis(item.kind, follower),
        child_origin=follower.position,
        child_axis=follower.rotation[:, 2] if turns else None,
    )
