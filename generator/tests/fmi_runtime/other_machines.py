"""Runs FMUs on other machines, as far as these are to be had here: in a bare root, under Wine, under QEMU."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy import read_model_description
from modelica2fmu.packaging.dependencies import find_fmi_headers
from numpy.typing import NDArray

IMPORTER = Path(__file__).with_name("importer.c")
WINE = Path("/usr/lib/wine/wine64")


@dataclass(frozen=True)
class Machine:
    """How programs are compiled for a machine and started on it.

    Attributes:
        platform: of the FMU.
        compiler: of the importer.
        options: beside the usual ones.
        runner: what starts it.
        suffix: of the FMU's binary.
        root: = true, if it sees the folder of the FMU alone, with the C library.
    """

    platform: str
    compiler: str
    options: tuple[str, ...] = ()
    runner: tuple[str, ...] = ()
    suffix: str = ".so"
    root: bool = False

    def missing(self) -> str:
        """What is not installed; empty if all is."""
        needed = [self.compiler, *self.runner[:1]]
        if self.root and os.geteuid() != 0:
            return "root's right to chroot"
        return ", ".join(name for name in needed if shutil.which(name) is None)


HERE = Machine("linux64", "gcc")
BARE = Machine("linux64", "gcc", root=True)
WINDOWS = Machine("win64", "x86_64-w64-mingw32-gcc-posix", ("-static",), (str(WINE),), ".dll")
ARM = Machine("aarch64-linux", "aarch64-linux-gnu-gcc", (), ("qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"))


def simulate(
    machine: Machine, fmu: Path, variables: Sequence[str], stop: float, steps: int, folder: Path
) -> NDArray[np.float64]:
    """Rows of the time and the variables at the start and after each step, by co-simulation."""
    description = read_model_description(str(fmu))
    numbers = {variable.name: variable.valueReference for variable in description.modelVariables}
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    program = folder / "importer"
    subprocess.run(
        [machine.compiler, "-O1", "-o", program, IMPORTER, f"-I{find_fmi_headers()}", *machine.options], check=True
    )
    program = program if program.is_file() else program.with_suffix(".exe")
    inside = Path("/") if machine.root else folder
    binary = inside / "binaries" / machine.platform / f"{description.coSimulation.modelIdentifier}{machine.suffix}"
    command = [
        *machine.runner,
        inside / program.name,
        binary,
        description.guid,
        (inside / "resources").as_uri(),
        stop,
        steps,
    ]
    if machine.root:
        _install_c_library(folder)
        command = ["chroot", folder, *command]
    environment = {**os.environ, "WINEPREFIX": str(folder / "wine"), "WINEDEBUG": "-all"}
    done = subprocess.run(
        [str(word) for word in (*command, *(numbers[name] for name in variables))],
        capture_output=True,
        text=True,
        env=environment,
        timeout=600,
        check=False,
    )
    if done.returncode != 0:
        raise AssertionError(f"{done.returncode}: {done.stdout[-500:]} {done.stderr[-2000:]}")
    return np.array([[float(word) for word in line.split()] for line in done.stdout.splitlines()])


def _install_c_library(root: Path) -> None:
    """The C library and its loader, and nothing else, where programs look for them."""
    listed = subprocess.run(["ldd", root / "importer"], capture_output=True, text=True, check=True).stdout
    files = set(re.findall(r"(/\S+)", listed))
    libc = next(Path(name) for name in files if Path(name).name == "libc.so.6")
    for name in {*files, str(libc.with_name("libm.so.6"))}:
        target = root / name.lstrip("/")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(Path(name).resolve(), target)
        target.chmod(0o755)
