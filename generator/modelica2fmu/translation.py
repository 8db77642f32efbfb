"""From a Modelica model to generated C and what the FMU says about it."""

from __future__ import annotations

import re
import sys
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError

from modelica2fmu.codegen.code_generation import GeneratedModel, generate
from modelica2fmu.description.icon_rendering import icon_png
from modelica2fmu.description.model_description import ModelDescription
from modelica2fmu.description.variables import describe_enumerations, describe_variables, internal_parameters
from modelica2fmu.equations.alias import ReducedModel, eliminate_aliases
from modelica2fmu.equations.systems import Systems, build_systems
from modelica2fmu.expand.backend_modules import chosen_modules
from modelica2fmu.expand.geometry_files import write_out_geometry
from modelica2fmu.expand.scalar_model import ScalarModel, derivative_name
from modelica2fmu.expand.scalarize import scalarize
from modelica2fmu.frontend.loading import load_flat_model
from modelica2fmu.garbage import collection_paused
from modelica2fmu.library.cache_pruning import pruned_after_use
from modelica2fmu.library.experiment import read_experiment
from modelica2fmu.library.external_code import ExternalCode, find_external_code
from modelica2fmu.library.library_repairs import repaired_library, views_folder
from modelica2fmu.library.named_files import NamedFiles
from modelica2fmu.library.source_map import SourceMap
from modelica2fmu.library.sources import locate
from modelica2fmu.library.standard_library import StandardLibrary, other_libraries, told_of_the_core_subset
from modelica2fmu.packaging.platforms import LINUX64
from modelica2fmu.phases import PhaseClock
from modelica2fmu.scene.energies import add_energies
from modelica2fmu.scene.mechanism import find_mechanism, pair_thicknesses
from modelica2fmu.scene.outputs import OutputGroup, with_outputs
from modelica2fmu.symbolic import expression as ex

_MODEL_NAME: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(\.[A-Za-z_][A-Za-z0-9_]*)*")
_RECURSION_LIMIT: Final = 20_000


@dataclass(frozen=True)
class Translation:
    """The intermediate results of a translation, for the report and for tests."""

    scalar: ScalarModel
    reduced: ReducedModel
    systems: Systems
    generated: GeneratedModel
    description: ModelDescription
    files: tuple[Path, ...] = ()
    """That the model names, and the generated code holds."""


def check_model_name(model: str) -> None:
    """Raises InputError if a text is no name of a Modelica class."""
    if not _MODEL_NAME.fullmatch(model):
        raise InputError(f"{model!r} is no name of a Modelica class")


def translate(
    model: str,
    sources: Sequence[Path],
    library: StandardLibrary,
    clock: PhaseClock | None = None,
    outputs: Collection[OutputGroup] = (),
) -> Translation:
    """Everything up to the C; see :func:`modelica2fmu.build.build_fmu`."""
    check_model_name(model)
    with collection_paused():
        return _translate(model, sources, library, clock or PhaseClock(), outputs)


def _translate(
    model: str,
    sources: Sequence[Path],
    library: StandardLibrary,
    clock: PhaseClock,
    outputs: Collection[OutputGroup],
) -> Translation:
    clock.begin("load")
    file, found = locate(model, sources)
    source_map = SourceMap([file, *sources, library.folder])
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, _RECURSION_LIMIT))
    try:
        with library.root() as original, pruned_after_use(views_folder()):
            library_root = repaired_library(original, source_map)
            file = _shown(file, original, library_root)
            roots = [*(_shown(root, original, library_root) for root in found), library_root, *other_libraries()]
            ex.new_graph()
            with told_of_the_core_subset(library):
                files = NamedFiles(roots, file)
                flat = load_flat_model(model, file, roots, source_map, clock.remark, files.find)
            clock.begin("expand")
            scalar = scalarize(flat, source_map, files.find)
            if OutputGroup.ENERGIES in outputs:
                add_energies(scalar, find_mechanism(scalar.variables))
            external = _with_real_paths(find_external_code(scalar.external_annotations, roots, model.split(".")[0]))
            external = replace(external, modules=chosen_modules(scalar.calls))
            icon = icon_png(model, [*sources, *roots])
            engines = LINUX64.searched(external.library_directories)
            scalar.calls[:] = write_out_geometry(scalar.calls, engines, files.find)
        clock.begin("reduce")
        reduced = eliminate_aliases(scalar, source_map)
        clock.begin("sort")
        systems = build_systems(reduced, source_map.place)
        if flat.refusal is not None:
            raise flat.refusal
        clock.begin("generate")
        generated = generate(reduced, systems, external.includes, source_map.place, pair_thicknesses(scalar.variables))
    finally:
        sys.setrecursionlimit(limit)
    states = tuple(systems.reduction.states)
    description = ModelDescription(
        name=model,
        identifier=model.replace(".", "_"),
        guid=generated.guid,
        variables=describe_variables(reduced, generated.slots, states, systems.integrated),
        states=states,
        derivatives=tuple(derivative_name(name) for name in states),
        outputs=tuple(name for name, variable in reduced.model.variables.items() if variable.is_output),
        indicator_count=len(systems.model.relations) + generated.watches_passages,
        description=flat.description,
        enumerations=describe_enumerations(reduced),
        experiment=read_experiment(model, sources),
        external=external,
        internal_parameters=internal_parameters(reduced, generated.slots),
        needs_completed_steps=generated.needs_completed_steps,
        icon=icon,
    )
    return Translation(scalar, reduced, systems, generated, with_outputs(description, outputs), files.found)


def _shown(path: Path, original: Path, view: Path) -> Path:
    """Where a file or folder of the library is seen in its repaired form; others stay as they are."""
    base = original.resolve()
    return view / path.resolve().relative_to(base) if path.resolve().is_relative_to(base) else path


def _with_real_paths(external: ExternalCode) -> ExternalCode:
    """The same folders without symbolic links, which may not last as long as the build."""
    return replace(
        external,
        include_directories=tuple(path.resolve() for path in external.include_directories),
        library_directories=tuple(path.resolve() for path in external.library_directories),
    )
