"""Contacts of bodies in mechanisms beside closed forms, at random parameters, stiffness and tolerance, by both modes.

Sources: the conveyor, the rolling sphere and the block on a wall follow from Coulomb's law and Newton's second; the
block on a wedge and the ladder, which leaves the wall at two thirds of its height, from Lagrange's equations (D. Morin,
Introduction to Classical Mechanics, 2008); the pendulum and the balls from the definition of restitution.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import cos, pi, sin, sqrt
from pathlib import Path
from typing import Final

import numpy as np
import pytest
from cmb.modelica_sources import find_sources
from fmu_regression.results.result import SimulationResult
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu
from program import HANGS
from scipy.integrate import solve_ivp

GRAVITY: Final = 9.81
SPREAD: Final = 40.0
"""How many tolerances a result may be off."""
MODELLING: Final = 1e-3
"""What the closed forms leave out: how deep bodies get, and static friction's springs."""
SLOPE: Final = 0.5
"""Of the wedge."""
SEEDS: Final = 5


@dataclass(frozen=True)
class Scene:
    """Parameters of a model, how long it runs, and how far a result is off, as a share."""

    parameters: dict[str, float]
    stop: float
    signals: Sequence[str]
    error: Callable[[SimulationResult], float]


def between(source: random.Random, low: float, high: float) -> float:
    """Evenly in the logarithm."""
    return float(low * (high / low) ** source.random())


def conveyor(source: random.Random) -> Scene:
    speed, mu, m = source.uniform(0.3, 1.5), source.uniform(0.2, 0.9), between(source, 0.1, 100)
    slides = speed / (mu * GRAVITY)
    way = speed - speed * slides / 2
    parameters = {"beltSpeed": speed, "mu": mu, "m": m, "K": m * between(source, 1e5, 1e7)}
    return Scene(parameters, 1.0, ["box.r_0[1]"], lambda found: abs(found["box.r_0[1]"][-1] / way - 1))


def wedge(source: random.Random) -> Scene:
    m, mass = between(source, 0.1, 10), between(source, 0.1, 30)
    away = -m * GRAVITY * sin(SLOPE) * cos(SLOPE) / (mass + m * sin(SLOPE) ** 2) * 0.5**2 / 2
    parameters = {"m": m, "wedgeMass": mass, "K": max(m, 1) * between(source, 1e6, 3e7)}
    return Scene(parameters, 0.5, ["slide.s"], lambda found: abs(found["slide.s"][-1] / away - 1))


def pendulum(source: random.Random) -> Scene:
    m, e, angle = between(source, 0.1, 10), source.random(), source.uniform(0.3, 1.4)
    arrives = sqrt(2 * GRAVITY * (1 - cos(angle)))

    def error(found: SimulationResult) -> float:
        phi, w = found["hinge.phi"][-1], found["hinge.w"][-1]
        return float(abs(sqrt(w**2 + 2 * GRAVITY * (1 - cos(phi))) / arrives - e))

    stop = 0.3 * (1 + angle**2 / 16) * 2 * pi / sqrt(GRAVITY)
    return Scene(
        {"m": m, "e": e, "angle": angle, "K": m * between(source, 1e7, 1e9)}, stop, ["hinge.phi", "hinge.w"], error
    )


def rolling(source: random.Random) -> Scene:
    slope, m, c = source.uniform(0.05, 0.6), between(source, 0.1, 100), source.uniform(0.2, 0.66)
    way = GRAVITY * sin(slope) / (1 + c) / 2
    parameters = {"slope": slope, "m": m, "c": c, "K": m * between(source, 1e6, 1e8)}
    return Scene(parameters, 1.0, ["body.r_0[1]"], lambda found: abs(found["body.r_0[1]"][-1] / way - 1))


def ladder(source: random.Random) -> Scene:
    m, angle = between(source, 0.1, 10), source.uniform(0.3, 0.9)
    rigid = solve_ivp(
        lambda _t, y: [y[1], 1.5 * GRAVITY * sin(y[0])],
        [0, 3],
        [angle, 0],
        rtol=1e-10,
        atol=1e-12,
        dense_output=True,
        events=lambda _t, y: cos(y[0]) - 2 / 3 * cos(angle),
    )
    leaves = float(rigid.t_events[0][0])
    phi, w = rigid.sol(leaves)
    across = cos(phi) * w / 2

    def error(found: SimulationResult) -> float:
        time, height = np.asarray(found.time), np.asarray(found["rod.r_0[3]"])
        on_wall = time <= leaves
        falls = float(np.max(np.abs(height[on_wall] - np.cos(rigid.sol(time[on_wall])[0]) / 2 - 0.01)))
        return max(falls, float(abs(found["rod.v_0[1]"][-1] / across - 1)))

    parameters = {"m": m, "angle": angle, "K": m * between(source, 1e6, 1e7)}
    return Scene(parameters, leaves + 0.05, ["rod.r_0[3]", "rod.v_0[1]"], error)


def held_on_wall(source: random.Random) -> Scene:
    mu, m = source.uniform(0.2, 0.9), between(source, 0.1, 10)
    needed = m * GRAVITY / mu
    force = needed * source.uniform(1.3, 3)
    fade = force / 3
    slips, stop = (force - needed) / fade, 2.9
    down = -mu * fade / m * (stop - slips) ** 3 / 6
    parameters = {"mu": mu, "m": m, "force": force, "fade": fade, "K": m * between(source, 1e5, 1e7)}
    return Scene(parameters, stop, ["brick.r_0[3]"], lambda found: abs(found["brick.r_0[3]"][-1] / down - 1))


def two_balls(source: random.Random) -> Scene:
    m1, m2, e = between(source, 0.1, 10), between(source, 0.1, 10), source.random()
    v, share = between(source, 0.5, 10), source.uniform(0, 0.9)
    reduced = m1 * m2 / (m1 + m2)
    normal = np.array([-sqrt(1 - share**2), share])
    after = np.array([v, 0]) - (1 + e) * reduced / m1 * (np.array([v, 0]) @ normal) * normal

    def error(found: SimulationResult) -> float:
        return float(max(abs(found[f"first.v_0[{k + 1}]"][-1] - after[k]) for k in range(2)) / v)

    depth = 0.3 * between(source, 1e-5, 1e-4)
    parameters = {"m1": m1, "m2": m2, "e": e, "v": v, "offset": 0.3 * share, "K": reduced * (v / depth) ** 2}
    return Scene(parameters, 1.5 / v, ["first.v_0[1]", "first.v_0[2]"], error)


SCENES: Final = {
    "Conveyor": conveyor,
    "Wedge": wedge,
    "Pendulum": pendulum,
    "Rolling": rolling,
    "Ladder": ladder,
    "HeldOnWall": held_on_wall,
    "TwoBalls": two_balls,
}


@pytest.mark.full
@pytest.mark.parametrize("model", SCENES)
def test_motion_is_as_textbooks_say(model: str, fmu_cache: Path, tmp_path: Path) -> None:
    source = find_sources(f"Textbook.{model}", [Path(__file__).parent / "fixtures" / "Textbook.mo"])
    fmu = build_fmu(f"Textbook.{model}", source, tmp_path / "scene.fmu", BuildOptions(cache=fmu_cache)).fmu
    wrong = []
    for seed in range(SEEDS):
        draw = random.Random(f"{model} {seed}")
        scene, tolerance = SCENES[model](draw), between(draw, 1e-8, 1e-3)
        for mode in ("cs", "me"):
            result = simulate(
                fmu,
                signals=list(scene.signals),
                stop=scene.stop,
                interval=scene.stop / 200,
                tolerance=tolerance,
                mode=mode,
                parameters=scene.parameters,
                time_limit=HANGS,
                cpu_limit=60,
            )
            error = scene.error(result)
            if not error < MODELLING + SPREAD * tolerance:
                wrong.append(f"seed {seed}, {mode}, tolerance {tolerance:.1g}: off by {error:.2g}, {scene.parameters}")
    assert not wrong, "\n".join(wrong)
