"""The laws give the values of their formulas; free impacts deliver what they should. Simulated by rumoca itself."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import rumoca
from library_compiler import Compiler
from numpy.typing import NDArray

Trajectory = dict[str, NDArray[np.float64]]

RESTITUTION = (0.1, 0.3, 0.5, 0.7, 0.9)


def simulate(core: Compiler, name: str, stop: float, modification: str = "", tolerance: float = 1e-9) -> Trajectory:
    config = rumoca.SimConfig(solver="bdf", rtol=tolerance, atol=tolerance * 1e-2, max_wall_seconds=60)
    result: Any = core.model(f"ContactMultiBodyTest.{name}", modification).simulate(stop, dt=stop / 200, config=config)
    assert result.time[-1] == pytest.approx(stop)
    return dict(zip(result.names, np.asarray(result.to_numpy(), dtype=float), strict=True))


@pytest.fixture(scope="module")
def factors(core: Compiler) -> Trajectory:
    return simulate(core, "Laws.DampingFactors", 1.0)


def final(trajectory: Trajectory, name: str) -> float:
    return float(trajectory[name][-1])


def row(trajectory: Trajectory, name: str) -> list[float]:
    return [final(trajectory, f"{name}[{i}]") for i in range(1, 6)]


def exact_factor(e: float) -> float:
    """Solves (1+d)/(1-d e) = exp(d (1+e)) by bisection for u = -ln(1 - d e), in 40 digits."""
    from decimal import Decimal, getcontext

    getcontext().prec = 40
    q = Decimal(str(e))
    low, high = Decimal("1e-9"), (1 + q) / q + 1
    for _ in range(130):
        u = (low + high) / 2
        y = 1 - (-u).exp()
        if (1 + q) * y / q - (1 + y / q).ln() - u > 0:
            low = u
        else:
            high = u
    return float((1 - (-low).exp()) / q)


def test_exact_law_solves_its_equation(factors: Trajectory) -> None:
    assert row(factors, "exact") == pytest.approx([exact_factor(e) for e in RESTITUTION], rel=1e-12)
    assert row(factors, "exact") == pytest.approx([9.998, 3.087, 1.433, 0.635, 0.166], abs=6e-4)


def test_exact_law_at_its_limits(factors: Trajectory) -> None:
    assert final(factors, "exactElastic") == pytest.approx(0, abs=1e-14)
    assert final(factors, "exactPlastic") == pytest.approx(2000, rel=1e-9)
    nearly = [final(factors, f"exactNearlyElastic[{i}]") for i in (1, 2, 3)]
    assert nearly == pytest.approx([exact_factor(e) for e in (0.979, 0.981, 0.999)], rel=1e-8)


PUBLISHED = {
    "juhasz": lambda e: (1 - e) / e,
    "huntCrossley": lambda e: 3 * (1 - e) / 2,
    "herbertMcWhannell": lambda e: 6 * (1 - e) / ((2 * e - 1) ** 2 + 3),
    "leeWang": lambda e: 3 * (1 - e) / 4,
    "lankaraniNikravesh": lambda e: 3 * (1 - e**2) / 4,
    "gonthier": lambda e: (1 - e**2) / e,
    "flores": lambda e: 8 * (1 - e) / (5 * e),
    "huGuo": lambda e: 3 * (1 - e) / (2 * e),
}
DELIVERED = {
    "juhasz": (0.111, 0.370, 0.594, 0.777, 0.931),
    "huntCrossley": (0.516, 0.581, 0.663, 0.768, 0.909),
    "herbertMcWhannell": (0.491, 0.520, 0.594, 0.723, 0.901),
    "leeWang": (0.687, 0.739, 0.799, 0.869, 0.952),
    "lankaraniNikravesh": (0.665, 0.684, 0.725, 0.796, 0.913),
    "gonthier": (0.101, 0.304, 0.488, 0.670, 0.876),
    "flores": (0.069, 0.256, 0.470, 0.683, 0.894),
    "huGuo": (0.074, 0.271, 0.488, 0.697, 0.900),
}


@pytest.mark.parametrize("law", PUBLISHED)
def test_published_laws(factors: Trajectory, law: str) -> None:
    assert row(factors, law) == pytest.approx([PUBLISHED[law](e) for e in RESTITUTION], rel=1e-14)
    number = list(PUBLISHED).index(law) + 1
    delivered = [final(factors, f"delivered[{number},{i}]") for i in range(1, 6)]
    assert delivered == pytest.approx(DELIVERED[law], abs=5.1e-4)


def test_scalar_laws(core: Compiler) -> None:
    values = simulate(core, "Laws.ScalarLaws", 1.0)
    assert final(values, "pull") == 0
    assert final(values, "push") == pytest.approx(1e4 * 0.01**1.5 * 1.25)
    assert final(values, "apart") == 0
    assert final(values, "fast") == pytest.approx(0.3)
    assert final(values, "slow") == pytest.approx(2000)
    assert final(values, "dead") == pytest.approx(2000)
    assert final(values, "hertz") == pytest.approx(4 / 3 * math.sqrt(0.01) / (2 * 0.91 / 210e9))
    assert [final(values, f"sliding[{i}]") for i in (1, 2, 3)] == pytest.approx([-3, -4, 0])
    assert final(values, "muSlow") == pytest.approx(0.6)
    assert final(values, "muFast") == pytest.approx(0.4)
    assert [final(values, f"spin[{i}]") for i in (1, 2, 3)] == pytest.approx([0, 0, -0.3])
    assert [final(values, f"roll[{i}]") for i in (1, 2, 3)] == pytest.approx([-0.54, -0.72, 0])


def test_combination_rules(core: Compiler) -> None:
    values = simulate(core, "Laws.CombinationRules", 1.0)
    expected = {"minimum": 0.2, "maximum": 0.8, "arithmetic": 0.5, "geometric": 0.4, "harmonic": 0.32, "product": 0.16}
    for name, value in expected.items():
        assert final(values, f"{name}[1]") == pytest.approx(value)


@pytest.mark.parametrize("e", [0.5, *(pytest.param(e, marks=pytest.mark.full) for e in (0.0, 0.05, 1.0))])
@pytest.mark.parametrize(
    "model",
    ["Impacts.RestitutionDelivered", pytest.param("Impacts.RestitutionWithoutEvents", marks=pytest.mark.full)],
)
def test_impact_delivers_the_restitution_asked_for(core: Compiler, model: str, e: float) -> None:
    delivered = final(simulate(core, model, 0.3, f"e={e}"), "delivered")
    assert delivered == pytest.approx(e, abs=1e-3)


@pytest.mark.full
def test_impact_with_a_published_law(core: Compiler) -> None:
    assert final(simulate(core, "Impacts.PublishedLawDelivered", 0.3), "delivered") == pytest.approx(0.725, abs=1e-3)


@pytest.mark.full
def test_spring_and_damper_do_not_pull(core: Compiler) -> None:
    ratio = 0.1
    expected = math.exp(-ratio / math.sqrt(1 - ratio**2) * (math.pi - 2 * math.asin(ratio)))
    assert final(simulate(core, "Impacts.SpringDamperImpact", 0.3), "delivered") == pytest.approx(expected, abs=1e-4)


@pytest.mark.full
def test_collision_keeps_momentum_and_angular_momentum(core: Compiler) -> None:
    motion = simulate(core, "Impacts.ObliqueImpact", 0.5)
    assert np.abs(motion["contact.impactSpeed[1]"]).max() > 1, "they never met"
    assert np.ptp(motion["a.v_0[2]"]) > 0.01, "the impact was not oblique"
    for i in (1, 2, 3):
        assert np.ptp(motion[f"momentum[{i}]"]) < 1e-6
        assert np.ptp(motion[f"angularMomentum[{i}]"]) < 1e-6


@pytest.mark.full
def test_hertz_impact(core: Compiler) -> None:
    motion = simulate(core, "Impacts.HertzImpact", 0.02)
    stiffness = 4 / 3 * math.sqrt(0.1) / ((1 - 0.49**2) / 4e6 + (1 - 0.3**2) / 210e9)
    deepest = (5 * 0.5 / (4 * stiffness)) ** 0.4
    assert -motion["contact.distance[1]"].min() == pytest.approx(deepest, rel=2e-3)
    assert motion["energy"] == pytest.approx(0.25, rel=1e-4)
