"""Simulation results: sampled signals with both sides of every event, and their CSV form."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place
from contact_foundation.near_names import did_you_mean
from contact_foundation.output import whole_file
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_MAX_CSV_BYTES = 2_000_000_000


@dataclass(frozen=True)
class SolverCounters:
    """Work of the integrator, summed over all restarts at events.

    Attributes:
        steps: accepted internal steps.
        evaluations: calls of the right-hand side, those for the Jacobian included.
        jacobians: Jacobian evaluations.
        error_test_failures: steps rejected because the error was too large.
        convergence_failures: steps rejected because Newton's iteration did not converge.
        state_events: zero crossings located.
        time_events: events at times that the model announced.
    """

    steps: int = 0
    evaluations: int = 0
    jacobians: int = 0
    error_test_failures: int = 0
    convergence_failures: int = 0
    state_events: int = 0
    time_events: int = 0


@dataclass(frozen=True)
class SimulationResult:
    """Signals over time.

    Attributes:
        time: shape (n,), s, never decreasing; the two rows of an event have the same time.
        signals: name to values, each of shape (n,), in the unit of the variable; Booleans are 0 and 1.
            The arrays are read-only.
        model: name of the model.
        mode: "me" (model exchange), "cs" (co-simulation) or "" (read from a file).
        tolerance: relative tolerance of the integration, if known.
        interval: output interval in s, if known.
        counters: the integrator's work, if known.
        wall_time: seconds the simulation took, if known; with initialization, without unpacking the FMU.
        cpu_time: processor time of the same, s, if known; what else runs on the machine counts for less in it.
        log: warnings of the FMU.
        units: unit of each signal, where known; no entry counts as unknown.
    """

    time: FloatArray
    signals: Mapping[str, FloatArray]
    model: str = ""
    mode: str = ""
    tolerance: float | None = None
    interval: float | None = None
    counters: SolverCounters | None = None
    wall_time: float | None = None
    cpu_time: float | None = None
    log: tuple[str, ...] = field(default=())
    units: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.time.ndim != 1:
            raise ValueError("time must have one dimension")
        self.time.flags.writeable = False
        for name, values in self.signals.items():
            if values.shape != self.time.shape:
                raise ValueError(f"signal {name} has shape {values.shape}, time has {self.time.shape}")
            values.flags.writeable = False

    def __contains__(self, name: object) -> bool:
        return name in self.signals

    def __getitem__(self, name: str) -> FloatArray:
        """Values of a signal, shape (n,).

        Raises:
            InputError: the result has no such signal.
        """
        try:
            return self.signals[name]
        except KeyError:
            raise InputError(
                f"the result has no signal {name!r}",
                place=Place(component=self.model or None),
                remedy=close_names_remedy(name, list(self.signals)),
            ) from None

    def vector(self, names: Sequence[str]) -> FloatArray:
        """Several signals side by side, shape (n, len(names))."""
        return np.column_stack([self[name] for name in names]) if names else np.empty((self.time.size, 0))

    def axis_label(self, name: str) -> str:
        """Text for the axis of a signal: its unit where known."""
        return f"value in {self.units[name]}" if self.units.get(name) else "value"

    def event_rows(self) -> NDArray[np.intp]:
        """Indices k of rows with time[k] == time[k + 1]: the left side of every event."""
        return np.flatnonzero(np.diff(self.time) == 0)


def close_names_remedy(name: str, known: Sequence[str]) -> str:
    """Text that names the known names nearest to a wrong one."""
    several = f"it has {len(known)} signals" + (f", among them {', '.join(known[:5])}" if known else "")
    return did_you_mean(name, known) or several


def format_number(value: float) -> str:
    """Twelve significant digits, always the same text for the same number; -0 is written 0."""
    if value == 0:
        return "0"
    if math.isnan(value):
        return "nan"
    return f"{value:.12g}"


def write_csv(result: SimulationResult, path: Path) -> None:
    """Writes a result as CSV: a header of Modelica names, then a row a sample, 12 significant digits.

    Names that hold commas are quoted (RFC 4180). The file appears whole or not at all.
    """
    columns = [result.time, *result.signals.values()]
    with whole_file(path) as staging, staging.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["time", *result.signals])
        for row in zip(*(column.tolist() for column in columns), strict=True):
            stream.write(",".join(map(format_number, row)) + "\n")


def read_csv(path: Path) -> SimulationResult:
    """Reads a result or a reference trajectory.

    Raises:
        InputError: the file is missing, has no column ``time``, a row of the wrong length, a value that is not a
            number, a name twice, or time that decreases; the line is named.
    """
    try:
        if path.stat().st_size > _MAX_CSV_BYTES:
            raise InputError("the file is too large to be a trajectory", place=Place(file=path))
        with path.open(encoding="utf-8-sig", newline="") as stream:
            reader = csv.reader(stream)
            try:
                header = [name.strip() for name in next(reader)]
            except StopIteration:
                raise InputError("the file is empty", place=Place(file=path)) from None
            rows: list[list[float]] = []
            for row in reader:
                if not row:
                    continue
                rows.append(_parse_row(row, len(header), path, reader.line_num))
    except OSError as error:
        raise InputError(f"cannot read: {error.strerror}", place=Place(file=path)) from error
    except UnicodeDecodeError as error:
        raise InputError("the file is not UTF-8 text", place=Place(file=path)) from error
    except csv.Error as error:
        raise InputError(f"not a CSV file: {error}", place=Place(file=path)) from error
    if not header or header[0] != "time":
        raise InputError(
            f"the first column is {header[0] if header else ''!r}, it must be 'time'", place=Place(file=path, line=1)
        )
    doubles = sorted({name for name in header if header.count(name) > 1}) if len(set(header)) < len(header) else []
    if doubles:
        raise InputError(f"the column {doubles[0]!r} appears twice", place=Place(file=path, line=1))
    if not rows:
        raise InputError("the file has a header and no rows", place=Place(file=path))
    table = np.array(rows, dtype=np.float64)
    time = np.ascontiguousarray(table[:, 0])
    falls = np.flatnonzero(np.diff(time) < 0)
    if falls.size or not np.isfinite(time).all():
        where = int(falls[0]) + 1 if falls.size else int(np.flatnonzero(~np.isfinite(time))[0])
        raise InputError(f"time is not increasing at data row {where + 1}", place=Place(file=path))
    signals = {name: np.ascontiguousarray(table[:, k]) for k, name in enumerate(header) if k > 0}
    return SimulationResult(time=time, signals=signals, model=path.stem)


def _parse_row(row: list[str], width: int, path: Path, line: int) -> list[float]:
    if len(row) != width:
        raise InputError(f"the row has {len(row)} values, the header {width} names", place=Place(file=path, line=line))
    try:
        values = [float(value) for value in row]
    except ValueError:
        wrong = next(value for value in row if not _is_number(value))
        raise InputError(f"{wrong!r} is not a number", place=Place(file=path, line=line)) from None
    undefined = next((text for text, value in zip(row, values, strict=True) if math.isnan(value)), None)
    if undefined is not None:
        raise InputError(f"{undefined!r} stands where a number belongs", place=Place(file=path, line=line))
    return values


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
