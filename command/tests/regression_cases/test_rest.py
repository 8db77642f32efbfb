"""What friction holds stands still, at every tolerance and by both integrators."""

from __future__ import annotations

import numpy as np
import pytest
from cmb.fmu_provider import FmuProvider
from fmu_regression.cases.case import load_case
from fmu_regression.cases.runner import Skip
from fmu_regression.fmi.binding import Mode
from fmu_regression.simulate.simulation import simulate
from program import CASES

STILL = 1e-10
"""m/s: a tenth of what is promised. Formulas of higher order than one left up to 2e-6."""


def tolerances(count: int) -> list[float]:
    random = np.random.default_rng(1127)
    return [*(10.0 ** random.uniform(-6, -3, count)), 1e-3, 1e-4]


@pytest.mark.full
@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("count", [30])
def test_a_block_on_an_incline_does_not_tremble(provide_fmu: FmuProvider, mode: Mode, count: int) -> None:
    fmu = provide_fmu(load_case(CASES / "known_answers" / "incline_sticks.toml"))
    assert not isinstance(fmu, Skip)
    for tolerance in tolerances(count):
        result = simulate(fmu, stop=8.0, tolerance=tolerance, interval=0.02, mode=mode, signals=("v",))
        late = result.time >= 5.0
        assert np.abs(result["v"][late]).max() < STILL, tolerance
