"""Plots and numbers that a modeller chooses for the report, beside those that every scene gets."""

from __future__ import annotations

from collections.abc import Container, Iterable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np
from contact_foundation.errors import InputError, Place

from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.loads import mean_over_time

Window = tuple[float, float]


class Taken(Enum):
    """Which number a signal is boiled down to."""

    LAST = "last"
    MEAN = "mean"
    LEAST = "least"
    GREATEST = "greatest"


@dataclass(frozen=True)
class ChosenPlot:
    """Curves in one plot.

    Attributes:
        title: heading.
        label: of the vertical axis, with the unit.
        signals: labels of the curves and names of their signals.
        window: s; the whole simulation if None.
    """

    title: str
    label: str
    signals: tuple[tuple[str, str], ...]
    window: Window | None = None


@dataclass(frozen=True)
class ChosenNumber:
    """A number taken from a signal."""

    title: str
    signal: str
    taken: Taken
    unit: str = ""
    window: Window | None = None

    def value(self, result: SimulationResult) -> float:
        """The number.

        Raises:
            InputError: the window has no rows.
        """
        rows = rows_within(result, self.window)
        time, values = result.time[rows], result[self.signal][rows]
        if not values.size:
            raise InputError(
                f"nothing was simulated in the window of {self.title!r}", remedy="Simulate longer or change the window."
            )
        match self.taken:
            case Taken.MEAN:
                return mean_over_time(time, values)
            case Taken.LEAST:
                return float(values.min())
            case Taken.GREATEST:
                return float(values.max())
            case Taken.LAST:
                return float(values[-1])


@dataclass(frozen=True)
class Figures:
    """What the modeller wants to see."""

    plots: tuple[ChosenPlot, ...] = ()
    numbers: tuple[ChosenNumber, ...] = ()

    @property
    def signals(self) -> tuple[str, ...]:
        """Names of all signals, each once."""
        of_plots = [name for plot in self.plots for _, name in plot.signals]
        return tuple(dict.fromkeys(of_plots + [number.signal for number in self.numbers]))

    def require(self, known: Container[str], place: Place) -> None:
        """Raises InputError if a signal is not known."""
        missing = [name for name in self.signals if name not in known]
        if missing:
            raise InputError(
                f"there is no variable {', '.join(map(repr, missing))}", place=place, remedy="Correct the names."
            )

    def within(self, result: SimulationResult) -> Figures:
        """What is left for a result that is shorter than some windows or lacks some signals."""
        end = float(result.time[-1])
        plots = tuple(
            plot
            for plot in self.plots
            if all(name in result for _, name in plot.signals) and (plot.window is None or plot.window[0] < end)
        )
        numbers = tuple(
            number
            for number in self.numbers
            if number.signal in result and (number.window is None or number.window[1] <= end + 1e-9)
        )
        return Figures(plots, numbers)

    def lines(self, result: SimulationResult) -> list[str]:
        """The numbers for the terminal, a line each."""
        return [
            f"  {number.title}: {number.value(result):.5g}{f' {number.unit}' if number.unit else ''}"
            for number in self.within(result).numbers
        ]


NO_FIGURES = Figures()


def rows_within(result: SimulationResult, window: Window | None) -> slice:
    """The rows of a window."""
    if window is None:
        return slice(None)
    return slice(
        int(np.searchsorted(result.time, window[0], "left")), int(np.searchsorted(result.time, window[1], "right"))
    )


def read_figures(content: dict[str, Any], file: Path) -> Figures:
    """Reads the tables ``[[plot]]`` and ``[[number]]`` of a TOML file; other keys are left alone.

    ```toml
    [[plot]]
    title = "Foot forces"
    label = "normal force in N"
    window = [10, 15]                                  # optional, s
    signals = { left = "force[1]", right = "force[2]" }

    [[number]]
    title = "Way"
    signal = "travel"
    taken = "last"                                     # last, mean, least, greatest
    unit = "m"                                         # optional; so is a window
    ```

    Raises:
        InputError: a table is wrong.
    """
    plots = tuple(_plot(table, file) for table in _tables(content, "plot", file))
    return Figures(plots, tuple(_number(table, file) for table in _tables(content, "number", file)))


def _tables(content: dict[str, Any], name: str, file: Path) -> list[dict[str, Any]]:
    tables = content.get(name, [])
    if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
        raise InputError(f"{name} is not a list of tables", place=Place(file=file), remedy=f"Write [[{name}]].")
    return tables


def _plot(table: dict[str, Any], file: Path) -> ChosenPlot:
    _check_keys(table, {"title", "label", "signals"}, {"window"}, "plot", file)
    signals = table["signals"]
    if not isinstance(signals, dict) or not signals or not all(isinstance(name, str) for name in signals.values()):
        raise _wrong("plot", table, "signals is not a table of labels and names", file)
    return ChosenPlot(
        _text(table, "title", "plot", file),
        _text(table, "label", "plot", file),
        tuple(signals.items()),
        _window(table, "plot", file),
    )


def _number(table: dict[str, Any], file: Path) -> ChosenNumber:
    _check_keys(table, {"title", "signal", "taken"}, {"unit", "window"}, "number", file)
    if table["taken"] not in [taken.value for taken in Taken]:
        raise _wrong("number", table, f"taken is none of {', '.join(taken.value for taken in Taken)}", file)
    return ChosenNumber(
        _text(table, "title", "number", file),
        _text(table, "signal", "number", file),
        Taken(table["taken"]),
        _text(table, "unit", "number", file) if "unit" in table else "",
        _window(table, "number", file),
    )


def _check_keys(table: dict[str, Any], needed: Iterable[str], optional: set[str], kind: str, file: Path) -> None:
    missing = sorted(set(needed) - set(table))
    unknown = sorted(set(table) - set(needed) - optional)
    if missing:
        raise _wrong(kind, table, f"{', '.join(missing)} is missing", file)
    if unknown:
        raise _wrong(kind, table, f"{', '.join(unknown)} has no meaning", file)


def _text(table: dict[str, Any], key: str, kind: str, file: Path) -> str:
    if not isinstance(table[key], str):
        raise _wrong(kind, table, f"{key} is not a text", file)
    return str(table[key])


def _window(table: dict[str, Any], kind: str, file: Path) -> Window | None:
    if "window" not in table:
        return None
    window = table["window"]
    numbers = [value for value in window if type(value) in (int, float)] if isinstance(window, list) else []
    if len(numbers) != 2 or len(window) != 2 or not numbers[0] < numbers[1]:
        raise _wrong(kind, table, "window is not [from, to] in s", file)
    return float(numbers[0]), float(numbers[1])


def _wrong(kind: str, table: dict[str, Any], what: str, file: Path) -> InputError:
    title = table.get("title")
    place = Place(file=file, component=f"[[{kind}]] {title!r}" if title else f"[[{kind}]]")
    return InputError(what, place=place, remedy="Correct the file.")
