"""Generates packages from all robot descriptions below a folder and counts what came of it.

Use ``python generator/tests/cad2modelica/survey_robots.py FOLDER [--seconds 60] [--without NAME]
[--decomposer vhacd]``: a Markdown table goes to the standard output, every file with its outcome to the standard error.
Every robot is generated in a process of its own, which is stopped after the given time.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from cad2modelica import Decomposer, GenerateOptions, generate
from cmb_base.errors import CmbError

REFUSED = 2
_ROBOT = re.compile(rb"<robot[\s>]")


@dataclass(frozen=True)
class Outcome:
    """Of one robot: ``kind`` is generated, refused, stopped or crashed; ``reason`` is the first problem's text."""

    file: Path
    kind: str
    seconds: float
    reason: str = ""


def descriptions(folder: Path, without: str) -> list[Path]:
    """Files with the ending ``urdf`` and an element ``robot``, except those below folders of a name."""
    files = [file for file in sorted(folder.rglob("*.urdf")) if without not in file.relative_to(folder).parts]
    return [file for file in files if _ROBOT.search(file.read_bytes())]


def outcome(file: Path, seconds: float, decomposer: Decomposer | None) -> Outcome:
    """Generates one robot's package in a temporary folder."""
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="cmb-survey-") as output:
        command = [sys.executable, __file__, str(file), "--into", str(Path(output) / "package")]
        command += ["--decomposer", decomposer.value] if decomposer is not None else []
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
        except subprocess.TimeoutExpired:
            return Outcome(file, "stopped", time.monotonic() - begin, f"takes longer than {seconds:g} s")
    kind = {0: "generated", REFUSED: "refused"}.get(done.returncode, "crashed")
    last = (done.stderr.strip().splitlines() or ["no message"])[-1]
    return Outcome(file, kind, time.monotonic() - begin, "" if kind == "generated" else last)


def generate_one(file: Path, output: Path, decomposer: Decomposer | None) -> int:
    """Generates one package; the first problem goes to the standard error."""
    try:
        generate(file, output, GenerateOptions(decomposer=decomposer))
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
    arguments = parser.parse_args()
    if arguments.into is not None:
        return generate_one(arguments.path, arguments.into, arguments.decomposer)
    files = descriptions(arguments.path, arguments.without)
    outcomes = []
    with ThreadPoolExecutor(arguments.processes) as pool:
        for found in pool.map(lambda file: outcome(file, arguments.seconds, arguments.decomposer), files):
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
