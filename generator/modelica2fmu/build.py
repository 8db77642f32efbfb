"""Builds an FMU from a Modelica model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from contact_foundation.progress import Progress, silent

from modelica2fmu.equations.blocks import Block, LinearBlock, NonlinearBlock
from modelica2fmu.expand.scalar_model import derivative_name
from modelica2fmu.fingerprint import fingerprint
from modelica2fmu.fmu_cache import FmuCache
from modelica2fmu.library.standard_library import StandardLibrary, find_standard_library
from modelica2fmu.options import BuildOptions
from modelica2fmu.packaging import package_fmu
from modelica2fmu.packaging.platforms import find_platforms
from modelica2fmu.phases import PhaseClock
from modelica2fmu.report import BuildReport, SolvedBlock
from modelica2fmu.source_places import SourcePlaces
from modelica2fmu.translation import Translation, check_model_name, translate

__all__ = ["BuildOptions", "BuildReport", "SolvedBlock", "Translation", "build_fmu", "translate"]


def build_fmu(
    model: str,
    sources: Sequence[Path],
    output: Path,
    options: BuildOptions | None = None,
    progress: Progress = silent,
) -> BuildReport:
    """Builds an FMU for model exchange and co-simulation.

    Args:
        model: full Modelica name.
        sources: Modelica files, or folders of packages; one holds the model, the others what it uses.
        output: the FMU to write; an existing file stays as it is if anything fails.
        options: see :class:`BuildOptions`.
        progress: told about phases.

    Raises:
        InputError: the model is wrong, or no Standard Library is found.
        UnsupportedModelError: the model uses a construct that is not translated.
        BuildError: a tool is missing or fails.
    """
    options = options or BuildOptions()
    library = find_standard_library(options.msl)
    if options.cache is None:
        return _build(model, sources, output, library, options, progress)
    check_model_name(model)
    cache = FmuCache(options.cache)
    key, places = fingerprint(model, sources, library, options), SourcePlaces.of(sources)
    report = cache.fetch(key, output, places)
    if report is None:
        report = _build(model, sources, output, library, options, progress)
        cache.store(key, report, places)
    # The same files may have been found in another place.
    return replace(report, library=library)


def _build(
    model: str,
    sources: Sequence[Path],
    output: Path,
    library: StandardLibrary,
    options: BuildOptions,
    progress: Progress,
) -> BuildReport:
    clock = PhaseClock(progress)
    translation = translate(model, sources, library, clock, options.outputs)
    package_fmu(
        translation.description,
        translation.generated.sources,
        output,
        version=options.fmi,
        platforms=find_platforms(options.platforms),
        options=options.solver,
        objects_folder=options.cache / "objects" if options.cache is not None else None,
        progress=clock,
    )
    clock.end()
    systems = translation.systems
    return BuildReport(
        fmu=output,
        model=model,
        fmi=options.fmi.value,
        library=library,
        states=tuple(systems.reduction.states),
        derivatives=tuple(derivative_name(name) for name in systems.reduction.states),
        equations=len(translation.scalar.equations),
        equations_left=len(translation.reduced.equations),
        differentiations=systems.reduction.differentiations,
        simulation_blocks=_solved(systems.simulation),
        initialization_blocks=_solved(systems.initialization),
        event_indicators=len(systems.model.relations),
        operations=translation.generated.operations,
        warnings=tuple(systems.warnings),
        timings=tuple(clock.timings.items()),
        files=translation.files,
    )


def _solved(blocks: Sequence[Block]) -> tuple[SolvedBlock, ...]:
    return tuple(
        SolvedBlock("linear" if isinstance(block, LinearBlock) else "nonlinear", block.size, block.torn)
        for block in blocks
        if isinstance(block, LinearBlock | NonlinearBlock)
    )
