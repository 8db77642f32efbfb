"""Balls of a tenth of a millimetre to a kilometre, hard and soft, slow and fast, at all tolerances: closed forms.

``CMB_SCENES=300`` takes so many random scenes.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from math import pi, sqrt
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from cmb.modelica_sources import find_sources
from fmu_regression.fmi.binding import Mode
from fmu_regression.results.result import SimulationResult
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu
from program import HANGS

SCENES = int(os.environ.get("CMB_SCENES", "150"))
GRAVITY = 9.81
SPREAD, MOST = 40.0, 0.3
"""How many tolerances a result may be off, and how much at most."""
MODELLING = {"BallOfAnySize": 3e-3, "BallOnSprings": 6e-3, "BallWithoutEvents": 3e-3}
"""What the closed forms leave out: speeds over which friction is regularised, springs of static friction that fill."""
BallFmus = Callable[[str], Path]


@dataclass(frozen=True)
class Scene:
    """A ball with a speed; `depth` is how far it gets into the floor, by its speed or its weight."""

    kind: Literal["strike", "roll"]
    model: str
    mode: Mode
    tolerance: float
    size: float
    depth: float
    mass: float
    speed: float
    rest_share: float
    restitution: float
    friction: float
    gap: float
    obliqueness: float

    @property
    def stiffness(self) -> float:
        """That lets the ball get so deep."""
        load = self.mass * (self.speed**2 / self.depth if self.kind == "strike" else GRAVITY)
        return load / self.depth

    @property
    def across(self) -> float:
        """Speed along the floor: one strike does not end the sliding, and a second would not."""
        if self.kind == "roll":
            return self.speed
        return self.obliqueness * self.friction * (1 + self.restitution) * self.speed

    @property
    def stop(self) -> float:
        """There and back and ten contacts, or half again until it rolls."""
        if self.kind == "roll":
            return 1.5 * 2 * self.across / (7 * self.friction * GRAVITY)
        flight = self.gap / self.speed
        return flight * (1 + 1 / self.restitution) + 10 * pi * sqrt(self.mass / self.stiffness)

    def parameters(self) -> dict[str, float]:
        """What is set on the FMU."""
        is_strike = self.kind == "strike"
        radius = self.size / 2
        return {
            "g": 0.0 if is_strike else GRAVITY,
            "m": self.mass,
            "radius": radius,
            "K": self.stiffness,
            "e": self.restitution,
            "mu": self.friction,
            "height": radius + self.gap if is_strike else radius - self.depth,
            "down": self.speed if is_strike else 0.0,
            "across": self.across,
            "restSpeed": self.rest_share * self.speed,
        }

    def error(self, result: SimulationResult) -> float:
        """Of the speeds at the end by those at the start, or the energy gained by that of motion, the larger one."""
        across, up = result["ball.v_0[1]"][-1], result["ball.v_0[3]"][-1]
        if self.kind == "strike":
            leaves = self.across - self.friction * (1 + self.restitution) * self.speed
            speeds = max(abs(up / self.speed - self.restitution), abs(across - leaves) / self.across)
        else:
            arm = (self.size - self.depth) / 2  # friction acts in the middle of the overlap
            rolling = self.across * arm**2 / (arm**2 + 0.4 * (self.size / 2) ** 2)
            speeds = abs(across - rolling) / self.across
        energy = np.asarray(result["energy"])
        motion = self.mass * (self.across**2 + (self.speed**2 if self.kind == "strike" else 0.0)) / 2
        gain = np.max(energy - np.minimum.accumulate(energy)) / motion
        return float(np.max([speeds, gain]))


def draw(seed: int) -> Scene:
    """The scene of a seed; evenly in the logarithm where a quantity has a scale."""
    source = random.Random(f"any size {seed}")

    def scale(low: float, high: float) -> float:
        return float(low * (high / low) ** source.random())

    size = scale(1e-4, 1e3)
    kind: Literal["strike", "roll"] = "strike" if source.random() < 0.7 else "roll"
    # Static friction's springs are as soft as the floor: a ball on them rolls on before it slides.
    models = [name for name in MODELLING if name != "BallOnSprings" or kind == "strike"]
    tolerance = scale(1e-8, 1e-2)
    shallowest = max(1e-10, 1e-6 * tolerance)  # the hysteresis of events
    return Scene(
        kind=kind,
        model=source.choice(models),
        mode="me" if source.random() < 0.5 else "cs",
        tolerance=tolerance,
        size=size,
        depth=max(size * scale(1e-6, 3e-2), shallowest),
        mass=1000 * size**3 * scale(0.1, 10),
        speed=sqrt(size) * scale(1e-3, 10),
        rest_share=scale(1e-6, 1e-1),
        restitution=source.uniform(0.2, 0.95),
        friction=source.uniform(0.05, 0.5),
        gap=size * source.uniform(0.1, 1.0),
        obliqueness=source.uniform(4, 8),
    )


@pytest.fixture(scope="module")
def balls(fmu_cache: Path, tmp_path_factory: pytest.TempPathFactory) -> BallFmus:
    """Builds the FMU of a model, each once."""
    folder = tmp_path_factory.mktemp("balls")
    source = Path(__file__).parent / "fixtures" / "BallOfAnySize.mo"
    options = BuildOptions(cache=fmu_cache)
    sources = find_sources("BallOfAnySize", [source])

    @cache
    def build(name: str) -> Path:
        return build_fmu(name, sources, folder / f"{name}.fmu", options).fmu

    return build


def wrong_scenes(seeds: Iterable[int], fmus: BallFmus) -> list[str]:
    """Those whose result is off by more than the tolerance excuses."""
    wrong = []
    for seed in seeds:
        scene = draw(seed)
        result = simulate(
            fmus(scene.model),
            signals=["ball.v_0[1]", "ball.v_0[3]", "energy"],
            stop=scene.stop,
            interval=scene.stop / 50,
            tolerance=scene.tolerance,
            mode=scene.mode,
            parameters=scene.parameters(),
            time_limit=HANGS,
            cpu_limit=20,
        )
        error = scene.error(result)
        if not error < MODELLING[scene.model] + min(SPREAD * scene.tolerance, MOST):
            wrong.append(f"{seed}: {scene} is off by {error:.2g}")
    return wrong


@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("share", [0.3, 1.9, 5.0])
def test_strikes_as_shallow_as_the_hysteresis_of_their_events(balls: BallFmus, share: float, mode: Mode) -> None:
    """Each bounce gives back its restitution, also where the relation of touches hardly or never changes."""
    tolerance, speed, mass, restitution = 1e-6, 0.2, 1e-6, 0.6
    depth = share * 1e-10
    parameters = {"g": GRAVITY, "m": mass, "radius": 5e-4, "K": mass * (speed / depth) ** 2, "e": restitution}
    parameters |= {"height": 5e-4 + speed**2 / (2 * GRAVITY), "down": 0.0, "across": 1e-3, "restSpeed": 1e-3}
    flights = speed / GRAVITY * np.array([1, *2 * restitution ** np.arange(1.0, 5.0)])
    result = simulate(
        balls("BallOfAnySize"),
        signals=["contact.impactSpeed[1]"],
        stop=flights.sum(),
        interval=flights[-1] / 10,
        tolerance=tolerance,
        mode=mode,
        parameters=parameters,
        time_limit=HANGS,
        cpu_limit=20,
    )
    caught = result["contact.impactSpeed[1]"]
    caught = caught[np.flatnonzero(np.diff(caught)) + 1]
    assert caught[:4] == pytest.approx(speed * restitution ** np.arange(4.0), rel=1e-3)


@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("model", ["BallOfAnySize", pytest.param("BallWithoutEvents", marks=pytest.mark.full)])
@pytest.mark.parametrize("size", [1e-2, 1.0, 1e3])
def test_bounces_of_all_sizes_are_similar(balls: BallFmus, size: float, model: str, mode: Mode) -> None:
    """Lengths by the size, speeds and times by its root: three bounces leave the same share of the energy.

    The floor gives way by a millionth of the size, a thousandth of what the tolerance times the position is.
    """
    tolerance, restitution = 1e-3, 0.7
    speed, gap, mass, depth = sqrt(size), 0.01 * size, 1000 * size**3, 1e-6 * size
    parameters = {"g": GRAVITY, "m": mass, "radius": size / 2, "K": mass * (speed / depth) ** 2, "e": restitution}
    parameters |= {"height": size / 2 + gap, "down": speed, "across": 1e-3 * speed, "mu": 0.0}
    parameters["restSpeed"] = 1e-3 * speed
    strikes = sqrt(speed**2 + 2 * GRAVITY * gap)
    stop = (strikes - speed) / GRAVITY + strikes / GRAVITY * (2 * restitution + 2 * restitution**2 + restitution**3)
    energy = simulate(
        balls(model),
        signals=["energy"],
        stop=stop,
        interval=stop,
        tolerance=tolerance,
        mode=mode,
        parameters=parameters,
        time_limit=HANGS,
        cpu_limit=20,
    )["energy"]
    left = (energy[-1] - mass * GRAVITY * size / 2) / (mass * strikes**2 / 2)
    assert left ** (1 / 6) == pytest.approx(restitution, abs=SPREAD * tolerance)


@pytest.mark.full
def test_balls_of_any_size_obey_closed_forms(balls: BallFmus) -> None:
    """The floor may be soft by ten nanometres or by ten metres; restitution and friction are as asked for."""
    assert not wrong_scenes(range(SCENES), balls)


def test_a_ball_that_begins_to_roll_in_half_a_millisecond(balls: BallFmus) -> None:
    """Its speed of rest is 2e-8 m/s, as small as the increments of difference quotients."""
    assert not wrong_scenes([161], balls)


SMALL_SPREAD = 75.0
"""Tolerances that the restitution of three bounces may be off; they are no more for larger balls."""


def restitution_error(fmu: Path, size: float, mode: Mode, tolerance: float) -> float:
    """Of three bounces of a ball of SmallBall.mo, in tolerances."""
    restitution = 0.7
    strike = sqrt(size + 2 * GRAVITY * 0.01 * size)
    flights = 2 * restitution + 2 * restitution**2 + restitution**3
    stop = (strike - sqrt(size)) / GRAVITY + strike / GRAVITY * flights
    result = simulate(
        fmu,
        signals=["energy"],
        stop=stop,
        interval=stop,
        tolerance=tolerance,
        mode=mode,
        time_limit=HANGS,
        cpu_limit=20,
    )
    mass = 1000 * size**3
    left = (result["energy"][-1] - mass * GRAVITY * size / 2) / (mass * strike**2 / 2)
    return float(abs(max(left, 0.0) ** (1 / 6) - restitution) / tolerance)


@pytest.mark.full
@pytest.mark.parametrize(
    ("model", "size"),
    [
        ("TinyBall", 1e-4),
        ("TinyBallWithoutEvents", 1e-4),
        ("SmallBall", 1e-3),
        ("SmallBallWithoutEvents", 1e-3),
    ],
)
def test_small_balls_bounce_as_large_ones(model: str, size: float, fmu_cache: Path, tmp_path: Path) -> None:
    """The floor gives way by a tenth of a nanometre, or one: nominal values of positions follow the thickness."""
    source = Path(__file__).parent / "fixtures" / "SmallBall.mo"
    sources = find_sources(model, [source])
    fmu = build_fmu(model, sources, tmp_path / f"{model}.fmu", BuildOptions(cache=fmu_cache)).fmu
    modes: tuple[Mode, ...] = ("me", "cs")
    errors = {
        (mode, tolerance): restitution_error(fmu, size, mode, tolerance)
        for mode in modes
        for tolerance in (1e-3, 1e-4, 1e-5, 1e-6)
    }
    assert max(errors.values()) < SMALL_SPREAD, errors
