"""The restitution asked for is delivered over six decades of stiffness and three of speed, with events and without."""

from __future__ import annotations

import pytest
from cmb.fmu_provider import FmuProvider
from contact_promises.impacts import Impact, all_impacts, delivered, random_impacts, some_impacts
from contact_promises.table import ALLOWED_RESTITUTION
from fmu_regression.cases.case import load_case
from fmu_regression.cases.runner import Skip
from fmu_regression.fmi.binding import Mode
from program import CASES


@pytest.mark.full
@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("tolerance", [1e-6, 1e-4])
@pytest.mark.parametrize("case", ["free_impact", "free_impact_without_events"])
def test_restitution_is_delivered(provide_fmu: FmuProvider, case: str, tolerance: float, mode: Mode) -> None:
    fmu = provide_fmu(load_case(CASES / "known_answers" / f"{case}.toml"))
    assert not isinstance(fmu, Skip)
    impacts = some_impacts() + random_impacts(60, seed=1126)
    found = {impact: delivered(fmu, impact, tolerance, mode) for impact in impacts}
    wrong = {impact: value for impact, value in found.items() if impact.error(value) > ALLOWED_RESTITUTION}
    assert not wrong


def test_the_sweep_covers_every_value() -> None:
    for name in ("restitution", "speed", "stiffness", "exponent"):
        assert {getattr(i, name) for i in some_impacts()} == {getattr(i, name) for i in all_impacts()}
    pairs = {(i.restitution, i.speed) for i in some_impacts()}
    assert len(pairs) == len(some_impacts()) == 28


def test_bodies_that_should_stay_together_may_part_slowly_and_no_others() -> None:
    """By the bound on damping: at 0.01 m/s a restitution of 0 may come out as 0.05, at 10 m/s not even as 0.01."""
    assert Impact(0.0, 0.01, 1e6, 1.0).error(0.05) == 0
    assert Impact(0.0, 10.0, 1e6, 1.0).error(0.01) > 9e-3
    assert Impact(0.1, 0.01, 1e6, 1.0).error(0.12) == pytest.approx(0.02)
    assert Impact(0.5, 0.01, 1e6, 1.0).error(0.4) == pytest.approx(0.1)
