"""URDF to the model: links, joints, masses and geometry, at joint position zero.

The Unified Robot Description Format as documented at wiki.ros.org/urdf/XML: SI units, a joint's origin is the pose of
the child link in the parent link, its axis is given in the child link's frame.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import CmbError, Place
from contact_foundation.progress import Progress, silent
from lxml import etree

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import IDENTITY, Pose
from cad2modelica.mechanism.description_defaults import DECOMPOSED_TRIANGLES
from cad2modelica.mechanism.mass_properties import NO_MASS, placed, solid_mass, together
from cad2modelica.mechanism.mass_repair import impossible_members, usable
from cad2modelica.mechanism.model import (
    GROUND,
    Assembly,
    CollisionChoice,
    ContactSettings,
    Coupling,
    DecompositionLimits,
    Joint,
    JointFriction,
    JointLimits,
    JointRating,
    JointType,
    MassProperties,
    Part,
)
from cad2modelica.meshio.mesh_library import UnreadableMesh, report_unreadable
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices
from cad2modelica.source.lost import Lost
from cad2modelica.source.number_limits import SMALLEST
from cad2modelica.source.problems import Problems
from cad2modelica.source.shape_lengths import ImpossibleShape
from cad2modelica.source.xml_document import unbound_prefixes
from cad2modelica.urdf.elements import UrdfElements
from cad2modelica.urdf.geometry import UrdfGeometry
from cad2modelica.urdf.mass import has_mass, read_mass_properties
from cad2modelica.urdf.mimic import start_position
from cad2modelica.urdf.tree import TYPES, Link, UrdfJoint, UrdfTree, read_tree


@dataclass(eq=False)
class _Found:
    """A link's geometry and mass, in the axes of the part it belongs to."""

    link: Link
    visual: list[Mesh]
    collision: list[Mesh]
    mass: MassProperties = NO_MASS

    @property
    def has_geometry(self) -> bool:
        return bool(self.visual or self.collision)


def read_urdf(
    root: etree._Element, path: Path, progress: Progress = silent, choices: SourceChoices = DEFAULT_CHOICES
) -> Assembly:
    """Reads a robot description.

    A root link without mass is the ground; links that are fixed to each other are one part, which has the name of the
    link that a joint moves. Descriptions in circulation are often approximate; what can be used is used, with a note on
    everything doubtful.

    Args:
        root: the element ``robot``.
        path: the file.
        progress: is told which link is being read.
        choices: where meshes may lie, and what becomes of links without mesh or mass.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    return _UrdfReader(root, path, progress, choices).read()


class _UrdfReader:
    def __init__(self, root: etree._Element, path: Path, progress: Progress, choices: SourceChoices) -> None:
        self._root = root
        self._file = path
        self._progress = progress
        self._problems = Problems(str(path))
        self._notes: list[str] = []
        self._elements = UrdfElements(path, self._problems, self._notes)
        self._geometry = UrdfGeometry(root, self._elements, choices.package_paths)
        self._choices = choices
        self._missing: list[UnreadableMesh] = []
        self._read_links = 0

    def read(self) -> Assembly:
        self._elements.refuse_macros(self._root)
        self._notes += [
            f"the prefix {prefix!r} is bound to no namespace: its elements and attributes were not read"
            for prefix in unbound_prefixes(self._root)
        ]
        tree = read_tree(self._root, self._elements, self._choices.density is not None)
        self._require_mass(tree)
        parts, ground = self._parts(tree)
        found = [self._model_joint(joint, tree, ground) for joint in tree.joints]
        joints = [joint for joint in found if joint is not None]
        couplings = self._couplings(tree, {joint.name for joint in joints})
        self._problems.raise_if_any()
        if not parts:
            self._problems.add(
                "no link has mass or geometry", self._place(self._root), "Add links; only rigid bodies are read."
            )
            self._problems.raise_if_any()
        return Assembly(
            name=self._root.get("name", "") or self._file.stem,
            source="URDF",
            file=self._file,
            parts=tuple(parts),
            joints=tuple(joints),
            contacts=ContactSettings(decomposition=DecompositionLimits(triangles=DECOMPOSED_TRIANGLES)),
            notes=tuple(self._notes),
            limits_stop=False,
            couplings=couplings,
            aliases={
                name: ground if host.part == GROUND else host.part
                for name, host in tree.hosts.items()
                if name not in {part.name for part in parts}
            },
        )

    # ----- parts -----

    def _parts(self, tree: UrdfTree) -> tuple[list[Part], str]:
        """All parts, and the name of what joints to the ground are fixed to: a part if the ground has geometry."""
        members: dict[str, list[Link]] = {}
        for name, link in tree.links.items():
            members.setdefault(tree.hosts[name].part, []).append(link)
        found = {host: [self._found(link, tree) for link in links] for host, links in members.items()}
        report_unreadable(self._missing, self._problems)
        parts = []
        ground = GROUND
        for name, link in tree.links.items():
            host = tree.hosts[name]
            if host.part == GROUND and ground == GROUND and any(item.has_geometry for item in found[GROUND]):
                ground = next(item.link.name for item in found[GROUND] if item.has_geometry)
                parts.append(self._standing_part(tree.links[ground], found[GROUND]))
            elif host.part == name:
                parts.append(self._moving_part(link, host.world, found[name]))
        self._note_groups(parts, ground, members)
        return parts, ground

    def _found(self, link: Link, tree: UrdfTree) -> _Found:
        """What one link brings into its part, in the part's axes."""
        self._read_links += 1
        self._progress("read geometry", self._read_links / len(tree.links), link.name)
        host = tree.hosts[link.name]
        found = _Found(link, self._meshes(link, "visual", host.inner), self._meshes(link, "collision", host.inner))
        inertial = link.element.find("inertial")
        if has_mass(link.element) and inertial is not None:
            own = read_mass_properties(inertial, self._elements)
            if not own.mass >= SMALLEST:
                message = f"mass is {own.mass:g} kg, but must be positive"
                self._problems.add(message, self._place(link.element), "Correct the inertial.")
            else:
                found.mass = placed(own, host.inner)
        elif link.by_density and self._choices.density is not None:
            found.mass, closed = solid_mass(found.visual or found.collision, self._choices.density)
            doubt = "" if closed else "; its meshes are not closed, and their hulls were taken"
            self._notes.append(
                f"link {link.name!r} has the mass {found.mass.mass:.4g} kg of its geometry with "
                f"{self._choices.density:g} kg/m3{doubt}"
            )
        return found

    def _meshes(self, link: Link, kind: str, inner: Pose) -> list[Mesh]:
        meshes = []
        for element in link.element.iterchildren(kind):
            try:
                meshes.append(self._geometry.mesh(element, link.name, inner))
            except ImpossibleShape as error:
                self._problems.record(error)
            except CmbError as error:
                if isinstance(error, UnreadableMesh) and not self._choices.allow_missing:
                    self._missing.append(error)
                    continue
                reason = ". ".join(line.strip().rstrip(".") for line in str(error).splitlines())
                self._notes.append(Lost(f"link {link.name!r}: {kind} geometry left out: {reason}"))
        return meshes

    def _standing_part(self, link: Link, members: list[_Found]) -> Part:
        """What stands in the world: it needs no mass."""
        self._notes.append(f"link {link.name!r} is fixed in the world; its geometry collides")
        return self._part(link, IDENTITY, members, NO_MASS, grounded=True)

    def _moving_part(self, link: Link, pose: Pose, members: list[_Found]) -> Part:
        properties = together(item.mass for item in members)
        meshes = tuple(mesh for item in members for mesh in item.visual)
        if properties.mass > 0:
            properties, remarks = usable(
                properties, meshes or tuple(mesh for item in members for mesh in item.collision)
            )
            self._notes += [f"link {link.name!r}: {remark}" for remark in remarks]
            pieces = ((item.link.name, item.mass) for item in members)
            self._notes += [f"link {remark}" for remark in impossible_members(pieces)]
        else:
            self._notes.append(f"link {link.name!r} has no mass: it only carries what is behind it")
        return self._part(link, pose, members, properties, grounded=False)

    def _part(
        self, link: Link, pose: Pose, members: list[_Found], properties: MassProperties, *, grounded: bool
    ) -> Part:
        visual = tuple(mesh for item in members for mesh in item.visual)
        collision = tuple(mesh for item in members for mesh in item.collision)
        if not (visual or collision):
            self._notes.append(f"link {link.name!r} has no geometry: it moves, but does not collide and is not shown")
        return Part(
            name=link.name,
            material=None,
            pose=pose,
            mass_properties=properties,
            meshes=visual or collision,
            collision=CollisionChoice.AUTO,
            grounded=grounded,
            place=self._place(link.element),
            collision_meshes=collision or None,
        )

    def _note_groups(self, parts: list[Part], ground: str, members: dict[str, list[Link]]) -> None:
        """Tells which links with mass have no part of their own."""
        for part in parts:
            links = members[GROUND if part.name == ground else part.name]
            others = [link.name for link in links if link.has_mass and link.name != part.name]
            if others:
                listed = ", ".join(repr(name) for name in others)
                self._notes.append(f"fixed to {part.name!r} and one body with it: {listed}")

    def _require_mass(self, tree: UrdfTree) -> None:
        """Records a problem if nothing could move, though there are joints that move."""
        moving = [joint for joint in tree.joints if joint.type != "fixed"]
        if moving and not any(link.has_mass for link in tree.links.values()):
            self._problems.add(
                f"no link has mass, so that none of its {len(moving)} joints would move",
                self._place(self._root),
                "Add inertial elements, or have masses made from the geometry: --density 2700 (kg/m3, aluminium).",
            )

    # ----- joints -----

    def _couplings(self, tree: UrdfTree, joints: set[str]) -> tuple[Coupling, ...]:
        """Couplings of joints that move; a joint that was taken as fixed neither leads nor follows."""
        kept = []
        for item in tree.couplings.values():
            if item.leader in joints and item.follower in joints:
                kept.append(item)
            elif item.follower in joints:
                reason = "which was taken as fixed: it moves by itself"
                self._notes.append(
                    Lost(f"joint {item.follower!r} is to follow joint {item.leader!r} (mimic), {reason}")
                )
        return tuple(kept)

    def _model_joint(self, joint: UrdfJoint, tree: UrdfTree, ground: str) -> Joint | None:
        parent, child = tree.hosts[joint.parent], tree.hosts[joint.child]
        if parent.part == child.part:
            return None
        kind = TYPES[joint.type]
        before = ground if parent.part == GROUND else parent.part
        limits, rating = self._limits(joint, kind)
        return Joint(
            name=joint.name,
            type=kind,
            # A floating joint holds nothing: its child moves freely, whatever its parent is.
            parent=GROUND if kind is JointType.FREE else before,
            child=child.part,
            origin=child.world.position,
            axis=child.world.direction(joint.axis) if kind.needs_axis else None,
            position=start_position(joint.name, tree.couplings),
            place=self._place(joint.element),
            limits=limits,
            friction=self._friction(joint, kind),
            rating=rating,
        )

    def _limits(self, joint: UrdfJoint, kind: JointType) -> tuple[JointLimits | None, JointRating | None]:
        """Range and largest effort and speed; zero, which many descriptions write for unknown, says nothing."""
        element = joint.element.find("limit")
        if element is None or not kind.is_scalar:
            return None, None
        effort, speed, lower, upper = (
            self._elements.number_or_zero(element, key) for key in ("effort", "velocity", "lower", "upper")
        )
        rating = JointRating(effort if effort > 0 else None, speed if speed > 0 else None)
        if joint.type == "continuous" or lower == upper:
            return None, rating
        if lower > upper:
            self._notes.append(
                Lost(f"joint {joint.name!r}: limits are left out, for lower={lower:g} is above upper={upper:g}")
            )
            return None, rating
        return JointLimits(lower, upper), rating

    def _friction(self, joint: UrdfJoint, kind: JointType) -> JointFriction | None:
        element = joint.element.find("dynamics")
        viscous = float(self._elements.numbers(element, "damping", (0.0,))[0])
        dry = float(self._elements.numbers(element, "friction", (0.0,))[0])
        if min(viscous, dry) < 0:
            self._problems.add("damping and friction must not be negative", self._place(joint.element), "Correct them.")
        if max(viscous, dry) <= 0 or kind is JointType.FIXED:
            return None
        if not kind.is_scalar:
            note = (
                f"joint {joint.name!r}: damping and friction are left out, which a {joint.type} joint cannot have here"
            )
            self._notes.append(Lost(note))
            return None
        return JointFriction(viscous, dry)

    def _place(self, element: etree._Element | None) -> Place:
        return self._elements.place(element)
