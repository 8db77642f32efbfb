"""Trajectories and scenes made without any FMU: closed forms, and a double pendulum integrated by SciPy."""

from __future__ import annotations

import copy
import functools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from fmu_regression.results.result import SimulationResult
from scipy.integrate import solve_ivp

G = 9.81


def box_mesh(
    name: str, size: tuple[float, float, float], center: tuple[float, float, float], color: Any
) -> dict[str, Any]:
    corners = [
        [center[0] + x * size[0] / 2, center[1] + y * size[1] / 2, center[2] + z * size[2] / 2]
        for x in (-1, 1)
        for y in (-1, 1)
        for z in (-1, 1)
    ]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])]
    return {"name": name, "vertices": corners, "triangles": triangles, "color": color}


def cylinder_mesh(name: str, radius: float, length: float, axis: str, center: Any, color: Any) -> dict[str, Any]:
    n = 40
    rings = [
        [radius * math.cos(2 * math.pi * k / n), radius * math.sin(2 * math.pi * k / n), z]
        for z in (-length / 2, length / 2)
        for k in range(n)
    ]
    points = [*rings, [0, 0, -length / 2], [0, 0, length / 2]]
    triangles = []
    for k in range(n):
        m = (k + 1) % n
        triangles += [[k, m, n + k], [m, n + m, n + k], [2 * n, m, k], [2 * n + 1, n + k, n + m]]
    turn = {"x": [2, 1, 0], "y": [0, 2, 1], "z": [0, 1, 2]}[axis]
    if axis != "z":
        triangles = [[a, c, b] for a, b, c in triangles]
    vertices = [[center[i] + point[turn[i]] for i in range(3)] for point in points]
    return {"name": name, "vertices": vertices, "triangles": triangles, "color": color}


def sphere_mesh(name: str, radius: float, color: Any, center: Any = (0, 0, 0)) -> dict[str, Any]:
    rows, columns = 20, 40
    vertices = [[0, 0, radius]]
    for i in range(1, rows):
        theta = math.pi * i / rows
        for k in range(columns):
            phi = 2 * math.pi * k / columns
            vertices.append(
                [
                    radius * math.sin(theta) * math.cos(phi),
                    radius * math.sin(theta) * math.sin(phi),
                    radius * math.cos(theta),
                ]
            )
    vertices.append([0, 0, -radius])
    last = len(vertices) - 1
    triangles = []
    for k in range(columns):
        m = (k + 1) % columns
        triangles.append([0, 1 + k, 1 + m])
        triangles.append([last, last - columns + m, last - columns + k])
        for i in range(rows - 2):
            a, b = 1 + i * columns, 1 + (i + 1) * columns
            triangles += [[a + k, b + k, b + m], [a + k, b + m, a + m]]
    vertices = [[value + offset for value, offset in zip(point, center, strict=True)] for point in vertices]
    return {"name": name, "vertices": vertices, "triangles": triangles, "color": color}


IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def body(name: str, **values: Any) -> dict[str, Any]:
    entry: dict[str, Any] = {
        "name": name,
        "label": name,
        "variable": name,
        "fixed": False,
        "position": [0.0, 0.0, 0.0],
        "rotation": IDENTITY,
        "mass": 0.0,
        "centerOfMass": [0.0, 0.0, 0.0],
        "inertia": [[0.0] * 3] * 3,
        "meshes": [],
    }
    return {**entry, **values}


def scene(name: str, bodies: list[dict[str, Any]], **values: Any) -> dict[str, Any]:
    return {"format": 1, "name": name, "gravity": [0.0, 0.0, -G], "bodies": bodies, "joints": [], **values}


def write_scene(content: dict[str, Any], path: Path) -> Path:
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def pose_signals(name: str, position: np.ndarray, rotation: np.ndarray) -> dict[str, np.ndarray]:
    signals = {f"{name}.frame_a.r_0[{i + 1}]": position[:, i].copy() for i in range(3)}
    for i in range(3):
        for j in range(3):
            signals[f"{name}.frame_a.R.T[{i + 1},{j + 1}]"] = rotation[:, i, j].copy()
    return signals


# --- A ball that bounces on a rigid floor, contact times of a given length, in closed form -----------------------


def bouncing_ball(
    e: float, drops: int = 3, events: bool = True
) -> tuple[dict[str, Any], SimulationResult, list[float]]:
    """A ball dropped from 1 m; its contacts are half sine pushes of 2 ms. Also returns the times of impact."""
    radius, push = 0.1, 2e-3
    pieces: list[tuple[np.ndarray, ...]] = []
    impacts = []
    t, height, speed = 0.0, 1.0, 0.0
    mass = 1.0
    for _ in range(drops):
        flight = (speed + math.sqrt(speed**2 + 2 * G * height)) / G
        s = np.linspace(0, flight, 200)
        z = height + speed * s - G * s**2 / 2
        pieces.append((t + s, z, speed - G * s, np.zeros_like(s), np.zeros_like(s)))
        t += flight
        impacts.append(t)
        v = G * flight - speed
        # The contact: speed goes from -v to e v like the integral of a half sine.
        s = np.linspace(0, push, 41)
        share = (1 - np.cos(math.pi * s / push)) / 2
        u = -v + (1 + e) * v * share
        force = mass * (1 + e) * v * math.pi / (2 * push) * np.sin(math.pi * s / push)
        depth = np.concatenate([[0], np.cumsum((u[1:] + u[:-1]) / 2 * np.diff(s))])
        depth -= depth[-1] * s / push
        pieces.append((t + s, depth - 1e-12, u, force, np.ones_like(s)))
        t += push
        height, speed = 0.0, e * v
    time, z, velocity, force, touches = (np.concatenate(columns) for columns in zip(*pieces, strict=True))
    if not events:
        keep = np.concatenate([[True], np.diff(time) > 0])
        time, z, velocity, force, touches = time[keep], z[keep], velocity[keep], force[keep], touches[keep]
    count = time.size
    position = np.stack([np.zeros(count), np.zeros(count), z + radius], axis=1)
    signals = pose_signals("ball", position, np.broadcast_to(np.eye(3), (count, 3, 3)))
    signals |= {"ball.v_0[1]": np.zeros(count), "ball.v_0[2]": np.zeros(count), "ball.v_0[3]": velocity}
    signals |= {f"ball.w_a[{i}]": np.zeros(count) for i in (1, 2, 3)}
    signals |= {
        "contacts.distance[1]": z,
        "contacts.normalForce[1]": force,
        "contacts.approachSpeed[1]": -velocity,
        "contacts.touches[1]": touches,
        "contacts.elasticEnergy": np.zeros(count),
        "contacts.force[1,1]": np.zeros(count),
        "contacts.force[1,2]": np.zeros(count),
        "contacts.force[1,3]": force,
    }
    inertia = [[0.004, 0, 0], [0, 0.004, 0], [0, 0, 0.004]]
    content = scene(
        "Ball on floor",
        [
            body(
                "ball",
                mass=mass,
                inertia=inertia,
                position=[0, 0, 1.1],
                meshes=[sphere_mesh("b", radius, [0.85, 0.4, 0.1])],
            ),
            body("floor", fixed=True, meshes=[box_mesh("f", (2, 2, 0.1), (0, 0, -0.05), [0.6, 0.63, 0.68])]),
        ],
        contacts={"manager": "contacts", "pairs": [{"index": 1, "bodies": ["ball", "floor"], "restitution": e}]},
    )
    return content, SimulationResult(time=time, signals=signals, model="BallOnFloor"), impacts


# --- A hammer on a double pendulum that strikes an anvil, integrated by SciPy -------------------------------------

ARM, HEAD, HEIGHT, PEEN = 0.3, 0.3, 0.04, 0.03
M1, M2, I1, I2 = 0.5, 1.2, 4e-3, 8e-3
C1, C2 = 0.15, 0.27
STIFFNESS, E = 1e6, 0.5
ANVIL = 0.0
DAMPING = 1.433


def hammer(rows: int = 1000) -> tuple[dict[str, Any], SimulationResult]:
    """Arm and hammer in the plane y = 0; the hammer's round peen hits the top of an anvil, F = k x (1 + d x'/v0).

    Integrated once a process; each call gets a copy of its own.
    """
    return copy.deepcopy(_integrated_hammer(rows))


@functools.cache
def _integrated_hammer(rows: int) -> tuple[dict[str, Any], SimulationResult]:

    def center(q1: float, q2: float) -> tuple[np.ndarray, np.ndarray]:
        a = q1 + q2
        p = np.array([ARM * math.cos(q1), -ARM * math.sin(q1)]) + HEAD * np.array([math.cos(a), -math.sin(a)])
        p += HEIGHT * np.array([-math.sin(a), -math.cos(a)])
        j1 = np.array([-ARM * math.sin(q1), -ARM * math.cos(q1)])
        j2 = HEAD * np.array([-math.sin(a), -math.cos(a)]) + HEIGHT * np.array([-math.cos(a), math.sin(a)])
        return p, np.column_stack([j1 + j2, j2])

    def force_at(state: np.ndarray, impact: float, touching: bool) -> tuple[float, float, float, np.ndarray]:
        p, jacobian = center(state[0], state[1])
        approach = -(jacobian @ state[2:])[1]
        gap = p[1] - PEEN - ANVIL
        force = max(0.0, STIFFNESS * -gap * (1 + DAMPING * approach / impact)) if touching else 0.0
        return force, gap, approach, jacobian

    def rate(_t: float, state: np.ndarray, impact: float, touching: bool) -> np.ndarray:
        q1, q2, w1, w2 = state
        h = M2 * ARM * C2
        mass = np.array(
            [
                [
                    I1 + M1 * C1**2 + I2 + M2 * (ARM**2 + C2**2) + 2 * h * math.cos(q2),
                    I2 + M2 * C2**2 + h * math.cos(q2),
                ],
                [I2 + M2 * C2**2 + h * math.cos(q2), I2 + M2 * C2**2],
            ]
        )
        bias = np.array([-h * math.sin(q2) * (2 * w1 * w2 + w2**2), h * math.sin(q2) * w1**2])
        weight = G * np.array(
            [(M1 * C1 + M2 * ARM) * math.cos(q1) + M2 * C2 * math.cos(q1 + q2), M2 * C2 * math.cos(q1 + q2)]
        )
        force, _, _, jacobian = force_at(state, impact, touching)
        return np.concatenate([[w1, w2], np.linalg.solve(mass, weight - bias + jacobian[1] * force)])

    state = np.array([-0.6, 0.2, 0.0, 0.0])
    t, touching, impact = 0.0, False, 1.0
    grid = np.linspace(0, 1, rows + 1)
    times: list[float] = []
    rows_out: list[tuple[float, ...]] = []

    def record(time: float, x: np.ndarray) -> None:
        force, gap, approach, _ = force_at(x, impact, touching)
        times.append(time)
        rows_out.append((*x, force, gap, approach, float(touching), impact))

    while t < 1:

        def edge(_t: float, x: np.ndarray, *_: object) -> float:
            return float(center(x[0], x[1])[0][1] - PEEN - ANVIL)

        edge.terminal = True  # type: ignore[attr-defined]
        edge.direction = 1 if touching else -1  # type: ignore[attr-defined]
        run = solve_ivp(
            rate,
            (t, 1),
            state,
            args=(impact, touching),
            events=edge,
            rtol=1e-10,
            atol=1e-12,
            dense_output=True,
            max_step=2e-3,
        )
        record(t, state)
        for point in grid[(grid > t) & (grid < run.t[-1])]:
            record(float(point), run.sol(point))  # type: ignore[misc]
        t, state = float(run.t[-1]), run.y[:, -1]
        record(t, state)
        if t >= 1:
            break
        touching = not touching
        if touching:
            impact = max(1e-3, force_at(state, 1.0, True)[2])
    table = np.array(rows_out)
    time = np.array(times)
    q1, q2, w1, w2, force, gap, approach, touches, _ = table.T

    def turned(angle: np.ndarray) -> np.ndarray:
        c, s, o = np.cos(angle), np.sin(angle), np.zeros_like(angle)
        return np.stack([np.stack([c, o, -s], 1), np.stack([o, o + 1, o], 1), np.stack([s, o, c], 1)], 1)

    zero = np.zeros_like(q1)
    tip = np.stack([ARM * np.cos(q1), zero, -ARM * np.sin(q1)], axis=1)
    signals = pose_signals("arm", np.zeros((time.size, 3)), turned(q1))
    signals |= pose_signals("hammer", tip, turned(q1 + q2))
    for i, v in enumerate((-ARM * np.sin(q1) * w1, zero, -ARM * np.cos(q1) * w1)):
        signals[f"hammer.v_0[{i + 1}]"] = v
        signals[f"arm.v_0[{i + 1}]"] = zero.copy()
    for name, w in (("arm", w1), ("hammer", w1 + w2)):
        signals |= {f"{name}.w_a[1]": zero.copy(), f"{name}.w_a[2]": w.copy(), f"{name}.w_a[3]": zero.copy()}
    signals |= {"shoulder.phi": q1.copy(), "shoulder.w": w1.copy(), "wrist.phi": q2.copy(), "wrist.w": w2.copy()}
    depth = np.maximum(0, -gap)
    signals |= {
        "contacts.distance[1]": gap.copy(),
        "contacts.normalForce[1]": force.copy(),
        "contacts.approachSpeed[1]": approach.copy(),
        "contacts.touches[1]": touches.copy(),
        "contacts.force[1,1]": zero.copy(),
        "contacts.force[1,2]": zero.copy(),
        "contacts.force[1,3]": force.copy(),
        "contacts.elasticEnergy": STIFFNESS * depth**2 / 2,
    }
    steel, wood, red = [0.55, 0.58, 0.63], [0.72, 0.5, 0.3], [0.2, 0.42, 0.75]
    content = scene(
        "Hammer",
        [
            body(
                "arm",
                mass=M1,
                centerOfMass=[C1, 0, 0],
                inertia=[[1e-4, 0, 0], [0, I1, 0], [0, 0, I1]],
                meshes=[
                    box_mesh("bar", (0.3, 0.03, 0.03), (0.15, 0, 0), red),
                    cylinder_mesh("pin", 0.024, 0.06, "y", (0, 0, 0), steel),
                    cylinder_mesh("pin", 0.024, 0.06, "y", (0.3, 0, 0), steel),
                ],
            ),
            body(
                "hammer",
                position=[0.25, 0, 0.17],
                mass=M2,
                centerOfMass=[C2, 0, 0],
                inertia=[[1e-3, 0, 0], [0, I2, 0], [0, 0, I2]],
                meshes=[
                    cylinder_mesh("shaft", 0.012, 0.28, "x", (0.14, 0, 0), wood),
                    box_mesh("head", (0.05, 0.05, 0.09), (HEAD, 0, 0), steel),
                    sphere_mesh("peen", PEEN, steel, (HEAD, 0, -HEIGHT)),
                ],
            ),
            body(
                "anvil",
                fixed=True,
                position=[0, 0, ANVIL],
                meshes=[box_mesh("block", (0.2, 0.16, 0.1), (0.55, 0, -0.05), [0.4, 0.43, 0.47])],
            ),
            body(
                "stand", fixed=True, meshes=[box_mesh("post", (0.06, 0.06, 0.1), (-0.06, 0, -0.05), [0.4, 0.43, 0.47])]
            ),
        ],
        joints=[
            {"name": "shoulder", "type": "revolute", "variable": "shoulder.phi", "rate": "shoulder.w", "unit": "rad"},
            {"name": "wrist", "type": "revolute", "variable": "wrist.phi", "rate": "wrist.w", "unit": "rad"},
        ],
        contacts={"manager": "contacts", "pairs": [{"index": 1, "bodies": ["hammer", "anvil"], "restitution": E}]},
    )
    return content, SimulationResult(time=time, signals=signals, model="Hammer", mode="me", tolerance=1e-10)
