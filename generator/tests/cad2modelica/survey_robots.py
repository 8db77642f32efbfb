"""Generates packages from all robot descriptions below a folder and counts what came of it.

Use ``python generator/tests/cad2modelica/survey_robots.py FOLDER [--seconds 60] [--without NAME]
[--decomposer vhacd] [--package-path FOLDER] [--allow-missing]``: a Markdown table goes to the standard output, every
file with its outcome to the standard error.
Every robot is generated in a process of its own, which is stopped when it, or a process it starts, has used the given
time of a processor. Times are of the processor, all processes together, so that other load does not count.
"""

from __future__ import annotations

import argparse
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from cad2modelica import Decomposer, GenerateOptions, SourceChoices, generate
from contact_foundation.errors import CmbError

REFUSED = 2
STOPPED = (-signal.SIGXCPU, 128 + signal.SIGXCPU, 124)  # the last by "timeout"
WALL = 10  # times the limit of processor time: what waits for ever is stopped then
FORMATS = {"urdf": "robot", "xml": "mujoco", "sdf": "sdf"}
"""Root elements of descriptions by the endings of their files."""


@dataclass(frozen=True)
class Outcome:
    """Of one robot: ``kind`` is generated, refused, stopped or crashed; ``reason`` is the first problem's text.

    ``seconds`` are of the processor.
    """

    file: Path
    kind: str
    seconds: float
    reason: str = ""


def descriptions(folder: Path, without: str) -> list[Path]:
    """Files of robot descriptions with the root element of their format, except those below folders of a name."""
    found = []
    for ending, root in FORMATS.items():
        files = [file for file in sorted(folder.rglob(f"*.{ending}")) if without not in file.relative_to(folder).parts]
        start = re.compile(rf"<{root}[\s>]".encode())
        found += [file for file in files if file.is_file() and start.search(file.read_bytes())]
    return found


def outcome(file: Path, seconds: float, decomposer: Decomposer | None, source: SourceChoices) -> Outcome:
    """Generates one robot's package in a temporary folder."""
    with tempfile.TemporaryDirectory(prefix="cmb-survey-") as output:
        command = [sys.executable, __file__, str(file), "--into", str(Path(output) / "package")]
        command += ["--seconds", str(seconds)]
        command += ["--decomposer", decomposer.value] if decomposer is not None else []
        command += [word for folder in source.package_paths for word in ("--package-path", str(folder))]
        command += ["--allow-missing"] if source.allow_missing else []
        with (Path(output) / "log").open("w+") as log:
            process = subprocess.Popen(["timeout", f"{WALL * seconds:g}", *command], stderr=log)
            # subprocess does not tell what one of several children used.
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            log.seek(0)
            last = (log.read().strip().splitlines() or ["no message"])[-1]
    used = usage.ru_utime + usage.ru_stime
    if process.returncode in STOPPED:
        return Outcome(file, "stopped", used, f"takes longer than {seconds:g} s")
    kind = {0: "generated", REFUSED: "refused"}.get(process.returncode, "crashed")
    return Outcome(file, kind, used, "" if kind == "generated" else last)


def generate_one(file: Path, output: Path, decomposer: Decomposer | None, source: SourceChoices) -> int:
    """Generates one package; the first problem goes to the standard error."""
    try:
        generate(file, output, GenerateOptions(decomposer=decomposer, source=source))
    except CmbError as error:
        problems = [line for line in str(error).splitlines() if line.startswith("- ")]
        sys.stderr.write(" ".join((problems[0] if problems else str(error)).split()) + "\n")
        return REFUSED
    return 0


def main() -> int:
    """Surveys a folder, or generates one robot."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("path", type=Path)
    parser.add_argument("--into", type=Path, help="generate the single file into this folder")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--without", default="", help="name of folders that are left out")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--decomposer", type=Decomposer, choices=list(Decomposer))
    parser.add_argument("--package-path", type=Path, action="append", default=[])
    parser.add_argument("--allow-missing", action="store_true")
    arguments = parser.parse_args()
    source = SourceChoices(tuple(arguments.package_path), arguments.allow_missing)
    if arguments.into is not None:
        resource.setrlimit(resource.RLIMIT_CPU, (int(arguments.seconds), resource.RLIM_INFINITY))
        return generate_one(arguments.path, arguments.into, arguments.decomposer, source)
    files = descriptions(arguments.path, arguments.without)
    outcomes = []
    with ThreadPoolExecutor(arguments.processes) as pool:
        for found in pool.map(lambda file: outcome(file, arguments.seconds, arguments.decomposer, source), files):
            outcomes.append(found)
            name = found.file.relative_to(arguments.path)
            sys.stderr.write(f"{found.kind} {found.seconds:.1f} s: {name} {found.reason}\n")
    counts = Counter(found.kind for found in outcomes)
    times = sorted(found.seconds for found in outcomes if found.kind == "generated") or [0.0]
    kinds = " | ".join(str(counts[kind]) for kind in ("generated", "refused", "stopped", "crashed"))
    sys.stdout.write(
        "| robots | generated | refused | stopped | crashed | median, s | longest, s |\n|---|---|---|---|---|---|---|\n"
        f"| {len(files)} | {kinds} | {times[len(times) // 2]:.1f} | {times[-1]:.0f} |\n"
    )
    return 1 if counts["crashed"] else 0


if __name__ == "__main__":
    sys.exit(main())
