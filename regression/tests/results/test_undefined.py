"""What is not a number in a result is told: the file looks whole."""

from __future__ import annotations

import numpy as np
from fmu_regression.report.simulation_report import report_html
from fmu_regression.report.summarise import summarise
from fmu_regression.results.result import SimulationResult
from fmu_regression.results.undefined import undefined_remarks

TIME = np.linspace(0.0, 2.0, 5)


def test_the_first_row_and_how_many_are_told() -> None:
    with np.errstate(divide="ignore", invalid="ignore"):
        signals = {"root": np.sqrt(1.2 - TIME), "pole": 1 / (TIME - 0.5), "fine": TIME.copy()}
    result = SimulationResult(TIME.copy(), signals, model="M")
    assert undefined_remarks(result) == (
        "root is not a number at t = 1.5 s, and no finite number in 2 of 5 rows",
        "pole is infinite at t = 0.5 s, and no finite number in 1 of 5 rows",
    )
    assert "root is not a number" in summarise(result)
    assert "root is not a number" in report_html(result, None)


def test_numbers_are_not_remarked_upon_and_many_signals_are_counted() -> None:
    assert undefined_remarks(SimulationResult(TIME.copy(), {"x": TIME.copy()})) == ()
    many = {f"x{k}": np.full(5, np.nan) for k in range(8)}
    remarks = undefined_remarks(SimulationResult(TIME.copy(), many))
    assert len(remarks) == 6
    assert remarks[-1] == "and so are 3 further signals"
