"""Joints that an import file names, as joints of the model; their axes are those of the base frame."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.mates.joint_chains import Chain, ChainJoint
from cad2modelica.mechanism.model import JointType

FREE_KINDS = ("Free", "SixDof", "SixDOF", "Bushing")
X, Y, Z = 0, 1, 2

KINDS: Mapping[str, tuple[tuple[JointType, int], ...]] = {
    "Revolute": ((JointType.REVOLUTE, Z),),
    "Prismatic": ((JointType.PRISMATIC, Z),),
    "Cylindrical": ((JointType.CYLINDRICAL, Z),),
    "Planar": ((JointType.PLANAR, Z),),
    "Spherical": ((JointType.SPHERICAL, Z),),
    "Gimbal": ((JointType.SPHERICAL, Z),),
    "Universal": ((JointType.UNIVERSAL, X),),
    "PinSlot": ((JointType.PRISMATIC, X), (JointType.REVOLUTE, Z)),
    "Rectangular": ((JointType.PRISMATIC, X), (JointType.PRISMATIC, Y)),
    "Cartesian": ((JointType.PRISMATIC, X), (JointType.PRISMATIC, Y), (JointType.PRISMATIC, Z)),
    "Telescoping": ((JointType.PRISMATIC, Z), (JointType.SPHERICAL, Z)),
    "Bearing": ((JointType.PRISMATIC, Z), (JointType.SPHERICAL, Z)),
}
"""Joints of Simscape Multibody by their primitives: shifts first, in the base frame's axes."""


def frame_chain(kind: str, base: Pose, follower: Pose) -> Chain | None:
    """The joints of a kind between two frames, which are given in the world; None if the kind is not known."""
    elements = KINDS.get(kind)
    if elements is None:
        return None
    single = len(elements) == 1
    return tuple(
        ChainJoint(each, base.position if single else follower.position, base.rotation[:, axis])
        for each, axis in elements
    )


def second_axis(kind: str, follower: Pose) -> Array | None:
    """The child's axis of a universal joint."""
    return follower.rotation[:, Y] if kind == "Universal" else None


def coordinate(kind: str, base: Pose, follower: Pose) -> float:
    """The joint's coordinate at the start: the follower's angle (rad) or way (m) from the base."""
    if kind == "Revolute":
        across = base.rotation.T @ follower.rotation[:, X]
        return float(np.arctan2(across[Y], across[X]))
    if kind == "Prismatic":
        return float((base.rotation.T @ (follower.position - base.position))[Z])
    return 0.0
