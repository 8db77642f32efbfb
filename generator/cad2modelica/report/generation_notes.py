"""Remarks of a generation that no single stage makes."""

from __future__ import annotations

import numpy as np

from cad2modelica.collision.start_overlaps import StartCheck
from cad2modelica.geometry.spatial import Array
from cad2modelica.kinematics.joint_twists import joint_twists, start_rates
from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.loops import joint_extent
from cad2modelica.kinematics.start_motion import free_joint_of
from cad2modelica.mechanism.mass_check import check_against_mechanism
from cad2modelica.mechanism.model import Assembly, Joint, JointType, Part
from cad2modelica.source.lost import Lost

NOTED_OVERLAPS = 10
LEAST_EXTENT = 1e-6  # m
IGNORED_SPEED = 1e-6  # part of a start speed that may be lost without a word


def unit_notes(assembly: Assembly) -> tuple[str, ...]:
    """Doubts about the units of parts without geometry; only joints tell how large such a mechanism is."""
    length = joint_extent(assembly)
    if length < LEAST_EXTENT:  # axes through one point say nothing about the size
        return ()
    notes = []
    for part in assembly.parts:
        if part.meshes or part.mass_properties.mass == 0.0:
            continue
        finding = check_against_mechanism(part.mass_properties, length)
        if finding is not None:
            notes.append(f"part {part.name!r}: {finding.message}; {finding.remedy}")
    return tuple(notes)


def speed_notes(assembly: Assembly, tree: KinematicTree) -> tuple[str, ...]:
    """Start speeds that do not count: of parts that are held, and of joints whose kind does not move so."""
    parts = (_part_speed_note(part, assembly, tree) for part in assembly.parts)
    joints = (_joint_speed_note(joint, assembly, tree) for joint in assembly.joints)
    return tuple(note for note in (*parts, *joints) if note is not None)


def _part_speed_note(part: Part, assembly: Assembly, tree: KinematicTree) -> Lost | None:
    if not (part.velocity.any() or part.angular_velocity.any()):
        return None
    ignored = f"part {part.name!r}: its start speed was ignored, for"
    if part.name in tree.fixed:
        return Lost(f"{ignored} it is fixed in the world")
    if tree.branch(part.name).predecessor is not None:
        return Lost(f"{ignored} joints hold it; give it to a joint")
    joint = free_joint_of(assembly, part.name)
    return Lost(f"{ignored} that of its free joint {joint.name!r} counts") if joint is not None else None


def _joint_speed_note(joint: Joint, assembly: Assembly, tree: KinematicTree) -> Lost | None:
    given = np.concatenate([joint.angular_velocity, joint.velocity])
    if not given.any():
        return None
    if joint.type is JointType.FREE:
        if tree.branch(joint.child).predecessor is not None:
            return Lost(f"joint {joint.name!r}: its start speed was ignored, for {joint.child!r} is held otherwise")
        counts = free_joint_of(assembly, joint.child)
        if counts is not None and counts is not joint:
            return Lost(f"joint {joint.name!r}: its start speed was ignored, for that of {counts.name!r} counts")
        return None
    possible = np.zeros(6)
    for twist, rate in zip(joint_twists(joint), start_rates(joint), strict=True):
        at_origin = np.concatenate([twist[:3], twist[3:] + np.cross(twist[:3], joint.origin)])
        possible += rate * at_origin
    left = np.linalg.norm(given - possible)
    if left <= IGNORED_SPEED * np.linalg.norm(given):
        return None
    return Lost(
        f"joint {joint.name!r}: of its start speed only what a {joint.type.value} joint can move counts, "
        f"angular velocity {_listed(possible[:3])} rad/s and velocity {_listed(possible[3:])} m/s in the world's axes"
    )


def _listed(values: Array) -> str:
    return " ".join(f"{value:.4g}" for value in values + 0.0)


def overlap_notes(start: StartCheck) -> tuple[str, ...]:
    """Overlaps in the start configuration, the deepest first, or why they were not looked for."""
    if start.reason is not None:
        return (f"overlaps at the start were not checked: {start.reason}",)
    return tuple(
        f"{item.first!r} and {item.second!r} overlap at the start by {1000 * item.depth:.4g} mm"
        + (f", {100 * item.share:.0f} % of the smaller one: contact throws them apart" if item.deep else "")
        for item in start.overlaps[:NOTED_OVERLAPS]
    )
