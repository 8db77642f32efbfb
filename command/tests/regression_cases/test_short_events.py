"""What begins and ends within one step of the integrator is seen."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import pytest
from fmu_regression.fmi.binding import Mode
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu


@pytest.fixture(scope="module")
def apex(fmu_cache: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A throw whose apex at 1 s is above a line."""
    source = Path(__file__).parent / "fixtures" / "Apex.mo"
    return build_fmu("Apex", [source], tmp_path_factory.mktemp("apex") / "Apex.fmu", BuildOptions(cache=fmu_cache)).fmu


@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("above", [1e-4, pytest.param(1e-3, marks=pytest.mark.full), 1e-2])
def test_a_short_stay_above_a_line_is_seen(above: float, mode: Mode, apex: Path) -> None:
    """It lasts 9 to 90 ms; steps of up to a second have both their ends below the line."""
    half = sqrt(2.0 * above / 10.0)
    for tolerance in (1e-6, 1e-8):
        for interval in (0.02, 0.05, 0.11, 0.3, 1.0):
            result = simulate(
                apex,
                signals=["entered", "left"],
                mode=mode,
                tolerance=tolerance,
                interval=interval,
                parameters={"above": above},
            )
            assert result["entered"][-1] == pytest.approx(1.0 - half, abs=1e-3), (tolerance, interval)
            assert result["left"][-1] == pytest.approx(1.0 + half, abs=1e-3), (tolerance, interval)
