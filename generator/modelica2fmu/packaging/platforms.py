"""The platforms that an FMU can hold binaries for, and what builds these."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from contact_foundation.errors import BuildError, InputError


@dataclass(frozen=True)
class Platform:
    """A platform and its toolchain.

    Attributes:
        name: as users say it; the folder of the binaries in FMI 2.0.
        fmi3: the folder in FMI 3.0.
        library_folders: sub-folders of a Modelica library folder that hold libraries for it.
        suffix: of the binaries.
        compilers: names of the C compiler, of which the first that is installed counts; where this program runs on the
            platform the environment's ``CC`` counts instead.
        compile_options: beside those of all platforms.
        link_options: beside those of all platforms.
        lists_headers: arguments of a program that lists what a binary needs.
        needs: finds the names in that list.
        system: names that every system of this kind has.
        is_host: = true, if this program runs on it.
    """

    name: str
    fmi3: str
    library_folders: tuple[str, ...]
    suffix: str
    compilers: tuple[str, ...]
    compile_options: tuple[str, ...]
    link_options: tuple[str, ...]
    lists_headers: tuple[str, ...]
    needs: re.Pattern[str]
    system: re.Pattern[str]
    is_host: bool = False

    def compiler(self) -> str:
        """The C compiler.

        Raises:
            BuildError: it is not installed.
        """
        named = os.environ.get("CC") if self.is_host else None
        names = (named,) if named else self.compilers
        for name in names:
            path = shutil.which(name)
            if path is not None:
                return path
        remedy = "Install it: apt-get install gcc" if self.is_host else "Run scripts/setup cross"
        raise BuildError(f"the C compiler {names[0]} is not installed", remedy=remedy)

    def searched(self, folders: Iterable[Path]) -> tuple[Path, ...]:
        """The folders that hold libraries: of each first its sub-folders of the platform, then itself."""
        names = (*self.library_folders, "")
        return tuple(path for folder in folders for name in names if (path := folder / name).is_dir())


_ELF_LINK: Final = (
    "-Wl,--exclude-libs,ALL",
    "-Wl,--disable-new-dtags",  # DT_RPATH: also found for libraries that bundled libraries need
    "-Wl,-rpath,$ORIGIN",
    "-Wl,--as-needed",
)
_ELF_NEEDS: Final = re.compile(r"\(NEEDED\).*\[(.*)\]")
# glibc, and the runtime libraries of gcc: every Linux system with programs of its own has them, and two copies
# in one process do not work.
_LINUX_SYSTEM: Final = re.compile(
    r"(ld-linux.*|linux-vdso|linux-gate|libc|libm|libmvec|libdl|libpthread|librt|libutil|libresolv|libnsl|libanl"
    r"|libgcc_s|libstdc\+\+)\.so(\.\d+)*"
)

LINUX64: Final = Platform(
    name="linux64",
    fmi3="x86_64-linux",
    library_folders=("linux64", "x86_64-linux-gnu"),
    suffix=".so",
    compilers=("gcc",),
    compile_options=(),
    link_options=_ELF_LINK,
    lists_headers=("readelf", "-d"),
    needs=_ELF_NEEDS,
    system=_LINUX_SYSTEM,
    is_host=True,
)
WIN64: Final = Platform(
    name="win64",
    fmi3="x86_64-windows",
    library_folders=("win64", "x86_64-w64-mingw32"),
    suffix=".dll",
    compilers=("x86_64-w64-mingw32-gcc-posix", "x86_64-w64-mingw32-gcc"),
    compile_options=("-D_USE_MATH_DEFINES", "-D__USE_MINGW_ANSI_STDIO=1"),
    # All but the system's libraries is linked statically; no time in the header, and no base made from the file's path.
    link_options=("-static", "-Wl,--no-insert-timestamp", "-Wl,--image-base,0x180000000"),
    lists_headers=("x86_64-w64-mingw32-objdump", "-p"),
    needs=re.compile(r"DLL Name: (\S+)"),
    system=re.compile(r"(kernel32|msvcrt|user32|advapi32|ntdll|api-ms-win-.*)\.dll", re.IGNORECASE),
)
AARCH64_LINUX: Final = Platform(
    name="aarch64-linux",
    fmi3="aarch64-linux",
    library_folders=("aarch64-linux-gnu",),
    suffix=".so",
    compilers=("aarch64-linux-gnu-gcc",),
    compile_options=(),
    link_options=_ELF_LINK,
    lists_headers=("readelf", "-d"),
    needs=_ELF_NEEDS,
    system=_LINUX_SYSTEM,
)

_PLATFORMS: Final = {platform.name: platform for platform in (LINUX64, WIN64, AARCH64_LINUX)}


def find_platforms(names: Sequence[str]) -> tuple[Platform, ...]:
    """The platforms of these names (linux64, win64, aarch64-linux), each once.

    Raises:
        InputError: there is none, or no name.
    """
    for name in names:
        if name not in _PLATFORMS:
            raise InputError(f"there is no platform {name!r}", remedy=f"choose among {', '.join(_PLATFORMS)}")
    if not names:
        raise InputError("no platform is named", remedy=f"choose among {', '.join(_PLATFORMS)}")
    return tuple(_PLATFORMS[name] for name in dict.fromkeys(names))
