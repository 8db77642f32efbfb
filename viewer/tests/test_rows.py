"""Curves with x of their own as rows of a common x: nothing is lost, nothing is made up."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from javascript import evaluate, needs_modules

pytestmark = needs_modules
IMPORTS = "import {commonRows} from '@/plots/rows.js'; import {tickText, valueText} from '@/plots/numbers.js';"
# JSON has neither NaN nor undefined.
ROWS = (
    "const number = value => value === 'nan' ? NaN : value;"
    "const series = data.series.map(([x, y]) => ({x: x.map(number), y: y.map(number)}));"
    "return commonRows(series, data.axes)"
    ".map(column => Array.from(column, value => value === undefined ? 'none' : value));"
)


def rows(series: list[tuple[Any, Any]], **axes: bool) -> list[list[Any]]:
    """Columns of the common rows."""

    def plain(values: Any) -> list[Any]:
        return ["nan" if math.isnan(value) else value for value in map(float, values)]

    data = {"series": [(plain(x), plain(y)) for x, y in series], "axes": axes}
    return list(evaluate(IMPORTS, ROWS, data))


def test_each_curve_keeps_its_points_in_their_order() -> None:
    rng = np.random.default_rng(5)
    for count in (1, 2, 5):
        series = []
        for _ in range(count):
            # Few different values: many are shared, and some come twice, as times of jumps do.
            x = np.sort(rng.integers(0, 12, rng.integers(0, 30)) / 4)
            series.append((x, rng.normal(size=x.size)))
        x, *columns = rows(series)
        assert x == sorted(x)
        for (own, y), column in zip(series, columns, strict=True):
            kept = [(at, value) for at, value in zip(x, column, strict=True) if value != "none"]
            assert kept == list(zip(own.tolist(), y.tolist(), strict=True))
        most = {value: max((own == value).sum() for own, _ in series) for value in x}
        assert len(x) == sum(most.values())  # no row without a point


def test_a_jump_keeps_the_values_before_and_after() -> None:
    x, held, other = rows([([0, 1, 1, 2], [0, 0, 5, 5]), ([0, 2], [1, 1])])
    assert x == [0, 1, 1, 2]
    assert held == [0, 0, 5, 5]
    assert other == [1, "none", "none", 1]


def test_what_cannot_be_drawn_is_a_gap() -> None:
    assert rows([([0, 1, 2], [1, math.nan, 3])]) == [[0, 1, 2], [1, None, 3]]
    assert rows([([0, 1, 2], [1, -2, 3])], yLog=True) == [[0, 1, 2], [1, None, 3]]
    assert rows([([0, 1, 2], [1, 2, 3])], xLog=True) == [[1, 2], [2, 3]]
    assert rows([]) == [[]]


def test_points_of_a_scan_are_put_in_order() -> None:
    assert rows([([3, 1, 2], [30, 10, 20])]) == [[1, 2, 3], [10, 20, 30]]


def test_numbers_at_axes_are_short() -> None:
    texts = evaluate(
        IMPORTS, "return data.map(([value, step]) => tickText(value, step));",
        [[0.1 + 0.2, 0.1], [2e-7, 1e-7], [0.01, 0], [500, 0], [-0.5, 0.25], [1e-18, 0.1]],
    )  # fmt: skip
    assert texts == ["0.3", "2e-7", "0.01", "500", "-0.5", "0"]


@pytest.mark.parametrize("value", [0.0, 1.0, -12345.678, 3.1e-9, 2.5e12, 1 / 3])
def test_values_are_told_to_six_digits(value: float) -> None:
    assert float(evaluate(IMPORTS, "return valueText(data);", value)) == pytest.approx(value, rel=1e-4)
