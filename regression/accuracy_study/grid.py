"""The grid of a study: every run of it, in the order of the file."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_regression.fmi.binding import Mode

from accuracy_study.definition import ONE_AT_A_TIME, Scene, Study
from accuracy_study.knobs import AS_MODELLED, SOLVERS, KnobValue, Part, part_of

_PLAIN = (1e-3, 1e4)
"""Numbers from the first to below the second are written without a power of ten."""


@dataclass(frozen=True)
class Variant:
    """A scene with chosen knobs of model and geometry: (name, value), by the order of the file."""

    settings: tuple[tuple[str, KnobValue], ...]

    def changed(self, name: str, value: KnobValue) -> Variant:
        """The variant with another value of one knob."""
        return Variant(tuple((n, value if n == name else v) for n, v in self.settings))

    @property
    def label(self) -> str:
        """For tables, e.g. "stiffness 1e6, friction Anchored"; knobs as modelled are left out."""
        words = [f"{n} {value_text(v)}" for n, v in self.settings if v != AS_MODELLED]
        return ", ".join(words) or AS_MODELLED


@dataclass(frozen=True)
class Run:
    """One run of the grid; ``max_step`` in s, None: the solver's own choice."""

    scene: Scene
    variant: Variant
    solver: Mode
    tolerance: float
    max_step: float | None


def value_text(value: KnobValue) -> str:
    """A value of a knob in tables, e.g. "1e5", "0.02" or "Anchored"."""
    if isinstance(value, str):
        return value
    if value == 0 or _PLAIN[0] <= abs(value) < _PLAIN[1]:
        return f"{value:g}"
    digits, power = f"{value:.5e}".split("e")
    return f"{digits.rstrip('0').rstrip('.')}e{int(power)}"


def base_variant(scene: Scene) -> Variant:
    """The first value of every knob of model and geometry."""
    return Variant(tuple((name, values[0]) for name, values in scene.knobs.items() if part_of(name) is not Part.SOLVER))


def base_geometry(scene: Scene, variant: Variant) -> Variant:
    """A variant with the first value of every knob of geometry."""
    for name, _ in variant.settings:
        if part_of(name) is Part.GEOMETRY:
            variant = variant.changed(name, scene.knobs[name][0])
    return variant


def variants(study: Study, scene: Scene) -> tuple[Variant, ...]:
    """Every variant of a scene, the base first, and with each that of its model with the base geometry."""
    base = base_variant(scene)
    if study.grid == ONE_AT_A_TIME:
        found = [base]
        for name, _ in base.settings:
            found += [base.changed(name, value) for value in scene.knobs[name][1:]]
        return tuple(found)
    names = [name for name, _ in base.settings]
    every = itertools.product(*(scene.knobs[name] for name in names))
    return tuple(Variant(tuple(zip(names, values, strict=True))) for values in every)


def runs(study: Study, scene: Scene) -> tuple[Run, ...]:
    """Every run of a scene: each variant with each solver, longest step and tolerance, from loose to tight."""
    solvers: Sequence[Mode] = [mode for mode in scene.knobs.get("solver", ("me",)) if mode in SOLVERS]  # type: ignore[misc]
    steps = [None if s == AS_MODELLED else float(s) for s in scene.knobs.get("max_step", (AS_MODELLED,))]
    tolerances = sorted((float(t) for t in scene.knobs["tolerance"]), reverse=True)
    return tuple(
        Run(scene, variant, solver, tolerance, step)
        for variant in variants(study, scene)
        for solver in solvers
        for step in steps
        for tolerance in tolerances
    )
