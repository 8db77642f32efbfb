"""The committed first impact: reproducible, and right by equations that share nothing with the script's."""

from __future__ import annotations

import runpy
import tomllib
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import read_assembly
from cad2modelica.collision.collision_shapes import collision_geometry
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation


def test_file_is_what_the_script_computes(hammer: Path) -> None:
    script = runpy.run_path(str(hammer.parent / "make_expected.py"))
    computed = tomllib.loads(script["report"]())
    committed = tomllib.loads((hammer.parent / "expected.toml").read_text())
    assert committed["first_impact"]["time"] == pytest.approx(computed["first_impact"]["time"], abs=1e-10)
    for ours, theirs in zip(committed["before_impact"], computed["before_impact"], strict=True):
        assert ours == pytest.approx(theirs, abs=1e-9)
    assert committed["first_impact"]["relative_energy_drift"] < 1e-12


def test_impact_by_constrained_bodies_in_space(hammer: Path) -> None:
    """Newton-Euler equations of two free bodies in space with joints as constraints, from the generator's own
    reading, and the collision hulls it chose: the same time of impact."""
    assembly = read_assembly(hammer)
    arm, head, anvil = (assembly.part(name) for name in ("arm", "hammer head", "anvil"))
    shoulder, elbow = assembly.joints
    vertices = np.concatenate([s.vertices for s in collision_geometry(head).shapes if s.vertices is not None])
    top = max(
        anvil.pose.point(s.vertices)[:, 2].max() for s in collision_geometry(anvil).shapes if s.vertices is not None
    )
    bodies = (arm, head)
    rotations = [Rotation.from_matrix(body.pose.rotation) for body in bodies]
    centers = [body.pose.point(body.mass_properties.center_of_mass) for body in bodies]
    # Joint points from the centres of mass, in body axes; the third and fourth are the elbow on both bodies.
    local = [
        rotations[0].inv().apply(shoulder.origin - centers[0]),
        rotations[0].inv().apply(elbow.origin - centers[0]),
        rotations[1].inv().apply(elbow.origin - centers[1]),
    ]

    def unpack(state: np.ndarray) -> tuple[list[np.ndarray], list[Rotation], np.ndarray]:
        return (
            [state[0:3], state[3:6]],
            [Rotation.from_quat(state[6:10]), Rotation.from_quat(state[10:14])],
            state[14:26],
        )

    def skew(v: np.ndarray) -> np.ndarray:
        return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])

    def rates(_time: float, state: np.ndarray) -> np.ndarray:
        _, turns, speed = unpack(state)
        omega = [speed[3:6], speed[9:12]]
        inertia = [
            t.as_matrix() @ b.mass_properties.inertia @ t.as_matrix().T for t, b in zip(turns, bodies, strict=True)
        ]
        mass = np.zeros((12, 12))
        force = np.zeros(12)
        for k, body in enumerate(bodies):
            mass[6 * k : 6 * k + 3, 6 * k : 6 * k + 3] = body.mass_properties.mass * np.eye(3)
            mass[6 * k + 3 : 6 * k + 6, 6 * k + 3 : 6 * k + 6] = inertia[k]
            force[6 * k : 6 * k + 3] = body.mass_properties.mass * assembly.gravity
            force[6 * k + 3 : 6 * k + 6] = -np.cross(omega[k], inertia[k] @ omega[k])
        s, e1, e2 = turns[0].apply(local[0]), turns[0].apply(local[1]), turns[1].apply(local[2])
        jacobian = np.zeros((6, 12))
        jacobian[0:3, 0:3], jacobian[0:3, 3:6] = np.eye(3), -skew(s)
        jacobian[3:6, 0:3], jacobian[3:6, 3:6] = np.eye(3), -skew(e1)
        jacobian[3:6, 6:9], jacobian[3:6, 9:12] = -np.eye(3), skew(e2)

        def centripetal(w: np.ndarray, arm_: np.ndarray) -> np.ndarray:
            return np.cross(w, np.cross(w, arm_))

        bias = np.concatenate([-centripetal(omega[0], s), -centripetal(omega[0], e1) + centripetal(omega[1], e2)])
        # Motion stays in the plane by symmetry; the axes' constraints carry no force then and are left out.
        system = np.block([[mass, jacobian.T], [jacobian, np.zeros((6, 6))]])
        acceleration = np.linalg.solve(system, np.concatenate([force, bias]))[:12]
        spins = []
        for turn, w in zip(turns, omega, strict=True):
            x, y, z, q = turn.as_quat()
            spins.append(0.5 * np.append(q * w + np.cross(w, [x, y, z]), -w @ [x, y, z]))
        return np.concatenate([speed[0:3], speed[6:9], *spins, acceleration])

    def gap(_time: float, state: np.ndarray) -> float:
        position, turns, _ = unpack(state)
        points = turns[1].apply(vertices - head.mass_properties.center_of_mass) + position[1]
        return float(points[:, 2].min() - top)

    gap.terminal = True  # type: ignore[attr-defined]
    start = np.concatenate([*centers, *(r.as_quat() for r in rotations), np.zeros(12)])
    solution = solve_ivp(
        rates, (0, 1), start, method="DOP853", rtol=1e-11, atol=1e-12, events=gap, dense_output=True, max_step=5e-3
    )
    guess = solution.t_events[0][0]
    time = brentq(lambda t: gap(t, solution.sol(t)), guess - 5e-3, guess, xtol=1e-14)
    expected = tomllib.loads((hammer.parent / "expected.toml").read_text())["first_impact"]
    assert time == pytest.approx(expected["time"], abs=1e-8)
    position, turns, _ = unpack(solution.sol(time))
    points = turns[1].apply(vertices - head.mass_properties.center_of_mass) + position[1]
    lowest = points[np.argmin(points[:, 2])]
    assert lowest[[0, 2]] == pytest.approx([expected["point"][0], expected["point"][2]], abs=1e-7)
    anvil_points = anvil.pose.point(np.concatenate([s.vertices for s in collision_geometry(anvil).shapes]))
    flat = anvil_points[np.abs(anvil_points[:, 2] - top) < 1e-9]
    assert flat[:, 0].min() < lowest[0] < flat[:, 0].max()
