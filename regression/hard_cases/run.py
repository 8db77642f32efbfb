"""What worker processes do: the FMU of a structure, then its runs, each row written as soon as it is whole."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

from contact_foundation.errors import CmbError
from contact_foundation.output import whole_file
from fmu_regression.simulate.simulation import simulate

from hard_cases.expectation import Expectation, expect
from hard_cases.knobs import HardCase, hard_case, structure_of
from hard_cases.scene_text import MODEL, scene_text, signals, start_values
from hard_cases.verdict import Kind, Verdict, classified, judge, stopped

Builder = Callable[[str, Sequence[Path], Path], None]
"""Builds the FMU of a model: (model, sources beside the contact library, FMU to write)."""
_WALL_BY_CPU: Final = 20.0
_WALL: Final = 60.0
_FORMAT: Final = 1


@dataclass(frozen=True)
class Row:
    """A run and its verdict."""

    case: HardCase
    expected: Expectation
    verdict: Verdict


@dataclass(frozen=True)
class StructureTask:
    """Builds the FMU of a structure and carries out those of its runs that are missing.

    Attributes:
        folder: where rows are kept, a file a run.
        structure: its number.
        seeds: of the runs.
        cpu_limit: processor time that a run may take, s.
        build: builds FMUs; picklable.
    """

    folder: Path
    structure: int
    seeds: tuple[int, ...]
    cpu_limit: float
    build: Builder

    def __call__(self) -> None:
        """Carries out; failures are rows too."""
        structure = structure_of(self.structure)
        fmu = self.folder / "fmus" / f"{structure.kind}-{structure.number}.fmu"
        source = fmu.with_suffix("") / f"{MODEL}.mo"
        with whole_file(source) as staging:
            staging.write_text(scene_text(structure), encoding="utf-8")
        mark = ""
        failure: CmbError | None = None
        try:
            self.build(MODEL, (source,), fmu)
            mark = hashlib.sha256(fmu.read_bytes()).hexdigest()
        except CmbError as error:
            failure = error
        for seed in self.seeds:
            case = hard_case(seed)
            key = {"format": _FORMAT, "fmu": mark, "cpu_limit": self.cpu_limit, "case": asdict(case)}
            if _kept(self.folder, seed, key) is None:
                expected = expect(case)
                verdict = (
                    stopped(failure, expected.stop) if failure else carry_out_run(case, expected, fmu, self.cpu_limit)
                )
                _keep(self.folder, seed, key, verdict)


def carry_out_run(case: HardCase, expected: Expectation, fmu: Path, cpu_limit: float) -> Verdict:
    """Simulates and judges."""
    interval = case.step * expected.stop
    try:
        result = simulate(
            fmu,
            signals=signals(case.structure),
            stop=expected.stop,
            interval=interval,
            tolerance=case.tolerance,
            mode=case.mode,
            parameters=start_values(case, expected.damping, expected.steady_rate),
            time_limit=_WALL + _WALL_BY_CPU * cpu_limit,
            cpu_limit=cpu_limit,
        )
    except CmbError as error:
        return stopped(error, expected.stop)
    return judge(case, expected, result)


def kept_verdict(folder: Path, seed: int) -> Verdict | None:
    """The verdict on a run by its kept figures, or None if it is missing or cannot be read."""
    found = _read(folder, seed)
    if found is None:
        return None
    values = found["verdict"]
    try:
        verdict = Verdict(**{**values, "kind": Kind(values["kind"])})
    except (TypeError, KeyError, ValueError):
        return None
    case = hard_case(seed)
    return verdict if math.isnan(verdict.depth) else classified(case, expect(case), verdict)


def _kept(folder: Path, seed: int, key: dict[str, Any]) -> dict[str, Any] | None:
    found = _read(folder, seed)
    return found if found is not None and found["key"] == json.loads(json.dumps(key)) else None


def _read(folder: Path, seed: int) -> dict[str, Any] | None:
    try:
        found: dict[str, Any] = json.loads(_file(folder, seed).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found if {"key", "verdict"} <= found.keys() else None


def _keep(folder: Path, seed: int, key: dict[str, Any], verdict: Verdict) -> None:
    with whole_file(_file(folder, seed)) as staging:
        staging.write_text(json.dumps({"key": key, "verdict": verdict.as_dict()}, indent=1), encoding="utf-8")


def _file(folder: Path, seed: int) -> Path:
    return folder / "runs" / f"{seed}.json"
