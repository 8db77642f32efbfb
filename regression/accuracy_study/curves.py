"""The curves of a scene's plots: runs that differ in tolerance alone."""

from __future__ import annotations

from dataclasses import dataclass

from accuracy_study.chart import Point
from accuracy_study.grid import Run
from accuracy_study.sentences import variant_text
from accuracy_study.study import Row, SceneFindings


@dataclass(frozen=True)
class Curve:
    """Runs of one variant, solver and longest step, from the loosest tolerance to the tightest."""

    label: str
    rows: tuple[Row, ...]

    def over_time(self) -> list[Point]:
        """Processor time in s and error, where both are known and not 0."""
        return [
            (row.outcome.cpu_time, row.outcome.error, self._note(row.run))
            for row in self.rows
            if row.outcome.cpu_time and row.outcome.error
        ]

    def over_tolerance(self) -> list[Point]:
        """Tolerance and solver error, where it is known and not 0."""
        return [
            (row.run.tolerance, row.outcome.solver_error, self._note(row.run))
            for row in self.rows
            if row.outcome.solver_error
        ]

    def _note(self, run: Run) -> str:
        return f"{self.label}, tolerance {run.tolerance:g}"


def curves(found: SceneFindings) -> tuple[Curve, ...]:
    """All curves of a scene, in the order of the grid."""
    groups: dict[tuple[object, ...], list[Row]] = {}
    for row in found.rows:
        groups.setdefault((row.run.variant, row.run.solver, row.run.max_step), []).append(row)
    return tuple(Curve(_label(found, rows[0].run), tuple(rows)) for rows in groups.values())


def _label(found: SceneFindings, run: Run) -> str:
    words: list[str] = [run.solver] if len(found.scene.knobs.get("solver", ())) > 1 else []
    if run.max_step is not None:
        words.append(f"step {run.max_step:g} s")
    variant = variant_text(run.variant, found.scene)
    return ", ".join([*words, variant])
