"""Joints that stand for mates: the freedoms that geometry says, and motions that keep every mate."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from cad2modelica.geometry.spatial import Array, Pose, rotation_about
from cad2modelica.mates.allowed_motion import allowed_twists, mated_pair
from cad2modelica.mates.joint_chains import Chain, joint_chain
from cad2modelica.mates.mate_equation import AXIS, CIRCLE, PLANE, POINT, Feature, MateEquation, mate_equation

FIRST = Pose(np.array([0.3, -1.2, 0.5]), rotation_about([1, 2, -1], 1.1))
SECOND = Pose(np.array([-0.4, 0.6, 1.5]), rotation_about([0.3, -1, 2], 0.7))
ORIGIN = np.array([0.1, 0.2, 0.3])
X, Y, Z = np.eye(3)
Q = np.array([1.0, 2.0, 3.0])

Given = tuple[str, tuple[str, Array, Array], tuple[str, Array, Array]]


def _feature(shape: str, point: Array, axis: Array, pose: Pose) -> Feature:
    back = pose.inverse()
    return Feature(shape, back.point(point), back.direction(axis / np.linalg.norm(axis)))


def _equations(*mates: Given) -> list[MateEquation]:
    found = []
    for kind, first, second in mates:
        equation = mate_equation(kind, kind, _feature(*first, FIRST), _feature(*second, SECOND), (FIRST, SECOND))
        assert equation is not None
        found.append(equation)
    return found


def _chain(*mates: Given) -> Chain | None:
    return joint_chain(mated_pair(_equations(*mates), FIRST, SECOND, 1.0))


def _line(point: Array, axis: Array = Z) -> tuple[str, Array, Array]:
    return AXIS, point, axis


def _plane(point: Array, axis: Array = Z) -> tuple[str, Array, Array]:
    return PLANE, point, axis


def _point(point: Array) -> tuple[str, Array, Array]:
    return POINT, point, Z


LOCK_TURN: Given = ("Parallel", _plane(ORIGIN, X), _plane(ORIGIN, X))


@pytest.mark.parametrize(
    ("mates", "expected"),
    [
        ([("Concentric", _line(ORIGIN, Q), _line(ORIGIN + 2 * Q, -Q))], ["cylindrical"]),
        ([("Coincident", _plane(ORIGIN), _plane(ORIGIN + X, -Z))], ["planar"]),
        ([("Distance", _plane(ORIGIN), _plane(ORIGIN + X + Z, -Z))], ["planar"]),
        ([("Coincident", _point(ORIGIN), _point(ORIGIN))], ["spherical"]),
        ([("Coincident", _plane(ORIGIN), _plane(ORIGIN)), LOCK_TURN], ["prismatic", "prismatic"]),
        (
            [("Coincident", _plane(ORIGIN), _plane(ORIGIN)), ("Coincident", _plane(ORIGIN, X), _plane(ORIGIN, -X))],
            ["prismatic"],
        ),
        (
            [("Concentric", _line(ORIGIN, Z), _line(ORIGIN, Z)), ("Coincident", _plane(ORIGIN), _plane(ORIGIN))],
            ["revolute"],
        ),
        ([("Coincident", (CIRCLE, ORIGIN, Q), (CIRCLE, ORIGIN, -Q))], ["revolute"]),
        ([("Coincident", _line(ORIGIN, Q), _point(ORIGIN + Q))], ["prismatic", "spherical"]),
        ([("Coincident", _plane(ORIGIN, Q), _point(ORIGIN))], ["prismatic", "prismatic", "spherical"]),
        ([("Parallel", _plane(ORIGIN), _plane(ORIGIN + X))], ["prismatic", "planar"]),
        (
            [("Coincident", _plane(ORIGIN), _plane(ORIGIN)), ("Coincident", _plane(ORIGIN, Y), _line(ORIGIN + X))],
            ["prismatic", "revolute"],
        ),
        (
            [("Coincident", _plane(ORIGIN), _plane(ORIGIN)), ("Coincident", _line(ORIGIN + X), _plane(ORIGIN, Y))],
            ["revolute", "prismatic"],
        ),
        (
            [("Coincident", _point(ORIGIN), _point(ORIGIN)), ("Perpendicular", _line(ORIGIN, X), _line(ORIGIN, Z))],
            ["revolute", "revolute"],
        ),
        ([("Tangent", _line(ORIGIN, X), _plane(ORIGIN + Z, Z))], ["revolute", "prismatic", "prismatic", "revolute"]),
    ],
)
def test_joints_of_mates(mates: list[Given], expected: list[str]) -> None:
    chain = _chain(*mates)
    assert chain is not None
    assert [joint.type.value for joint in chain] == expected


def test_three_planes_leave_nothing() -> None:
    assert _chain(*(("Coincident", _plane(ORIGIN, axis), _plane(ORIGIN, axis)) for axis in (X, Y, Z))) == ()


def test_a_curved_contact_is_no_joint() -> None:
    """Two parallel axes at a distance: three freedoms at the start, as some joint has, but not on the way."""
    pair = mated_pair(_equations(("Distance", _line(ORIGIN), _line(ORIGIN + X))), FIRST, SECOND, 1.0)
    assert len(allowed_twists(pair).twists) == 3
    assert joint_chain(pair) is None


def test_axes_and_points_are_where_the_geometry_is() -> None:
    chain = _chain(
        ("Concentric", _line(ORIGIN, Q), _line(ORIGIN, Q)), ("Coincident", _plane(ORIGIN, Q), _plane(ORIGIN, Q))
    )
    assert chain is not None
    (joint,) = chain
    unit = Q / np.linalg.norm(Q)
    assert np.linalg.norm(np.cross(joint.axis, unit)) < 1e-9
    assert np.linalg.norm(np.cross(joint.point - ORIGIN, unit)) < 1e-9


@pytest.mark.parametrize("angle", [0.4, np.pi / 2, 2.8])
def test_an_angle_is_kept(angle: float) -> None:
    turned = rotation_about(X, angle) @ Z
    equation = _equations(("Angle", _line(ORIGIN), _line(ORIGIN, turned)))[0]
    for other, kept in ((rotation_about(Z, 0.3), True), (rotation_about(X, 0.3), False)):
        moved = Pose(other @ SECOND.position, other @ SECOND.rotation)
        assert bool(np.abs(equation.values(FIRST, moved, 1.0)).max() < 1e-12) is kept


def test_no_equation_for_what_is_not_known() -> None:
    sides = (_feature(PLANE, ORIGIN, Z, FIRST), _feature(PLANE, ORIGIN, Z, SECOND))
    make: Callable[[str], MateEquation | None] = lambda kind: mate_equation("m", kind, *sides, (FIRST, SECOND))  # noqa: E731
    assert make("Gear") is None
    assert make("Concentric") is None
