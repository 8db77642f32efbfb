"""How parts move at the start: the speeds of the joints on the way to each, added up as twists."""

from __future__ import annotations

import numpy as np
from contact_foundation.errors import InputError

from cad2modelica.geometry.spatial import Array
from cad2modelica.kinematics.joint_twists import joint_twists
from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.loops import LoopAnalysis
from cad2modelica.mechanism.model import GROUND, Assembly, Joint, JointType, Part

Twist = Array
"""Angular velocity (rad/s) and velocity at the world's origin (m/s), shape (6,)."""


def free_joint_of(assembly: Assembly, part: str) -> Joint | None:
    """The free joint that says how a part starts: of several the one listed first."""
    free = (joint for joint in assembly.joints if joint.type is JointType.FREE and joint.child == part)
    return next(free, None)


def start_motion(assembly: Assembly, tree: KinematicTree, loops: LoopAnalysis, part: Part) -> tuple[Array, Array]:
    """Velocity of a part's origin (m/s) and its angular velocity (rad/s) at the start, world axes, shape (3,) each.

    A free joint's speeds are those against its parent, which may move itself.

    Raises:
        InputError: a free joint's parent hangs on its child.
    """
    motion: Twist = np.zeros(6)
    current, passed = part.name, {part.name}
    while current != GROUND:
        own, following = _step(assembly, tree, loops, current)
        motion = motion + own
        if following in passed:
            joint = free_joint_of(assembly, part.name)
            raise InputError(
                f"the free joint says how {part.name!r} starts against {joint.parent if joint else following!r}, "
                f"which hangs on {part.name!r} itself",
                place=joint.place if joint is not None else part.place,
                remedy=f"Name {GROUND!r} as its parent, or a part that does not hang on the child.",
            )
        passed.add(following)
        current = following
    return motion[3:] + np.cross(motion[:3], part.pose.position), motion[:3]


def _step(assembly: Assembly, tree: KinematicTree, loops: LoopAnalysis, name: str) -> tuple[Twist, str]:
    """How a part moves against the one before it, and which that is."""
    branch = tree.branch(name)
    if branch.joint is not None and branch.predecessor is not None:
        sign = 1.0 if branch.joint.child == name else -1.0
        rates = loops.rates[branch.joint.name]
        twists = zip(joint_twists(branch.joint), rates, strict=True)
        return sum((sign * rate * twist for twist, rate in twists), np.zeros(6)), branch.predecessor
    if branch.predecessor is not None:  # grounded
        return np.zeros(6), branch.predecessor
    joint = free_joint_of(assembly, name)
    if joint is not None:
        return _twist(joint.velocity, joint.angular_velocity, joint.origin), joint.parent
    return _twist(branch.part.velocity, branch.part.angular_velocity, branch.part.pose.position), GROUND


def _twist(velocity: Array, angular_velocity: Array, point: Array) -> Twist:
    return np.concatenate([angular_velocity, velocity - np.cross(angular_velocity, point)])
