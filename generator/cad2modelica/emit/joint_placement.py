"""Places the joints of a mechanism, with the offsets between them and the bodies."""

from __future__ import annotations

import math

import numpy as np

from cad2modelica.emit.joint_resistance import resistances
from cad2modelica.emit.joint_view import (
    CLOSURE,
    COORDINATES,
    MULTIBODY,
    axis_of,
    closure_modifiers,
    coordinate_modifiers,
    joint_declaration,
    start_rotation,
)
from cad2modelica.emit.mechanism_draft import MechanismDraft
from cad2modelica.geometry.spatial import IDENTITY, Pose
from cad2modelica.kinematics.joint_couplings import coupling_view
from cad2modelica.kinematics.joint_twists import spherical_axes
from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.loop_closures import Closure
from cad2modelica.kinematics.loops import LoopAnalysis
from cad2modelica.mechanism.model import GROUND, Assembly, Coupling, Joint, JointType, Part
from cad2modelica.modelica.text import tidy_direction, tidy_length, vector

ROTATION_SNAP = 1e-9  # a rotation nearer to the identity than this is the identity


class JointPlacement:
    """Adds joints and offsets to a draft.

    Args:
        assembly: the mechanism.
        tree: its spanning tree.
        loops: what its loops ask of the joints.
        draft: what is added to; its parts and joints have their names.
    """

    def __init__(self, assembly: Assembly, tree: KinematicTree, loops: LoopAnalysis, draft: MechanismDraft) -> None:
        self._assembly = assembly
        self._tree = tree
        self._loops = loops
        self._draft = draft

    def add_joint(self, joint: Joint, child: Part, connector: str, pose: Pose, column: int) -> tuple[str, int]:
        """Adds offset, joint and offset between a placed part and ``child``; returns where the child connects."""
        forward = joint.child == child.name
        first, second = (pose, child.pose) if forward else (child.pose, pose)
        # Frame of the joint at its parent side: at the joint's origin, parallel to the parent.
        before = Pose(first.rotation.T @ (joint.origin - first.position), np.eye(3))
        side = Pose(joint.origin, first.rotation)
        if joint.type is JointType.FIXED:
            return self.add_offset(connector, pose.inverse() @ child.pose, joint.name, column, joint)
        moved = side @ Pose(np.zeros(3), start_rotation(joint, side))
        if joint.type in (JointType.PRISMATIC, JointType.SCREW):
            way = joint.position * (joint.pitch / (2 * math.pi) if joint.type is JointType.SCREW else 1.0)
            before = Pose(before.position - first.rotation.T @ (axis_of(joint) * way), before.rotation)
        after = moved.inverse() @ second
        name = self._draft.view.joint_names[joint.name]
        text = joint.name
        offset, label = (before, f"{name} base") if forward else (after.inverse(), f"{name} end")
        connector, column = self.add_offset(connector, offset, label, column)
        if joint.type is JointType.SPHERICAL and joint.axis is not None:
            start, end, column = self._add_spherical_chain(joint, side, column)
        else:
            self._connect_joint(joint, side, name, text, column)
            start, end, column = name, name, column + 1
        near, far = (f"{start}.frame_a", f"{end}.frame_b") if forward else (f"{end}.frame_b", f"{start}.frame_a")
        self._draft.connect(connector, near)
        offset, label = (after, f"{name} end") if forward else (before.inverse(), f"{name} base")
        return self.add_offset(far, offset, label, column)

    def add_cut_joint(self, joint: Joint) -> None:
        """Closes a loop: a joint between two bodies that stand already."""
        parent = self._assembly.part(joint.parent) if joint.parent != GROUND else None
        child = self._assembly.part(joint.child)
        closure = self._loops.closures.get(joint.name)
        if closure is not None and closure.is_empty:
            return
        connector = f"{self._draft.view.part_names[parent.name]}.frame_a" if parent is not None else "world.frame_b"
        pose = parent.pose if parent is not None else IDENTITY
        far = f"{self._draft.view.part_names[child.name]}.frame_a"
        if closure is None:
            end, _ = self.add_joint(joint, child, connector, pose, 1)
        else:
            end, far = self._add_closure(joint, closure, (connector, pose), (far, child))
        self._draft.connect(end, far)
        self._draft.row += 1

    def _add_closure(
        self, joint: Joint, closure: Closure, near: tuple[str, Pose], far: tuple[str, Part]
    ) -> tuple[str, str]:
        """Adds the joint, if it has coordinates, and the conditions behind it; returns the connectors left to meet."""
        name = self._draft.view.joint_names[joint.name]
        connector, pose = near
        other, child = far
        if joint.type is JointType.SPHERICAL:
            # The conditions are the joint: they hold its centre and nothing else.
            origin = Pose(joint.origin, pose.rotation)
            connector, column = self.add_offset(connector, pose.inverse() @ origin, f"{name} base", 1)
            own = Pose(joint.origin, child.pose.rotation)
            other, _ = self.add_offset(other, child.pose.inverse() @ own, f"{name} end", column + 1)
        else:
            connector, column = self.add_joint(joint, child, connector, pose, 1)
            name = self._draft.names.instance(f"{name} closure")
        text = f"{joint.name}: conditions that close the loop"
        self._draft.place(CLOSURE, name, closure_modifiers(closure), text, column)
        self._draft.connect(connector, f"{name}.frame_a")
        return f"{name}.frame_b", other

    def _add_spherical_chain(self, joint: Joint, side: Pose, column: int) -> tuple[str, str, int]:
        """A spherical joint in a loop, as universal joint and a third axis; the ends in its direction, next column."""
        first, second, third = (
            tidy_direction(side.rotation.T @ axis) for axis in spherical_axes(joint.axis, joint.second_axis)
        )
        flags, rates = self._loops.independent[joint.name], self._loops.rates[joint.name]
        name = self._draft.view.joint_names[joint.name]
        spin = self._draft.names.instance(f"{name} spin")
        both = coordinate_modifiers(COORDINATES[JointType.UNIVERSAL], flags[:2], rates[:2])
        universal = (f"n_a={vector(first)}", f"n_b={vector(second)}", *both)
        revolute = (f"n={vector(third)}", *coordinate_modifiers(COORDINATES[JointType.REVOLUTE], flags[2:], rates[2:]))
        for class_name, own, modifiers, place in (
            ("Universal", name, universal, column),
            ("Revolute", spin, revolute, column + 1),
        ):
            label = joint.name if own == name else f"{joint.name}: third axis"
            self._draft.place(f"{MULTIBODY}.Joints.{class_name}", own, modifiers, label, place)
        self._draft.connect(f"{name}.frame_b", f"{spin}.frame_a")
        return name, spin, column + 2

    def _connect_joint(self, joint: Joint, side: Pose, name: str, text: str, column: int) -> None:
        class_name, modifiers = joint_declaration(joint, side, self._loops)
        found = () if joint.name in self._loops.planar_constraints else resistances(joint, self._moved_by(joint))
        couplings = self._assembly.couplings
        if found or any(joint.name in (item.leader, item.follower) for item in couplings):
            modifiers = ("useAxisFlange=true", *modifiers)
        self._draft.place(class_name, name, modifiers, text, column)
        for place, item in enumerate(found, start=1):
            own = self._draft.names.instance(f"{name} {item.suffix}")
            label = f"{joint.name}: {item.suffix}"
            self._draft.place(item.class_name, own, item.modifiers, label, column, place)
            self._draft.connect(f"{own}.{item.flange}", f"{name}.axis")
            if item.has_support:
                self._draft.connect(f"{own}.support", f"{name}.support")
        for coupling in couplings:
            if coupling.follower == joint.name:
                self._add_coupling(coupling, joint, column, len(found) + 1)

    def _add_coupling(self, coupling: Coupling, follower: Joint, column: int, place: int) -> None:
        leader = next(joint for joint in self._assembly.joints if joint.name == coupling.leader)
        view = coupling_view(coupling, leader, follower)
        names = self._draft.view.joint_names
        own = self._draft.names.instance(f"{names[follower.name]} coupling")
        text = f"{follower.name} follows {leader.name}"
        self._draft.place(view.class_name, own, view.modifiers, text, column, place)
        self._draft.connect(f"{own}.{view.follower}", f"{names[follower.name]}.axis")
        self._draft.connect(f"{own}.{view.leader}", f"{names[leader.name]}.axis")

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

    def add_offset(
        self, connector: str, offset: Pose, label: str, column: int, joint: Joint | None = None
    ) -> tuple[str, int]:
        """Adds a fixed translation or rotation if there is one; returns the connector behind it and the next column."""
        position = tidy_length(offset.position)
        turned = np.abs(offset.rotation - np.eye(3)).max() > ROTATION_SNAP
        if not turned and not position.any() and joint is None:
            return connector, column
        if joint is not None:
            name = self._draft.view.joint_names[joint.name]
        else:
            name = self._draft.names.instance(f"{label} offset" if connector.startswith("world.") else label)
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
        self._draft.place(class_name, name, tuple(modifiers), text, column)
        self._draft.connect(connector, f"{name}.frame_a")
        return f"{name}.frame_b", column + 1
