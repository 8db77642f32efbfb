"""An FMU from a model's description and its generated C."""

from __future__ import annotations

import re
import shutil
from collections.abc import Sequence
from pathlib import Path, PurePosixPath

from contact_foundation.errors import InputError, Place
from contact_foundation.output import whole_file
from contact_foundation.progress import Progress, silent
from contact_foundation.scratch import scratch_folder

from modelica2fmu.codegen.generated_source import GeneratedSource
from modelica2fmu.description.model_description import ModelDescription
from modelica2fmu.packaging.archive import write_archive
from modelica2fmu.packaging.binary import BinarySources, build_binary, copy_licences
from modelica2fmu.packaging.dependencies import find_fmi_headers, find_sundials
from modelica2fmu.packaging.documentation import documentation_page
from modelica2fmu.packaging.interface_tables import interface_source
from modelica2fmu.packaging.layout import LAYOUTS, FmiVersion, Layout
from modelica2fmu.packaging.platforms import LINUX64, Platform
from modelica2fmu.packaging.runtime_sources import runtime_files
from modelica2fmu.packaging.solver_variables import SolverOptions, with_solver_variables
from modelica2fmu.packaging.source_folder import EXTERNAL_HEADERS, cmake_project, copy_headers

INTERFACE_FILE = "fmurt_interface.c"
_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_FILE_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*")


def _check_names(description: ModelDescription, sources: Sequence[GeneratedSource]) -> None:
    place = Place(component=description.name)
    if not _IDENTIFIER.fullmatch(description.identifier):
        raise InputError(f"{description.identifier!r} is no C identifier", place=place)
    runtime = {path.name for path in runtime_files()} | {INTERFACE_FILE}
    names = [source.name for source in sources]
    for name in names:
        if not _FILE_NAME.fullmatch(name) or not name.endswith((".c", ".h")):
            raise InputError(f"{name!r} is no name for a generated C file", place=place)
        if name in runtime or names.count(name) > 1:
            raise InputError(f"two source files would be called {name}", place=place)
    for resource in description.resources:
        target = PurePosixPath(resource.target)
        if target.is_absolute() or ".." in target.parts or not target.parts or "\\" in resource.target:
            raise InputError(f"the resource name {resource.target!r} leaves the folder of the FMU", place=place)
        if not resource.source.is_file():
            raise InputError("this resource is not a file", place=Place(file=resource.source))


def _write_sources(
    folder: Path,
    description: ModelDescription,
    sources: Sequence[GeneratedSource],
    options: SolverOptions,
    layout: Layout,
) -> None:
    folder.mkdir()
    other_versions = tuple(other.prefix for other in LAYOUTS.values() if other.prefix != layout.prefix)
    for path in runtime_files():
        if not path.name.startswith(other_versions):
            shutil.copyfile(path, folder / path.name)
    (folder / INTERFACE_FILE).write_text(interface_source(description, options), encoding="utf-8")
    for source in sources:
        (folder / source.name).write_text(source.text, encoding="utf-8")
    (folder / "CMakeLists.txt").write_text(cmake_project(description), encoding="utf-8")


def _copy_resources(folder: Path, description: ModelDescription) -> None:
    folder.mkdir()
    for resource in description.resources:
        target = folder / resource.target
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(resource.source, target)


def _build_binaries(
    root: Path,
    scratch: Path,
    platforms: Sequence[Platform],
    description: ModelDescription,
    generated: frozenset[str],
    objects_folder: Path | None,
    layout: Layout,
    progress: Progress,
) -> None:
    folder = root / "sources"
    external = description.external
    sources = BinarySources(folder, generated, INTERFACE_FILE, external, objects_folder)
    for number, platform in enumerate(platforms):
        progress("compile", 0.1 + 0.8 * number / len(platforms))
        target = root / "binaries" / layout.platform(platform) / f"{description.identifier}{platform.suffix}"
        target.parent.mkdir(parents=True)
        objects = scratch / platform.name
        objects.mkdir()
        sundials = find_sundials(platform)
        binary = build_binary(platform, sources, sundials, target, objects)
        copy_licences(binary.licences, root / "documentation" / "licenses")
        headers = (find_fmi_headers(), *external.include_directories)
        copy_headers(binary.dependencies, headers, sundials.include, folder / EXTERNAL_HEADERS)


def package_fmu(
    description: ModelDescription,
    sources: Sequence[GeneratedSource],
    output: Path,
    *,
    version: FmiVersion = FmiVersion.FMI2,
    platforms: Sequence[Platform] = (LINUX64,),
    options: SolverOptions | None = None,
    objects_folder: Path | None = None,
    progress: Progress = silent,
) -> Path:
    """Compiles a generated model with the runtime and packs an FMU (model exchange and co-simulation).

    Args:
        description: what modelDescription.xml says, and the external libraries.
        sources: generated C; one of the files defines ``fmurt_model`` with ``description.guid`` in it.
        output: the FMU file to write, replaced if it exists; on errors it stays as it is.
        version: of the FMI standard.
        platforms: what it holds binaries for, each once.
        options: defaults of the co-simulation integrator.
        objects_folder: where objects of the runtime are kept between builds; None to compile them.
        progress: told about the phases.

    Returns:
        ``output``.

    Raises:
        InputError: the description contradicts itself or names files that leave the FMU's folder.
        BuildError: compiler or linker failed, or something they need is not installed.
    """
    options = options if options is not None else SolverOptions()
    _check_names(description, sources)
    layout = LAYOUTS[version]
    described = with_solver_variables(description, options)
    generated = frozenset(source.name for source in sources)
    with scratch_folder("fmu") as scratch:
        root = scratch / "fmu"
        root.mkdir()
        progress("describe", 0.0)
        (root / "modelDescription.xml").write_bytes(layout.describe(described))
        _write_sources(root / "sources", described, sources, options, layout)
        layout.complete(description, root)
        documentation = root / "documentation"
        documentation.mkdir()
        (documentation / "index.html").write_text(documentation_page(described), encoding="utf-8")
        _copy_resources(root / "resources", description)

        _build_binaries(root, scratch, platforms, description, generated, objects_folder, layout, progress)

        progress("pack", 0.9)
        with whole_file(output) as staging:
            write_archive(root, staging)
    progress("pack", 1.0)
    return output
