"""Regression cases: one TOML file each (docs/regression.md)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, cast

from contact_foundation.errors import CmbError, InputError, Place, ProblemList
from contact_foundation.toml_text import read_toml

from fmu_regression.cases.toml_table import TomlTable
from fmu_regression.compare.checks import (
    BoundCheck,
    Check,
    Direction,
    EventCheck,
    MeanCheck,
    MonotonicCheck,
    SignalCheck,
    ValueCheck,
)
from fmu_regression.fmi.binding import Mode
from fmu_regression.fmi.description import StartValue

_DEFAULT_NOMINAL = 1e-3
_TIME_TOLERANCE_SHARE = 1e-5


@dataclass(frozen=True)
class Case:
    """A regression case.

    Attributes:
        path: the TOML file.
        name: the file's name without ending, or as given.
        description: what the case shows.
        model: Modelica class, or "" if an FMU is named.
        package: file or folder of the Modelica package that holds the model; None with an FMU.
        sources: further Modelica files or folders that the model needs.
        fmu: a ready FMU, or None.
        requires: what the case needs beyond the project, e.g. "msl"; the caller decides.
        start, stop: s.
        tolerance: relative tolerance of the integration.
        interval: output interval, s.
        max_step: longest step, s, or None.
        modes: "me", "cs" or both.
        parameters: start values.
        reference: the CSV to compare with, or None.
        time_tolerance: how far events may lie apart without counting as a difference of signals, s.
        checks: what is asked.
    """

    path: Path
    name: str
    description: str
    model: str
    package: Path | None
    sources: tuple[Path, ...]
    fmu: Path | None
    requires: tuple[str, ...]
    start: float
    stop: float
    tolerance: float
    interval: float
    max_step: float | None
    modes: tuple[Mode, ...]
    parameters: Mapping[str, StartValue]
    reference: Path | None
    time_tolerance: float
    checks: tuple[Check, ...]

    @property
    def signals(self) -> tuple[str, ...]:
        """All signals that the checks read, each once."""
        return tuple(dict.fromkeys(name for check in self.checks for name in check.signals))


def load_case(path: Path) -> Case:
    """Reads a case.

    Raises:
        InputError: the file is missing or no TOML.
        ProblemList: keys are unknown or missing, values have the wrong type or range; all are named.
    """
    return _CaseReader(path, read_toml(path, "a case")).read()


def find_cases(folder: Path) -> tuple[Path, ...]:
    """All case files below a folder, sorted.

    Raises:
        InputError: there is no such folder, or no case in it.
    """
    if not folder.is_dir():
        raise InputError("there is no such folder", place=Place(file=folder))
    found = tuple(sorted(folder.rglob("*.toml")))
    if not found:
        raise InputError("the folder holds no case (*.toml)", place=Place(file=folder))
    return found


class _CaseReader:
    """Reads the tables of a case file and gathers what is wrong."""

    def __init__(self, path: Path, content: dict[str, Any]) -> None:
        self._path, self._content = path, content
        self._problems: list[CmbError] = []

    def read(self) -> Case:
        folder = self._path.parent
        kinds: dict[str, Callable[[TomlTable], Check | tuple[Check, ...]]] = {
            "signal": _signals,
            "value": _value,
            "event": _event,
            "mean": _mean,
            "bound": _bound,
            "monotonic": _monotonic,
        }
        for key in self._content:
            if key != "case" and key not in kinds:
                self._problem(key, f"is not a table of a case; there are case, {', '.join(kinds)}")
        if "case" not in self._content:
            self._problem("case", "is missing")
        table = TomlTable(self._path, "case", self._content.get("case", {}), self._problems)
        start, stop = table.number("start", 0.0), table.number("stop")
        if stop <= start:
            table.wrong("stop", f"{stop:g} is not after the start {start:g}")
        mode = table.choice("mode", ("me", "cs", "both"), "me")
        model, fmu, package = table.text("model", ""), table.file("fmu", folder), table.file("package", folder)
        if bool(model) == (fmu is not None):
            table.wrong("model", "give either model or fmu")
        if model and package is None:
            table.wrong("package", "is missing: the file or folder of the package that holds the model")
        sources = (table.below("sources", text, folder) for text in table.texts("sources"))
        case = Case(
            path=self._path,
            name=table.text("name", self._path.stem),
            description=table.text("description", ""),
            model=model,
            package=package,
            sources=tuple(source for source in sources if source is not None),
            fmu=fmu,
            requires=table.texts("requires"),
            start=start,
            stop=stop,
            tolerance=table.number("tolerance", positive=True),
            interval=table.number("interval", positive=True),
            max_step=table.optional_number("max_step", positive=True),
            modes=("me", "cs") if mode == "both" else (cast(Mode, mode),),
            parameters=table.values("parameters"),
            reference=table.file("reference", folder),
            time_tolerance=table.number("time_tolerance", _TIME_TOLERANCE_SHARE * abs(stop - start), least=0.0),
            checks=tuple(check for kind, read in kinds.items() for check in self._checks(kind, read)),
        )
        table.done()
        if not case.checks:
            self._problem("signal", "the case checks nothing")
        if case.reference is None and any(isinstance(check, SignalCheck) for check in case.checks):
            self._problem("case.reference", "is missing, signals are compared with it")
        if self._problems:
            raise ProblemList(str(self._path), self._problems)
        return case

    def _checks(self, kind: str, read: Callable[[TomlTable], Check | tuple[Check, ...]]) -> list[Check]:
        entries = self._content.get(kind, [])
        if not isinstance(entries, list):
            self._problem(kind, f"is not a list of tables; write [[{kind}]]")
            return []
        checks: list[Check] = []
        for k, entry in enumerate(entries):
            table = TomlTable(self._path, f"{kind}[{k + 1}]", entry, self._problems)
            found = read(table)
            checks += found if isinstance(found, tuple) else (found,)
            table.done()
        return checks

    def _problem(self, key: str, what: str) -> None:
        self._problems.append(InputError(what, place=Place(file=self._path, component=key)))


def _signals(table: TomlTable) -> tuple[SignalCheck, ...]:
    """One check for ``name``, or one for each of ``names``."""
    if table.has("name") == table.has("names"):
        table.wrong("name", "give either name (one signal) or names (a list of signals)")
    names = table.texts("names") if table.has("names") else (table.text("name"),)
    tolerance = table.number("tolerance", positive=True)
    nominal = table.number("nominal", _DEFAULT_NOMINAL, positive=True)
    window, tube = table.window(), table.number("tube", 0.0, least=0.0)
    return tuple(SignalCheck(name, tolerance, nominal, window, tube) for name in names)


def _value(table: TomlTable) -> ValueCheck:
    return ValueCheck(
        signals=table.signals(),
        expected=table.number("expected"),
        tolerance=table.number("tolerance", least=0.0),
        time=table.optional_number("time"),
    )


def _event(table: TomlTable) -> EventCheck:
    values, value_of = table.optional_numbers("values"), table.text("value_of", "") or None
    value_tolerance = table.optional_number("value_tolerance", positive=True)
    if (value_of is None) != (value_tolerance is None):
        table.wrong("value_of", "give value_of and value_tolerance together")
    return EventCheck(
        name=table.text("name"),
        tolerance=table.number("tolerance", positive=True),
        threshold=table.optional_number("threshold"),
        direction=cast(Direction, table.choice("direction", ("rising", "falling", "either"), "either")),
        times=table.optional_numbers("times"),
        count=table.optional_count("count"),
        first=table.optional_count("first"),
        window=table.window(),
        value_of=value_of,
        values=values,
        value_tolerance=value_tolerance,
    )


def _mean(table: TomlTable) -> MeanCheck:
    relative = table.has("relative_tolerance")
    if relative == table.has("tolerance"):
        table.wrong("tolerance", "give either tolerance or relative_tolerance")
    return MeanCheck(
        signals=table.signals(),
        tolerance=table.number("relative_tolerance" if relative else "tolerance", positive=True),
        relative=relative,
        expected=table.optional_number("expected"),
        window=table.window(),
    )


def _bound(table: TomlTable) -> BoundCheck:
    if not table.has("minimum") and not table.has("maximum"):
        table.wrong("minimum", "give minimum, maximum or both")
    return BoundCheck(
        signals=table.signals(),
        minimum=table.optional_number("minimum"),
        maximum=table.optional_number("maximum"),
        window=table.window(),
    )


def _monotonic(table: TomlTable) -> MonotonicCheck:
    return MonotonicCheck(
        signals=table.signals(),
        direction=cast(Literal["rising", "falling"], table.choice("direction", ("rising", "falling"))),
        tolerance=table.number("tolerance", least=0.0),
        window=table.window(),
    )
