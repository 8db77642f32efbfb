"""The restitution asked for is delivered over six decades of stiffness and three of speed, with events and without."""

from __future__ import annotations

import pytest
from cmb.fmu_provider import FmuProvider
from contact_promises.impacts import all_impacts, delivered, some_impacts
from contact_promises.table import ALLOWED_RESTITUTION
from fmu_regression.cases.case import load_case
from fmu_regression.cases.runner import Skip
from program import CASES


@pytest.mark.full
@pytest.mark.parametrize(("tolerance", "allowed"), [(1e-6, ALLOWED_RESTITUTION), (1e-4, 6e-3)])
@pytest.mark.parametrize("case", ["free_impact", "free_impact_without_events"])
def test_restitution_is_delivered(provide_fmu: FmuProvider, case: str, tolerance: float, allowed: float) -> None:
    fmu = provide_fmu(load_case(CASES / "known_answers" / f"{case}.toml"))
    assert not isinstance(fmu, Skip)
    found = {impact: delivered(fmu, impact, tolerance) for impact in some_impacts()}
    wrong = {impact: value for impact, value in found.items() if abs(value - impact.restitution) > allowed}
    assert not wrong


def test_the_sweep_covers_every_value() -> None:
    for name in ("restitution", "speed", "stiffness", "exponent"):
        assert {getattr(i, name) for i in some_impacts()} == {getattr(i, name) for i in all_impacts()}
    pairs = {(i.restitution, i.speed) for i in some_impacts()}
    assert len(pairs) == len(some_impacts()) == 28
