"""Doubts about where a joint is: its axis far from the parts it joins, as a mixed-up unit or coordinate system puts it.

A revolute, cylindrical or screw joint is a line, a universal or spherical one a point; of prismatic and planar joints
the direction alone counts. Parts are taken as the balls around their geometry, those without any are left out.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cad2modelica.geometry.mesh import join
from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import GROUND, Assembly, Joint, JointType, Part

FAR = 2.0  # diameters of the part's ball between it and the joint
NAMED = 5  # joints named one by one
LINES = (JointType.REVOLUTE, JointType.CYLINDRICAL, JointType.SCREW)
POINTS = (JointType.UNIVERSAL, JointType.SPHERICAL)
FACTORS = (0.001, 1000.0, 1 / 25.4, 25.4, 0.1, 10.0, 1 / 39.37, 39.37)  # of m, mm, cm and inches

Ball = tuple[Array, float]


def distance_notes(assembly: Assembly) -> tuple[str, ...]:
    """A remark on each joint that lies farther from a part it joins than twice that part's size."""
    balls = {part.name: _ball(part) for part in assembly.parts}
    found = []
    for joint in assembly.joints:
        if joint.type in LINES or joint.type in POINTS:
            far = _farthest(joint, balls)
            if far is not None:
                found.append((joint, *far))
    notes = [
        f"joint {joint.name!r} lies {1000 * away:.4g} mm outside {name!r}, whose size is {1000 * size:.4g} mm"
        f"{_reason(joint, assembly, balls)}"
        for joint, name, away, size in found[:NAMED]
    ]
    if len(found) > NAMED:
        notes.append(f"so far from a part they join lie {len(found) - NAMED} more joints")
    return tuple(notes)


def _ball(part: Part) -> Ball | None:
    """Middle in the world and radius of a part's geometry."""
    if not part.meshes:
        return None
    vertices, _ = join(part.meshes)
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    return part.pose.point(middle), float(np.linalg.norm(vertices - middle, axis=1).max())


def _ends(joint: Joint, balls: dict[str, Ball | None]) -> Iterator[tuple[str, Ball]]:
    for name in (joint.parent, joint.child):
        ball = balls.get(name)
        if name != GROUND and ball is not None:
            yield name, ball


def _away(joint: Joint, origin: Array, axis: Array | None, ball: Ball) -> float:
    """Distance of a joint from a ball's surface, m; negative inside."""
    way = ball[0] - origin
    if joint.type in LINES and axis is not None:
        way = way - axis * (way @ axis)
    return float(np.linalg.norm(way)) - ball[1]


def _farthest(joint: Joint, balls: dict[str, Ball | None]) -> tuple[str, float, float] | None:
    """The part that a joint lies farthest from by its size: name, distance and size, m; None if it is near to all."""
    found = [(name, _away(joint, joint.origin, joint.axis, ball), 2 * ball[1]) for name, ball in _ends(joint, balls)]
    far = [item for item in found if item[1] > FAR * item[2]]
    return max(far, key=lambda item: item[1] / item[2]) if far else None


def _reason(joint: Joint, assembly: Assembly, balls: dict[str, Ball | None]) -> str:
    """What would put the joint into all parts it joins; if nothing does, a question."""
    ends = list(_ends(joint, balls))

    def fits(origin: Array, axis: Array | None) -> bool:
        return all(_away(joint, origin, axis, ball) <= 0 for _, ball in ends)

    for factor in FACTORS:
        if fits(joint.origin * factor, joint.axis):
            return f"; {factor:.3g} times its origin would fit: another unit of length?"
    for end, name in (("parent", joint.parent), ("child", joint.child)):
        if name == GROUND:
            continue
        pose = assembly.part(name).pose
        turned = pose.direction(joint.axis) if joint.axis is not None else None
        if fits(pose.point(joint.origin), turned):
            return f': is its origin meant in the coordinates of its {end} (frame="{end}")?'
        back = pose.inverse()
        turned = back.direction(joint.axis) if joint.axis is not None else None
        if fits(back.point(joint.origin), turned):
            return f": is its origin meant in the world's coordinates, and not in those of its {end}?"
    return ": is it where it should be?"
