"""The file of a study (docs/accuracy.md): which scenes, which knobs, measured against what."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final, cast

from contact_foundation.errors import CmbError, InputError, Place, ProblemList
from contact_foundation.toml_text import read_toml
from fmu_regression.cases.toml_table import TomlTable
from fmu_regression.compare.checks import Direction
from fmu_regression.fmi.description import StartValue

from accuracy_study.answers import ClosedForm, GivenTrajectory, KnownEvents, KnownValue
from accuracy_study.knobs import AS_MODELLED, KNOBS, PARAMETER, KnobValue, knob

FULL, ONE_AT_A_TIME = "full", "one at a time"
_DEFAULT_REPEATS: Final = 3
_DEFAULT_TIME_LIMIT: Final = 60.0

Knobs = Mapping[str, tuple[KnobValue, ...]]


@dataclass(frozen=True, eq=False)
class Scene:
    """A scene of a study; equal to itself alone.

    Attributes:
        name: in tables; no two scenes have the same.
        place: of the scene in the study's file, e.g. "scene[2]".
        model: Modelica class.
        sources: Modelica files or folders beside the contact library.
        manager: the ContactManager, needed where there are several.
        stop: stop time, s; the model's own if None.
        interval: output interval, s; the model's own if None.
        parameters: start values of every run.
        signals: what trajectories are compared by; positions of the manager's bodies if empty.
        energy: variable that holds the total energy, J; "" where there is none.
        reference: what runs are measured against; None: the tight trajectory of the first value of every knob.
        knobs: name to values, the first of each being what others are compared with.
        geometries: further values of the knob geometry: name to the Modelica modification of the scene that makes it.
    """

    name: str
    place: str
    model: str
    sources: tuple[Path, ...]
    manager: str | None
    stop: float | None
    interval: float | None
    parameters: Mapping[str, StartValue]
    signals: tuple[str, ...]
    energy: str
    reference: ClosedForm | GivenTrajectory | None
    knobs: Knobs
    geometries: Mapping[str, str]


@dataclass(frozen=True)
class Study:
    """A study.

    Attributes:
        path: its file.
        name: of the file without ending, or as given.
        description: what the study shows.
        grid: FULL (every value with every other) or ONE_AT_A_TIME (model and geometry knobs change one by one from
            their first values; those of the solver always meet every other).
        repeats: how often each run is timed; the median counts.
        time_limit: processor time of each run, s.
        scenes: at least one.
    """

    path: Path
    name: str
    description: str
    grid: str
    repeats: int
    time_limit: float
    scenes: tuple[Scene, ...]

    def only(self, names: Collection[str]) -> Study:
        """The study with the scenes of these names alone; with all if there are none.

        Raises:
            InputError: it has no scene of a name.
        """
        known = [scene.name for scene in self.scenes]
        for name in names:
            if name not in known:
                raise InputError(
                    f"has no scene {name!r}", place=Place(self.path), remedy=f"It has: {', '.join(known)}."
                )
        return replace(self, scenes=tuple(s for s in self.scenes if s.name in names)) if names else self

    def problem(self, scene: Scene, key: str, what: str) -> InputError:
        """An error about a key of a scene."""
        return InputError(what, place=Place(file=self.path, component=f"{scene.place}.{key}"))


def load_study(path: Path) -> Study:
    """Reads a study.

    Raises:
        InputError: the file is missing or no TOML.
        ProblemList: keys or knobs are unknown, values have the wrong type or range, a grid is empty; all are named.
    """
    return _StudyReader(path, read_toml(path, "a study")).read()


class _StudyReader:
    def __init__(self, path: Path, content: dict[str, Any]) -> None:
        self._path, self._content = path, content
        self._problems: list[CmbError] = []

    def read(self) -> Study:
        for key in self._content:
            if key not in ("study", "knobs", "scene"):
                self._problem(key, "is not a table of a study; there are study, knobs, scene")
        table = TomlTable(self._path, "study", self._content.get("study", {}), self._problems)
        repeats = table.optional_count("repeats")
        if repeats == 0:
            table.wrong("repeats", "every run is needed at least once")
        common = self._knobs("knobs", self._content.get("knobs", {}))
        for name, values in common.items():
            if not values:
                self._problem(f"knobs.{name}", "the grid is empty: give at least one value")
        scenes = self._scenes(common)
        study = Study(
            path=self._path,
            name=table.text("name", self._path.stem),
            description=table.text("description", ""),
            grid=table.choice("grid", (FULL, ONE_AT_A_TIME), FULL),
            repeats=_DEFAULT_REPEATS if repeats is None else repeats,
            time_limit=table.number("time_limit", _DEFAULT_TIME_LIMIT, positive=True),
            scenes=scenes,
        )
        table.done()
        if self._problems:
            raise ProblemList(str(self._path), self._problems)
        return study

    def _scenes(self, common: Knobs) -> tuple[Scene, ...]:
        entries = self._content.get("scene", [])
        if not isinstance(entries, list):
            self._problem("scene", "is not a list of tables; write [[scene]]")
            return ()
        if not entries:
            self._problem("scene", "the grid is empty: give at least one [[scene]]")
        scenes = tuple(self._scene(f"scene[{k + 1}]", entry, common) for k, entry in enumerate(entries))
        names = [scene.name for scene in scenes]
        for scene in scenes:
            if scene.name and names.count(scene.name) > 1:
                self._problem(f"{scene.place}.name", f"{scene.name!r} is the name of two scenes")
        return scenes

    def _scene(self, place: str, entry: Any, common: Knobs) -> Scene:
        folder = self._path.parent
        table = TomlTable(self._path, place, entry, self._problems)
        content = entry if isinstance(entry, dict) else {}
        geometries = self._geometries(place, table)
        own = self._knobs(f"{place}.knobs", content.get("knobs", {}), geometries)
        table.skip("knobs")
        knobs = {name: values for name, values in {**common, **own}.items() if values}
        if not knobs.get("tolerance"):
            table.wrong("knobs.tolerance", "the grid is empty: give tolerances of the solver")
        sources = (table.below("sources", text, folder) for text in table.texts("sources"))
        reference = self._reference(f"{place}.reference", content.get("reference"))
        table.skip("reference")
        model = table.text("model")
        scene = Scene(
            name=table.text("name", model.split(".")[-1] or "scene"),
            place=place,
            model=model,
            sources=tuple(source for source in sources if source is not None),
            manager=table.text("manager", "") or None,
            stop=table.optional_number("stop", positive=True),
            interval=table.optional_number("interval", positive=True),
            parameters=table.values("parameters"),
            signals=table.texts("signals"),
            energy=table.text("energy", ""),
            reference=reference,
            knobs=MappingProxyType(knobs),
            geometries=MappingProxyType(geometries),
        )
        for source in scene.sources:
            if not source.exists():
                table.wrong("sources", f"{source} does not exist")
        table.done()
        return scene

    def _geometries(self, place: str, table: TomlTable) -> dict[str, str]:
        found: dict[str, str] = {}
        for name, text in table.values("geometries").items():
            if isinstance(text, str) and text:
                found[name] = text
            else:
                self._problem(f"{place}.geometries.{name}", 'is not a Modelica modification, as in "bowl(n=64)"')
        return found

    def _knobs(self, place: str, content: Any, geometries: Collection[str] = ()) -> Knobs:
        if not isinstance(content, dict):
            self._problem(place, "is not a table")
            return {}
        flat = {name: values for name, values in content.items() if f"{name}." != PARAMETER}
        further = content.get(PARAMETER.rstrip("."), {})
        if isinstance(further, dict):
            flat.update({f"{PARAMETER}{name}": values for name, values in further.items()})
        else:
            self._problem(f"{place}.{PARAMETER.rstrip('.')}", "is not a table of variables, each with a list of values")
        words = {"geometry": geometries}
        return {name: self._values(f"{place}.{name}", name, v, words.get(name, ())) for name, v in flat.items()}

    def _values(self, place: str, name: str, values: Any, further: Collection[str]) -> tuple[KnobValue, ...]:
        found = knob(name)
        if found is None:
            self._problem(place, f"is no knob; there are {', '.join(KNOBS)} and {PARAMETER}VARIABLE")
            return ()
        if not isinstance(values, list):
            self._problem(place, "is not a list of values")
            return ()
        for value in values:
            if value != AS_MODELLED and value not in further and (problem := found.problem(value)):
                self._problem(place, f"{value!r} {problem}")
        if len(set(map(repr, values))) < len(values):
            self._problem(place, "a value is given twice")
        if name in ("tolerance", "solver") and AS_MODELLED in values:
            self._problem(place, f"{AS_MODELLED!r} is no value of this knob")
        return tuple(values)

    def _reference(self, place: str, content: Any) -> ClosedForm | GivenTrajectory | None:
        if content is None:
            return None
        table = TomlTable(self._path, place, content, self._problems)
        source = table.text("source")
        trajectory = table.file("trajectory", self._path.parent)
        values = tuple(self._value(t) for t in self._list(place, "value", content))
        events = tuple(self._events(t) for t in self._list(place, "event", content))
        table.skip("value")
        table.skip("event")
        table.done()
        if (trajectory is None) == (not values and not events):
            self._problem(place, "give either trajectory, or tables value and event")
        if trajectory is not None:
            if not trajectory.is_file():
                self._problem(f"{place}.trajectory", f"{trajectory} does not exist")
            return GivenTrajectory(trajectory, source)
        return ClosedForm(values, events, source)

    def _list(self, place: str, key: str, content: Any) -> list[TomlTable]:
        entries = content.get(key, []) if isinstance(content, dict) else []
        if not isinstance(entries, list):
            self._problem(f"{place}.{key}", "is not a list of tables")
            return []
        return [TomlTable(self._path, f"{place}.{key}[{k + 1}]", e, self._problems) for k, e in enumerate(entries)]

    def _value(self, table: TomlTable) -> KnownValue:
        signals, expected = table.signals(), table.number("expected")
        value = KnownValue(signals, expected, table.optional_number("time"), self._scale(table, abs(expected)))
        table.done()
        return value

    def _events(self, table: TomlTable) -> KnownEvents:
        times = table.optional_numbers("times") or ()
        if not times:
            table.wrong("times", "is missing: the known times in s")
        event = KnownEvents(
            name=table.text("name"),
            threshold=table.number("threshold"),
            direction=cast(Direction, table.choice("direction", ("rising", "falling", "either"), "either")),
            times=times,
            scale=self._scale(table, max(map(abs, times), default=math.nan)),
        )
        table.done()
        return event

    def _scale(self, table: TomlTable, default: float) -> float:
        if not table.has("scale") and not default > 0:
            table.wrong("scale", "is missing: what errors are divided by, as nothing else is at hand but 0")
            return math.nan
        return table.number("scale", default, positive=True)

    def _problem(self, key: str, what: str) -> None:
        self._problems.append(InputError(what, place=Place(file=self._path, component=key)))
