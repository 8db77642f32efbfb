"""Building and running variants, and what is measured."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from contact_foundation.errors import CmbError
from contact_foundation.progress import Progress, silent
from fmu_regression.fmi.description import ModelDescription, read_description
from fmu_regression.results.result import SimulationResult, SolverCounters
from fmu_regression.simulate.simulation import simulate

from scene_effects.choices import Change
from scene_effects.difference import Difference, motion_difference
from scene_effects.manager import Manager, Parameters, find_manager, read_parameters
from scene_effects.observation import exact_distances, pair_signals
from scene_effects.variants import Variant, modification, write_variant


@dataclass(frozen=True)
class BuildFigures:
    """The size of a built model.

    Attributes:
        equations: scalar equations.
        states: continuous states.
        event_indicators: relations that generate events.
        systems: unknowns of each linear or nonlinear system that is solved in every evaluation.
        lines: of C in one evaluation of the derivatives.
    """

    equations: int
    states: int
    event_indicators: int
    systems: tuple[int, ...]
    lines: int


Builder = Callable[[str, Sequence[Path], Path], BuildFigures]
"""Builds the FMU of a model: (model, further sources, FMU to write)."""


@dataclass(frozen=True)
class RunOptions:
    """How variants are simulated; None leaves a choice to the model.

    Attributes:
        stop: stop time in s.
        tolerance: relative tolerance.
        interval: output interval in s.
        time_limit: wall time of each simulation in s.
    """

    stop: float | None = None
    tolerance: float | None = None
    interval: float | None = None
    time_limit: float | None = None


@dataclass(frozen=True)
class Measurement:
    """A variant and what it costs.

    Attributes:
        variant: which.
        modification: in Modelica, or "".
        build: size of the model, or None if it could not be built.
        counters: work of the solver, or None if it failed.
        wall_time: s of the simulation, or None.
        difference: from the variant it is compared with, or None where it is that one or failed.
        error: why it failed, or "".
        result: the simulation, or None.
    """

    variant: Variant
    modification: str
    build: BuildFigures | None = None
    counters: SolverCounters | None = None
    wall_time: float | None = None
    difference: Difference | None = None
    error: str = ""
    result: SimulationResult | None = None

    def against(self, manager: Manager, reference: Measurement) -> Measurement:
        """The same with the difference from another one."""
        if self.result is None or reference.result is None or self is reference:
            return self
        return replace(self, difference=motion_difference(manager, self.result, reference.result))


class Bench:
    """Builds and runs a model and variants of it; the same modification is measured once.

    Args:
        model: qualified name.
        build: builds FMUs.
        folder: an empty folder for what is built.
        manager: name of the manager, needed where the model has several.
        options: of the simulations.
        progress: told about the variants.

    Raises:
        CmbError: the model itself cannot be built or simulated, or has no manager.
    """

    def __init__(
        self,
        model: str,
        build: Builder,
        folder: Path,
        manager: str | None = None,
        options: RunOptions | None = None,
        progress: Progress = silent,
    ) -> None:
        self.model = model
        self._build = build
        self._folder = folder
        self._options = options or RunOptions()
        self._progress = progress
        fmu = folder / "AsModelled.fmu"
        figures = build(model, (), fmu)
        description = read_description(fmu)
        self.manager = find_manager(description, manager)
        self._experiment = description
        signals = self.manager.parameter_signals()
        result = self._simulate(fmu, description, signals)
        self.parameters: Parameters = read_parameters(self.manager, result)
        self.as_modelled = Measurement(
            Variant("as modelled", None), "", figures, result.counters, result.wall_time, result=result
        )
        self._done: dict[str, Measurement] = {"": self.as_modelled}

    def measure(self, variant: Variant) -> Measurement:
        """Builds and runs a variant; a failure is an outcome too."""
        text = modification(variant.change or Change(), self.manager, self.parameters)
        if text in self._done:
            return replace(self._done[text], variant=variant, modification=text)
        name = f"Variant{len(self._done)}Of{self.model.split('.')[-1]}"
        source, fmu = self._folder / f"{name}.mo", self._folder / f"{name}.fmu"
        write_variant(source, self.model, text)
        figures: BuildFigures | None = None
        try:
            figures = self._build(name, (source,), fmu)
            result = self._simulate(fmu, read_description(fmu), ())
            found = Measurement(variant, text, figures, result.counters, result.wall_time, result=result)
        except CmbError as error:
            found = Measurement(variant, text, figures, error=error.message.splitlines()[0])
        finally:
            fmu.unlink(missing_ok=True)
        self._done[text] = found
        return found

    def _simulate(self, fmu: Path, description: ModelDescription, signals: Sequence[str]) -> SimulationResult:
        """All variants run over the model's own experiment, which an extending model does not inherit."""
        options, own = self._options, self._experiment
        wanted = [*self.manager.motion_signals(), *pair_signals(self.manager, description), *signals]
        return simulate(
            fmu,
            signals=wanted,
            start=own.start,
            stop=options.stop if options.stop is not None else own.stop,
            tolerance=options.tolerance if options.tolerance is not None else own.tolerance,
            interval=options.interval if options.interval is not None else own.interval,
            parameters=exact_distances(self.manager, description),
            time_limit=options.time_limit,
            progress=self._progress,
        )
