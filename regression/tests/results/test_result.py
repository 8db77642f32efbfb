"""CSV form of results."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError
from fmu_regression.results.result import SimulationResult, format_number, read_csv, write_csv
from hypothesis import given, settings
from hypothesis import strategies as st


def result_with_event() -> SimulationResult:
    return SimulationResult(
        time=np.array([0.0, 0.1, 0.1, 0.2]),
        signals={"a[1,2]": np.array([1.0, 2.0, -2.0, 1 / 3]), 'odd"name': np.array([0.0, -0.0, 1e-300, 1e300])},
    )


def test_round_trip_keeps_event_rows_and_names(tmp_path: Path) -> None:
    path = tmp_path / "result.csv"
    write_csv(result_with_event(), path)
    text = path.read_text()
    assert text.splitlines()[0] == 'time,"a[1,2]","odd""name"'
    assert "-0" not in text.splitlines()[2]
    again = read_csv(path)
    assert again.time.tolist() == [0.0, 0.1, 0.1, 0.2]
    assert again.event_rows().tolist() == [1]
    assert again["a[1,2]"] == pytest.approx([1, 2, -2, 1 / 3], rel=1e-11)
    assert again['odd"name'].tolist() == [0.0, 0.0, 1e-300, 1e300]


def test_writing_twice_gives_the_same_bytes(tmp_path: Path) -> None:
    write_csv(result_with_event(), tmp_path / "a.csv")
    write_csv(read_csv(tmp_path / "a.csv"), tmp_path / "b.csv")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()


@given(st.floats(allow_nan=False, allow_infinity=False))
@settings(max_examples=200)
def test_numbers_keep_twelve_digits(value: float) -> None:
    assert float(format_number(value)) == pytest.approx(value, rel=6e-12, abs=0)


def test_values_cannot_be_changed() -> None:
    result = result_with_event()
    with pytest.raises(ValueError, match="read-only"):
        result["a[1,2]"][0] = 5
    with pytest.raises(InputError, match=r"did you mean a\[1,2\]"):
        result["a[1,3]"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "empty"),
        ("time,a\n", "no rows"),
        ("t,a\n0,1\n", "first column"),
        ("time,a,a\n0,1,2\n", "twice"),
        ("time,a\n0,1\n1,2,3\n", r"wrong\.csv:3: the row has 3 values"),
        ("time,a\n0,1\n1,x\n", r"wrong\.csv:3: 'x' is not a number"),
        ("time,a\n1,1\n0,1\n", "not increasing"),
        ("time,a\nnan,1\n", r"wrong\.csv:2: 'nan' stands"),
        ("time,a\ninf,1\n", "not increasing"),
    ],
)
def test_wrong_files_are_named(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "wrong.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_csv(path)
