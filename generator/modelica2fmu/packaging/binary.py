"""The binary of an FMU for one platform."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import BuildError

from modelica2fmu.library.external_code import ExternalCode
from modelica2fmu.packaging.dependencies import Sundials, find_fmi_headers
from modelica2fmu.packaging.object_store import ObjectStore
from modelica2fmu.packaging.platforms import Platform
from modelica2fmu.packaging.runtime_sources import runtime_folders
from modelica2fmu.packaging.shared_libraries import bundle_libraries, copy_modules, licence_of, refuse_other_libraries
from modelica2fmu.packaging.toolchain import DEPENDENCIES, Compilation, Libraries, compile_objects, link_shared

_RUNTIME_FLAGS = ("-Wall", "-Wextra")
_GENERATED_FLAGS = ("-O1",)  # long straight-line code gains nothing from -O2 and takes twice as long to compile


@dataclass(frozen=True)
class BinarySources:
    """What a binary is made from, whatever the platform.

    Attributes:
        folder: with all C files and headers.
        generated: names of the files that are not the runtime's.
        own: the runtime's file that is this FMU's own.
        external: code and libraries of the model.
        objects_folder: where objects of the runtime are kept between builds; None to compile them.
    """

    folder: Path
    generated: frozenset[str]
    own: str
    external: ExternalCode
    objects_folder: Path | None = None


@dataclass(frozen=True)
class Binary:
    """A binary that was built.

    Attributes:
        dependencies: files that say what each source includes.
        licences: texts of what it brings along, by name.
    """

    dependencies: tuple[Path, ...]
    licences: dict[str, Path]


def build_binary(platform: Platform, sources: BinarySources, sundials: Sundials, target: Path, scratch: Path) -> Binary:
    """Compiles and links a binary, with the shared libraries that it needs and loads beside it.

    Args:
        platform: what to build for.
        sources: what to build from.
        sundials: the platform's CVODE.
        target: the binary, in an existing folder.
        scratch: existing folder for what is made on the way.

    Raises:
        BuildError: compiler or linker failed, or something they need is not installed.
    """
    external = sources.external
    directories = platform.searched(external.library_directories)
    if not platform.is_host and external.modules:
        raise BuildError(
            f"there is no {external.modules[0]} for {platform.name}",
            remedy="Choose the back end Automatic in the model.",
        )
    compiled = compile_objects(
        _compilations(sources, sundials), scratch, _kept_objects(sources, sundials, platform), platform
    )
    link_shared(compiled, Libraries((sundials.archive,), external.libraries, directories), target, scratch, platform)
    bundled: dict[str, Path] = {}
    if platform.is_host:
        modules = copy_modules(external.modules, directories, target.parent)
        bundled = bundle_libraries([target, *modules], directories)
    else:
        refuse_other_libraries(target, platform)
    licences = {"sundials": sundials.licence} | {name: licence_of(name, origin) for name, origin in bundled.items()}
    return Binary(
        tuple(path.with_suffix(DEPENDENCIES) for path in compiled),
        {name: licence for name, licence in licences.items() if licence is not None},
    )


def copy_licences(licences: dict[str, Path], folder: Path) -> None:
    """Copies licence texts into a folder, which is made where there are some."""
    for name, licence in licences.items():
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(licence, folder / f"{name}.txt")


def _compilations(sources: BinarySources, sundials: Sundials) -> Sequence[Compilation]:
    headers = (sources.folder, find_fmi_headers(), sundials.include)
    external = sources.external.include_directories
    return [
        Compilation(path, (sources.folder, *external), _GENERATED_FLAGS)
        if path.name in sources.generated
        else Compilation(path, headers, _RUNTIME_FLAGS, common=path.name != sources.own)
        for path in sorted(sources.folder.glob("*.c"))
    ]


def _kept_objects(sources: BinarySources, sundials: Sundials, platform: Platform) -> ObjectStore | None:
    if sources.objects_folder is None:
        return None
    headers = (*runtime_folders(), find_fmi_headers(), sundials.include / "sundials" / "sundials_config.h")
    return ObjectStore(sources.objects_folder, headers, platform)
