"""`cmb regress`: runs regression cases."""

from __future__ import annotations

import tempfile
from argparse import ArgumentParser, Namespace
from pathlib import Path

from contact_data import regression_cases
from contact_foundation.errors import EXIT_FAILURE, InputError
from contact_foundation.output import check_file
from contact_foundation.progress import silent

from cmb.build_arguments import add_build_arguments, build_options
from cmb.input_file import check_input
from cmb.jobs_argument import add_jobs_argument
from cmb.simulation_arguments import add_time_limit
from cmb.terminal import progress_bars

NAME = "regress"
SUMMARY = "simulate regression cases and compare with references"
DESCRIPTION = (
    "Runs every case (a TOML file with a model or FMU, signals, tolerances) below a folder and prints a table. "
    "The exit status is 1 if any case fails."
)
EXAMPLES = """examples:
  cmb regress --jobs 2
  cmb regress regression/cases/reference --output out/regression.html
  cmb regress regression/cases/library --fmi 3
  cmb regress mycases --junit regression.xml
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument(
        "folder", type=Path, nargs="?", metavar="FOLDER", help="folder with cases (in a checkout: the project's own)"
    )
    parser.add_argument("--output", type=Path, metavar="HTML", help="also write a page with plots")
    parser.add_argument("--junit", type=Path, metavar="XML", help="also write JUnit XML")
    add_time_limit(parser)
    add_jobs_argument(parser)
    add_build_arguments(parser)


def run(arguments: Namespace) -> int:
    """Runs the cases."""
    for output in (arguments.output, arguments.junit):
        if output is not None:
            check_file(output)
    folder_of_cases = arguments.folder or regression_cases()
    if folder_of_cases is None:
        raise InputError("this installation has no cases of its own", remedy="name a folder with cases")
    check_input(folder_of_cases)
    from fmu_regression.cases.runner import Verdict, run_cases
    from fmu_regression.report.case_summary import text_table, write_junit, write_summary

    from cmb.fmu_provider import FmuProvider

    with tempfile.TemporaryDirectory(prefix="cmb-regress-") as folder, progress_bars() as progress:
        # Worker processes have no terminal: they report their cases alone.
        builds = progress if arguments.jobs == 1 else silent
        provider = FmuProvider(Path(folder), build_options(arguments), builds)
        results = run_cases(
            folder_of_cases, provider, time_limit=arguments.time_limit, jobs=arguments.jobs, progress=progress
        )
    print(text_table(results))
    if arguments.output is not None:
        write_summary(results, arguments.output)
    if arguments.junit is not None:
        write_junit(results, arguments.junit)
    failed = any(result.verdict in (Verdict.FAILED, Verdict.ERROR) for result in results)
    return EXIT_FAILURE if failed else 0
