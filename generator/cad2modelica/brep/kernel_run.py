"""Runs the CAD kernel on files of unknown hands: in a process of its own, with limits on size, time and memory."""

from __future__ import annotations

import json
import shutil
import sys
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from contact_foundation.child_process import ChildLimits, run_child
from contact_foundation.errors import InputError, Place
from contact_foundation.scratch import scratch_folder
from numpy.typing import NDArray

MAXIMUM_BYTES = 256 * 2**20
MEMORY_LIMIT = 16 * 2**30  # address space of the kernel's process
TIME_LIMIT = 120  # s of processor time for small files
BYTES_PER_SECOND = 200_000  # that larger files have more
WALL_FACTOR = 10  # times as long by the clock, for a machine that is busy otherwise
ANGLE = 0.3  # rad, largest angle between neighbouring triangles of a curved face
INSTALL = "Install the kernel: pip install 'cadquery-ocp-novtk>=7.9,<8'  (67 MB; the extra contactmultibody[step])"
EXTERNAL = (b"DOCUMENT_FILE", b"EXTERNAL_IDENTIFICATION_ASSIGNMENT")

_PROCESS = "cad2modelica.brep.kernel_process"

KernelResult = tuple[dict[str, Any], dict[str, NDArray[Any]]]


def kernel_is_installed() -> bool:
    """Whether the extra is there."""
    return find_spec("OCP") is not None


def run_kernel(files: Sequence[Path], deflection: float | None) -> list[KernelResult | InputError]:
    """What the kernel says of each file (see ``kernel_process``), or why it says nothing.

    Args:
        files: STEP files.
        deflection: largest distance of the triangles from the faces, mm; None: by each part's size.
    """
    results: dict[int, KernelResult | InputError] = {}
    for number, file in enumerate(files):
        refused = _refused(file)
        if refused is not None:
            results[number] = refused
    pending = [number for number in range(len(files)) if number not in results]
    while pending:
        done, failure = _run({number: files[number] for number in pending}, deflection)
        results |= done
        left = [number for number in pending if number not in done]
        if left:  # the process ended over this file; the others are tried without it
            message, remedy = failure
            results[left[0]] = InputError(message, place=Place(file=files[left[0]]), remedy=remedy)
        pending = left[1:]
    return [results[number] for number in range(len(files))]


def _run(
    files: Mapping[int, Path], deflection: float | None
) -> tuple[dict[int, KernelResult | InputError], tuple[str, str]]:
    """Results of one process, in the order of the files, and why it ended if some are missing."""
    limit = TIME_LIMIT + sum(file.stat().st_size for file in files.values()) // BYTES_PER_SECOND
    with scratch_folder("kernel") as folder:
        for number, file in files.items():  # copies: what a file names beside itself is out of reach
            shutil.copyfile(file, folder / f"{number}.step")
        task = folder / "task.json"
        copies = {str(number): str(folder / f"{number}.step") for number in files}
        task.write_text(json.dumps({"files": copies, "deflection": deflection, "angle": ANGLE}))
        # -P: what lies in the current folder is no module of ours.
        command = [sys.executable, "-P", "-m", _PROCESS, str(task), str(folder)]
        failure = _ended(command, folder, limit)
        return {
            number: _result(folder / f"{number}.npz", file)
            for number, file in files.items()
            if (folder / f"{number}.npz").exists()
        }, failure


def _ended(command: Sequence[str], folder: Path, limit: int) -> tuple[str, str]:
    """Runs the process to its end; why it ended, for files that have no result then."""
    end = run_child(command, ChildLimits(limit, WALL_FACTOR * limit, MEMORY_LIMIT), folder)
    if end.overran:
        longest = WALL_FACTOR * limit if end.overran == "wall" else limit
        return f"the CAD kernel took longer than {longest} s", "Leave out details such as threads."
    return (
        f"the CAD kernel failed with status {end.status}: {end.complaint}",
        "Export the file again, or its parts alone.",
    )


def _result(stored: Path, file: Path) -> KernelResult | InputError:
    try:
        with np.load(stored, allow_pickle=False) as entries:
            arrays = {entry: np.asarray(entries[entry]) for entry in entries.files}
    except (OSError, ValueError, BadZipFile):
        return InputError("the CAD kernel left no result", place=Place(file=file), remedy="Try again.")
    manifest: dict[str, Any] = json.loads(str(arrays.pop("manifest")))
    if "refused" in manifest:
        return InputError(manifest["refused"], place=Place(file=file), remedy="Export it again as STEP AP214 or AP242.")
    return manifest, arrays


def _refused(file: Path) -> InputError | None:
    """Why a file is not given to the kernel at all."""
    place = Place(file=file)
    if not kernel_is_installed():
        return InputError(
            "is STEP, which is read through a CAD kernel that is not installed", place=place, remedy=INSTALL
        )
    try:
        with file.open("rb") as stream:
            data = stream.read(MAXIMUM_BYTES + 1)
    except OSError as error:
        remedy = "Check the path and the permissions."
        return InputError(f"cannot be read: {error.strerror}", place=place, remedy=remedy)
    if len(data) > MAXIMUM_BYTES:
        remedy = "Leave out what does not move."
        return InputError(f"is larger than {MAXIMUM_BYTES // 2**20} MiB", place=place, remedy=remedy)
    if b"ISO-10303-21" not in data[:4096]:
        return InputError("is no STEP file", place=place, remedy="Export it again as STEP AP214 or AP242.")
    if all(word in data for word in EXTERNAL):
        remedy = "Export the assembly as one file."
        return InputError("refers to other files, which are not read", place=place, remedy=remedy)
    return None
