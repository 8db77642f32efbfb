"""A study in sentences: what accuracy costs, what limits it, what failed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from accuracy_study.definition import Scene
from accuracy_study.grid import Run, Variant, value_text
from accuracy_study.knobs import KnobValue, Part, knob, part_of
from accuracy_study.pareto import cheapest_below, most_accurate
from accuracy_study.study import Findings, Row, SceneFindings

_LEVELS = tuple(10.0**-k for k in range(1, 13))
_TOLD = 4
_MATTERS = 2.0
"""A part limits a run if it is this many times larger than what the solver errs."""


def study_sentences(findings: Findings) -> list[str]:
    """Some sentences a scene, each beginning with its name."""
    return [f"{found.scene.name}: {' '.join(scene_sentences(found))}" for found in findings.scenes]


def scene_sentences(found: SceneFindings) -> list[str]:
    """What a scene's runs say."""
    best = most_accurate(found.rows)
    failures = [row for row in found.rows if row.outcome.failure]
    sentences = []
    if best is not None:
        sentences = [_costs(found), _limit(found, best), *_knobs(found)]
    if failures:
        reason, count = Counter(row.outcome.failure for row in failures).most_common(1)[0]
        often = "" if count == len(failures) else f", {count} of them"
        sentences.append(f"{len(failures)} of {len(found.rows)} runs failed{often}: {reason.rstrip('.')}.")
    return [sentence for sentence in sentences if sentence]


def run_text(run: Run, scene: Scene) -> str:
    """A run in words, e.g. "me, tolerance 1e-06, stiffness 1e6"; knobs with one value are left out."""
    words = [run.solver, f"tolerance {run.tolerance:g}"]
    if run.max_step is not None:
        words.append(f"longest step {run.max_step:g} s")
    if any(value != scene.knobs[name][0] for name, value in run.variant.settings):
        words.append(variant_text(run.variant, scene))
    return ", ".join(words)


def variant_text(variant: Variant, scene: Scene) -> str:
    """What differs in a variant from the first value of every knob, in words; "base" if nothing does."""
    words = [f"{label(n)} {value_text(v)}" for n, v in variant.settings if v != scene.knobs[n][0]]
    return ", ".join(words) or "base"


def label(name: str) -> str:
    """A knob in words."""
    found = knob(name)
    return found.label if found is not None else name


def milliseconds(row: Row) -> str:
    """The processor time of a run in words."""
    time = row.outcome.cpu_time or 0.0
    return f"{time:.2g} s" if time >= 0.1 else f"{1000 * time:.2g} ms"


def _costs(found: SceneFindings) -> str:
    """What it costs to err less than powers of ten, where the price changes."""
    steps: list[tuple[float, Row]] = []
    for level in _LEVELS:
        row = cheapest_below(found.rows, level)
        if row is None:
            break
        if steps and steps[-1][1] is row:
            steps[-1] = level, row
        else:
            steps.append((level, row))
    if not steps:
        return "No run errs less than 10 % of the scale."
    kept = steps if len(steps) <= _TOLD else [steps[round(k * (len(steps) - 1) / (_TOLD - 1))] for k in range(_TOLD)]
    told = [f"{_level(level)} costs {milliseconds(row)} ({run_text(row.run, found.scene)})" for level, row in kept]
    return f"An error below {'; below '.join(told)}."


def _limit(found: SceneFindings, best: Row) -> str:
    """What the most accurate run is limited by."""
    errors = found.errors[best.run.variant]
    solver = best.outcome.solver_error
    parts = {Part.SOLVER: solver, Part.GEOMETRY: errors.geometry, Part.MODEL: errors.model}
    known = {part: value for part, value in parts.items() if value is not None}
    text = f"The least error is {best.outcome.error:.1e}"
    if len(known) < len(parts):
        return f"{text}; what limits it cannot be told, as a tight trajectory is missing."
    largest = max(known, key=lambda part: known[part])
    shares = ", ".join(f"{part.value} {value:.1e}" for part, value in known.items())
    if largest is Part.SOLVER or known[largest] < _MATTERS * known[Part.SOLVER]:
        return f"{text} ({shares}): what limits you is the solver."
    name = _most_telling(found, best.run.variant, largest)
    what = f"the {label(name)}" if name else f"the {largest.value}"
    return f"{text} ({shares}): what limits you is {what}, not the solver."


def _most_telling(found: SceneFindings, variant: Variant, part: Part) -> str:
    """The knob of a part whose values, with all else as in a variant, differ most in their errors; "" if none does."""
    spreads = {name: _spread(found, variant, name) for name, _ in variant.settings if part_of(name) is part}
    best = max(spreads, key=lambda name: spreads[name], default="")
    return best if best and spreads[best] > _MATTERS else ""


def _spread(found: SceneFindings, variant: Variant, name: str) -> float:
    """How the errors of a knob's values differ; of words, how much better another one than the variant's would be."""
    pairs = _errors_over(found, variant, name)
    values = [error for _, error in pairs]
    if len(values) < 2:
        return 1.0
    own = dict(variant.settings)[name]
    worst = next((error for value, error in pairs if value == own), 0.0) if isinstance(own, str) else max(values)
    return worst / max(min(values), 1e-300)


def _errors_over(found: SceneFindings, variant: Variant, name: str) -> list[tuple[KnobValue, float]]:
    """Values of a knob, with all else as in a variant, and the error that the solver has no part in."""
    part = part_of(name)
    pairs = []
    for value in found.scene.knobs[name]:
        errors = found.errors.get(variant.changed(name, value))
        error = None if errors is None else errors.geometry if part is Part.GEOMETRY else errors.model
        if error is not None:
            pairs.append((value, error))
    return pairs


def _knobs(found: SceneFindings) -> Iterator[str]:
    """For each knob of model and geometry: what its values err by, all else as in the first variant."""
    base = next(iter(found.errors))
    for name, _ in base.settings:
        pairs = _errors_over(found, base, name)
        if len(pairs) > 1:
            part = part_of(name).value
            told = ", ".join(f"{value_text(value)}: {error:.1e}" for value, error in pairs)
            yield f"{label(name)[:1].upper()}{label(name)[1:]}, {part} error: {told}."


def _level(level: float) -> str:
    return f"{level:.0e}"
