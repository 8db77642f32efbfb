"""URDF to the model: links, joints, inertials, primitives and meshes (STL, OBJ), at joint position zero.

The Unified Robot Description Format as documented at wiki.ros.org/urdf/XML: SI units, a joint's origin is the pose of
the child link in the parent link, its axis is given in the child link's frame.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from cmb_base.errors import CmbError, InputError, Place
from cmb_base.progress import Progress, silent
from lxml import etree

from cad2modelica.file_reference import resolve_inside
from cad2modelica.mass_check import check_against_geometry, check_tensor
from cad2modelica.mesh import Mesh
from cad2modelica.mesh_files import read_mesh
from cad2modelica.model import GROUND, Assembly, CollisionChoice, Joint, JointType, MassProperties, Part
from cad2modelica.primitive_meshes import Surface, box_surface, cylinder_surface, sphere_surface
from cad2modelica.problems import Problems
from cad2modelica.spatial import IDENTITY, Array, Pose, rotation_about, rotation_of_roll_pitch_yaw
from cad2modelica.xml_document import line_of

DEFAULT_COLOR = (0.7, 0.7, 0.7)
GRAVITY = (0.0, 0.0, -9.81)
STOP_TIME = 1.0
TOLERANCE = 1e-6
PACKAGE = "package://"

_TYPES = {
    "revolute": JointType.REVOLUTE,
    "continuous": JointType.REVOLUTE,
    "prismatic": JointType.PRISMATIC,
    "planar": JointType.PLANAR,
    "floating": JointType.FREE,
    "fixed": JointType.FIXED,
}
_IGNORED = {"limit", "dynamics", "mimic", "safety_controller", "calibration"}


@dataclass(frozen=True, eq=False)
class _Link:
    name: str
    element: etree._Element

    @property
    def has_mass(self) -> bool:
        return self.element.find("inertial") is not None


@dataclass(frozen=True, eq=False)
class _UrdfJoint:
    name: str
    type: str
    parent: str
    child: str
    origin: Pose
    axis: Array
    element: etree._Element


@dataclass(frozen=True, eq=False)
class _Host:
    """The part (or the ground) that a link belongs to, and the link's pose in it and in the world."""

    part: str
    inner: Pose
    world: Pose


@dataclass
class _Found:
    visual: list[Mesh] = field(default_factory=list)
    collision: list[Mesh] = field(default_factory=list)


def read_urdf(root: etree._Element, path: Path, progress: Progress = silent) -> Assembly:
    """Reads a robot description.

    A root link without inertial is the ground; other links without inertial belong to the link they are fixed to.

    Args:
        root: the element ``robot``.
        path: the file.
        progress: is told which link is being read.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    return _UrdfReader(root, path, progress).read()


class _UrdfReader:
    def __init__(self, root: etree._Element, path: Path, progress: Progress) -> None:
        self._root = root
        self._file = path
        self._progress = progress
        self._problems = Problems(str(path))
        self._notes: list[str] = []

    def read(self) -> Assembly:
        links = self._links()
        joints = self._joints(links)
        self._problems.raise_if_any()
        order = self._order(links, joints)
        hosts = self._hosts(order, links)
        parts = self._parts(links, hosts)
        model_joints = [self._model_joint(joint, hosts) for joint in order]
        self._problems.raise_if_any()
        if not parts:
            self._problems.add("no link has an inertial", self._place(self._root), "Add masses and inertias.")
            self._problems.raise_if_any()
        return Assembly(
            name=self._root.get("name", "") or self._file.stem,
            description="",
            source="URDF",
            file=self._file,
            gravity=np.array(GRAVITY),
            stop_time=STOP_TIME,
            tolerance=TOLERANCE,
            materials=(),
            planes=(),
            parts=tuple(parts),
            joints=tuple(joint for joint in model_joints if joint is not None),
            notes=tuple(self._notes),
        )

    # ----- structure -----

    def _links(self) -> dict[str, _Link]:
        links: dict[str, _Link] = {}
        for element in self._root.iterchildren("link"):
            name = element.get("name", "")
            if not name or name in links:
                self._problems.add(
                    f"a link needs a name of its own; {name!r} is not", self._place(element), "Rename the link."
                )
            links[name] = _Link(name, element)
        return links

    def _joints(self, links: dict[str, _Link]) -> list[_UrdfJoint]:
        joints: list[_UrdfJoint] = []
        ignored: set[str] = set()
        for element in self._root.iterchildren("joint"):
            place = self._place(element)
            name, kind = element.get("name", ""), element.get("type", "")
            if not name or any(joint.name == name for joint in joints):
                self._problems.add(f"a joint needs a name of its own; {name!r} is not", place, "Rename the joint.")
            if kind not in _TYPES:
                self._problems.add(f"joints of type {kind!r} are not known", place, f"Known: {', '.join(_TYPES)}.")
                continue
            ends = [self._end(element, end, links) for end in ("parent", "child")]
            axis_element = element.find("axis")
            axis = self._numbers(axis_element, "xyz", (1.0, 0.0, 0.0))
            length = float(np.linalg.norm(axis))
            if length < 1e-9:
                self._problems.add("the axis is the zero vector", self._place(axis_element), "Give a direction.")
                length, axis = 1.0, np.array([1.0, 0.0, 0.0])
            ignored |= {str(child.tag) for child in element} & _IGNORED
            origin = self._origin(element)
            joints.append(_UrdfJoint(name, kind, ends[0], ends[1], origin, axis / length, element))
        if ignored:
            self._notes.append(f"not used: {', '.join(sorted(ignored))} of joints")
        return joints

    def _end(self, element: etree._Element, end: str, links: dict[str, _Link]) -> str:
        child = element.find(end)
        name = child.get("link", "") if child is not None else ""
        if name not in links:
            self._problems.add(
                f"the joint's {end} {name!r} is no link", self._place(element), "Correct the name, or add the link."
            )
        return name

    def _order(self, links: dict[str, _Link], joints: list[_UrdfJoint]) -> list[_UrdfJoint]:
        """Joints from the roots outwards."""
        by_child: dict[str, _UrdfJoint] = {}
        for joint in joints:
            if joint.child in by_child:
                self._problems.add(
                    f"the link {joint.child!r} has two parents", self._place(joint.element), "A robot is a tree."
                )
            by_child[joint.child] = joint
        reached = {name for name in links if name not in by_child}
        ordered: list[_UrdfJoint] = []
        while True:
            following = [joint for joint in joints if joint.child not in reached and joint.parent in reached]
            if not following:
                break
            for joint in following:
                ordered.append(joint)
                reached.add(joint.child)
        for joint in joints:
            if joint.child not in reached:
                self._problems.add(
                    f"the link {joint.child!r} hangs in a circle", self._place(joint.element), "A robot is a tree."
                )
        self._problems.raise_if_any()
        return ordered

    def _hosts(self, order: list[_UrdfJoint], links: dict[str, _Link]) -> dict[str, _Host]:
        children = {joint.child for joint in order}
        hosts: dict[str, _Host] = {}
        for name, link in links.items():
            if name not in children:
                grounded = not link.has_mass
                hosts[name] = _Host(GROUND if grounded else name, IDENTITY, IDENTITY)
                if not grounded:
                    self._notes.append(
                        f"link {name!r} is the root and moves freely; fix it to a massless link to ground it"
                    )
        for joint in order:
            parent = hosts[joint.parent]
            world = parent.world @ joint.origin
            if links[joint.child].has_mass:
                hosts[joint.child] = _Host(joint.child, IDENTITY, world)
            elif joint.type == "fixed":
                hosts[joint.child] = _Host(parent.part, parent.inner @ joint.origin, world)
            else:
                self._problems.add(
                    f"the link {joint.child!r} moves, but has no inertial",
                    self._place(joint.element),
                    "Give the link mass and inertia, or make the joint fixed.",
                )
                hosts[joint.child] = _Host(joint.child, IDENTITY, world)
        return hosts

    # ----- parts -----

    def _parts(self, links: dict[str, _Link], hosts: dict[str, _Host]) -> list[Part]:
        found: dict[str, _Found] = {}
        for index, (name, link) in enumerate(links.items()):
            self._progress("read geometry", index / len(links), name)
            collected = found.setdefault(hosts[name].part, _Found())
            for kind, target in (("visual", collected.visual), ("collision", collected.collision)):
                for element in link.element.iterchildren(kind):
                    try:
                        target.append(self._mesh(element, name, hosts[name].inner))
                    except CmbError as error:
                        self._problems.record(error)
        parts = []
        for name, link in links.items():
            if hosts[name].part == name and link.has_mass:
                parts.append(self._part(link, hosts[name].world, found[name]))
        if GROUND in found and (found[GROUND].visual or found[GROUND].collision):
            self._notes.append("geometry of massless links that stand on the ground was left out")
        return parts

    def _part(self, link: _Link, pose: Pose, found: _Found) -> Part:
        properties = self._mass_properties(link)
        place = self._place(link.element)
        meshes = tuple(found.visual or found.collision)
        finding = check_tensor(properties)
        if finding is not None:
            self._problems.add(finding.message, place, finding.remedy)
        elif meshes:
            for doubt in check_against_geometry(properties, meshes):
                if doubt.wrong:
                    self._problems.add(doubt.message, place, doubt.remedy)
                else:
                    self._notes.append(f"link {link.name!r}: {doubt.message}")
        if not meshes:
            self._notes.append(f"link {link.name!r} has no geometry: it moves, but does not collide and is not shown")
        return Part(
            name=link.name,
            material=None,
            pose=pose,
            mass_properties=properties,
            meshes=meshes,
            collision=CollisionChoice.AUTO,
            grounded=False,
            velocity=np.zeros(3),
            angular_velocity=np.zeros(3),
            place=place,
            collision_meshes=tuple(found.collision) if found.collision else None,
        )

    def _mass_properties(self, link: _Link) -> MassProperties:
        inertial = link.element.find("inertial")
        if inertial is None:
            raise AssertionError("only links with an inertial become parts")
        origin = self._origin(inertial)
        mass = self._numbers(inertial.find("mass"), "value", (0.0,))[0]
        element = inertial.find("inertia")
        value = {key: self._numbers(element, key, (0.0,))[0] for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")}
        tensor = np.array(
            [
                [value["ixx"], value["ixy"], value["ixz"]],
                [value["ixy"], value["iyy"], value["iyz"]],
                [value["ixz"], value["iyz"], value["izz"]],
            ]
        )
        turned = origin.rotation @ tensor @ origin.rotation.T
        return MassProperties(float(mass), origin.position, (turned + turned.T) / 2)

    def _mesh(self, element: etree._Element, name: str, inner: Pose) -> Mesh:
        geometry = element.find("geometry")
        shape = next(iter(geometry), None) if geometry is not None else None
        if shape is None:
            raise InputError(
                "names no geometry", place=self._place(element, name), remedy="Add box, sphere, ... or mesh."
            )
        vertices, triangles = self._surface(shape, name)
        pose = inner @ self._origin(element)
        return Mesh(name, pose.point(vertices), triangles, self._color(element))

    def _surface(self, shape: etree._Element, name: str) -> Surface:
        kind = str(shape.tag)
        if kind == "mesh":
            vertices, triangles = read_mesh(self._mesh_file(shape, name))
            scale = self._numbers(shape, "scale", (1.0, 1.0, 1.0))
            if not scale.all():
                raise InputError("scale is zero", place=self._place(shape, name), remedy="Correct the scale.")
            return vertices * scale, triangles[:, ::-1] if np.prod(scale) < 0 else triangles
        keys = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length")}.get(kind)
        if keys is None:
            raise InputError(
                f"geometry of type {kind!r} is not known",
                place=self._place(shape, name),
                remedy="Known: box, sphere, cylinder, mesh.",
            )
        values = [self._numbers(shape, key, (0.0, 0.0, 0.0) if key == "size" else (0.0,)) for key in keys]
        if any((value <= 0).any() for value in values):
            raise InputError(f"a {kind} needs positive lengths", place=self._place(shape, name), remedy="Correct them.")
        if kind == "box":
            return box_surface(values[0])
        if kind == "sphere":
            return sphere_surface(float(values[0][0]))
        vertices, triangles = cylinder_surface(float(values[0][0]), float(values[1][0]))
        # URDF's cylinder lies along z, the mesh along y.
        return vertices @ rotation_about([1, 0, 0], np.pi / 2).T, triangles

    def _mesh_file(self, shape: etree._Element, name: str) -> Path:
        reference = shape.get("filename", "")
        folder = self._file.parent
        if reference.startswith(PACKAGE):
            package, _, reference = reference.removeprefix(PACKAGE).partition("/")
            ancestors = [ancestor for ancestor in self._file.resolve().parents if ancestor.name == package]
            folder = ancestors[0] if ancestors else folder
        return resolve_inside(folder, reference, self._place(shape, name))

    def _color(self, element: etree._Element) -> tuple[float, float, float]:
        material = element.find("material")
        color = material.find("color") if material is not None else None
        if material is not None and color is None:
            for shared in self._root.iterchildren("material"):
                if shared.get("name") == material.get("name"):
                    color = shared.find("color")
        if color is None:
            return DEFAULT_COLOR
        red, green, blue, _ = np.clip(self._numbers(color, "rgba", (*DEFAULT_COLOR, 1.0)), 0.0, 1.0)
        return float(red), float(green), float(blue)

    # ----- joints -----

    def _model_joint(self, joint: _UrdfJoint, hosts: dict[str, _Host]) -> Joint | None:
        parent, child = hosts[joint.parent], hosts[joint.child]
        if parent.part == child.part:
            return None
        kind = _TYPES[joint.type]
        if kind is JointType.FREE and parent.part != GROUND:
            self._problems.add(
                "a floating joint needs a massless root link as its parent",
                self._place(joint.element),
                "Correct the parent.",
            )
        return Joint(
            name=joint.name,
            type=kind,
            parent=parent.part,
            child=child.part,
            origin=child.world.position,
            axis=child.world.direction(joint.axis) if kind.needs_axis else None,
            second_axis=None,
            position=0.0,
            speed=0.0,
            velocity=np.zeros(3),
            angular_velocity=np.zeros(3),
            place=self._place(joint.element),
        )

    # ----- helpers -----

    def _origin(self, element: etree._Element) -> Pose:
        origin = element.find("origin")
        position = self._numbers(origin, "xyz", (0.0, 0.0, 0.0))
        angles = self._numbers(origin, "rpy", (0.0, 0.0, 0.0))
        return Pose(position, rotation_of_roll_pitch_yaw(angles))

    def _numbers(self, element: etree._Element | None, name: str, default: tuple[float, ...]) -> Array:
        text = element.get(name) if element is not None else None
        if text is None:
            return np.array(default)
        try:
            values = np.array(text.split(), dtype=np.float64)
        except ValueError:
            values = np.zeros(0)
        if len(values) != len(default) or not np.isfinite(values).all():
            self._problems.add(
                f"{name}={text!r} must be {len(default)} finite number{'s' if len(default) > 1 else ''}",
                self._place(element),
                "Correct the value; xacro files must be expanded first." if "$" in text else "Correct the value.",
            )
            return np.array(default)
        return values

    def _place(self, element: etree._Element | None, component: str | None = None) -> Place:
        if element is None:
            return Place(file=self._file, component=component)
        return Place(file=self._file, line=line_of(element), component=component or element.get("name"))
