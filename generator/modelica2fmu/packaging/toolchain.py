"""Compiling and linking the FMU's shared library."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from contact_foundation.errors import BuildError

from modelica2fmu.packaging.platforms import LINUX64, Platform

# No contraction of a*b+c and no time or path in the output: the same source gives the same numbers and bytes.
COMPILE_OPTIONS = (
    "-std=c11",
    "-D_DEFAULT_SOURCE",  # POSIX, and M_PI for external code
    "-O2",
    "-fPIC",
    "-fvisibility=hidden",
    "-ffunction-sections",
    "-fdata-sections",
    "-ffp-contract=off",
    "-fno-math-errno",
)
_LINK = (
    "-shared",
    "-Wl,--no-undefined",
    "-Wl,--gc-sections",
    "-s",
)
_VERSION_SCRIPT = "{ global: fmi2*; fmi3*; local: *; };\n"
_ERROR = re.compile(r"\b(fatal error|error|undefined reference|cannot find)\b")
_ERROR_LINES = 5
DEPENDENCIES = ".d"
_TIMEOUT = 1800.0


@dataclass(frozen=True)
class Libraries:
    """What is linked beside the FMU's own objects.

    Attributes:
        archives: static libraries by path.
        names: as after ``-l``, in link order.
        directories: searched for ``names``.
    """

    archives: tuple[Path, ...] = ()
    names: tuple[str, ...] = ()
    directories: tuple[Path, ...] = ()


@dataclass(frozen=True)
class Compilation:
    """One C file and the folders it includes from.

    Attributes:
        source: the file.
        include: folders for ``#include``.
        flags: beside ``COMPILE_OPTIONS``.
        common: = true, if other FMUs have the same file.
    """

    source: Path
    include: tuple[Path, ...] = ()
    flags: tuple[str, ...] = field(default=())
    common: bool = False


class KeptObjects(Protocol):
    """Objects of common sources from earlier builds."""

    def fetch(self, compilation: Compilation, target: Path) -> bool:
        """Copies the object of a source to ``target``, and its dependencies beside it; whether it was there."""

    def keep(self, compilation: Compilation, target: Path) -> None:
        """Keeps an object that was compiled."""


def first_errors(output: str, count: int = _ERROR_LINES) -> str:
    """The lines of a compiler's or linker's output that say what went wrong; its end if none does."""
    lines = [line.rstrip() for line in output.splitlines() if line.strip()]
    telling = [line for line in lines if _ERROR.search(line)]
    return "\n  ".join(telling[:count] or lines[-count:])


def run_tool(command: Sequence[str], purpose: str, *, environment: dict[str, str] | None = None) -> str:
    """Runs a tool and gives its standard output.

    Raises:
        BuildError: it cannot be started, fails or does not end.
    """
    settings = {**os.environ, "LC_ALL": "C", **(environment or {})}
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=_TIMEOUT, env=settings, check=False
        )
    except OSError as error:
        raise BuildError(f"{purpose}: {command[0]} cannot be started: {error.strerror}") from error
    except subprocess.TimeoutExpired as error:
        raise BuildError(f"{purpose}: {command[0]} did not end within {_TIMEOUT:.0f} s") from error
    if done.returncode != 0:
        raise BuildError(f"{purpose} failed:\n  {first_errors(done.stderr or done.stdout)}")
    return done.stdout


def compile_objects(
    compilations: Sequence[Compilation], folder: Path, kept: KeptObjects | None = None, platform: Platform = LINUX64
) -> list[Path]:
    """Compiles C files into ``folder``, several at a time; the objects come in the order of the sources.

    Beside each object lies a file with the suffix ``DEPENDENCIES`` that names what its source includes.

    Args:
        compilations: what to compile.
        folder: to write to.
        kept: objects of common sources from earlier builds.
        platform: what to compile for.

    Raises:
        BuildError: with the first error lines.
    """
    program = platform.compiler()

    def compile_one(compilation: Compilation, target: Path) -> None:
        if compilation.common and kept is not None and kept.fetch(compilation, target):
            return
        includes = [f"-I{path}" for path in compilation.include]
        command = [
            program,
            *COMPILE_OPTIONS,
            *platform.compile_options,
            *compilation.flags,
            *includes,
            "-MD",
            "-MF",
            str(target.with_suffix(DEPENDENCIES)),
            "-c",
            str(compilation.source),
            "-o",
            str(target),
        ]
        run_tool(command, f"compiling {compilation.source.name}")
        if compilation.common and kept is not None:
            kept.keep(compilation, target)

    targets = [folder / f"{number:03d}-{each.source.stem}.o" for number, each in enumerate(compilations)]
    # The longest first, so that none is left over at the end.
    order = sorted(zip(compilations, targets, strict=True), key=lambda pair: -pair[0].source.stat().st_size)
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        running = [pool.submit(compile_one, compilation, target) for compilation, target in order]
        try:
            for each in running:
                each.result()
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return targets


def link_shared(
    objects: Sequence[Path], libraries: Libraries, target: Path, scratch: Path, platform: Platform = LINUX64
) -> None:
    """Links objects and libraries into a shared library that shows the FMI functions only.

    Raises:
        BuildError: with the first error lines.
    """
    options = [*_LINK, *platform.link_options]
    if platform.suffix == ".so":  # a DLL shows what its sources declare as exported
        script = scratch / "exports.map"
        script.write_text(_VERSION_SCRIPT, encoding="ascii")
        options += [f"-Wl,--version-script={script}", f"-Wl,-soname,{target.name}"]
    command = [
        platform.compiler(),
        *options,
        "-o",
        str(target),
        *(str(path) for path in objects),
        *(f"-L{path}" for path in libraries.directories),
        "-Wl,--start-group",
        *(str(path) for path in libraries.archives),
        *(f"-l{name}" for name in libraries.names),
        "-Wl,--end-group",
        "-lstdc++",
        "-lm",
        "-lpthread",
    ]
    run_tool(command, f"linking {target.name}")
