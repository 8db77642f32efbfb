"""An FMU from a model's description and its generated C."""

from __future__ import annotations

import re
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path, PurePosixPath

from contact_foundation.errors import InputError, Place
from contact_foundation.output import whole_file
from contact_foundation.progress import Progress, silent

from modelica2fmu.codegen.generated_source import GeneratedSource
from modelica2fmu.description.model_description import ModelDescription
from modelica2fmu.packaging.archive import write_archive
from modelica2fmu.packaging.dependencies import Sundials, find_fmi_headers, find_sundials
from modelica2fmu.packaging.documentation import documentation_page
from modelica2fmu.packaging.interface_tables import interface_source
from modelica2fmu.packaging.layout import LAYOUTS, FmiVersion, Layout
from modelica2fmu.packaging.object_store import ObjectStore
from modelica2fmu.packaging.runtime_sources import runtime_files, runtime_folders
from modelica2fmu.packaging.shared_libraries import bundle_libraries, copy_modules, licence_of
from modelica2fmu.packaging.solver_variables import SolverOptions, with_solver_variables
from modelica2fmu.packaging.source_folder import EXTERNAL_HEADERS, cmake_project, copy_headers
from modelica2fmu.packaging.toolchain import DEPENDENCIES, Compilation, Libraries, compile_objects, link_shared

INTERFACE_FILE = "fmurt_interface.c"

_RUNTIME_FLAGS = ("-Wall", "-Wextra")
_GENERATED_FLAGS = ("-O1",)  # long straight-line code gains nothing from -O2 and takes twice as long to compile
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
    other_versions = {other.functions for other in LAYOUTS.values()} - {layout.functions}
    for path in runtime_files():
        if path.name not in other_versions:
            shutil.copyfile(path, folder / path.name)
    (folder / INTERFACE_FILE).write_text(interface_source(description, options), encoding="utf-8")
    for source in sources:
        (folder / source.name).write_text(source.text, encoding="utf-8")
    (folder / "CMakeLists.txt").write_text(cmake_project(description), encoding="utf-8")


def _compilations(
    folder: Path, description: ModelDescription, sources: Sequence[GeneratedSource], sundials: Sundials
) -> list[Compilation]:
    generated = {source.name for source in sources}
    headers = (folder, find_fmi_headers())
    external = description.external.include_directories
    return [
        Compilation(path, (folder, *external), _GENERATED_FLAGS)
        if path.name in generated
        else Compilation(path, (*headers, sundials.include), _RUNTIME_FLAGS, common=path.name != INTERFACE_FILE)
        for path in sorted(folder.glob("*.c"))
    ]


def _kept_objects(folder: Path | None, sundials: Sundials) -> ObjectStore | None:
    if folder is None:
        return None
    return ObjectStore(
        folder, (*runtime_folders(), find_fmi_headers(), sundials.include / "sundials" / "sundials_config.h")
    )


def _copy_licences(folder: Path, sundials: Sundials, bundled: dict[str, Path]) -> None:
    licences = {"sundials": sundials.licence} | {name: licence_of(name, origin) for name, origin in bundled.items()}
    for name, licence in licences.items():
        if licence is not None:
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(licence, folder / f"{name}.txt")


def _copy_resources(folder: Path, description: ModelDescription) -> None:
    folder.mkdir()
    for resource in description.resources:
        target = folder / resource.target
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(resource.source, target)


def package_fmu(
    description: ModelDescription,
    sources: Sequence[GeneratedSource],
    output: Path,
    *,
    version: FmiVersion = FmiVersion.FMI2,
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
    sundials = find_sundials()
    with tempfile.TemporaryDirectory(prefix="cmb-fmu-") as name:
        scratch = Path(name)
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

        progress("compile", 0.1)
        objects = scratch / "objects"
        objects.mkdir()
        kept = _kept_objects(objects_folder, sundials)
        compiled = compile_objects(_compilations(root / "sources", description, sources, sundials), objects, kept)
        copy_headers(
            (path.with_suffix(DEPENDENCIES) for path in compiled),
            (find_fmi_headers(), *description.external.include_directories),
            sundials.include,
            root / "sources" / EXTERNAL_HEADERS,
        )

        progress("link", 0.8)
        binaries = root / "binaries" / layout.platform
        binaries.mkdir(parents=True)
        library = binaries / f"{description.identifier}.so"
        external = description.external
        link_shared(
            compiled, Libraries((sundials.archive,), external.libraries, external.library_directories), library, scratch
        )
        modules = copy_modules(external.modules, external.library_directories, binaries)
        bundled = bundle_libraries([library, *modules], external.library_directories)
        _copy_licences(documentation / "licenses", sundials, bundled)

        progress("pack", 0.9)
        with whole_file(output) as staging:
            write_archive(root, staging)
    progress("pack", 1.0)
    return output
