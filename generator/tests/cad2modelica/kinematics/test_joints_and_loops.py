"""Joints move by closed forms or independent integrations; loops are closed, or refused with a reason."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from cad2modelica.kinematics.kinematic_graph import kinematic_tree
from cad2modelica.kinematics.loops import analyse_loops
from contact_foundation.errors import InputError
from mechanics_simulation import ROOT, Trajectory, simulate
from scipy.spatial.transform import Rotation

GRAVITY = np.array([0.0, 0.0, -9.81])
STEEP = np.array([0.6, 0.0, -0.8])
TIME = 0.5

SWING = {"mass": 2.0, "center": (0.1, -0.05, 0.2), "inertia": (0.02, 0.03, 0.04)}


@pytest.fixture(scope="module")
def moved(tmp_path_factory: pytest.TempPathFactory) -> Trajectory:
    """One assembly with all joint types but spherical ones, each with a body of its own."""
    folder = tmp_path_factory.mktemp("joints")
    turn = ((0.0, 0.6, 0.8), 0.7)
    parts = [
        part("slider", position=(1, 2, 3), turn=turn),
        part("screw", position=(0, 5, 0), turn=turn, center=(0, 0, 0)),
        part("puck", position=(4, 0, 0), turn=turn),
        part("cardan", position=(7, 0, 1), turn=turn, **SWING),
        part("cross", position=(9, 0, 1), mass=1e-9, inertia=(1e-12, 1e-12, 1e-12)),
        part("twin", position=(9, 0, 1), turn=turn, **SWING),
        part(
            "stone",
            position=(13, 0, 2),
            turn=turn,
            **SWING,
            start='<start velocity="1 -2 3" angularVelocity="0.5 4 -1"/>',
        ),
        part("thrown", position=(15, 0, 2), turn=turn, **SWING),
        part("plate", position=(17, 1, 0)),
        part("rider", position=(17, 1, 0.5), turn=turn),
    ]
    joints = [
        joint(
            "slide", "prismatic", "ground", "slider", origin=(0, 0, 1), axis=STEEP, start='position="0.25" speed="0.5"'
        ),
        joint(
            "spindle",
            "cylindrical",
            "ground",
            "screw",
            origin=(0, 5, 0),
            axis=STEEP,
            start='velocity="0.6 0 -0.8" angularVelocity="1.8 0 -2.4"',
        ),
        joint(
            "table",
            "planar",
            "ground",
            "puck",
            origin=(4, 0, 0),
            axis=(0, 1, 0),
            start='velocity="1 0 2" angularVelocity="0 3 0"',
        ),
        joint(
            "hook",
            "universal",
            "ground",
            "cardan",
            origin=(7, 0, 1),
            axis=(0, 1, 0),
            axis2=(1, 0, 0),
            start='angularVelocity="0.7 0.3 0"',
        ),
        joint("first", "revolute", "ground", "cross", origin=(9, 0, 1), axis=(0, 1, 0), start='speed="0.3"'),
        joint("second", "revolute", "cross", "twin", origin=(9, 0, 1), axis=(1, 0, 0), start='speed="0.7"'),
        joint("throw", "free", "ground", "thrown", origin=(15, 1, 2), start='velocity="1 0 4" angularVelocity="0 0 2"'),
        joint("rail", "prismatic", "ground", "plate", origin=(17, 1, 0), axis=(1, 0, 0), start='speed="2"'),
        joint("weld", "fixed", "plate", "rider", origin=(17, 1, 0)),
    ]
    package = generate(write_assembly(folder / "joints.xml", parts, joints), folder / "out")
    # Tighter than this, the simulator refuses its own interpolation at one step.
    return simulate(folder / "out", package.mechanics, TIME, 0.05, tolerance=1e-9)


def center_of(moved: Trajectory, name: str) -> np.ndarray:
    turned = moved.matrix(f"{name}.frame_a.R.T")
    return moved.vector(f"{name}.frame_a.r_0") + np.einsum("tji,j->ti", turned, np.array(SWING["center"]))


def test_prismatic(moved: Trajectory) -> None:
    along = 0.25 + 0.5 * moved.time + 0.5 * GRAVITY @ STEEP * moved.time**2
    np.testing.assert_allclose(moved.columns["slide.s"], along, atol=1e-7)
    expected = np.array([1, 2, 3]) + np.outer(along - 0.25, STEEP)
    np.testing.assert_allclose(moved.vector("slider.frame_a.r_0"), expected, atol=1e-7)


def test_cylindrical(moved: Trajectory) -> None:
    along = 1.0 * moved.time + 0.5 * GRAVITY @ STEEP * moved.time**2
    np.testing.assert_allclose(moved.columns["spindle.s"], along, atol=1e-7)
    np.testing.assert_allclose(moved.columns["spindle.phi"], 3.0 * moved.time, atol=1e-7)


def test_planar(moved: Trajectory) -> None:
    expected = np.array([4, 0, 0]) + np.outer(moved.time, [1, 0, 2]) + np.outer(moved.time**2 / 2, GRAVITY)
    np.testing.assert_allclose(moved.vector("puck.frame_a.r_0"), expected, atol=1e-7)
    np.testing.assert_allclose(moved.columns["table.phi"], 3.0 * moved.time, atol=1e-7)


def test_universal_is_two_revolutes(moved: Trajectory) -> None:
    np.testing.assert_allclose(moved.columns["hook.phi_a"], moved.columns["first.phi"], atol=1e-6)
    np.testing.assert_allclose(moved.columns["hook.phi_b"], moved.columns["second.phi"], atol=1e-6)
    assert np.ptp(moved.columns["hook.phi_b"]) > 0.1


def test_free_part_and_free_joint(moved: Trajectory) -> None:
    """Centres of mass fly on parabolas; their start speeds follow from the given point's."""
    turn = Rotation.from_rotvec(0.7 * np.array([0, 0.6, 0.8]))
    arm = turn.apply(SWING["center"])
    for name, position, velocity, spin in (
        ("stone", [13, 0, 2], np.array([1, -2, 3]), np.array([0.5, 4, -1])),
        # The joint's point (15, 1, 2) moves with the given speed; the part's origin lies 1 m beside it.
        ("thrown", [15, 0, 2], np.array([1, 0, 4]) + np.cross([0, 0, 2], [0, -1, 0]), np.array([0, 0, 2])),
    ):
        speed = velocity + np.cross(spin, arm)
        expected = position + arm + np.outer(moved.time, speed) + np.outer(moved.time**2 / 2, GRAVITY)
        np.testing.assert_allclose(center_of(moved, name), expected, atol=1e-6, err_msg=name)


def test_free_part_is_the_root_of_its_mechanism(tmp_path: Path) -> None:
    """A limb chosen as root would make the free part's given orientation a nonlinear condition on the limb's."""
    parts = [part("torso", position=(0, 0, 1)), part("upper", position=(1, 0, 1)), part("lower", position=(2, 0, 1))]
    joints = [
        joint("hip", "revolute", "torso", "upper", origin=(0.5, 0, 1), axis=(0, 0, 1)),
        joint("knee", "revolute", "upper", "lower", origin=(1.5, 0, 1), axis=(0, 1, 0)),
    ]
    package = generate(write_assembly(tmp_path / "limbs.xml", parts, joints), tmp_path / "out")
    text = (package.root / "Mechanics.mo").read_text()
    bodies = {name: kind for kind, name in re.findall(r"Parts\.(\w*Body) (\w+)\(", text)}
    assert bodies == {"torso": "FreeBody", "upper": "Body", "lower": "Body"}


@pytest.mark.parametrize("by_joint", [True, False])
def test_part_with_a_speed_is_the_root_wherever_it_is_listed(tmp_path: Path, by_joint: bool) -> None:
    start = 'velocity="1 0 2" angularVelocity="0 0 3"'
    torso = part("torso", position=(0, 0, 1), start="" if by_joint else f"<start {start}/>")
    parts = [part("lower", position=(2, 0, 1)), part("upper", position=(1, 0, 1)), torso]
    joints = [
        joint("knee", "revolute", "upper", "lower", origin=(1.5, 0, 1), axis=(0, 1, 0)),
        joint("hip", "revolute", "torso", "upper", origin=(0.5, 0, 1), axis=(0, 0, 1)),
    ]
    if by_joint:
        joints.append(joint("throw", "free", "ground", "torso", origin=(0, 0, 1), start=start))
    package = generate(write_assembly(tmp_path / "limbs.xml", parts, joints), tmp_path / "out")
    text = (package.root / "Mechanics.mo").read_text()
    bodies = dict(re.findall(r"Parts\.FreeBody (\w+)\((.*?)\) \"", text, flags=re.DOTALL))
    assert list(bodies) == ["torso"]
    assert "v_0(start={1,0,2}" in bodies["torso"]
    assert "w_0_start={0,0,3}" in bodies["torso"]
    assert not any("its start speed was ignored" in note for note in package.notes)


def test_speed_of_a_part_that_a_joint_holds_is_named(tmp_path: Path) -> None:
    arm = part("arm", start='<start velocity="1 0 2"/>')
    file = write_assembly(tmp_path / "arm.xml", [arm], [joint("j", "revolute", "ground", "arm", axis=(0, 1, 0))])
    notes = generate(file, tmp_path / "out").notes
    assert "part 'arm': its start speed was ignored, for joints hold it; give it to a joint" in notes


def test_fixed_joint_carries_its_part(moved: Trajectory) -> None:
    expected = np.array([17, 1, 0.5]) + np.outer(moved.time, [2, 0, 0])
    np.testing.assert_allclose(moved.vector("rider.frame_a.r_0"), expected, atol=1e-7)


# ----- loops -----


def four_bar() -> tuple[dict[str, np.ndarray], dict[str, float]]:
    """Corners and bar angles of the reference four-bar linkage at the start, by intersecting two circles."""
    crank = 0.9
    a, d = 0.2 * np.array([np.cos(crank), np.sin(crank)]), np.array([0.6, 0.0])
    across = d - a
    distance = float(np.hypot(*across))
    along = (0.5**2 - 0.4**2 + distance**2) / (2 * distance)
    height = np.sqrt(0.5**2 - along**2)
    b = a + (along * across + height * np.array([-across[1], across[0]])) / distance

    def angle(vector: np.ndarray) -> float:
        return float(np.arctan2(vector[1], vector[0]))

    corners = {"o": np.zeros(3), "a": np.append(a, 0), "b": np.append(b, 0), "d": np.append(d, 0)}
    return corners, {"crank": crank, "coupler": angle(b - a), "rocker": angle(b - d)}


def write_four_bar(file: Path, last_axis: tuple[float, float, float] = (0, 0, 1), last: str = "revolute") -> Path:
    corners, angles = four_bar()
    up = (0, 0, 1)
    parts = [
        part("crank", turn=(up, angles["crank"]), mass=0.4, center=(0.1, 0, 0), inertia=(1e-3, 1e-3, 2e-3)),
        part(
            "coupler",
            position=corners["a"],
            turn=(up, angles["coupler"]),
            mass=0.8,
            center=(0.25, 0.02, 0),
            inertia=(1e-2, 1e-2, 2e-2),
        ),
        part(
            "rocker",
            position=corners["d"],
            turn=(up, angles["rocker"]),
            mass=0.6,
            center=(0.2, 0, 0),
            inertia=(4e-3, 4e-3, 8e-3),
        ),
    ]
    difference = {"j2": angles["coupler"] - angles["crank"], "j4": angles["rocker"]}
    axis = None if last == "spherical" else last_axis
    joints = [
        joint("j1", "revolute", "ground", "crank", axis=up, start='position="0.9"'),
        joint(
            "j2", "revolute", "crank", "coupler", origin=corners["a"], axis=up, start=f'position="{difference["j2"]!r}"'
        ),
        joint(
            "j4", "revolute", "ground", "rocker", origin=corners["d"], axis=up, start=f'position="{difference["j4"]!r}"'
        ),
        joint("j3", last, "rocker", "coupler", origin=corners["b"], axis=axis),
    ]
    return write_assembly(file, parts, joints, gravity=(0, -9.80665, 0), name="Linkage")


def test_planar_loop_agrees_with_openmodelica(tmp_path: Path) -> None:
    """The reference trajectory of the same four-bar linkage written by hand."""
    package = generate(write_four_bar(tmp_path / "linkage.xml"), tmp_path / "out")
    text = (package.root / "Mechanics.mo").read_text()
    assert text.count("RevolutePlanarLoopConstraint j3(") == text.count("PlanarLoopConstraint") == 1
    assert text.count("fixed=true") == 2  # one degree of freedom: its position and its speed
    found = simulate(tmp_path / "out", package.mechanics, 1.0, 0.1)
    reference = np.genfromtxt(ROOT / "Resources" / "reference" / "PlanarFourBar.csv", delimiter=",", names=True)
    rows = [int(np.argmin(np.abs(reference["time"] - time))) for time in found.time]
    np.testing.assert_allclose(reference["time"][rows], found.time, atol=1e-9)
    for ours, theirs in (("j1.phi", "j1phi"), ("j4.phi", "j4phi"), ("j1.w", "j1w")):
        np.testing.assert_allclose(found.columns[ours], reference[theirs][rows], atol=1e-5, err_msg=ours)


def test_overconstrained_loop_is_refused(tmp_path: Path) -> None:
    """A revolute axis out of the plane leaves the four-bar no motion: six equations, four unknowns."""
    with pytest.raises(InputError, match="overconstrained") as caught:
        generate(write_four_bar(tmp_path / "linkage.xml", last_axis=(0.1, 0, 1)), tmp_path / "out")
    assert "spherical" in str(caught.value)
    assert not (tmp_path / "out").exists()


def independent_count(file: Path) -> int:
    assembly = read_assembly(file)
    return sum(sum(flags) for flags in analyse_loops(assembly, kinematic_tree(assembly)).independent.values())


def test_spatial_loop_with_spherical_joints(tmp_path: Path) -> None:
    """Revolute, spherical, spherical, revolute: 1 + 3 + 3 + 1 - 6 = 2 freedoms (one is the coupler's spin)."""
    parts = [part("crank"), part("coupler", position=(0.2, 0, 0)), part("rocker", position=(0.6, 0, 0))]
    joints = [
        joint("in", "revolute", "ground", "crank", axis=(0, 0, 1)),
        joint("s1", "spherical", "crank", "coupler", origin=(0.2, 0.1, 0)),
        joint("s2", "spherical", "coupler", "rocker", origin=(0.6, 0.3, 0.1)),
        joint("out", "revolute", "ground", "rocker", origin=(0.6, 0, 0), axis=(0, 1, 0)),
    ]
    file = write_assembly(tmp_path / "rssr.xml", parts, joints)
    assert independent_count(file) == 2


def test_slider_crank_cuts_a_revolute_joint(tmp_path: Path) -> None:
    """In a planar loop with a prismatic joint the cut falls on a revolute joint, wherever it is listed."""
    parts = [part("crank"), part("rod", position=(0.1, 0, 0)), part("slider", position=(0.3, 0, 0))]
    joints = [
        joint("shaft", "revolute", "ground", "crank", axis=(0, 1, 0)),
        joint("pin", "revolute", "crank", "rod", origin=(0.1, 0, 0.05), axis=(0, 1, 0)),
        joint("eye", "revolute", "rod", "slider", origin=(0.3, 0, 0), axis=(0, -1, 0)),
        joint("guide", "prismatic", "ground", "slider", origin=(0.3, 0, 0), axis=(1, 0, 0)),
    ]
    file = write_assembly(tmp_path / "crank.xml", parts, joints)
    assembly = read_assembly(file)
    tree = kinematic_tree(assembly)
    assert [joint.name for joint in tree.cut_joints] == ["eye"]
    loops = analyse_loops(assembly, tree)
    assert loops.planar_constraints == {"eye"}
    assert loops.independent["shaft"] == (True,)
    assert not any(any(loops.independent[name]) for name in ("pin", "eye", "guide"))


def test_two_coupled_planar_loops_have_one_constraint_each(tmp_path: Path) -> None:
    """A six-bar (Watt) chain: seven revolutes, two loops: 7 - 2 * 3 = 1 freedom."""
    places = {
        "a": (0, 0, 0),
        "b": (1, 0, 2),
        "c": (3, 0, 2.5),
        "d": (4, 0, 0),
        "e": (3.5, 0, 4),
        "f": (7, 0, 3),
        "g": (6, 0, 0),
    }
    names = ["crank", "ternary", "rocker", "link", "output"]
    edges = [
        ("a", "ground", "crank"),
        ("b", "crank", "ternary"),
        ("c", "ternary", "rocker"),
        ("d", "ground", "rocker"),
        ("e", "ternary", "link"),
        ("f", "link", "output"),
        ("g", "ground", "output"),
    ]
    joints = [joint(n, "revolute", p, c, origin=places[n], axis=(0, 1, 0)) for n, p, c in edges]
    file = write_assembly(tmp_path / "watt.xml", [part(name) for name in names], joints)
    assembly = read_assembly(file)
    tree = kinematic_tree(assembly)
    loops = analyse_loops(assembly, tree)
    assert len(tree.cut_joints) == len(loops.planar_constraints) == 2
    assert independent_count(file) == 1


def test_start_speeds_satisfy_the_loop(tmp_path: Path) -> None:
    """A parallelogram: the rocker turns as fast as the crank, the coupler not at all."""
    parts = [part("crank"), part("coupler", position=(0, 0, 1)), part("rocker", position=(2, 0, 0))]
    joints = [
        joint("j1", "revolute", "ground", "crank", axis=(0, 1, 0), start='speed="3"'),
        joint("j2", "revolute", "crank", "coupler", origin=(0.5, 0, 1), axis=(0, 1, 0), start='speed="9"'),
        joint("j3", "revolute", "ground", "rocker", origin=(2, 0, 0), axis=(0, 1, 0)),
        joint("j4", "revolute", "rocker", "coupler", origin=(2.5, 0, 1), axis=(0, 1, 0)),
    ]
    assembly = read_assembly(write_assembly(tmp_path / "loop.xml", parts, joints))
    loops = analyse_loops(assembly, kinematic_tree(assembly))
    assert loops.rates["j1"] == (3.0,)
    assert loops.rates["j3"] == pytest.approx((3.0,))
    assert loops.rates["j2"] == pytest.approx((-3.0,))
    assert any("'j2'" in note and "ignored" in note for note in loops.notes)
