"""Joints of robot descriptions that follow others: motion against reduced equations, power, wrong couplings."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, generate, read_assembly
from fmpy import simulate_fmu
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu
from scipy.integrate import solve_ivp

GRAVITY = 9.81
MASS, ARM, INERTIA = 1.5, 0.3, 0.02  # of every link: centre of mass along its x, moment of inertia about it
END = 0.5


def link(name: str) -> str:
    return (
        f'<link name="{name}"><inertial><origin xyz="{ARM} 0 0"/><mass value="{MASS}"/>'
        f'<inertia ixx="{INERTIA}" iyy="{INERTIA}" izz="{INERTIA}" ixy="0" ixz="0" iyz="0"/></inertial></link>'
    )


def joint(name: str, kind: str, axis: str, mimic: str = "") -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="base"/><child link="{name} link"/>'
        f'<origin xyz="0 {len(name)} 0"/><axis xyz="{axis}"/>{mimic}</joint>'
    )


def follows(leader: str, multiplier: float, offset: float = 0.0) -> str:
    return f'<mimic joint="{leader}" multiplier="{multiplier}" offset="{offset}"/>'


def robot(folder: Path, *joints: str) -> Path:
    names = [text.split('"')[1] for text in joints]
    file = folder / "robot.urdf"
    links = "".join(link(f"{name} link") for name in names)
    file.write_text(f'<robot name="coupled"><link name="base"/>{links}{"".join(joints)}</robot>')
    return file


# Leader, and what follows it: kind, ratio and offset to the leader. Arms turn about y, downwards; lifts go up.
ARMS = {"arm": ("arm", "arm", 1.0, 0.0), "second": ("arm", "arm", -2.0, 0.3), "lift": ("arm", "lift", 0.15, -0.1)}
CHAIN = {"third": ("arm", "arm", 3 * 0.15, 3 * -0.1 + 0.2)}  # follows the lift
LIFTS = {"hoist": ("hoist", "lift", 1.0, 0.0), "wheel": ("hoist", "arm", 5.0, 0.2), "sled": ("hoist", "sled", 0.5, 0.1)}


def coupled(folder: Path) -> Path:
    return robot(
        folder,
        joint("second", "revolute", "0 1 0", follows("arm", -2.0, 0.3)),
        joint("arm", "continuous", "0 1 0"),
        joint("lift", "prismatic", "0 0 1", follows("arm", 0.15, -0.1)),
        joint("third", "revolute", "0 1 0", follows("lift", 3.0, 0.2)),
        joint("hoist", "prismatic", "0 0 1"),
        joint("wheel", "revolute", "0 1 0", follows("hoist", 5.0, 0.2)),
        joint("sled", "prismatic", "1 0 0", follows("hoist", 0.5, 0.1)),
    )


def effort(kind: str, coordinate: float) -> float:
    """What gravity does at a joint."""
    return {"arm": MASS * GRAVITY * ARM * np.cos(coordinate), "lift": -MASS * GRAVITY, "sled": 0.0}[kind]


def inertia(kind: str) -> float:
    return INERTIA + MASS * ARM**2 if kind == "arm" else MASS


def reduced(times: np.ndarray, joints: dict[str, tuple[str, str, float, float]]) -> np.ndarray:
    """The leader's coordinate, speed and acceleration, shape (3, times), by Lagrange's equation of one freedom."""
    whole = sum(ratio**2 * inertia(kind) for _, kind, ratio, _ in joints.values())

    def acceleration(coordinate: float) -> float:
        return sum(r * effort(kind, r * coordinate + c) for _, kind, r, c in joints.values()) / whole

    solution = solve_ivp(
        lambda _t, q: [q[1], acceleration(q[0])], (0, times[-1]), [0, 0], t_eval=times, rtol=1e-11, atol=1e-12
    )
    return np.vstack([solution.y, [acceleration(q) for q in solution.y[0]]])


EFFORTS = {
    "second": ("flange_a.tau", "flange_b.tau"),
    "lift": ("flangeR.tau", "flangeT.f"),
    "third": ("flangeT.f", "flangeR.tau"),
    "wheel": ("flangeT.f", "flangeR.tau"),
    "sled": ("flange_a.f", "flange_b.f"),
}


def test_joints_follow_and_share_their_forces(tmp_path: Path, fmu_cache: Path) -> None:
    """All four pairs of kinds, and one that follows a follower."""
    package = generate(coupled(tmp_path), tmp_path / "out")
    sources, options = [package.root, ROOT / "ContactMultiBody"], BuildOptions(cache=fmu_cache)
    fmu = build_fmu(package.mechatronics, sources, tmp_path / "robot.fmu", options).fmu
    groups = (ARMS | CHAIN, LIFTS)
    letters = {
        name: "s" if kind in ("lift", "sled") else "phi" for group in groups for name, (_, kind, *_) in group.items()
    }
    rates = {"phi": "w", "s": "v"}
    names = [f"{name}.{letter}" for name, letter in letters.items()]
    names += [f"{name}.{rates[letter]}" for name, letter in letters.items()]
    names += [f"{name}Coupling.{item}" for name, pair in EFFORTS.items() for item in pair]
    rows = simulate_fmu(str(fmu), stop_time=END, relative_tolerance=1e-9, output_interval=0.05, output=names)
    leaders = {"second": "arm", "lift": "arm", "third": "lift", "wheel": "hoist", "sled": "hoist"}
    for joints in groups:
        q, v, a = reduced(rows["time"], joints)
        assert np.ptp(q) > 0.05
        for name, (_, kind, ratio, offset) in joints.items():
            found = rows[f"{name}.{letters[name]}"]
            np.testing.assert_allclose(found, ratio * q + offset, atol=1e-7, err_msg=name)
            speed = rows[f"{name}.{rates[letters[name]]}"]
            np.testing.assert_allclose(speed, ratio * v, atol=1e-7, err_msg=name)
            if name not in EFFORTS:
                continue
            given, taken = (rows[f"{name}Coupling.{item}"] for item in EFFORTS[name])
            other = rows[f"{leaders[name]}.{rates[letters[leaders[name]]]}"]
            np.testing.assert_allclose(given * other + taken * speed, 0, atol=1e-8, err_msg=name)
            # What the coupling does to a joint that nothing follows, its link needs beside gravity.
            if name not in leaders.values():
                own = inertia(kind) * ratio * a - np.array([effort(kind, ratio * k + offset) for k in q])
                np.testing.assert_allclose(-taken, own, atol=1e-5, err_msg=name)
                assert np.abs(own).max() > 0.1


def test_followers_start_where_their_leaders_put_them(tmp_path: Path) -> None:
    assembly = read_assembly(coupled(tmp_path))
    starts = {item.name: item.position for item in assembly.joints}
    assert starts == pytest.approx(
        {"arm": 0, "second": 0.3, "lift": -0.1, "third": -0.1, "hoist": 0, "wheel": 0.2, "sled": 0.1}
    )
    np.testing.assert_allclose(assembly.part("lift link").pose.position, [0, 4, -0.1], atol=1e-15)
    turned = assembly.part("second link").pose.direction([1, 0, 0])
    np.testing.assert_allclose(turned, [np.cos(0.3), 0, -np.sin(0.3)], atol=1e-15)


def test_coupling_is_told_and_can_be_left_out(tmp_path: Path) -> None:
    file = coupled(tmp_path)
    package = generate(file, tmp_path / "out")
    assert "joint 'second' follows joint 'arm': -2 times its coordinate + 0.3 rad" in package.notes
    assert "joint 'lift' follows joint 'arm': 0.15 m/rad times its coordinate + -0.1 m" in package.notes
    assert "in the tree, follows &#39;arm&#39;" in package.report.read_text()
    text = (package.root / "Mechanics.mo").read_text()
    assert text.count("fixed=true") == 2 * 2  # two freedoms, angle and speed
    alone = generate(file, tmp_path / "alone", GenerateOptions(couple=False))
    text = (alone.root / "Mechanics.mo").read_text()
    assert "Coupling" not in text
    assert text.count("fixed=true") == 2 * 7
    assert any("as was asked for: 'second'" in note for note in alone.notes)


@pytest.mark.parametrize(
    ("joints", "words"),
    [
        ((joint("a", "revolute", "0 1 0", follows("b", 1)),), "'b' (mimic), which does not exist"),
        (
            (joint("a", "revolute", "0 1 0"), joint("b", "planar", "0 1 0", follows("a", 1))),
            "but only revolute, continuous and prismatic joints can be coupled",
        ),
        ((joint("a", "revolute", "0 1 0"), joint("b", "revolute", "0 1 0", follows("a", 0))), "with the multiplier 0"),
        ((joint("a", "revolute", "0 1 0", follows("a", 2)),), "'a' (mimic), which follows it"),
        (
            (
                joint("a", "revolute", "0 1 0", follows("b", 1)),
                joint("b", "revolute", "0 1 0", follows("c", 1)),
                joint("c", "revolute", "0 1 0", follows("a", 1)),
            ),
            "joint 'c' is to follow joint 'a' (mimic), which follows it: it moves by itself",
        ),
    ],
)
def test_coupling_that_cannot_be_kept_is_named(tmp_path: Path, joints: tuple[str, ...], words: str) -> None:
    package = generate(robot(tmp_path, *joints), tmp_path / "out")
    assert any(words in note for note in package.notes)


def test_joint_taken_as_fixed_does_not_lead(tmp_path: Path) -> None:
    file = robot(tmp_path, joint("a", "revolute", "0 1 0", follows("b", 1)), joint("b", "revolute", "0 1 0"))
    text = file.read_text()
    begin = text.index("<inertial>", text.index('<link name="b link">'))
    end = text.index("</inertial>", begin) + len("</inertial>")
    file.write_text(text[:begin] + text[end:])
    package = generate(file, tmp_path / "out")
    assert any("'b' (mimic), which was taken as fixed: it moves by itself" in note for note in package.notes)
