"""At loose tolerances a simulation loses accuracy, not its way."""

from __future__ import annotations

from pathlib import Path

import pytest
from cmb.fmu_provider import FmuProvider
from cmb.project import CASES
from fmu_regression.cases.case import load_case
from fmu_regression.fmi.fmu import Mode
from fmu_regression.simulate.simulation import simulate

GRAVITY, FRICTION, SPEED = 9.81, 0.3, 2.0
DISTANCE = SPEED**2 / (2.0 * FRICTION * GRAVITY)
FEW = 5000  # tolerance 1e-8 takes a tenth of it


@pytest.fixture(scope="session")
def sliding_block(provide_fmu: FmuProvider) -> Path:
    fmu = provide_fmu(load_case(CASES / "library" / "SlidingBlock.toml"))
    assert isinstance(fmu, Path)
    return fmu


@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("tolerance", [1e-3, 3e-4, 1e-4])
def test_a_sliding_block_stops_in_few_steps(tolerance: float, mode: Mode, sliding_block: Path) -> None:
    """Steps of any length: beside the kink of dry friction the integrator must not go round in circles."""
    for count in (1, 3, 10, 30):
        result = simulate(
            sliding_block,
            signals=["slider.r_0[1]"],
            stop=1.5,
            interval=1.5 / count,
            max_step=1.5 / count,
            tolerance=tolerance,
            mode=mode,
            time_limit=60,
        )
        assert result.counters is not None
        assert result.counters.steps < FEW
        assert result["slider.r_0[1]"][-1] == pytest.approx(DISTANCE, abs=1e-4)
