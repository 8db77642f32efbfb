"""Many bodies that collide and come to rest, soft and hard, at all tolerances: explicit steps and CVODE take turns."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from cmb.modelica_sources import find_sources
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu

QUICK, ALL = 1, 40
"""Scenes of boxes at every run of the tests, and of all bodies at the long ones."""
RISE, SPREAD = 1.0, 300.0
"""How many tolerances the energy may rise, by that at the start, and the bodies' middle be off, by their distance.

Bodies strike each other some five times: each impact spreads the errors before it."""
MODEL = """model {name} "Bodies that fall onto each other"
  ContactMultiBody.Parts.FreeBodies bodies(
    bodyCount={count}, bodyGeometry=ContactMultiBody.Shapes.{shape}, bodyMass=0.5, bodyInertia=fill(0.0005, 3),
    bodyRadius=0.05, surroundings=ContactMultiBody.Shapes.halfSpace(), material(each muStatic=0.4, each muDynamic=0.4),
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given, regularisationSpeed=0.02,
    r_start={{{{0.13*mod(i - 1, 4), 0.13*mod(div(i - 1, 4), 4), 0.08 + 0.13*div(i - 1, 16) + 0.02*mod(7*i, 5)}}
      for i in 1:{count}}},
    v_start={{{{0.5*sin(1.7*i), 0.5*cos(2.3*i), 0}} for i in 1:{count}}});
end {name};
"""
MODELS = {
    "ManyBalls": MODEL.format(name="ManyBalls", count=20, shape="sphere(0.05)"),
    "ManyBoxes": MODEL.format(name="ManyBoxes", count=10, shape="box({0.08, 0.09, 0.1})"),
}


@dataclass(frozen=True)
class Scene:
    """One of the models with a stiffness in N/m, and a tolerance."""

    model: str
    stiffness: float
    tolerance: float


def scenes() -> list[Scene]:
    draw = random.Random(20261126)
    return [
        Scene(list(MODELS)[number % 2], 10 ** draw.uniform(3.5, 6.5), 10 ** draw.uniform(-5, -2))
        for number in range(ALL)
    ]


@pytest.fixture(scope="module")
def fmu_of(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Callable[[str], Path]:
    folder = tmp_path_factory.mktemp("many")

    @cache
    def build(name: str) -> Path:
        source = folder / f"{name}.mo"
        source.write_text(MODELS[name], encoding="utf-8")
        return build_fmu(name, find_sources(name, [source]), folder / f"{name}.fmu", BuildOptions(cache=fmu_cache)).fmu

    return build


def is_quick(number: int, scene: Scene) -> bool:
    return scene.model == "ManyBoxes" and number < 2 * QUICK


@pytest.mark.full
@pytest.mark.parametrize(
    "scene",
    [pytest.param(s, marks=() if is_quick(k, s) else pytest.mark.full, id=str(k)) for k, s in enumerate(scenes())],
)
def test_energy_falls_and_results_follow_the_tolerance(scene: Scene, fmu_of: Callable[[str], Path]) -> None:
    """Against the same FMU at a thousandth of the tolerance, as long as bodies have struck each other a few times."""
    count = 20 if scene.model == "ManyBalls" else 10
    middle = [f"bodies.r[{k},3]" for k in range(1, count + 1)]

    def run(tolerance: float, stop: float) -> dict[str, np.ndarray]:
        result = simulate(
            fmu_of(scene.model),
            signals=["bodies.energy", *middle],
            stop=stop,
            interval=0.01,
            tolerance=tolerance,
            mode="cs",
            parameters={"bodies.bodyStiffness": scene.stiffness},
        )
        return dict(result.signals)

    found = run(scene.tolerance, 2.0)
    energy = found["bodies.energy"]
    assert np.max(energy - np.minimum.accumulate(energy)) <= RISE * scene.tolerance * energy[0]
    exact = run(1e-3 * scene.tolerance, 0.2)
    most = SPREAD * scene.tolerance
    assert energy[:20] == pytest.approx(exact["bodies.energy"][:20], abs=most * energy[0])
    height = np.mean([found[name][:20] for name in middle], axis=0)
    expected = np.mean([exact[name][:20] for name in middle], axis=0)
    assert height == pytest.approx(expected, abs=most * 0.13)
