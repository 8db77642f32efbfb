"""Carrying out the comparison: every configuration of every scene, interleaved, each run kept once it is whole."""

from __future__ import annotations

import hashlib
import json
import statistics
import time as clock
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import count
from pathlib import Path
from typing import Any, Final, Protocol

import numpy as np
from contact_foundation.output import whole_file
from contact_foundation.progress import Progress, silent
from fmu_regression.compare.provenance import load, machine

from peer_bench.configurations import PROGRAMS, Configuration
from peer_bench.references import error, reference
from peer_bench.scenes import FloatArray, Scene

Builder = Callable[[str], Path]
"""The FMU of a Modelica model, built or found."""
_FORMAT: Final = 1
_MODULES: Final = Path(__file__).parent / "programs"
_LONG: Final = 1.0
"""Processor time of a run that is not repeated, s: its spread says nothing that is looked for."""


class Asked(Protocol):
    """A program that simulates."""

    version: str
    missing: str

    def start(self) -> None:
        """Starts it."""

    def ask(self, scene: str, settings: dict[str, float | str], limit: float) -> dict[str, Any]:
        """What a run gives."""


@dataclass(frozen=True)
class Row:
    """A run and its repeats.

    Attributes:
        scene, configuration, value: what was run; value of the swept setting.
        error: None where it failed.
        cpu_times: of all repeats, s.
        loads: of the machine at each of them, in processes; None where unknown.
        work: counts.
        failure: why it failed, or "".
    """

    scene: Scene
    configuration: Configuration
    value: float
    error: float | None
    cpu_times: tuple[float, ...]
    loads: tuple[float | None, ...]
    work: Mapping[str, float] = field(hash=False)
    failure: str

    @property
    def cpu_time(self) -> float | None:
        """Median processor time, s."""
        return statistics.median(self.cpu_times) if self.cpu_times else None


@dataclass(frozen=True)
class Findings:
    """What the comparison found.

    Attributes:
        rows: in the order of scenes and configurations.
        scenes: those with a row.
        machine: processor, cores and system.
        versions: of the programs that were there.
        missing: programs that were not, and why.
    """

    rows: tuple[Row, ...]
    scenes: tuple[Scene, ...]
    machine: str
    versions: Mapping[str, str]
    missing: Mapping[str, str]

    def of(self, scene: Scene) -> tuple[Row, ...]:
        """The rows of a scene."""
        return tuple(row for row in self.rows if row.scene == scene)


@dataclass(frozen=True)
class _Run:
    scene: Scene
    configuration: Configuration
    value: float
    settings: dict[str, float | str]

    def key(self, version: str, repeat: int) -> str:
        """Of the run in the folder: a digest of all that determines it."""
        settings = {key: value for key, value in self.settings.items() if key != "fmu"}
        program = self.configuration.program
        content = [_FORMAT, repr(self.scene), program, version, _source(program), settings, repeat]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:24]


@cache
def _source(program: str) -> str:
    """A digest of how scenes are made for a program."""
    module = PROGRAMS.get(program, program)
    files = [_MODULES / f"{module}_program.py", _MODULES / "simulation.py"]
    return hashlib.sha256(b"".join(file.read_bytes() for file in files if file.exists())).hexdigest()[:12]


def carry_out(
    scenes: Sequence[Scene],
    configurations: Mapping[str, Sequence[Configuration]],
    programs: Mapping[str, Asked],
    build: Builder,
    folder: Path,
    repeats: int = 3,
    limit: float = 30.0,
    progress: Progress = silent,
) -> Findings:
    """Carries out the comparison, or what is missing of it.

    Repeats follow each other scene by scene, and in each the programs take turns, so that what else the machine does
    meets all alike.

    Args:
        scenes: which.
        configurations: of each scene.
        programs: by name; one that is missing is left out and told.
        build: gives FMUs.
        folder: keeps every run; what is found there is not run again.
        repeats: runs of each, but of long ones; the median of all that are kept counts.
        limit: wall time of a run, s.
        progress: receives the phases "FMUs" and "runs".
    """
    folder.mkdir(parents=True, exist_ok=True)
    versions, missing = _started(programs)
    runs = _runs(scenes, configurations, versions, build, progress)
    total, done, began = repeats * len(runs), 0, clock.monotonic()
    for scene in scenes:
        for repeat in range(repeats):
            for run in _in_turn([run for run in runs if run.scene == scene]):
                done += 1
                _run(run, repeat, programs, versions, folder, limit)
                left = (clock.monotonic() - began) / done * (total - done)
                progress("runs", done / total, f"{done} of {total}, {left:.0f} s left")
    rows = _rows(runs, versions, folder)
    return Findings(
        rows, tuple(scene for scene in scenes if configurations.get(scene.name)), machine(), versions, missing
    )


def _started(programs: Mapping[str, Asked]) -> tuple[dict[str, str], dict[str, str]]:
    versions, missing = {}, {}
    for name, program in programs.items():
        program.start()
        if program.missing:
            missing[name] = program.missing
        else:
            versions[name] = program.version
    return versions, missing


def _runs(
    scenes: Sequence[Scene],
    configurations: Mapping[str, Sequence[Configuration]],
    versions: Mapping[str, str],
    build: Builder,
    progress: Progress,
) -> list[_Run]:
    chosen = [(s, c) for s in scenes for c in configurations.get(s.name, ()) if c.program in versions]
    runs = []
    for k, (scene, configuration) in enumerate(chosen):
        settings = dict(configuration.settings)
        if configuration.model:
            progress("FMUs", k / len(chosen), configuration.model)
            fmu = build(configuration.model)
            settings["fmu"] = str(fmu)
            settings["digest"] = hashlib.sha256(fmu.read_bytes()).hexdigest()
        runs += [_Run(scene, configuration, v, {**settings, configuration.swept: v}) for v in configuration.values]
    progress("FMUs", 1.0)
    return runs


def _in_turn(runs: Sequence[_Run]) -> list[_Run]:
    """The runs so that programs take turns: the first of each, then the second of each."""
    places: dict[str, int] = {}
    order = []
    for run in runs:
        place = places.get(run.configuration.program, 0)
        places[run.configuration.program] = place + 1
        order.append(place)
    return [runs[k] for k in sorted(range(len(runs)), key=lambda k: order[k])]


def _run(
    run: _Run, repeat: int, programs: Mapping[str, Asked], versions: Mapping[str, str], folder: Path, limit: float
) -> None:
    name = run.configuration.program
    target = folder / f"{run.key(versions[name], repeat)}.json"
    kept = _read(target)
    if kept is not None and kept.get("limit", limit) >= limit:
        return
    first = _read(folder / f"{run.key(versions[name], 0)}.json") if repeat else None
    if first is not None and ("failure" in first or first["cpu_time"] > _LONG):
        return
    found = programs[name].ask(run.scene.name, run.settings, limit)
    found["load"] = load()
    if "failure" in found:
        found["limit"] = limit  # with more time it is tried again
    with whole_file(target) as staging:
        staging.write_text(json.dumps(found), encoding="utf-8")


def _read(path: Path) -> dict[str, Any] | None:
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found


def _rows(runs: Sequence[_Run], versions: Mapping[str, str], folder: Path) -> tuple[Row, ...]:
    truths: dict[tuple[str, str], FloatArray | None] = {}
    rows = []
    for run in runs:
        version = versions[run.configuration.program]
        kept = (_read(folder / f"{run.key(version, repeat)}.json") for repeat in count())
        whole = list(_until_none(kept))
        if not whole or "failure" in whole[0]:
            failure = whole[0]["failure"] if whole else "is missing"
            rows.append(Row(run.scene, run.configuration, run.value, None, (), (), {}, failure))
            continue
        identity = (run.scene.name, run.configuration.name if run.scene.own_reference else "")
        if identity not in truths:
            truths[identity] = _truth(run, versions, folder) if run.scene.own_reference else reference(run.scene)
        truth = truths[identity]
        values = np.array(whole[0]["values"])
        deviation = None if truth is None else error(run.scene, truth, values)
        if run.scene.own_reference and run.value == min(run.configuration.values):
            continue  # it is what the others are measured against
        timed = [one for one in whole if "failure" not in one and deviation is not None]
        rows.append(
            Row(
                run.scene,
                run.configuration,
                run.value,
                deviation,
                tuple(one["cpu_time"] for one in timed),
                tuple(one.get("load") for one in timed),
                whole[0]["work"],
                "" if deviation is not None else "its tightest run failed, by which it would be measured",
            )
        )
    return tuple(rows)


def _until_none(found: Iterable[dict[str, Any] | None]) -> Iterator[dict[str, Any]]:
    for one in found:
        if one is None:
            return
        yield one


def _truth(run: _Run, versions: Mapping[str, str], folder: Path) -> FloatArray | None:
    """The tightest run of the same configuration."""
    tightest = min(run.configuration.values)
    settings = {**run.settings, run.configuration.swept: tightest}
    same = _Run(run.scene, run.configuration, tightest, settings)
    found = _read(folder / f"{same.key(versions[run.configuration.program], 0)}.json")
    return None if found is None or "failure" in found else np.array(found["values"])
