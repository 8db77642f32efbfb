"""Loops that move although they have too many conditions, against closed forms, and such that do not move."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from cad2modelica.geometry.spatial import Pose, rotation_about
from cad2modelica.kinematics.kinematic_graph import kinematic_tree
from cad2modelica.kinematics.loop_motion import displacement
from cad2modelica.kinematics.loops import LoopAnalysis, analyse_loops
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu
from scipy.linalg import expm

GRAVITY = 9.81
ACROSS = (0, 1, 0)
ORIGIN = Pose(np.zeros(3), np.eye(3))

Mechanism = tuple[list[str], list[str]]


def analysed(parts: Sequence[str], joints: Sequence[str], folder: Path) -> LoopAnalysis:
    assembly = read_assembly(write_assembly(folder / "loops.xml", parts, joints))
    return analyse_loops(assembly, kinematic_tree(assembly))


def refusal(parts: Sequence[str], joints: Sequence[str], folder: Path) -> str:
    with pytest.raises(InputError) as caught:
        analysed(parts, joints, folder)
    assert caught.value.exit_status == 2
    return str(caught.value)


def held(loops: LoopAnalysis, name: str) -> int:
    """How many conditions a closing joint kept."""
    return sum(loops.closures[name].shifts) + sum(loops.closures[name].turns)


def revolute_chain(angles: Sequence[float], lengths: Sequence[float], twists: Sequence[float]) -> list[Pose]:
    """Frames whose z are the axes of a chain by Denavit and Hartenberg; the last is the first again if it closes."""
    frames = [ORIGIN]
    for angle, length, twist in zip(angles, lengths, twists, strict=True):
        turn = Pose(np.zeros(3), rotation_about([0, 0, 1], angle))
        frames.append(frames[-1] @ turn @ Pose([length, 0, 0], rotation_about([1, 0, 0], twist)))
    return frames


def ring(name: str, frames: Sequence[Pose]) -> Mechanism:
    """A closed ring of revolute joints, the first link on the ground; all but the last frame carry axes."""
    assert np.abs(frames[-1].position).max() < 1e-12
    assert np.abs(frames[-1].rotation - np.eye(3)).max() < 1e-12
    count = len(frames) - 1
    bodies = ["ground", *(f"{name}{k}" for k in range(1, count))]
    parts = [part(body, position=frames[k].position) for k, body in enumerate(bodies) if k > 0]
    joints = []
    for k in range(count):
        ends = (bodies[k], bodies[k + 1]) if k + 1 < count else ("ground", bodies[k])
        start = 'speed="1"' if k == 0 else ""
        axis = frames[k].rotation[:, 2]
        joints.append(joint(f"{name}j{k + 1}", "revolute", *ends, origin=frames[k].position, axis=axis, start=start))
    return parts, joints


# Bennett's linkage: opposite links equal, sines of the twists as the lengths.
LENGTHS, TWIST = (1.0, 1.4), 0.6
TWISTS = (TWIST, float(np.arcsin(LENGTHS[1] / LENGTHS[0] * np.sin(TWIST))))
BENNETT = np.sin(sum(TWISTS) / 2) / np.sin((TWISTS[1] - TWISTS[0]) / 2)  # tan(first/2) tan(second/2)
FIRST = 1.0
SECOND = 2 * np.arctan(BENNETT / np.tan(FIRST / 2))


def bennett() -> Mechanism:
    angles = (FIRST, SECOND, -FIRST, -SECOND)
    return ring("bennett", revolute_chain(angles, (*LENGTHS, *LENGTHS), (*TWISTS, *TWISTS)))


def bricard() -> Mechanism:
    """Six equal links with right angles between their axes, alternately to both sides."""
    first = 0.9
    second = np.arccos(-np.cos(first) / (1 + np.cos(first)))
    frames = revolute_chain((first, second) * 3, (1.0,) * 6, (np.pi / 2, -np.pi / 2) * 3)
    return ring("bricard", frames)


LEG = np.hypot(0.4, 0.5)


def sarrus(bent: float = 0.4) -> Mechanism:
    """A platform 1 m high on two legs of two links, with hinges along y and along x."""
    parts = [part("a1", position=(1 + bent / 2, 0, 0.25)), part("a2", position=(1 + bent / 2, 0, 0.75))]
    parts += [part("b1", position=(0, 1 + bent / 2, 0.25)), part("b2", position=(0, 1 + bent / 2, 0.75))]
    parts += [part("platform", position=(0, 0, 1))]
    joints = []
    for name, axis, out in (("a", ACROSS, np.array([1.0, 0, 0])), ("b", (1, 0, 0), np.array([0, 1.0, 0]))):
        bodies = ("ground", f"{name}1", f"{name}2", "platform")
        points = (out, out * (1 + bent) + [0, 0, 0.5], out + np.array([0, 0, 1]))
        for k, point in enumerate(points):
            joints.append(joint(f"{name} hinge {k}", "revolute", bodies[k], bodies[k + 1], origin=point, axis=axis))
    return parts, joints


CRANK = np.array([0.2, 0, 1.0])


def three_cranks(lean: Sequence[float] = CRANK) -> Mechanism:
    """A parallelogram with one crank more than it needs."""
    parts = [part("top", position=np.array([1.0, 0, 0]) + lean)]
    joints = []
    for name, x in (("left", 0.0), ("middle", 1.0), ("right", 2.0)):
        foot = np.array([x, 0, 0])
        parts.append(part(name, position=foot + np.asarray(lean) / 2))
        joints.append(joint(f"{name} foot", "revolute", "ground", name, origin=foot, axis=ACROSS))
        joints.append(joint(f"{name} head", "revolute", name, "top", origin=foot + lean, axis=ACROSS))
    return parts, joints


def spindle() -> Mechanism:
    """A nut on a spindle that slides in a guide: all three joints along one direction."""
    parts = [part("shaft"), part("nut", position=(0, 0, 0.2))]
    joints = [
        joint("bearing", "revolute", "ground", "shaft", axis=(0, 0, 1)),
        joint("thread", "screw", "shaft", "nut", origin=(0, 0, 0.2), axis=(0, 0, 1), pitch=0.5),
        joint("guide", "prismatic", "ground", "nut", origin=(0.1, 0, 0.2), axis=(0, 0, 1)),
    ]
    return parts, joints


def flap() -> Mechanism:
    """Two hinges on one line."""
    joints = [
        joint("near hinge", "revolute", "ground", "flap", origin=(0, -0.3, 0), axis=ACROSS),
        joint("far hinge", "revolute", "ground", "flap", origin=(0, 0.3, 0), axis=ACROSS),
    ]
    return [part("flap", position=(0.5, 0, 0))], joints


def lid() -> Mechanism:
    """A hinge, and a ball on its line: of the ball's three conditions none is left."""
    joints = [
        joint("lid hinge", "revolute", "ground", "lid", origin=(0, -0.3, 0), axis=ACROSS),
        joint("lid ball", "spherical", "ground", "lid", origin=(0, 0.3, 0)),
    ]
    return [part("lid", position=(0.5, 0, 0))], joints


def guided_ball() -> Mechanism:
    """A slider whose ball meets a slider beside it: along the way it is the only one to hold."""
    parts = [part("lead", position=(0, 0, 1)), part("follower", position=(0, 1, 1), turn=((1, 2, 3), 0.7))]
    joints = [
        joint("lead guide", "prismatic", "ground", "lead", origin=(0, 0, 1), axis=(0, 0, 1)),
        joint("follower guide", "prismatic", "ground", "follower", origin=(0, 1, 1), axis=(0, 0, 1)),
        joint("between", "spherical", "lead", "follower", origin=(0, 0.5, 1.2)),
    ]
    return parts, joints


def slide(kind: str) -> Mechanism:
    """A slide on two parallel guides."""
    joints = [
        joint("left guide", kind, "ground", "slide", axis=(1, 0, 0)),
        joint("right guide", kind, "ground", "slide", origin=(0, 1, 0), axis=(1, 0, 0)),
    ]
    return [part("slide")], joints


def spherical_linkage() -> Mechanism:
    """Four axes through one point."""
    axes = ((1, 0, 0.2), (0.3, 1, 0), (-1, 0.4, 0.5), (0.1, -0.8, 1))
    joints = [
        joint("s1", "revolute", "ground", "first", axis=axes[0]),
        joint("s2", "revolute", "first", "second", axis=axes[1]),
        joint("s3", "revolute", "second", "third", axis=axes[2]),
        joint("s4", "revolute", "ground", "third", axis=axes[3]),
    ]
    return [part("first"), part("second"), part("third")], joints


# ----- which loops are accepted, and with how many conditions -----


@pytest.mark.parametrize(
    ("mechanism", "closing", "conditions"),
    [
        (bennett(), "bennettj4", 3),  # four joints, one freedom
        (bricard(), "bricardj6", 5),
        (sarrus(), "b hinge 2", 5),
        (three_cranks(), "right head", 2),
        (spindle(), "bearing", 2),
        (flap(), "far hinge", 1),
        (lid(), "lid ball", 0),
        (guided_ball(), "between", 1),
        (slide("prismatic"), "right guide", 1),
        (slide("cylindrical"), "right guide", 3),
        (spherical_linkage(), "s4", 3),
    ],
)
def test_movable_loops_keep_as_many_conditions_as_are_independent(
    tmp_path: Path, mechanism: Mechanism, closing: str, conditions: int
) -> None:
    loops = analysed(*mechanism, tmp_path)
    assert held(loops, closing) == conditions
    assert loops.freedoms == 1
    assert closing not in loops.planar_constraints
    (note,) = [note for note in loops.notes if closing in note and "was ignored" not in note]
    assert ("one of many solutions" if conditions else "was left out: it repeats") in note


@pytest.mark.full
def test_order_of_joints_does_not_matter(tmp_path: Path) -> None:
    parts, joints = bennett()
    for order in (joints, joints[::-1], [*joints[2:], *joints[:2]]):
        loops = analysed(parts, order, tmp_path)
        assert loops.freedoms == 1
        assert sum(held(loops, name) for name in loops.closures) == 3


def test_export_that_rounds_still_moves(tmp_path: Path) -> None:
    """Six digits: the linkage closes along its way as far as they go, and the closure allows that gap."""
    parts, joints = bennett()
    joints = [re.sub(r"-?\d+\.\d{8,}(e-\d+)?", lambda n: f"{float(n[0]):.6f}", text) for text in joints]
    (closure,) = analysed(parts, joints, tmp_path).closures.values()
    assert 1e-6 < closure.angle < 1e-4


def test_part_that_is_welded_twice(tmp_path: Path) -> None:
    """Nothing moves, nothing is missing: the second weld repeats the first."""
    parts = [part("a"), part("b")]
    joints = [joint("w1", "fixed", "ground", "a"), joint("w2", "fixed", "a", "b"), joint("w3", "fixed", "ground", "b")]
    loops = analysed(parts, joints, tmp_path)
    assert loops.closures["w3"].is_empty
    package = generate(tmp_path / "loops.xml", tmp_path / "out")
    assert "left out: repeats what others hold" in package.report.read_text()
    text = (package.root / "Mechanics.mo").read_text()
    assert "LoopClosure" not in text
    assert "connect(b.frame_a" not in text
    assert text.count("b.frame_a") == 1  # met once, by the first weld


def test_joints_that_cannot_move_are_named(tmp_path: Path) -> None:
    """A four-bar linkage with one inclined axis stands still; the rod of balls on it still spins about its line."""
    corners = {"a": (0, 0, 0), "b": (0, 0, 1), "c": (1.5, 0, 1.3), "d": (2, 0, 0)}
    axes = {"a": ACROSS, "b": ACROSS, "c": ACROSS, "d": (0.1, 1, 0)}
    ends = {"a": ("ground", "one"), "b": ("one", "two"), "c": ("two", "three"), "d": ("ground", "three")}
    joints = [joint(key, "revolute", *ends[key], origin=corners[key], axis=axes[key]) for key in corners]
    joints += [
        joint("near ball", "spherical", "one", "rod", origin=(0, 0.5, 1)),
        joint("far ball", "spherical", "two", "rod", origin=(1.5, 0.5, 1.5)),
    ]
    parts = [part(name) for name in ("one", "two", "three", "rod")]
    loops = analysed(parts, joints, tmp_path)
    (note,) = [note for note in loops.notes if "cannot move" in note]
    assert note.endswith("In these loops cannot move: 'd', 'c', 'b', 'a'")


# ----- what does not move -----


def test_one_axis_beside_its_place_locks_the_linkage(tmp_path: Path) -> None:
    frames = revolute_chain((FIRST, SECOND, -FIRST, -SECOND), (*LENGTHS, *LENGTHS), (*TWISTS, *TWISTS))
    parts, joints = ring("bennett", frames)
    axis = frames[3].rotation[:, 2] + [0.01, 0, 0]
    joints[3] = joint("bennettj4", "revolute", "ground", "bennett3", origin=frames[3].position, axis=axis)
    text = refusal(parts, joints, tmp_path)
    assert "nothing in it can move" in text
    assert "of 6 closing conditions only 4" in text


@pytest.mark.parametrize(
    ("mechanism", "conditions"),
    [(sarrus(bent=0.0), 5), (three_cranks(lean=(0.5, 0, 0)), 5)],
)
def test_singular_start_is_told_from_a_lasting_dependence(
    tmp_path: Path, mechanism: Mechanism, conditions: int
) -> None:
    text = refusal(*mechanism, tmp_path)
    assert f"singular position, as a dead centre is: beside it {conditions} conditions are independent" in text
    assert "alone makes it right" not in text


def test_stretched_pair_of_links_moves_infinitely_little(tmp_path: Path) -> None:
    parts = [part("one", position=(0.5, 0, 0)), part("two", position=(2, 0, 0))]
    joints = [
        joint("left", "revolute", "ground", "one", axis=ACROSS),
        joint("knee", "revolute", "one", "two", origin=(1, 0, 0), axis=ACROSS),
        joint("right", "revolute", "ground", "two", origin=(3, 0, 0), axis=ACROSS),
    ]
    assert "only move infinitely little" in refusal(parts, joints, tmp_path)


def test_displacement_is_the_matrix_exponential() -> None:
    generator = np.random.default_rng(3)
    for scale in (1e-14, 1e-3, 1.0, 3.0):
        twist = scale * generator.standard_normal(6)
        x, y, z = twist[:3]
        matrix = np.zeros((4, 4))
        matrix[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        matrix[:3, 3] = twist[3:]
        exact = expm(matrix)
        found = displacement(twist)
        np.testing.assert_allclose(found.rotation, exact[:3, :3], atol=1e-13)
        np.testing.assert_allclose(found.position, exact[:3, 3], atol=1e-13)


# ----- the same mechanisms as one FMU -----


@dataclass(frozen=True)
class Simulated:
    """Columns of the FMU's result."""

    rows: np.ndarray

    def vector(self, name: str) -> np.ndarray:
        """Shape (times, 3)."""
        return np.column_stack([self.rows[f"{name}[{k}]"] for k in (1, 2, 3)])

    def turn(self, body: str) -> np.ndarray:
        """Rotation from the world into the body, shape (times, 3, 3)."""
        entries = [[self.rows[f"{body}.frame_a.R.T[{i},{j}]"] for j in (1, 2, 3)] for i in (1, 2, 3)]
        return np.asarray(entries).transpose(2, 0, 1)

    def point(self, body: str, local: Sequence[float] | np.ndarray) -> np.ndarray:
        """A point of a body in the world, shape (times, 3)."""
        return self.vector(f"{body}.frame_a.r_0") + np.einsum("tij,i->tj", self.turn(body), np.asarray(local, float))

    def energies(self, bodies: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
        """Kinetic and potential: 1 kg each with moments of inertia of 0.01 kg.m2 about the origin, the centre."""
        kinetic = np.zeros(len(self.rows))
        height = np.zeros(len(self.rows))
        for body in bodies:
            kinetic += 0.5 * (self.vector(f"{body}.v_0") ** 2).sum(axis=1)
            kinetic += 0.005 * (self.vector(f"{body}.w_a") ** 2).sum(axis=1)
            height += np.asarray(self.rows[f"{body}.frame_a.r_0[3]"])
        return kinetic, GRAVITY * height


BODIES = {
    "bennett": ("bennett1", "bennett2", "bennett3"),
    "bricard": tuple(f"bricard{k}" for k in range(1, 6)),
    "sarrus": ("a1", "a2", "b1", "b2", "platform"),
    "cranks": ("top", "left", "middle", "right"),
    "spindle": ("shaft", "nut"),
    "flap": ("flap",),
    "lid": ("lid",),
    "guided": ("lead", "follower"),
}


@pytest.fixture(scope="module")
def simulated(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Simulated:
    """All movable mechanisms of this file in one model: one FMU to build."""
    folder = tmp_path_factory.mktemp("overconstrained")
    mechanisms = (bennett(), bricard(), sarrus(), three_cranks(), spindle(), flap(), lid(), guided_ball())
    parts = [text for mechanism in mechanisms for text in mechanism[0]]
    joints = [text for mechanism in mechanisms for text in mechanism[1]]
    file = write_assembly(folder / "linkages.xml", parts, joints, name="Linkages")
    package = generate(file, folder / "out")
    text = (package.root / "Mechanics.mo").read_text()
    # The lid's ball has nothing to hold.
    assert text.count("ContactMultiBody.Joints.LoopClosure ") == len(mechanisms) - 1
    sources, options = [package.root, ROOT / "ContactMultiBody"], BuildOptions(cache=fmu_cache)
    fmu = build_fmu(package.mechanics, sources, folder / "linkages.fmu", options).fmu
    bodies = [body for group in BODIES.values() for body in group]
    names = [f"{body}.{vector}[{k}]" for body in bodies for vector in ("frame_a.r_0", "v_0", "w_a") for k in (1, 2, 3)]
    names += [f"{body}.frame_a.R.T[{i},{j}]" for body in bodies for i in (1, 2, 3) for j in (1, 2, 3)]
    names += [f"bennettj{k}.phi" for k in (1, 2, 3, 4)] + ["leftFoot.a", "thread.a", "nearHinge.a", "lidHinge.a"]
    result = simulate_fmu(str(fmu), stop_time=0.4, relative_tolerance=1e-9, output_interval=0.02, output=names)
    assert result["time"][-1] == pytest.approx(0.4)
    return Simulated(result)


@pytest.mark.full
def test_bennetts_linkage_keeps_its_relation_of_angles(simulated: Simulated) -> None:
    first, second, third, fourth = (simulated.rows[f"bennettj{k}.phi"] for k in (1, 2, 3, 4))
    product = np.tan((FIRST + first) / 2) * np.tan((SECOND + second) / 2)
    np.testing.assert_allclose(product, BENNETT, rtol=1e-9)
    np.testing.assert_allclose(third, -first, atol=1e-9)
    # The fourth joint is listed from the ground on, against the sense of the ring.
    np.testing.assert_allclose(fourth, second, atol=1e-9)
    assert np.ptp(first) > 0.2


@pytest.mark.full
def test_sarrus_platform_moves_on_a_straight_line(simulated: Simulated) -> None:
    platform = simulated.vector("platform.frame_a.r_0")
    assert np.abs(platform[:, :2]).max() < 1e-9
    assert np.abs(simulated.turn("platform") - np.eye(3)).max() < 1e-9
    assert np.ptp(platform[:, 2]) > 0.05
    knee = simulated.point("a1", (0.2, 0, 0.25))
    # Both links of a leg are equally long: the knee is half as high, and as far out as they reach.
    np.testing.assert_allclose(knee[:, 2], platform[:, 2] / 2, atol=1e-9)
    np.testing.assert_allclose(knee[:, 0], 1 + np.sqrt(LEG**2 - platform[:, 2] ** 2 / 4), atol=1e-9)


@pytest.mark.full
def test_three_cranks_fall_as_two_would_with_the_mass_of_three(simulated: Simulated) -> None:
    length = CRANK @ CRANK
    inertia = 3 * (0.01 + length / 4) + length
    assert simulated.rows["leftFoot.a"][0] == pytest.approx(GRAVITY * (3 * CRANK[0] / 2 + CRANK[0]) / inertia, rel=1e-7)
    assert np.abs(simulated.turn("top") - np.eye(3)).max() < 1e-9
    for name, x in (("left", 0.0), ("middle", 1.0), ("right", 2.0)):
        head = simulated.point(name, CRANK / 2) - simulated.vector("top.frame_a.r_0")
        assert np.abs(head - [x - 1, 0, 0]).max() < 1e-9


@pytest.mark.full
def test_nut_in_a_guide_drives_its_spindle(simulated: Simulated) -> None:
    lead = 0.5 / (2 * np.pi)
    # The nut turns against the shaft as it sinks; it cannot turn in the guide, so the shaft does.
    np.testing.assert_allclose(simulated.rows["thread.a"], -GRAVITY * lead / (0.01 + lead**2), rtol=1e-7)
    assert np.abs(simulated.turn("nut") - np.eye(3)).max() < 1e-9
    sunk = simulated.rows["nut.frame_a.r_0[3]"] - 0.2
    turned = np.unwrap(np.arctan2(simulated.turn("shaft")[:, 0, 1], simulated.turn("shaft")[:, 0, 0]))
    np.testing.assert_allclose(sunk, -lead * turned, atol=1e-9)


@pytest.mark.full
@pytest.mark.parametrize("hinge", ["nearHinge", "lidHinge"])
def test_flap_on_two_bearings_is_a_pendulum(simulated: Simulated, hinge: str) -> None:
    assert simulated.rows[f"{hinge}.a"][0] == pytest.approx(GRAVITY * 0.5 / (0.01 + 0.25), rel=1e-7)


@pytest.mark.full
def test_ball_between_two_sliders_takes_both_along(simulated: Simulated) -> None:
    fallen = [simulated.rows[f"{body}.frame_a.r_0[3]"] - 1 for body in ("lead", "follower")]
    for way in fallen:
        np.testing.assert_allclose(way, -0.5 * GRAVITY * simulated.rows["time"] ** 2, atol=1e-8)


@pytest.mark.full
def test_bricards_ring_stays_closed(simulated: Simulated) -> None:
    first = 0.9
    second = np.arccos(-np.cos(first) / (1 + np.cos(first)))
    frames = revolute_chain((first, second) * 3, (1.0,) * 6, (np.pi / 2, -np.pi / 2) * 3)
    for k in range(5):
        for along in (0.0, 1.0):  # two points of each axis, from both its bodies
            point = frames[k].point([0, 0, along])
            after = simulated.point(f"bricard{k + 1}", point - frames[k + 1].position) if k < 5 else point
            before = simulated.point(f"bricard{k}", point - frames[k].position) if k > 0 else point
            assert np.abs(after - before).max() < 1e-8
    last = frames[5].point([0, 0, 1.0])
    assert np.abs(simulated.point("bricard5", last - frames[5].position) - last).max() < 1e-8
    assert np.ptp(simulated.vector("bricard3.frame_a.r_0"), axis=0).max() > 0.1


@pytest.mark.full
@pytest.mark.parametrize("mechanism", BODIES)
def test_energy_stays(simulated: Simulated, mechanism: str) -> None:
    """Whatever conditions were left out: ideal constraints do no work."""
    kinetic, potential = simulated.energies(BODIES[mechanism])
    energy = kinetic + potential
    assert np.ptp(kinetic) > 0.1
    assert np.abs(energy - energy[0]).max() < 1e-6 * kinetic.max()
