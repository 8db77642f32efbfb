"""Hard cases: drawn from seeds, judged by figures, kept, resumed, mapped."""

from __future__ import annotations

import csv
import math
import os
import signal
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import BuildError, SimulationError
from fmu_regression.results.result import SimulationResult
from fmu_regression.simulate.cvode import WHAT_HELPS
from hard_cases.bodies import motions, pairs, shapes
from hard_cases.campaign import carry_out_cases
from hard_cases.expectation import expect
from hard_cases.knobs import KINDS, NUMBERS, RUNS_PER_STRUCTURE, HardCase, hard_case
from hard_cases.operating_range import inside
from hard_cases.picture import hard_map
from hard_cases.run import Row, kept_verdict
from hard_cases.scene_text import scene_text, signals, start_values
from hard_cases.table import write_table
from hard_cases.tables import failure_rows, range_rows, verdict_rows
from hard_cases.verdict import Kind, Verdict, classified, judge, named_knobs, stopped


def case_of(kind: str, **settings: object) -> HardCase:
    found = hard_case(KINDS.index(kind) * RUNS_PER_STRUCTURE)
    return replace(found, **settings)  # type: ignore[arg-type]


def test_a_seed_gives_the_same_run_and_every_range_is_drawn_from():
    cases = [hard_case(seed) for seed in range(7000)]
    assert cases[:100] == [hard_case(seed) for seed in range(100)]
    for name, knob in NUMBERS.items():
        values = [case.number(name) for case in cases]
        assert all(knob.low <= value <= knob.high for value in values)
        middle = math.sqrt(knob.low * knob.high) if knob.logarithmic else (knob.low + knob.high) / 2
        assert min(values) < middle < max(values)
    assert {0.0, 1.0} <= {case.restitution for case in cases}
    assert {case.structure.kind for case in cases} == set(KINDS)


@pytest.mark.parametrize("kind", KINDS)
def test_bodies_start_where_they_do_not_yet_touch_unless_they_shall(kind):
    for number in range(KINDS.index(kind), 70, len(KINDS)):
        case = hard_case(number * RUNS_PER_STRUCTURE)
        bodies = motions(case)
        assert len(bodies) == len(shapes(case.structure)) == case.structure.count
        assert all(body.mass > 0 for body in bodies)
        expected = expect(case)
        assert expected.stop > 0
        assert expected.depth > 0
        if kind == "chain":
            apart = bodies[1].position[0] - bodies[0].position[0] - case.structure.size
            assert 0 <= apart <= 1.01e-3 * case.structure.size
            assert pairs(case.structure)[0] == (2, 1)
        names = start_values(case, 1.0, 1.0)
        assert len([name for name in names if name.startswith("m[")]) == len(bodies)
        assert all(math.isfinite(value) for value in names.values())
        assert scene_text(case.structure).count("Parts.Body") == len(bodies)


def ball_result(case: HardCase, energy: Sequence[float], depth: float = 0.0) -> SimulationResult:
    count = len(energy)
    values = {name: np.zeros(count) for name in signals(case.structure)}
    values["kinetic"] = np.array(energy, dtype=float) * expect(case).energy
    values["contacts.distance[1]"] = np.full(count, -depth * expect(case).thickness)
    return SimulationResult(
        time=np.linspace(0, expect(case).stop, count), signals=values, model="", mode="cs", tolerance=1e-6, interval=1.0
    )


def test_figures_make_the_verdict():
    case = case_of("box", tolerance=1e-6)
    expected = expect(case)
    assert judge(case, expected, ball_result(case, [1, 0.5, 0.5])).kind is Kind.RIGHT
    gained = judge(case, expected, ball_result(case, [1, 0.5, 0.6]))
    assert gained.kind is Kind.WRONG
    assert gained.energy_gain == pytest.approx(0.1)
    assert "energy" in gained.cause
    assert judge(replace(case, tolerance=1e-2), expected, ball_result(case, [1, 0.5, 0.6])).kind is Kind.RIGHT
    assert judge(case, expected, ball_result(case, [1, math.nan])).kind is Kind.WRONG
    deep = judge(case, expected, ball_result(case, [1, 0.5], depth=0.6))
    assert deep.kind is Kind.DEEP
    warned = classified(case, expected, replace(deep, warnings="a body penetrates by half: raise stiffness"))
    assert (warned.kind, warned.knobs) == (Kind.WARNED, "stiffness")


def test_a_ball_gets_no_deeper_than_its_energy_allows():
    case = case_of("ball", tolerance=1e-6)
    bound = expect(case).relative_depth
    assert judge(case, expect(case), ball_result(case, [1, 0.5], depth=bound)).kind is Kind.RIGHT
    assert judge(case, expect(case), ball_result(case, [1, 0.5], depth=1.1 * bound)).kind is Kind.WRONG


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("given up after 5 s of processor time at t = 0.5", Kind.SLOW),
        ("the simulation crashed: signal SIGSEGV in the FMU", Kind.CRASHED),
        ("needs more than 100000 steps: raise cmbSolver.maximumSteps at time 0.25", Kind.STOPPED),
        ("the error test failed at t = 0.5", Kind.UNNAMED),
    ],
)
def test_messages_make_the_verdict(text, kind):
    assert stopped(SimulationError(text), 1.0).kind is kind
    assert named_knobs("take a smaller tolerance or stiffness") == "stiffness tolerance"


@dataclass(frozen=True)
class _NoFmu:
    """Cannot build; kills its worker the first time that it is asked for a structure of ``deadly``."""

    folder: Path
    deadly: str = ""

    def __call__(self, model: str, sources: Sequence[Path], fmu: Path) -> None:
        with (self.folder / "built").open("a") as stream:
            stream.write(f"{fmu.stem}\n")
        if fmu.stem == self.deadly and not (self.folder / "died").exists():
            (self.folder / "died").touch()
            os.kill(os.getpid(), signal.SIGKILL)
        raise BuildError(f"{model} of {sources[0].name}: no compiler")


@pytest.mark.full
def test_rows_are_kept_and_a_killed_worker_is_repeated(tmp_path):
    folder = tmp_path / "hard"
    build = _NoFmu(tmp_path, "box-1")
    rows = carry_out_cases(range(20, 30), build, folder, jobs=2)
    assert [row.case.seed for row in rows] == list(range(20, 30))
    assert all("no compiler" in row.verdict.cause for row in rows)
    assert (tmp_path / "died").exists()
    kept = kept_verdict(folder, 27)
    assert kept is not None
    (folder / "runs" / "27.json").write_text("{}")
    before = {path: path.stat().st_mtime_ns for path in (folder / "runs").iterdir()}
    again = carry_out_cases(range(20, 30), build, folder)
    assert [row.verdict.cause for row in again] == [row.verdict.cause for row in rows]
    changed = [path.name for path, time in before.items() if path.stat().st_mtime_ns != time]
    assert changed == ["27.json"]


def test_table_map_and_summaries_tell_every_run(tmp_path):
    kinds = list(Kind)
    rows = [Row(hard_case(k), expect(hard_case(k)), Verdict(kinds[k % len(kinds)], f"cause {k}")) for k in range(60)]
    write_table(rows, tmp_path / "table.csv")
    with (tmp_path / "table.csv").open(newline="") as stream:
        found = list(csv.DictReader(stream))
    assert [row["seed"] for row in found] == [str(k) for k in range(60)]
    assert float(found[3]["stiffness"]) == rows[3].case.stiffness
    assert hard_map(rows).count("h0") == 4 * 60
    assert hard_map(rows) == hard_map(rows)
    assert verdict_rows(rows)[-1] == ("all", "60", str(sum(inside(row) for row in rows)))
    assert "tolerance" in {line[0] for line in range_rows(rows)[1:]}
    assert {line[0] for line in failure_rows(rows)[1:]} == {kind.value for kind in Kind if kind is not Kind.RIGHT}


def test_an_integrator_whose_steps_become_too_small_names_knobs() -> None:
    """Rods of a kilometre at a tolerance of 1e-3, whose contact is noise, ended with a message that named none."""
    assert named_knobs(WHAT_HELPS) == "stiffness tolerance"
