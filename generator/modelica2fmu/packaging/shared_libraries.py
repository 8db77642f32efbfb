"""Bundling the shared libraries that an FMU needs and a fresh machine does not have."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from contact_foundation.errors import BuildError

from modelica2fmu.packaging.platforms import LINUX64, Platform
from modelica2fmu.packaging.toolchain import run_tool

_RESOLVED = re.compile(r"^\s*(?P<name>\S+) => (?P<path>/.*?)(?: \(0x[0-9a-f]+\))?$")
_MISSING = re.compile(r"^\s*(?P<name>\S+) => not found$")


def needed_libraries(library: Path, directories: Sequence[Path] = ()) -> dict[str, Path]:
    """All shared libraries, also those of libraries, that ``library`` needs and a system does not always have.

    Args:
        library: a shared library.
        directories: searched before the system's.

    Returns:
        Paths by the names under which they are looked for.

    Raises:
        BuildError: one is not found.
    """
    search = os.pathsep.join(str(directory) for directory in directories)
    output = run_tool(
        ["ldd", str(library)], f"listing what {library.name} needs", environment={"LD_LIBRARY_PATH": search}
    )
    needed: dict[str, Path] = {}
    for line in output.splitlines():
        missing = _MISSING.match(line)
        if missing:
            raise BuildError(
                f"{library.name} needs {missing['name']}, which is not found",
                remedy="Install the package that has it, or add its folder to the library directories.",
            )
        resolved = _RESOLVED.match(line)
        if resolved and not LINUX64.system.fullmatch(resolved["name"]):
            needed[resolved["name"]] = Path(resolved["path"])
    return dict(sorted(needed.items()))


def _refuse_callers_of_modelica(name: str, library: Path) -> None:
    """An FMU shows its FMI functions only, so a shared library would look for ModelicaError in vain, and fail late."""
    listed = run_tool(["nm", "-D", "--undefined-only", str(library)], f"listing what {name} calls")
    called = sorted(symbol for symbol in listed.split() if symbol.startswith("Modelica"))
    if called:
        raise BuildError(
            f"the shared library {name} calls {called[0]}, which only code inside the FMU's own library can",
            remedy="Link it statically: offer it as a static library (.a).",
        )


def copy_modules(names: Sequence[str], directories: Sequence[Path], target: Path) -> list[Path]:
    """Copies shared objects that the FMU's library loads while it runs into its folder.

    Raises:
        BuildError: one is not found.
    """
    copies = []
    for name in names:
        origin = next((path for directory in directories if (path := directory / name).is_file()), None)
        if origin is None:
            raise BuildError(
                f"the module {name}, which the model needs, is not in {', '.join(map(str, directories))}",
                remedy="Install it there, or choose another back end in the model.",
            )
        shutil.copyfile(origin.resolve(), target / name)
        (target / name).chmod(0o755)
        copies.append(target / name)
    return copies


def bundle_libraries(libraries: Sequence[Path], directories: Sequence[Path]) -> dict[str, Path]:
    """Copies what ``libraries``, all in one folder, need beside them and makes sure that it is found there.

    Returns:
        The origin of each copy, by file name.

    Raises:
        BuildError: a library is not found, or one is still taken from elsewhere.
    """
    needed = {name: path for library in libraries for name, path in needed_libraries(library, directories).items()}
    folder = libraries[0].parent
    for name, origin in needed.items():
        _refuse_callers_of_modelica(name, origin)
        copy = folder / name
        shutil.copyfile(origin.resolve(), copy)
        copy.chmod(0o755)
    for library in libraries:
        for name, path in needed_libraries(library).items():
            if path.parent.resolve() != folder.resolve():
                raise BuildError(
                    f"{library.name} would take {name} from {path} and not from the FMU",
                    remedy="A library that it needs has a run path of its own (DT_RUNPATH); use one without.",
                )
    return needed


def refuse_other_libraries(library: Path, platform: Platform) -> None:
    """Of other platforms than this one nothing is known but the system's own libraries.

    Raises:
        BuildError: another one is needed.
    """
    listed = run_tool([*platform.lists_headers, str(library)], f"listing what {library.name} needs")
    for name in platform.needs.findall(listed):
        if not platform.system.fullmatch(name):
            raise BuildError(
                f"{library.name} needs {name}, which not every {platform.name} system has",
                remedy="Link it statically: offer a static library (.a) for the platform.",
            )


@cache
def licence_of(name: str, library: Path) -> Path | None:
    """The licence text that Debian keeps of the package a library comes from; ``None`` where there is none.

    Args:
        name: under which the library is looked for; its package is known by it also where only a copy lies elsewhere.
        library: the file.
    """
    for pattern in (str(library.resolve()), f"*/{name}"):
        try:
            answer = run_tool(["dpkg-query", "-S", pattern], f"asking for the package of {name}")
        except BuildError:
            continue
        for line in answer.splitlines():
            licence = Path("/usr/share/doc") / line.split(":", 1)[0] / "copyright"
            if licence.is_file():
                return licence
    return None
