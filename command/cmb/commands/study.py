"""`cmb study`: scenes under every knob, what each run errs and what it costs."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from contact_foundation.progress import Progress

from cmb.build_arguments import add_build_arguments, build_options
from cmb.input_file import check_input
from cmb.jobs_argument import add_jobs_argument
from cmb.modelica_sources import find_sources
from cmb.terminal import progress_bars

if TYPE_CHECKING:
    from modelica2fmu.build import BuildOptions

NAME = "study"
SUMMARY = "run a grid of scenes and knobs: what each run errs, what it costs, what limits it"
DESCRIPTION = (
    "Builds every variant of every scene of a study file (docs/accuracy.md), runs the grid, and tells errors of model, "
    "geometry and solver apart. Every run is kept as soon as it is whole: called again, only what is missing is run. "
    "Writes table.csv, study.html and a picture of each scene into the output folder and prints sentences."
)
EXAMPLES = """examples:
  cmb study Resources/studies/quick.toml      # less than a minute
  cmb study Resources/studies/all.toml \\
    --output out/accuracy --jobs 2
  cmb study Resources/studies/all.toml --scene gripper
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("study", type=Path, metavar="FILE", help="the study, a TOML file")
    parser.add_argument(
        "--output", type=Path, metavar="FOLDER", help="where runs are kept (out/study/ and the file's name if left out)"
    )
    parser.add_argument(
        "--scene", action="append", default=[], metavar="NAME", help="this scene alone; more than once for several"
    )
    add_jobs_argument(parser, "the most exact times")
    parser.add_argument(
        "--scheduler",
        default="",
        metavar="ADDRESS",
        help="run on the workers of this scheduler of Dask, as tcp://host:8786, in place of processes here "
        "(contactmultibody[cluster]); they must see the output folder",
    )
    parser.add_argument(
        "--parquet", action="store_true", help="write table.parquet beside table.csv (contactmultibody[parquet])"
    )
    add_build_arguments(parser)


def run(arguments: Namespace) -> int:
    """Carries the study out and prints its sentences."""
    check_input(arguments.study)
    from accuracy_study.definition import load_study
    from accuracy_study.page import write_page
    from accuracy_study.picture import write_pictures
    from accuracy_study.sentences import study_sentences
    from accuracy_study.study import carry_out_study
    from accuracy_study.table import check_parquet, write_parquet, write_table

    if arguments.parquet:
        check_parquet()
    study = load_study(arguments.study).only(arguments.scene)
    folder: Path = arguments.output or Path("out") / "study" / arguments.study.stem
    with progress_bars() as progress:
        build = partial(_build, build_options(arguments), progress)
        findings = carry_out_study(study, build, folder, arguments.jobs, progress, arguments.scheduler)
    write_table(findings, folder / "table.csv")
    if arguments.parquet:
        write_parquet(findings, folder / "table.parquet")
    write_page(findings, folder / "study.html")
    write_pictures(findings, folder / "pictures")
    print("\n".join(study_sentences(findings)))
    print(f"Page: {folder / 'study.html'}")
    return 0


def _build(options: BuildOptions, progress: Progress, model: str, sources: Sequence[Path], fmu: Path) -> None:
    from modelica2fmu.build import build_fmu

    build_fmu(model, find_sources(model, sources), fmu, options, progress)
