"""A digest of everything an FMU is made from: the same digest, the same FMU."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Final

from modelica2fmu.library.sources import locate
from modelica2fmu.library.standard_library import StandardLibrary, other_libraries
from modelica2fmu.options import BuildOptions
from modelica2fmu.packaging.dependencies import find_sundials
from modelica2fmu.packaging.platforms import Platform, find_platforms
from modelica2fmu.packaging.toolchain import run_tool
from modelica2fmu.source_places import file_digest

_BUILDER: Final = Path(__file__).resolve().parent
_BUILDER_SUFFIXES: Final = (".py", ".c", ".h")
_PACKAGES: Final = ("rumoca", "fmpy", "networkx", "numpy")
# Folders of a Modelica package whose files go into its FMUs (Modelica Language Specification 3.6, section 12.9.4).
_RESOURCES: Final = ("Include", "Library")
# Geometry that descriptors name by file is written out into FMUs.
_GEOMETRY_SUFFIXES: Final = (".stl", ".obj", ".ply", ".csv", ".txt")


def fingerprint(model: str, sources: Sequence[Path], library: StandardLibrary, options: BuildOptions) -> str:
    """The digest of a build, SHA-256 in hexadecimal.

    It covers contents, not times: the model's sources and those of every library that the front end may read, C
    headers and libraries beside them, the Standard Library, the builder itself, its compiler and the options. Where the
    sources stand it does not cover: see :mod:`modelica2fmu.source_places`.

    Raises:
        InputError: a source does not exist, or none holds the model's package.
        BuildError: the compiler or SUNDIALS is not installed.
    """
    digest = hashlib.sha256()

    def add(*words: str) -> None:
        for word in words:
            data = word.encode("utf-8", errors="surrogateescape")
            digest.update(len(data).to_bytes(8, "little"))
            digest.update(data)

    add(model, options.fmi.value, repr(options.solver), repr(options.outputs), _builder())
    for platform in find_platforms(options.platforms):
        add(platform.name, _toolchain(platform))
    file, roots = locate(model, sources)
    libraries = {path.resolve() for path in (library.folder, *other_libraries())}
    places = dict.fromkeys(path.resolve() for path in (*roots, *libraries, *sources, file))
    for root in places:
        if any(parent in places for parent in root.parents):
            continue
        is_package = (root / "package.mo").is_file()
        add(str(root) if root in libraries else "source", root.name if is_package else "")
        for path in _inputs(root):
            add(path.relative_to(root).as_posix() if root.is_dir() else path.name, file_digest(path))
    return digest.hexdigest()


def _inputs(root: Path) -> Iterator[Path]:
    """Files below a root that decide about an FMU, in order of their paths."""
    if not root.is_dir():
        yield root
        return
    for name, folders, files in os.walk(root):
        folder = Path(name)
        folders[:] = sorted(each for each in folders if not each.startswith("."))
        everything = any(part in _RESOURCES for part in folder.relative_to(root).parts) and "Resources" in folder.parts
        for each in sorted(files):
            geometry = "Resources" in folder.parts and each.lower().endswith(_GEOMETRY_SUFFIXES)
            if everything or geometry or each.endswith(".mo") or each == "package.order":
                yield folder / each


def _digest_all(paths: Iterable[Path]) -> str:
    return hashlib.sha256("".join(file_digest(path) for path in paths).encode()).hexdigest()


@cache
def _builder() -> str:
    files = sorted(path for path in _BUILDER.rglob("*") if path.suffix in _BUILDER_SUFFIXES)
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in _PACKAGES)
    return f"{_digest_all(files)} {versions}"


@cache
def _toolchain(platform: Platform) -> str:
    program = platform.compiler()
    version = run_tool([program, "--version"], "asking the compiler for its version").splitlines()[0]
    return f"{program} {version} {file_digest(find_sundials(platform).archive)}"
