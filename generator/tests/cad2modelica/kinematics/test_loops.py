"""Loops: which are found, where they are cut, what is wrong with them, and that they stay closed when simulated."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import make_two_loops
import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from cad2modelica.kinematics.kinematic_graph import KinematicTree, kinematic_tree
from cad2modelica.kinematics.loops import LoopAnalysis, analyse_loops
from cad2modelica.kinematics.spherical_axes import with_spherical_axes
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from loop_mechanisms import ring
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu

FIXTURE = Path(__file__).parents[1] / "fixtures" / "two_loops.xml"
ACROSS = (0, 1, 0)


def analysed(file: Path) -> tuple[KinematicTree, LoopAnalysis]:
    assembly = with_spherical_axes(read_assembly(file))
    tree = kinematic_tree(assembly)
    return tree, analyse_loops(assembly, tree)


@dataclass(frozen=True)
class Motion:
    """Poses of bodies at every point of time, from an FMU."""

    rows: Any

    def point(self, body: str, local: Sequence[float]) -> np.ndarray:
        """A point of a body in the world, shape (times, 3)."""
        turn = np.array([[self.rows[f"{body}.frame_a.R.T[{i},{j}]"] for j in (1, 2, 3)] for i in (1, 2, 3)])
        position = np.array([self.rows[f"{body}.frame_a.r_0[{i}]"] for i in (1, 2, 3)])
        return (position + np.einsum("ijt,i->jt", turn, np.asarray(local, dtype=float))).T

    def energy(self, body: str, mass: float, inertia: Sequence[float]) -> np.ndarray:
        """Kinetic and potential energy of a body whose frame is in its centre of mass."""
        velocity = np.array([self.rows[f"{body}.v_0[{i}]"] for i in (1, 2, 3)])
        spin = np.array([self.rows[f"{body}.w_a[{i}]"] for i in (1, 2, 3)])
        height = self.rows[f"{body}.frame_a.r_0[3]"]
        kinetic = 0.5 * mass * (velocity**2).sum(axis=0) + 0.5 * np.asarray(inertia) @ spin**2
        return np.asarray(kinetic + mass * 9.81 * height)


def moved(file: Path, folder: Path, cache: Path, bodies: Sequence[str], stop: float) -> Motion:
    """Generates, builds and simulates."""
    package = generate(file, folder / "out")
    sources, options = [package.root, ROOT / "ContactMultiBody"], BuildOptions(cache=cache)
    fmu = build_fmu(package.mechatronics, sources, folder / "model.fmu", options).fmu
    names = [f"{body}.frame_a.r_0[{i}]" for body in bodies for i in (1, 2, 3)]
    names += [f"{body}.frame_a.R.T[{i},{j}]" for body in bodies for i in (1, 2, 3) for j in (1, 2, 3)]
    names += [f"{body}.{value}[{i}]" for body in bodies for value in ("v_0", "w_a") for i in (1, 2, 3)]
    return Motion(simulate_fmu(str(fmu), stop_time=stop, relative_tolerance=1e-9, output_interval=0.02, output=names))


# ----- eight bodies, nine joints -----


def test_fixture_is_what_its_script_writes(tmp_path: Path) -> None:
    assert make_two_loops.write(tmp_path / "two_loops.xml").read_bytes() == FIXTURE.read_bytes()


def test_eight_bodies_and_nine_joints_have_two_cut_joints(tmp_path: Path) -> None:
    assembly = read_assembly(FIXTURE)
    tree, loops = analysed(FIXTURE)
    assert len(assembly.parts) == 8
    assert len(assembly.joints) == 9
    assert [joint.name for joint in tree.cut_joints] == ["rocker bearing", "lever bearing"]
    assert loops.planar_constraints == {"rocker bearing", "lever bearing"}
    assert {step[0].name for step in loops.loops[0].steps} == {
        "crank bearing",
        "crank pin",
        "coupler pin",
        "rocker bearing",
    }
    # Grübler in the plane: 7 joints - 2*3 = 1, and the two joints of the arm.
    assert loops.freedoms == 3
    text = (generate(FIXTURE, tmp_path / "out").root / "Mechanics.mo").read_text()
    assert len(re.findall(r"ContactMultiBody\.Parts\.Body \w+\(", text)) == 8
    assert len(re.findall(r"Modelica\.Mechanics\.MultiBody\.Joints\.\w+ \w+\(", text)) == 9
    assert text.count("Joints.RevolutePlanarLoopConstraint ") == 2


@pytest.mark.full
def test_two_loops_that_share_bodies_stay_closed(tmp_path: Path, fmu_cache: Path) -> None:
    motion = moved(FIXTURE, tmp_path, fmu_cache, ["crank", "coupler", "rocker", "link", "lever", "hand"], 0.5)
    points = {name: np.array(value) for name, value in make_two_loops.POINTS.items()}
    joints = [
        ("coupler", "b", "rocker", "d", "c"),
        ("link", "e", "lever", "g", "f"),
        ("crank", "a", "coupler", "b", "b"),
    ]
    for first, own, second, other, point in joints:
        gap = motion.point(first, points[point] - points[own]) - motion.point(second, points[point] - points[other])
        assert np.abs(gap).max() < 1e-8
    assert np.abs(motion.point("rocker", (0, 0, 0)) - points["d"]).max() < 1e-8
    assert np.abs(motion.point("lever", (0, 0, 0)) - points["g"]).max() < 1e-8
    assert np.ptp(motion.point("crank", (0.1, 0, 0.2)), axis=0).max() > 0.02


# ----- planar and spatial loops -----


def spatial_crank(first: str, axes: dict[str, Any]) -> tuple[list[str], list[str]]:
    """Crank, coupler and rocker in space; frames in the centres of mass."""
    parts = [
        part("crank", position=(0.05, 0, 0.05)),
        part("coupler", position=(0.3, 0.1, 0.15), inertia=(0.01, 0.011, 0.012)),
        part("rocker", position=(0.6, 0.2, 0.1)),
    ]
    joints = [
        joint("in", "revolute", "ground", "crank", axis=ACROSS, start='speed="2"'),
        joint("near", first, "crank", "coupler", origin=(0.1, 0, 0.1), **axes),
        joint("far", "spherical", "coupler", "rocker", origin=(0.6, 0.3, 0.2)),
        joint("out", "revolute", "ground", "rocker", origin=(0.6, 0.1, 0), axis=(1, 0, 0)),
    ]
    return parts, joints


@pytest.mark.full
def test_loop_with_two_spherical_joints_stays_closed_and_keeps_its_energy(tmp_path: Path, fmu_cache: Path) -> None:
    """Two freedoms: the crank's turn, and the spin of the coupler about its own line, which the model can start."""
    file = write_assembly(tmp_path / "rssr.xml", *spatial_crank("spherical", {}), name="Rssr")
    tree, loops = analysed(file)
    assert [joint.name for joint in tree.cut_joints] == ["far"]
    assert loops.planar_constraints == frozenset()
    assert loops.freedoms == 2
    # Shortly after 0.5 s the crank, whose angle is the state, stands in a dead centre.
    motion = moved(file, tmp_path, fmu_cache, ["crank", "coupler", "rocker"], 0.4)
    gap = motion.point("coupler", (0.3, 0.2, 0.05)) - motion.point("rocker", (0, 0.1, 0.1))
    assert np.abs(gap).max() < 1e-8
    assert np.abs(motion.point("coupler", (-0.2, -0.1, -0.05)) - motion.point("crank", (0.05, 0, 0.05))).max() < 1e-8
    energy = motion.energy("crank", 1.0, (0.01, 0.01, 0.01)) + motion.energy("rocker", 1.0, (0.01, 0.01, 0.01))
    energy += motion.energy("coupler", 1.0, (0.01, 0.011, 0.012))
    assert np.ptp(motion.point("rocker", (0, 0, 0)), axis=0).max() > 0.05
    assert np.abs(energy - energy[0]).max() < 1e-5


@pytest.mark.full
def test_planar_loop_beside_a_spatial_one(tmp_path: Path, fmu_cache: Path) -> None:
    """A four-bar linkage whose rocker moves a lever in another plane: one planar constraint, one cut in space."""
    parts = [
        part("crank"),
        part("coupler", position=(0, 0, 0.3)),
        part("rocker", position=(1, 0, 0)),
        part("link", position=(1, 0.2, 0.3)),
        part("lever", position=(1.5, 0.5, 0)),
    ]
    joints = [
        joint("j1", "revolute", "ground", "crank", axis=ACROSS, start='speed="1"'),
        joint("j2", "revolute", "crank", "coupler", origin=(0.05, 0, 0.25), axis=ACROSS),
        joint("j3", "revolute", "ground", "rocker", origin=(1, 0, 0), axis=ACROSS),
        joint("j4", "revolute", "rocker", "coupler", origin=(1.1, 0, 0.4), axis=ACROSS),
        joint("u", "universal", "rocker", "link", origin=(1, 0.2, 0.3), axis=(0, 0, 1), axis2=(0.3, -0.5, 0)),
        joint("s", "spherical", "link", "lever", origin=(1.5, 0.5, 0.3)),
        joint("hinge", "revolute", "ground", "lever", origin=(1.5, 0.5, 0), axis=(1, 0, 0)),
    ]
    file = write_assembly(tmp_path / "mixed.xml", parts, joints, name="Mixed")
    tree, loops = analysed(file)
    assert loops.planar_constraints == {"j4"}
    assert [joint.name for joint in tree.cut_joints] == ["j4", "s"]
    assert loops.freedoms == 1
    assert loops.rates["j1"] == (1.0,)
    # Shortly after 0.37 s the hinge, whose angle is the state, stands in the dead centre of which the notes tell.
    bodies = ["crank", "coupler", "rocker", "link", "lever"]
    motion = moved(file, tmp_path, fmu_cache, bodies, 0.36)
    assert np.abs(motion.point("coupler", (1.1, 0, 0.1)) - motion.point("rocker", (0.1, 0, 0.4))).max() < 1e-8
    assert np.abs(motion.point("link", (0.5, 0.3, 0)) - motion.point("lever", (0, 0, 0.3))).max() < 1e-8
    assert np.ptp(motion.point("lever", (0, 0, 0.3)), axis=0).max() > 0.005
    energy = np.asarray(sum(motion.energy(body, 1.0, (0.01, 0.01, 0.01)) for body in bodies))
    assert np.abs(energy - energy[0]).max() < 1e-5
    assert any(
        "'hinge' is the state of its loop and comes to a dead centre at about -32.7" in note for note in loops.notes
    )
    with pytest.raises(FMICallException):
        moved(file, tmp_path, fmu_cache, bodies, 0.5)


@pytest.mark.full
def test_loops_planar_through_fixed_rotations_and_parallelogram(tmp_path: Path, fmu_cache: Path) -> None:
    """A slider-crank whose rod is welded from two turned parts, and a parallelogram; both in one model."""
    parts = [
        part("crank"),
        part("rod", position=(0.1, 0, 0.05)),
        part("rod end", position=(0.2, 0, 0.025), turn=((0.3, 0.5, 0.7), 0.8)),
        part("slider", position=(0.4, 0, 0)),
        part("left", position=(0, 1, 0)),
        part("top", position=(0, 1, -0.3)),
        part("right", position=(1, 1, 0)),
    ]
    joints = [
        joint("shaft", "revolute", "ground", "crank", axis=ACROSS, start='speed="3"'),
        joint("pin", "revolute", "crank", "rod", origin=(0.1, 0, 0.05), axis=ACROSS),
        joint("weld", "fixed", "rod", "rod end", origin=(0.2, 0, 0.025)),
        joint("eye", "revolute", "rod end", "slider", origin=(0.4, 0, 0), axis=(0, -1, 0)),
        joint("guide", "prismatic", "ground", "slider", origin=(0.4, 0, 0), axis=(1, 0, 0)),
        joint("l0", "revolute", "ground", "left", origin=(0, 1, 0), axis=ACROSS, start='speed="2"'),
        joint("l1", "revolute", "left", "top", origin=(0.1, 1, -0.3), axis=ACROSS),
        joint("r0", "revolute", "ground", "right", origin=(1, 1, 0), axis=ACROSS),
        joint("r1", "revolute", "right", "top", origin=(1.1, 1, -0.3), axis=ACROSS),
    ]
    file = write_assembly(tmp_path / "planar.xml", parts, joints, name="Planar")
    _, loops = analysed(file)
    assert loops.planar_constraints == {"eye", "r1"}
    assert loops.freedoms == 2
    motion = moved(file, tmp_path, fmu_cache, ["rod", "slider", "top", "right"], 0.5)
    assert np.abs(motion.point("rod", (0.3, 0, -0.05)) - motion.point("slider", (0, 0, 0))).max() < 1e-8
    assert np.abs(motion.point("top", (1.1, 0, 0)) - motion.point("right", (0.1, 0, -0.3))).max() < 1e-8
    level = motion.point("top", (1, 0, 0)) - motion.point("top", (0, 0, 0))
    assert np.abs(level - [1, 0, 0]).max() < 1e-8  # the bar of a parallelogram never turns
    assert np.ptp(motion.point("slider", (0, 0, 0)), axis=0).max() > 0.05


def test_loop_without_spherical_joints(tmp_path: Path) -> None:
    """Revolute and three cylindrical joints: 1 + 3*2 - 6 = 1 freedom; cut at the revolute one, which has a speed."""
    parts = [part("a"), part("b", position=(0.3, 0, 0.2)), part("c", position=(0.6, 0.3, 0.2))]
    joints = [
        joint("r", "revolute", "ground", "a", axis=ACROSS, start='speed="1"'),
        joint("c1", "cylindrical", "a", "b", origin=(0.3, 0, 0.2), axis=(0.6, 0, 0.8)),
        joint("c2", "cylindrical", "b", "c", origin=(0.6, 0.3, 0.2), axis=(0, 0.6, 0.8)),
        joint("c3", "cylindrical", "ground", "c", origin=(0.9, 0.1, 0), axis=(0.8, 0.6, 0)),
    ]
    file = write_assembly(tmp_path / "rccc.xml", parts, joints, name="Rccc")
    tree, loops = analysed(file)
    assert [joint.name for joint in tree.cut_joints] == ["r"]
    assert loops.freedoms == 1
    assert loops.rates["r"] == (1.0,)


@pytest.mark.full
def test_two_planar_loops_in_different_planes_that_share_two_bodies(tmp_path: Path) -> None:
    """Each keeps its own planar constraint, whatever order the joints are listed in."""
    corners = {"p": (1, 0, 1), "q": (2, 0, 1.2), "r": (0.5, 1, 0.4)}
    parts = [part(name) for name in ("bar", "one", "two", "three")]
    joints = [
        joint("bearing", "revolute", "ground", "bar", axis=ACROSS),
        joint("a", "revolute", "bar", "one", origin=corners["p"], axis=ACROSS),
        joint("b", "revolute", "one", "two", origin=corners["q"], axis=ACROSS),
        joint("c", "revolute", "ground", "two", origin=(3, 0, 0), axis=ACROSS),
        joint("x", "revolute", "two", "three", origin=corners["r"], axis=(1, 0, 0)),
    ]
    for order in (joints, joints[::-1]):
        _, loops = analysed(write_assembly(tmp_path / "planes.xml", parts, order))
        assert len(loops.planar_constraints) == 1
        assert loops.freedoms == 2
    extra = [
        part("four"),
        part("five"),
    ]
    second = [
        joint("d", "revolute", "three", "four", origin=(0.5, 2, 1), axis=(1, 0, 0)),
        joint("e", "revolute", "four", "five", origin=(0.5, 3, 0.5), axis=(1, 0, 0)),
        joint("f", "revolute", "two", "five", origin=(0.5, 2.5, -1), axis=(1, 0, 0)),
    ]
    for order in ([*joints, *second], [*second, *joints]):
        tree, loops = analysed(write_assembly(tmp_path / "planes.xml", [*parts, *extra], order))
        assert len(tree.cut_joints) == len(loops.planar_constraints) == 2
        assert loops.freedoms == 8 - 2 * 3


# ----- overconstrained loops -----


def test_third_crank_that_does_not_fit_is_named(tmp_path: Path) -> None:
    """A third crank of another length locks a parallelogram: six revolute joints, six conditions in the plane."""
    parts = [part(name) for name in ("left", "middle", "right", "top")]
    joints = []
    for name, x, foot in (("left", 0.0, 0.0), ("middle", 1.0, 0.0), ("right", 2.0, 0.1)):
        joints.append(joint(f"{name} foot", "revolute", "ground", name, origin=(x, 0, foot), axis=ACROSS))
        joints.append(joint(f"{name} head", "revolute", name, "top", origin=(x + 0.2, 0, 1), axis=ACROSS))
    joints[-1] = joint("right head", "revolute", "right", "top", origin=(2.2, 0, 1), axis=(0.01, 1, 0))
    with pytest.raises(InputError) as caught:
        analysed(write_assembly(tmp_path / "three.xml", parts, joints))
    text = str(caught.value)
    assert "nothing in it can move" in text
    for name in ("left foot", "middle head", "right head"):
        assert f"'{name}'" in text


def test_second_hinge_of_a_rigid_frame_can_be_left_out(tmp_path: Path) -> None:
    """Two bars make a triangle with the ground; one corner has two hinges on one line."""
    parts = [part("a"), part("b")]
    joints = [
        joint("one", "revolute", "ground", "a", axis=ACROSS),
        joint("top", "revolute", "a", "b", origin=(1, 0, 1), axis=ACROSS),
        joint("two", "revolute", "ground", "b", origin=(2, 0, 0), axis=ACROSS),
        joint("again", "revolute", "ground", "b", origin=(2, 1, 0), axis=ACROSS),
    ]
    with pytest.raises(InputError) as caught:
        analysed(write_assembly(tmp_path / "frame.xml", parts, joints))
    assert "'again' left out: the others hold what it holds" in str(caught.value)


def test_remedies_make_the_loop_right(tmp_path: Path) -> None:
    """Every single remedy that the message names gives a mechanism that is accepted."""
    kinds: dict[str, tuple[str, Any]] = {name: ("revolute", ACROSS) for name in ("j1", "j2", "j3")}
    kinds["j4"] = ("revolute", (0.1, 1, 0))

    def write(changed: dict[str, str]) -> Path:
        origins = {"j1": (0, 0, 0), "j2": (0, 0, 1), "j3": (1.5, 0, 1.3), "j4": (2, 0, 0)}
        ends = {"j1": ("ground", "a"), "j2": ("a", "b"), "j3": ("b", "c"), "j4": ("ground", "c")}
        joints = []
        for name, (kind, axis) in kinds.items():
            wanted = changed.get(name, kind)
            axes: dict[str, Any] = {} if wanted == "spherical" else {"axis": axis}
            axes |= {"axis2": np.cross(axis, (0.3, 0, 1))} if wanted == "universal" else {}
            joints.append(joint(name, wanted, *ends[name], origin=origins[name], **axes))
        return write_assembly(tmp_path / "bar.xml", [part("a"), part("b"), part("c")], joints)

    with pytest.raises(InputError) as caught:
        analysed(write({}))
    assert "'j4'" in str(caught.value)
    remedies = re.findall(r"- '(\w+)' as (\w+) joint", str(caught.value))
    assert ("j3", "spherical") in remedies
    for name, kind in remedies:
        _, loops = analysed(write({name: kind}))
        assert loops.freedoms >= 0


def test_cut_joint_does_not_depend_on_other_mechanisms(tmp_path: Path) -> None:
    """Parts elsewhere, and their order, leave the choice alone; stops are kept where they can be."""
    parts = [part("a"), part("b", position=(0, 0, 1)), part("c", position=(2, 0, 0))]
    joints = [
        joint("j1", "revolute", "ground", "a", axis=ACROSS),
        joint("j2", "revolute", "a", "b", origin=(0, 0, 1), axis=ACROSS),
        joint("j3", "revolute", "b", "c", origin=(1.5, 0, 1.3), axis=ACROSS),
        joint("j4", "revolute", "ground", "c", origin=(2, 0, 0), axis=ACROSS, extra='<limits upper="1"/>'),
    ]
    tree, _ = analysed(write_assembly(tmp_path / "one.xml", parts, joints))
    other = joint("other", "revolute", "ground", "z", origin=(9, 9, 9), axis=(1, 0, 0))
    more, _ = analysed(write_assembly(tmp_path / "two.xml", [part("z"), *parts[::-1]], [other, *joints]))
    assert [j.name for j in tree.cut_joints] == [j.name for j in more.cut_joints] == ["j3"]


def test_a_ring_of_many_freedoms_is_noted(tmp_path):
    def notes(count: int) -> list[str]:
        angles = 2 * np.pi * np.arange(count) / count
        points = [(float(np.sin(angle)), 0.0, float(np.cos(angle))) for angle in angles]
        mechanism = ring("r", ["revolute"] * count, points, [ACROSS] * count)
        file = write_assembly(tmp_path / f"ring{count}.xml", mechanism.parts, mechanism.joints)
        return [str(note) for note in analysed(file)[1].notes if "dead centres" in str(note)]

    (said,) = notes(12)
    assert "moves in 9 ways" in said
    assert "ends there" in said
    assert notes(4) == []
