"""The mechanism as Modelica components and connections, without any text layout."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from cad2modelica.collision_shapes import CollisionGeometry
from cad2modelica.joint_resistance import resistances
from cad2modelica.joint_twists import spherical_axes
from cad2modelica.joint_view import (
    CLOSURE,
    COORDINATES,
    MULTIBODY,
    axis_of,
    closure_modifiers,
    coordinate_modifiers,
    joint_declaration,
    start_rotation,
)
from cad2modelica.kinematic_graph import KinematicTree
from cad2modelica.loop_closures import Closure
from cad2modelica.loops import LoopAnalysis
from cad2modelica.model import GROUND, Assembly, Joint, JointType, Part, Plane
from cad2modelica.modelica_names import NamePool
from cad2modelica.modelica_text import number, tidy_direction, tidy_length, vector
from cad2modelica.spatial import IDENTITY, Array, Pose, cardan_angles

ROTATION_SNAP = 1e-9  # a rotation nearer to the identity than this is the identity
RESERVED = ("world", "contacts", "Mechanics", "Mechatronics", "Geometry")


@dataclass(frozen=True)
class Component:
    """One component declaration.

    Attributes:
        row: line of the diagram, counted downwards from 0.
        column: place in the line, counted from 0; the world stands at -1.
        level: 0 in the line, 1 and 2 beside each other over it, -1 under it.
    """

    class_name: str
    name: str
    modifiers: tuple[str, ...]
    description: str
    column: int
    row: int
    level: int = 0


@dataclass(frozen=True)
class Connection:
    """``connect(first, second)``; both are ``component.connector``."""

    first: str
    second: str


@dataclass(frozen=True)
class ContactView:
    """What the contact manager is given: bodies in their order, and pairs as 1-based indices."""

    bodies: tuple[str, ...]
    pairs: tuple[tuple[int, int], ...]
    stiffness: float | None
    friction: str | None


@dataclass
class MechanismView:
    """The mechanical model.

    Attributes:
        part_names, joint_names, plane_names, material_names: Modelica name by name in the source.
    """

    gravity: float
    gravity_direction: Array
    components: list[Component] = field(default_factory=list)
    connections: list[Connection] = field(default_factory=list)
    part_names: dict[str, str] = field(default_factory=dict)
    joint_names: dict[str, str] = field(default_factory=dict)
    plane_names: dict[str, str] = field(default_factory=dict)
    material_names: dict[str, str] = field(default_factory=dict)
    contacts: ContactView | None = None


def mechanism_view(
    assembly: Assembly,
    tree: KinematicTree,
    loops: LoopAnalysis,
    geometries: dict[str, CollisionGeometry],
    pairs: list[tuple[str, str]],
) -> MechanismView:
    """Builds the components and connections of the mechanical model.

    Args:
        assembly: the mechanism.
        tree: its spanning tree.
        loops: what its loops ask of the joints.
        geometries: collision shapes by part.
        pairs: pairs of part and plane names that may touch.
    """
    return _Builder(assembly, tree, loops, geometries, pairs).build()


class _Builder:
    def __init__(
        self,
        assembly: Assembly,
        tree: KinematicTree,
        loops: LoopAnalysis,
        geometries: dict[str, CollisionGeometry],
        pairs: list[tuple[str, str]],
    ) -> None:
        self._assembly = assembly
        self._tree = tree
        self._loops = loops
        self._geometries = geometries
        self._pairs = pairs
        strength = float(np.linalg.norm(assembly.gravity))
        self._view = MechanismView(
            gravity=strength,
            gravity_direction=assembly.gravity / strength if strength > 0 else np.array([0.0, 0.0, -1.0]),
        )
        self._pool = NamePool(RESERVED)
        self._row = 0

    def build(self) -> MechanismView:
        view = self._view
        # Names first: parts and joints have priority over helpers, in the order of the source.
        view.part_names = {part.name: self._pool.instance(part.name) for part in self._assembly.parts}
        view.joint_names = {
            joint.name: self._pool.instance(joint.name, "joint")
            for joint in self._assembly.joints
            if joint.type is not JointType.FREE
        }
        view.plane_names = {plane.name: self._pool.instance(plane.name, "plane") for plane in self._assembly.planes}
        view.material_names = {
            material.name: self._pool.instance(material.name, "material") for material in self._assembly.materials
        }
        for branch in self._tree.branches:
            if branch.predecessor in (None, GROUND):
                self._add_tree(branch.part.name)
        for joint in self._tree.cut_joints:
            self._add_cut_joint(joint)
        for plane in self._assembly.planes:
            self._add_plane(plane)
        self._add_contacts()
        return view

    # ----- bodies and joints -----

    def _add_tree(self, root: str) -> None:
        """Adds a root part and all that hangs on it, depth first.

        Bodies hang under their chain; the first child of a part continues its line, each other one begins a new line.
        """
        branch = self._tree.branch(root)
        connector: str | None = None
        column = 1
        if branch.joint is not None:
            connector, column = self._add_joint(branch.joint, branch.part, "world.frame_b", IDENTITY, 0)
        elif branch.predecessor == GROUND:
            connector, column = self._add_offset("world.frame_b", branch.part.pose, branch.part.name, 0)
        grounded = branch.joint is None and branch.predecessor == GROUND
        self._add_body(branch.part, column, connector, grounded=grounded)
        # A stack instead of recursion: chains may be longer than Python's recursion limit.
        stack = [(child, column, number) for number, child in reversed(list(enumerate(branch.children)))]
        while stack:
            name, column, number = stack.pop()
            following = self._tree.branch(name)
            if following.joint is None or following.predecessor is None:
                raise AssertionError("a child in the tree is reached by a joint")
            self._row += 1 if number > 0 else 0
            before = self._assembly.part(following.predecessor)
            own = f"{self._view.part_names[before.name]}.frame_a"
            connector, column = self._add_joint(following.joint, following.part, own, before.pose, column)
            self._add_body(following.part, column, connector, grounded=False)
            stack += [(child, column, k) for k, child in reversed(list(enumerate(following.children)))]
        self._row += 1

    def _add_body(self, part: Part, column: int, connector: str | None, *, grounded: bool) -> None:
        properties = part.mass_properties
        inertia = properties.inertia
        modifiers = [
            f"m={number(properties.mass)}",
            f"r_CM={vector(properties.center_of_mass)}",
            *(f"I_{i}{j}={number(inertia[i - 1, j - 1])}" for i, j in ((1, 1), (2, 2), (3, 3), (2, 1), (3, 1), (3, 2))),
        ]
        name = self._view.part_names[part.name]
        if self._geometries[part.name].shapes:
            modifiers.append(f"geometry=Geometry.{name}")
            if part.material is not None:
                modifiers.append(f"material={self._view.material_names[part.material]}")
        if connector is None and not grounded:
            modifiers += _free_start(self._free_motion(part), part.pose)
        self._view.components.append(
            Component("ContactMultiBody.Parts.Body", name, tuple(modifiers), part.name, column, self._row, -1)
        )
        if connector is not None:
            self._view.connections.append(Connection(connector, f"{name}.frame_a"))

    def _free_motion(self, part: Part) -> tuple[Array, Array]:
        """Velocity of the part's origin and angular velocity at the start, world axes."""
        for joint in self._assembly.joints:
            if joint.type is JointType.FREE and joint.child == part.name:
                arm = part.pose.position - joint.origin
                return joint.velocity + np.cross(joint.angular_velocity, arm), joint.angular_velocity
        return part.velocity, part.angular_velocity

    def _add_joint(self, joint: Joint, child: Part, connector: str, pose: Pose, column: int) -> tuple[str, int]:
        """Adds offset, joint and offset between a placed part and ``child``; returns where the child connects."""
        forward = joint.child == child.name
        first, second = (pose, child.pose) if forward else (child.pose, pose)
        # Frame of the joint at its parent side: at the joint's origin, parallel to the parent.
        before = Pose(first.rotation.T @ (joint.origin - first.position), np.eye(3))
        side = Pose(joint.origin, first.rotation)
        if joint.type is JointType.FIXED:
            return self._add_offset(connector, pose.inverse() @ child.pose, joint.name, column, joint)
        moved = side @ Pose(np.zeros(3), start_rotation(joint, side))
        if joint.type in (JointType.PRISMATIC, JointType.SCREW):
            way = joint.position * (joint.pitch / (2 * math.pi) if joint.type is JointType.SCREW else 1.0)
            before = Pose(before.position - first.rotation.T @ (axis_of(joint) * way), before.rotation)
        after = moved.inverse() @ second
        name = self._view.joint_names[joint.name]
        text = joint.name
        offset, label = (before, f"{name} base") if forward else (after.inverse(), f"{name} end")
        connector, column = self._add_offset(connector, offset, label, column)
        if joint.type is JointType.SPHERICAL and joint.axis is not None:
            start, end, column = self._add_spherical_chain(joint, side, column)
        else:
            self._connect_joint(joint, side, name, text, column)
            start, end, column = name, name, column + 1
        near, far = (f"{start}.frame_a", f"{end}.frame_b") if forward else (f"{end}.frame_b", f"{start}.frame_a")
        self._view.connections.append(Connection(connector, near))
        offset, label = (after, f"{name} end") if forward else (before.inverse(), f"{name} base")
        return self._add_offset(far, offset, label, column)

    def _add_cut_joint(self, joint: Joint) -> None:
        """Closes a loop: a joint between two bodies that stand already."""
        parent = self._assembly.part(joint.parent) if joint.parent != GROUND else None
        child = self._assembly.part(joint.child)
        closure = self._loops.closures.get(joint.name)
        if closure is not None and closure.is_empty:
            return
        connector = f"{self._view.part_names[parent.name]}.frame_a" if parent is not None else "world.frame_b"
        pose = parent.pose if parent is not None else IDENTITY
        far = f"{self._view.part_names[child.name]}.frame_a"
        if closure is None:
            end, _ = self._add_joint(joint, child, connector, pose, 1)
        else:
            end, far = self._add_closure(joint, closure, (connector, pose), (far, child))
        self._view.connections.append(Connection(end, far))
        self._row += 1

    def _add_closure(
        self, joint: Joint, closure: Closure, near: tuple[str, Pose], far: tuple[str, Part]
    ) -> tuple[str, str]:
        """Adds the joint, if it has coordinates, and the conditions behind it; returns the connectors left to meet."""
        name = self._view.joint_names[joint.name]
        connector, pose = near
        other, child = far
        if joint.type is JointType.SPHERICAL:
            # The conditions are the joint: they hold its centre and nothing else.
            origin = Pose(joint.origin, pose.rotation)
            connector, column = self._add_offset(connector, pose.inverse() @ origin, f"{name} base", 1)
            own = Pose(joint.origin, child.pose.rotation)
            other, _ = self._add_offset(other, child.pose.inverse() @ own, f"{name} end", column + 1)
        else:
            connector, column = self._add_joint(joint, child, connector, pose, 1)
            name = self._pool.instance(f"{name} closure")
        text = f"{joint.name}: conditions that close the loop"
        self._view.components.append(Component(CLOSURE, name, closure_modifiers(closure), text, column, self._row))
        self._view.connections.append(Connection(connector, f"{name}.frame_a"))
        return f"{name}.frame_b", other

    def _add_spherical_chain(self, joint: Joint, side: Pose, column: int) -> tuple[str, str, int]:
        """A spherical joint in a loop, as universal joint and a third axis; the ends in its direction, next column."""
        first, second, third = (
            tidy_direction(side.rotation.T @ axis) for axis in spherical_axes(joint.axis, joint.second_axis)
        )
        flags, rates = self._loops.independent[joint.name], self._loops.rates[joint.name]
        name = self._view.joint_names[joint.name]
        spin = self._pool.instance(f"{name} spin")
        both = coordinate_modifiers(COORDINATES[JointType.UNIVERSAL], flags[:2], rates[:2])
        universal = (f"n_a={vector(first)}", f"n_b={vector(second)}", *both)
        revolute = (f"n={vector(third)}", *coordinate_modifiers(COORDINATES[JointType.REVOLUTE], flags[2:], rates[2:]))
        for class_name, own, modifiers, place in (
            ("Universal", name, universal, column),
            ("Revolute", spin, revolute, column + 1),
        ):
            label = joint.name if own == name else f"{joint.name}: third axis"
            self._view.components.append(
                Component(f"{MULTIBODY}.Joints.{class_name}", own, modifiers, label, place, self._row)
            )
        self._view.connections.append(Connection(f"{name}.frame_b", f"{spin}.frame_a"))
        return name, spin, column + 2

    def _connect_joint(self, joint: Joint, side: Pose, name: str, text: str, column: int) -> None:
        class_name, modifiers = joint_declaration(joint, side, self._loops)
        found = () if joint.name in self._loops.planar_constraints else resistances(joint, self._moved_by(joint))
        if found:
            modifiers = ("useAxisFlange=true", *modifiers)
        self._view.components.append(Component(class_name, name, modifiers, text, column, self._row))
        for place, item in enumerate(found, start=1):
            own = self._pool.instance(f"{name} {item.suffix}")
            label = f"{joint.name}: {item.suffix}"
            component = Component(item.class_name, own, item.modifiers, label, column, self._row, place)
            self._view.components.append(component)
            self._view.connections.append(Connection(f"{own}.flange", f"{name}.axis"))
            self._view.connections.append(Connection(f"{own}.support", f"{name}.support"))

    def _moved_by(self, joint: Joint) -> list[Part]:
        """Parts behind a joint in the tree; the child alone where the joint closes a loop."""
        branch = self._tree.branch(joint.child)
        if branch.joint is not joint:
            branch = self._tree.branch(joint.parent) if joint.parent != GROUND else branch
        if branch.joint is not joint:
            return [self._assembly.part(joint.child)]
        found, queue = [], [branch]
        while queue:
            current = queue.pop()
            found.append(current.part)
            queue += [self._tree.branch(name) for name in current.children]
        return found

    def _add_offset(
        self, connector: str, offset: Pose, label: str, column: int, joint: Joint | None = None
    ) -> tuple[str, int]:
        """Adds a fixed translation or rotation if there is one; returns the connector behind it and the next column."""
        position = tidy_length(offset.position)
        turned = np.abs(offset.rotation - np.eye(3)).max() > ROTATION_SNAP
        if not turned and not position.any() and joint is None:
            return connector, column
        if joint is not None:
            name = self._view.joint_names[joint.name]
        else:
            name = self._pool.instance(f"{label} offset" if connector.startswith("world.") else label)
        modifiers = [f"r={vector(position)}"]
        class_name = f"{MULTIBODY}.Parts.FixedTranslation"
        if turned:
            class_name = f"{MULTIBODY}.Parts.FixedRotation"
            modifiers += [
                f"rotationType={MULTIBODY}.Types.RotationTypes.TwoAxesVectors",
                f"n_x={vector(tidy_direction(offset.rotation[:, 0]))}",
                f"n_y={vector(tidy_direction(offset.rotation[:, 1]))}",
            ]
        text = joint.name if joint is not None else label
        self._view.components.append(Component(class_name, name, tuple(modifiers), text, column, self._row))
        self._view.connections.append(Connection(connector, f"{name}.frame_a"))
        return f"{name}.frame_b", column + 1

    # ----- ground and contacts -----

    def _add_plane(self, plane: Plane) -> None:
        modifiers = []
        if plane.position.any():
            modifiers.append(f"r={vector(plane.position)}")
        if (plane.normal != np.array([0.0, 0.0, 1.0])).any():
            modifiers.append(f"normal={vector(plane.normal)}")
        if plane.material is not None:
            modifiers.append(f"material={self._view.material_names[plane.material]}")
        self._view.components.append(
            Component(
                "ContactMultiBody.Parts.Ground",
                self._view.plane_names[plane.name],
                tuple(modifiers),
                plane.name,
                0,
                self._row,
            )
        )
        self._row += 1

    def _add_contacts(self) -> None:
        if not self._pairs:
            return
        touching = {name for pair in self._pairs for name in pair}
        names = {**self._view.part_names, **self._view.plane_names}
        bodies = [name for name in names if name in touching]
        index = {name: number for number, name in enumerate(bodies, start=1)}
        self._view.contacts = ContactView(
            bodies=tuple(names[name] for name in bodies),
            pairs=tuple((index[first], index[second]) for first, second in self._pairs),
            stiffness=self._assembly.contacts.stiffness,
            friction=self._assembly.contacts.friction,
        )
        self._view.connections += [
            Connection(f"{names[name]}.frame_a", f"contacts.frame[{index[name]}]") for name in bodies
        ]


def _free_start(motion: tuple[Array, Array], pose: Pose) -> list[str]:
    velocity, angular_velocity = motion
    angles = cardan_angles(pose.rotation)
    return [
        f"r_0(start={vector(pose.position)},each fixed=true)",
        f"v_0(start={vector(tidy_length(velocity))},each fixed=true)",
        "angles_fixed=true",
        f"angles_start={vector(angles)}",
        "w_0_fixed=true",
        f"w_0_start={vector(tidy_length(angular_velocity))}",
        # Without it the root of the mechanism's orientations, whose coordinates are the states, may be any other body.
        "enforceStates=true",
    ]
