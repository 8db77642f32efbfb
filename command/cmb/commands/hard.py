"""`cmb hard`: random hard cases over the whole range of every knob, and where the product holds."""

from __future__ import annotations

import math
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from cmb.build_arguments import add_build_arguments, build_options
from cmb.jobs_argument import add_jobs_argument
from cmb.modelica_sources import find_sources
from cmb.terminal import progress_bars

if TYPE_CHECKING:
    from modelica2fmu.build import BuildOptions

NAME = "hard"
SUMMARY = "run random hard cases of contact and map where the product holds"
DESCRIPTION = (
    "Draws scenes and all knobs from seeds (docs/hard-cases.md): stiffness, mass ratio, speed, size, step, tolerance, "
    "restitution, friction, slenderness, laws, numbers of contacts. Says for each run whether it is right, was stopped "
    "with a message, took too long, or is wrong without a message. Every run is kept as soon as it is whole: called "
    "again, only what is missing is run. Writes table.csv, hard.html and map.svg into the output folder."
)
EXAMPLES = """examples:
  cmb hard --runs 50                          # about a minute
  cmb hard --runs 5000 --jobs 2 --output out/hard
  cmb hard --first 137 --runs 1               # one run, by its seed
"""
_MOST_RUNS = 1_000_000


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("--runs", type=_runs, default=1000, metavar="N", help="number of runs (1000 if left out)")
    parser.add_argument("--first", type=_seed, default=0, metavar="SEED", help="first seed (0 if left out)")
    parser.add_argument("--output", type=Path, default=Path("out") / "hard", metavar="FOLDER", help="(out/hard)")
    add_jobs_argument(parser)
    parser.add_argument(
        "--cpu-limit",
        type=_limit,
        default=5.0,
        metavar="S",
        help="processor time that a run may take (5 s if left out)",
    )
    add_build_arguments(parser)


def run(arguments: Namespace) -> int:
    """Carries the runs out and prints how many are right; status 1 if a run within the operating range failed."""
    from hard_cases.campaign import carry_out_cases
    from hard_cases.operating_range import inside
    from hard_cases.page import write_page
    from hard_cases.picture import write_map
    from hard_cases.summary import is_wrong, summary_lines
    from hard_cases.table import write_table

    folder: Path = arguments.output
    seeds = range(arguments.first, arguments.first + arguments.runs)
    with progress_bars() as progress:
        build = _Build(build_options(arguments))
        rows = carry_out_cases(seeds, build, folder, arguments.cpu_limit, arguments.jobs, progress)
    write_table(rows, folder / "table.csv")
    write_map(rows, folder / "map.svg")
    write_page(rows, folder / "hard.html")
    print("\n".join(summary_lines(rows)))
    print(f"Page: {folder / 'hard.html'}")
    return 1 if any(inside(row) and is_wrong(row) for row in rows) else 0


@dataclass(frozen=True)
class _Build:
    """Builds FMUs in worker processes."""

    options: BuildOptions

    def __call__(self, model: str, sources: Sequence[Path], fmu: Path) -> None:
        from modelica2fmu.build import build_fmu

        build_fmu(model, find_sources(model, sources), fmu, self.options)


def _runs(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text) <= _MOST_RUNS:
        raise ArgumentTypeError(f"{text!r} is not a number of runs from 1 to {_MOST_RUNS}")
    return int(text)


def _seed(text: str) -> int:
    if not text.isdecimal():
        raise ArgumentTypeError(f"{text!r} is not a seed, a whole number from 0")
    return int(text)


def _limit(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise ArgumentTypeError(f"{text!r} is not a time in s")
    return value
