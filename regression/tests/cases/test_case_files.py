"""The project's own cases can be read and name files and models that exist."""

from __future__ import annotations

from pathlib import Path

import pytest
from fmu_regression.cases.case import find_cases, load_case
from fmu_regression.compare.checks import EventCheck, MeanCheck, SignalCheck
from fmu_regression.results.result import read_csv

CASES = Path(__file__).parents[2] / "cases"


@pytest.mark.parametrize("path", find_cases(CASES), ids=lambda path: path.relative_to(CASES).as_posix())
def test_case(path: Path) -> None:
    case = load_case(path)
    assert case.description
    assert case.package is not None
    assert case.package.exists()
    for source in case.sources:
        assert source.exists()
    model = case.model.split(".")
    if case.package.is_dir():
        assert case.package.name == model[0]
        assert case.package.joinpath(*model[1:-1], f"{model[-1]}.mo").is_file()
    else:
        assert f"model {model[-1]}" in case.package.read_text(encoding="utf-8")
    if case.reference is None:
        return
    reference = read_csv(case.reference)
    assert reference.time[-1] >= case.stop
    for check in case.checks:
        from_reference = isinstance(check, SignalCheck) or (
            isinstance(check, EventCheck) and check.times is None and check.count is None
        )
        from_reference |= isinstance(check, MeanCheck) and check.expected is None
        if from_reference:
            assert set(check.signals) <= set(reference.signals)
