"""Builds an FMU from a Modelica model."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from cmb_base.errors import InputError, Place
from cmb_base.progress import Progress, silent

from modelica2fmu import expression as ex
from modelica2fmu.alias import ReducedModel, eliminate_aliases
from modelica2fmu.blocks import Block, LinearBlock, NonlinearBlock
from modelica2fmu.code_generation import GeneratedModel, generate
from modelica2fmu.description import DefaultExperiment, ModelDescription
from modelica2fmu.experiment import read_experiment
from modelica2fmu.external_code import find_external_code
from modelica2fmu.front_end import load_flat_model
from modelica2fmu.packaging import SolverOptions, package_fmu
from modelica2fmu.scalar_model import ScalarModel, derivative_name
from modelica2fmu.scalarize import scalarize
from modelica2fmu.source_map import SourceMap
from modelica2fmu.standard_library import StandardLibrary, find_standard_library, other_libraries
from modelica2fmu.systems import Systems, build_systems
from modelica2fmu.variables import describe_enumerations, describe_variables

_MODEL_NAME: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(\.[A-Za-z_][A-Za-z0-9_]*)*")
_RECURSION_LIMIT: Final = 20_000


@dataclass(frozen=True)
class BuildOptions:
    """What can be chosen about a build.

    Attributes:
        msl: folder of the Modelica Standard Library; ``None`` to look for it.
        solver: defaults of the co-simulation integrator.
    """

    msl: Path | None = None
    solver: SolverOptions = field(default_factory=SolverOptions)


@dataclass(frozen=True)
class SolvedBlock:
    """A block that is solved numerically: its unknowns before and after tearing."""

    kind: str
    size: int
    torn: tuple[str, ...]


@dataclass(frozen=True)
class BuildReport:
    """What was built, and how.

    Attributes:
        fmu: the file.
        model: full Modelica name.
        library: the Standard Library that was used.
        states: chosen states, in order.
        derivatives: their derivatives.
        equations: scalar equations of the flat model.
        equations_left: those left without trivial ones.
        differentiations: differentiations of the index reduction.
        simulation_blocks: numerically solved blocks while simulating.
        initialization_blocks: the same at initialization.
        event_indicators: number of relations that generate events.
        operations: lines of C of one evaluation of the derivatives.
        warnings: assumptions the user should know of.
        timings: seconds by phase.
    """

    fmu: Path
    model: str
    library: StandardLibrary
    states: tuple[str, ...]
    derivatives: tuple[str, ...]
    equations: int
    equations_left: int
    differentiations: int
    simulation_blocks: tuple[SolvedBlock, ...]
    initialization_blocks: tuple[SolvedBlock, ...]
    event_indicators: int
    operations: int
    warnings: tuple[str, ...]
    timings: tuple[tuple[str, float], ...]

    def text(self) -> str:
        """The report as readable lines."""
        lines = [
            f"model               {self.model}",
            f"standard library    {self.library.version or 'unknown version'} ({self.library.origin}, "
            f"{self.library.folder})",
            f"scalar equations    {self.equations}, without trivial ones {self.equations_left}",
            f"index reduction     {self.differentiations} differentiations",
            f"states              {len(self.states)}: {', '.join(self.states)}",
            f"event indicators    {self.event_indicators}",
            f"generated code      {self.operations} lines an evaluation",
        ]
        for title, blocks in (
            ("solved blocks", self.simulation_blocks),
            ("at initialization", self.initialization_blocks),
        ):
            lines.append(f"{title:<19} {len(blocks)}")
            for block in blocks:
                names = ", ".join(block.torn[:4]) + (", ..." if len(block.torn) > 4 else "")
                lines.append(f"  {block.kind:<9} {block.size:4d} unknowns, torn to {len(block.torn):2d}: {names}")
        lines.extend(f"warning: {warning}" for warning in self.warnings)
        lines.append("seconds             " + ", ".join(f"{name} {value:.2f}" for name, value in self.timings))
        return "\n".join(lines)


class _Clock:
    """Times phases and reports their beginning."""

    def __init__(self, progress: Progress) -> None:
        self._progress = progress
        self._start = time.perf_counter()
        self._phase = ""
        self.timings: list[tuple[str, float]] = []

    def phase(self, name: str, fraction: float) -> None:
        now = time.perf_counter()
        if self._phase:
            self.timings.append((self._phase, now - self._start))
        self._phase, self._start = name, now
        if name:
            self._progress(name, fraction)


@dataclass(frozen=True)
class Translation:
    """The intermediate results of a translation, for the report and for tests."""

    scalar: ScalarModel
    reduced: ReducedModel
    systems: Systems
    generated: GeneratedModel
    description: ModelDescription


def build_fmu(
    model: str,
    sources: Sequence[Path],
    output: Path,
    options: BuildOptions | None = None,
    progress: Progress = silent,
) -> BuildReport:
    """Builds an FMU 2.0 for model exchange and co-simulation.

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
    clock = _Clock(progress)
    clock.phase("load", 0.0)
    library = find_standard_library(options.msl)
    translation = translate(model, sources, library, clock)
    clock.phase("compile", 0.6)
    package_fmu(
        translation.description, translation.generated.sources, output, options=options.solver, progress=progress
    )
    clock.phase("", 1.0)
    systems = translation.systems
    return BuildReport(
        fmu=output,
        model=model,
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
        timings=tuple(clock.timings),
    )


def translate(
    model: str, sources: Sequence[Path], library: StandardLibrary, clock: _Clock | None = None
) -> Translation:
    """Everything up to the C; see :func:`build_fmu`."""
    clock = clock or _Clock(silent)
    if not _MODEL_NAME.fullmatch(model):
        raise InputError(f"{model!r} is no name of a Modelica class")
    file, roots = locate(model, sources)
    roots = [*roots, library.folder, *other_libraries()]
    source_map = SourceMap([file, *sources, library.folder])
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, _RECURSION_LIMIT))
    try:
        ex.new_graph()
        flat = load_flat_model(model, file, roots, source_map)
        clock.phase("expand", 0.2)
        scalar = scalarize(flat, source_map)
        clock.phase("reduce", 0.3)
        reduced = eliminate_aliases(scalar, source_map)
        clock.phase("sort", 0.4)
        systems = build_systems(reduced, source_map.place)
        clock.phase("generate", 0.5)
        external = find_external_code(scalar.external_annotations, roots, model.split(".")[0])
        generated = generate(reduced, systems, external.includes, source_map.place)
    finally:
        sys.setrecursionlimit(limit)
    states = tuple(systems.reduction.states)
    description = ModelDescription(
        name=model,
        identifier=model.replace(".", "_"),
        guid=generated.guid,
        variables=describe_variables(reduced, generated.slots, states),
        states=states,
        derivatives=tuple(derivative_name(name) for name in states),
        outputs=tuple(name for name, variable in reduced.model.variables.items() if variable.is_output),
        indicator_count=len(systems.model.relations),
        description=flat.description,
        enumerations=describe_enumerations(reduced),
        experiment=_experiment(model, sources),
        external=external,
    )
    return Translation(scalar, reduced, systems, generated, description)


def _experiment(model: str, sources: Sequence[Path]) -> DefaultExperiment:
    return read_experiment(model, sources)


def locate(model: str, sources: Sequence[Path]) -> tuple[Path, list[Path]]:
    """The file to load for ``model`` and the folders that contain the packages of ``sources``.

    Raises:
        InputError: a source does not exist, or none holds the model's package.
    """
    package = model.split(".")[0]
    file: Path | None = None
    roots: dict[Path, None] = {}
    for source in sources:
        if not source.exists():
            raise InputError("this source does not exist", place=Place(file=source))
        path = source.parent if source.name == "package.mo" else source
        if path.is_dir():
            inner = path if (path / "package.mo").is_file() else path / package
            if inner.name == package and (inner / "package.mo").is_file():
                file = file or inner / "package.mo"
            # The package's own folder: a front end may read every Modelica file below a root.
            roots[inner if (inner / "package.mo").is_file() else path] = None
        elif path.suffix == ".mo":
            if path.stem == package or _declares(path, package):
                file = file or path
            else:
                roots[path.parent] = None
        else:
            raise InputError("a source is a .mo file or a folder of a package", place=Place(file=source))
    if file is None:
        names = ", ".join(str(source) for source in sources)
        raise InputError(
            f"no source holds {package}, of which {model} is a part", remedy=f"these were given: {names or 'none'}"
        )
    return file.resolve(), [root.resolve() for root in roots]


def _declares(file: Path, name: str) -> bool:
    pattern = re.compile(rf"^\s*(?:encapsulated\s+)?(?:package|model|block|class)\s+{re.escape(name)}\b", re.MULTILINE)
    return pattern.search(file.read_text(encoding="utf-8", errors="replace")) is not None


def _solved(blocks: Sequence[Block]) -> tuple[SolvedBlock, ...]:
    return tuple(
        SolvedBlock("linear" if isinstance(block, LinearBlock) else "nonlinear", block.size, block.torn)
        for block in blocks
        if isinstance(block, LinearBlock | NonlinearBlock)
    )
