"""Joints proposed from faces that are given as data: no CAD kernel is needed."""

from __future__ import annotations

import numpy as np
import pytest
from cad2modelica.brep.step_model import Face, Shape
from cad2modelica.geometry.primitive_meshes import cylinder_surface
from cad2modelica.step.part_faces import RoundFace, faces_of_shape
from cad2modelica.step.proposal import Proposal, propose_joints
from step_models import X, Y, Z, hole, part, shaft, square

HERE = np.array([0.1, 0.2, 0.3])


def _two(*pairs: tuple[object, object]) -> Proposal:
    """The proposal for a large part and a small one with these faces."""
    first = part("base", *(one for one, _ in pairs), volume=1.0)  # type: ignore[arg-type]
    return propose_joints([first, part("arm", *(other for _, other in pairs))])  # type: ignore[arg-type]


def test_a_shaft_in_a_hole_with_a_shoulder_turns() -> None:
    proposal = _two((shaft(HERE, Z), hole(HERE, -Z)), (square(HERE, Z), square(HERE, -Z)))
    (joint,) = proposal.joints
    assert (joint.type.value, joint.parent, joint.child, joint.use) == ("revolute", "base", "arm", True)
    assert np.abs(joint.axis) == pytest.approx(Z)
    assert joint.origin == pytest.approx(HERE)
    assert joint.confidence > 0.8
    assert "shaft in hole" in joint.seen[0]
    assert proposal.ground == "base"


@pytest.mark.parametrize(("half_length", "kind"), [(0.02, "cylindrical"), (0.004, "revolute")])
def test_without_a_shoulder_a_long_fit_slides(half_length: float, kind: str) -> None:
    (joint,) = _two((shaft(HERE, Y, half_length=half_length), hole(HERE, Y, half_length=half_length))).joints
    assert joint.type.value == kind


def test_a_ball_in_a_socket() -> None:
    ball = RoundFace("sphere", HERE, Z, 0.01, 0.01, False)
    socket = RoundFace("sphere", HERE, Z, 0.0101, 0.0101, True)
    (joint,) = _two((ball, socket)).joints
    assert (joint.type.value, joint.use) == ("spherical", True)
    assert joint.origin == pytest.approx(HERE)


def test_two_directions_of_planes_slide() -> None:
    pairs = [(square(HERE, axis), square(HERE, -axis)) for axis in (Z, -Z, X, -X)]
    (joint,) = _two(*pairs).joints
    assert joint.type.value == "prismatic"
    assert np.abs(joint.axis) == pytest.approx(Y)


def test_planes_in_three_directions_and_two_bolt_holes_are_one_body() -> None:
    three = _two(*((square(HERE, axis), square(HERE, -axis)) for axis in (X, Y, Z)))
    bolted = _two(
        *((hole(HERE + 0.03 * k * X, Z), hole(HERE + 0.03 * k * X + 0.04 * Z, Z)) for k in (0, 1)),
        (square(HERE, Z), square(HERE, -Z)),
    )
    for proposal in (three, bolted):
        assert not proposal.joints
        assert [body.parts for body in proposal.bodies] == [("base", "arm")]


def test_one_plane_alone_is_taken_as_fixed_and_says_so() -> None:
    proposal = _two((square(HERE, Z), square(HERE, -Z)))
    assert not proposal.joints
    assert "planar is possible" in proposal.bodies[0].seen[0]


@pytest.mark.parametrize(
    "other",
    [
        hole(HERE + 0.001 * X, Z),  # beside the shaft
        hole(HERE, Z + 0.1 * X),  # at an angle
        hole(HERE, Z, radius=0.02),  # far too wide
        hole(HERE + 0.1 * Z, Z),  # behind its end
        shaft(HERE, Z),  # no hole
    ],
)
def test_what_does_not_guide_is_no_joint(other: RoundFace) -> None:
    axis = other.axis / np.linalg.norm(other.axis)
    given = RoundFace(other.kind, other.point, axis, other.radius, other.half_length, other.hollow)
    proposal = _two((shaft(HERE, Z), given))
    assert not proposal.joints
    assert proposal.loose == ("arm",)


def test_planes_that_do_not_cover_each_other_are_no_contact() -> None:
    assert _two((square(HERE, Z), square(HERE + 0.06 * X, -Z))).loose == ("arm",)
    assert _two((square(HERE, Z), square(HERE, Z))).loose == ("arm",)  # the same side
    assert _two((square(HERE, Z), square(HERE + 0.001 * Z, -Z))).loose == ("arm",)


def test_a_motors_shaft_in_line_with_the_hole_it_drives() -> None:
    """The spline of a servo ends where the bore of its horn begins: seen, but less sure than a fit."""
    pairs = (shaft(HERE, Z, half_length=0.01), hole(HERE + 0.021 * Z, Z, radius=0.006, half_length=0.01))
    (joint,) = _two(pairs, (square(HERE, Z), square(HERE, -Z))).joints
    assert (joint.type.value, joint.use) == ("revolute", True)
    assert 0.5 <= joint.confidence < 0.7


def test_a_pin_belongs_to_one_part_and_carries_the_other() -> None:
    """Base and arm have holes, and a pin goes through both: one joint, not two, and the pin is no body of its own."""
    pin = part("pin", shaft(HERE, Z, half_length=0.03), size=0.02, volume=1e-6, turned=(HERE, Z))
    base = part("base", hole(HERE - 0.02 * Z, Z), square(HERE, Z), volume=1.0)
    arm = part("arm", hole(HERE + 0.01 * Z, Z, half_length=0.01), square(HERE, -Z))
    proposal = propose_joints([base, arm, pin])
    assert [body.parts for body in proposal.bodies] == [("base", "pin")]
    (joint,) = proposal.joints
    assert joint.type.value == "revolute"
    assert {joint.parent, joint.child} == {"arm", "pin"}


def test_joints_point_away_from_the_ground() -> None:
    links = [
        part(f"link {k}", shaft(HERE + k * X, Z), hole(HERE + (k + 1) * X, Z), square(HERE + k * X, -Z), volume=1e-4)
        for k in (2, 0, 1)
    ]
    base = part("base", hole(HERE, Z), volume=1.0)
    proposal = propose_joints([*links, base])
    assert [(joint.parent, joint.child) for joint in proposal.joints] == [
        ("base", "link 0"),
        ("link 0", "link 1"),
        ("link 1", "link 2"),
    ]


def test_faces_of_a_shape_tell_shafts_from_holes() -> None:
    vertices, triangles = cylinder_surface(0.01, 0.05)  # along y
    sides = np.abs(np.cross(*np.swapaxes(vertices[triangles][:, 1:] - vertices[triangles][:, :1], 0, 1))[:, 1]) < 1e-12
    order = np.argsort(~sides, kind="stable")
    for turned, hollow in ((False, False), (True, True)):
        corners = triangles[order][:, ::-1] if turned else triangles[order]
        face = Face("cylinder", np.zeros(3), Y, 0.01, (0, int(sides.sum())))
        shape = Shape("pin", vertices, corners, None, 1.0, np.zeros(3), np.eye(3), (face,))
        (found,) = faces_of_shape("pin", shape).rounds
        assert found.hollow is hollow
        assert found.half_length == pytest.approx(0.025)


def test_rounded_edges_are_no_shafts() -> None:
    vertices, triangles = cylinder_surface(0.01, 0.05)
    corners = vertices[triangles][:, :, [0, 2]]
    quarter = triangles[(corners >= -1e-9).all(axis=(1, 2))]
    face = Face("cylinder", np.zeros(3), Y, 0.01, (0, len(quarter)))
    shape = Shape("edge", vertices, quarter, None, 1.0, np.zeros(3), np.eye(3), (face,))
    assert not faces_of_shape("edge", shape).rounds
