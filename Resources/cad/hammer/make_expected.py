"""Computes when and how the hammer first strikes the anvil, independently of the generator and of Modelica.

Arm and head are a planar double pendulum until they touch anything. Masses, centres of mass, inertias, poses and
joints come from ``hammer.xml``; the outlines of head and anvil in the plane of motion are those of the CAD model,
exact because both are bounded by planes there. The pendulum's Lagrange equations are integrated by an explicit
Runge-Kutta method of order 8 (SciPy's DOP853); the strike is the root of the exact distance of the two outlines.

Run: ``python make_expected.py`` writes ``expected.toml`` beside this script.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from lxml import etree
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

FOLDER = Path(__file__).resolve().parent
NAMESPACE = {"a": "urn:contactmultibody:assembly:1"}
TOLERANCE = 1e-13
LARGEST_STEP = 1e-3  # s
CHECKPOINTS = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3)  # s

# Outlines in the plane of motion (x, z), mm, in the parts' own coordinates.
HEAD_OUTLINE = ((-35, -34), (-30, -39), (30, -39), (35, -34), (35, 26), (30, 31), (-30, 31), (-35, 26))
ANVIL_OUTLINE = ((-80, 0), (80, 0), (80, 105), (65, 120), (-65, 120), (-80, 105))

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PlanarPart:
    """A part in the plane y = 0, SI units: angle about +y, vectors (x, z)."""

    mass: float
    center: Array
    inertia: float
    position: Array
    angle: float


@dataclass(frozen=True, eq=False)
class Pendulum:
    """The double pendulum: both parts at the start, the shoulder in the world, the elbow in the arm."""

    arm: PlanarPart
    head: PlanarPart
    anvil: PlanarPart
    shoulder: Array
    elbow: Array
    gravity: float


def turned(angle: float, vector: Array) -> Array:
    """A vector (x, z) turned by ``angle`` about +y, which takes z to x."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([cosine * vector[0] + sine * vector[1], -sine * vector[0] + cosine * vector[1]])


def read_pendulum(file: Path) -> Pendulum:
    """Reads what the pendulum needs from the assembly's XML file."""
    root = etree.parse(file).getroot()
    parts = {
        name: _read_part(root.find(f"a:parts/a:part[@name='{name}']", NAMESPACE))
        for name in ("arm", "hammer head", "anvil")
    }
    origins = {
        joint.get("name"): _plane(joint.findtext("a:origin", namespaces=NAMESPACE)) / 1000
        for joint in root.iterfind("a:joints/a:joint", NAMESPACE)
    }
    arm = parts["arm"]
    return Pendulum(
        arm=arm,
        head=parts["hammer head"],
        anvil=parts["anvil"],
        shoulder=origins["shoulder"],
        elbow=turned(-arm.angle, origins["elbow"] - arm.position),
        gravity=-_plane(root.findtext("a:gravity", namespaces=NAMESPACE))[1],
    )


def _plane(text: str | None) -> Array:
    x, y, z = (float(word) for word in (text or "").split())
    if y != 0.0:
        raise ValueError(f"not in the plane of motion: {text}")
    return np.array([x, z])


def _read_part(element: etree._Element | None) -> PlanarPart:
    if element is None:
        raise ValueError("a part is missing")
    properties = element.find("a:massProperties", NAMESPACE)
    turn = element.find("a:pose/a:axisAngle", NAMESPACE)
    inertia = element.find("a:massProperties/a:inertia", NAMESPACE)
    if properties is None or inertia is None or (turn is not None and turn.get("axis") != "0 1 0"):
        raise ValueError("a part is not described as expected")
    return PlanarPart(
        mass=float(properties.findtext("a:mass", "", NAMESPACE)),
        center=_plane(properties.findtext("a:centerOfMass", namespaces=NAMESPACE)) / 1000,
        inertia=float(inertia.get("yy", "")) / 1e6,
        position=_plane(element.findtext("a:pose/a:position", namespaces=NAMESPACE)) / 1000,
        angle=math.radians(float(turn.get("angle", ""))) if turn is not None else 0.0,
    )


def accelerations(pendulum: Pendulum, state: Array) -> Array:
    """Angular accelerations of both parts; ``state``: absolute angles and angular velocities about +y."""
    first, second, first_speed, second_speed = state
    arm, head, elbow = pendulum.arm, pendulum.head, pendulum.elbow
    coupling = head.mass * float(elbow @ turned(second - first, head.center))
    slope = head.mass * float(elbow @ turned(second - first + math.pi / 2, head.center))
    matrix = np.array(
        [
            [arm.inertia + arm.mass * arm.center @ arm.center + head.mass * elbow @ elbow, coupling],
            [coupling, head.inertia + head.mass * head.center @ head.center],
        ]
    )
    lever = arm.mass * turned(first, arm.center) + head.mass * turned(first, elbow)
    forces = np.array(
        [
            pendulum.gravity * lever[0] - slope * second_speed**2,
            pendulum.gravity * head.mass * turned(second, head.center)[0] + slope * first_speed**2,
        ]
    )
    return np.linalg.solve(matrix, forces)


def energy(pendulum: Pendulum, state: Array) -> float:
    """Kinetic and potential energy, J."""
    first, second, first_speed, second_speed = state
    arm, head = pendulum.arm, pendulum.head
    arm_center = turned(first, arm.center)
    elbow = turned(first, pendulum.elbow)
    head_center = turned(second, head.center)
    # The velocity of a point at offset (x, z) from the axis of a turn about +y is (z, -x) times the speed.
    velocity = first_speed * np.array([elbow[1], -elbow[0]]) + second_speed * np.array(
        [head_center[1], -head_center[0]]
    )
    kinetic = (arm.inertia + arm.mass * arm_center @ arm_center) * first_speed**2 / 2
    kinetic += head.mass * velocity @ velocity / 2 + head.inertia * second_speed**2 / 2
    return float(kinetic + pendulum.gravity * (arm.mass * arm_center[1] + head.mass * (elbow + head_center)[1]))


def outline(points: tuple[tuple[float, float], ...], position: Array, angle: float) -> Array:
    """Corners of an outline in the world, shape (n, 2), m."""
    return np.array([position + turned(angle, np.array(point) / 1000) for point in points])


def distance(first: Array, second: Array) -> float:
    """Signed separation of two convex outlines over all edge normals: its sign and its zero are exact."""
    return max(_separation(first, second), _separation(second, first))


def _separation(first: Array, second: Array) -> float:
    edges = np.roll(first, -1, axis=0) - first
    normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
    if normals[0] @ (first[0] - first.mean(axis=0)) < 0:
        normals = -normals
    return float(max((second @ normal).min() - normal @ corner for normal, corner in zip(normals, first, strict=True)))


def head_outline(pendulum: Pendulum, state: Array) -> Array:
    """The head's outline in the world."""
    return outline(HEAD_OUTLINE, pendulum.shoulder + turned(state[0], pendulum.elbow), state[1])


def solve(pendulum: Pendulum) -> tuple[float, Array, Array, float]:
    """Time of the strike, the state then, states at the checkpoints, and the relative drift of energy."""
    start = np.array([pendulum.arm.angle, pendulum.head.angle, 0.0, 0.0])
    anvil = outline(ANVIL_OUTLINE, pendulum.anvil.position, pendulum.anvil.angle)

    def gap(_time: float, state: Array) -> float:
        return distance(head_outline(pendulum, state), anvil)

    gap.terminal = True  # type: ignore[attr-defined]
    solution = solve_ivp(
        lambda _time, state: np.concatenate([state[2:], accelerations(pendulum, state)]),
        (0.0, 2.0),
        start,
        method="DOP853",
        rtol=TOLERANCE,
        atol=TOLERANCE,
        max_step=LARGEST_STEP,
        dense_output=True,
        events=gap,
    )
    if solution.sol is None or not solution.t_events or not len(solution.t_events[0]):
        raise RuntimeError("the head never meets the anvil")
    guess = float(solution.t_events[0][0])
    time = brentq(lambda t: gap(t, solution.sol(t)), guess - LARGEST_STEP, guess, xtol=1e-15)
    state = solution.sol(time)
    drift = abs(energy(pendulum, state) - energy(pendulum, start)) / abs(energy(pendulum, start))
    return time, state, np.array([solution.sol(t) for t in CHECKPOINTS]), drift


def corner_velocity(pendulum: Pendulum, state: Array, corner: Array) -> Array:
    """Velocity of a point of the head."""
    elbow = turned(state[0], pendulum.elbow)
    arm = corner - pendulum.shoulder - elbow
    velocity: Array = state[2] * np.array([elbow[1], -elbow[0]]) + state[3] * np.array([arm[1], -arm[0]])
    return velocity


def report() -> str:
    """The text of ``expected.toml``."""
    pendulum = read_pendulum(FOLDER / "hammer.xml")
    time, state, checkpoints, drift = solve(pendulum)
    corners = head_outline(pendulum, state)
    corner = corners[int(np.argmin(corners[:, 1]))]
    velocity = corner_velocity(pendulum, state, corner)
    lines = [
        "# Written by make_expected.py. Joint coordinates as in hammer.xml, SI units.",
        "[first_impact]",
        'bodies = ["hammerHead", "anvil"]',
        f"time = {time:.12g}",
        f"shoulder = {state[0]:.12g}",
        f"elbow = {state[1] - state[0]:.12g}",
        f"shoulder_rate = {state[2]:.12g}",
        f"elbow_rate = {state[3] - state[2]:.12g}",
        f"point = [{corner[0]:.12g}, 0.0, {corner[1]:.12g}]",
        f"approach_speed = {-velocity[1]:.12g}",
        f"relative_energy_drift = {drift:.1e}",
        "",
    ]
    for checkpoint, values in zip(CHECKPOINTS, checkpoints, strict=True):
        lines += [
            "[[before_impact]]",
            f"time = {checkpoint}",
            f"shoulder = {values[0]:.12g}",
            f"elbow = {values[1] - values[0]:.12g}",
            f"shoulder_rate = {values[2]:.12g}",
            f"elbow_rate = {values[3] - values[2]:.12g}",
            "",
        ]
    return "\n".join(lines).rstrip("\n") + "\n"


if __name__ == "__main__":
    (FOLDER / "expected.toml").write_text(report(), encoding="utf-8")
