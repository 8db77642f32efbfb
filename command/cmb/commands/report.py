"""`cmb report`: a result to a self-contained HTML page."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path

from cmb.input_file import check_input

NAME = "report"
SUMMARY = "write report.html from a result: forces, joints, energy, impacts, 3-D animation"
DESCRIPTION = (
    "Writes one HTML file that works offline. With the scene file that `cmb generate` writes beside a package the "
    "report animates the real geometry and lists impacts and energy; without it, it plots the result's signals."
)
EXAMPLES = """examples:
  cmb report out/hammer/result.csv \\
    --scene out/hammer/model/scene.json --output hammer.html
  cmb report drop.csv --scene Drop.fmu --output drop.html
  cmb report ball.csv --output ball.html
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("result", type=Path, metavar="CSV", help="trajectories as `cmb simulate` writes them")
    parser.add_argument(
        "--scene",
        type=Path,
        metavar="FILE",
        help="scene file of the generated package, or the FMU itself where its model is hand-written",
    )
    parser.add_argument(
        "--experiment", type=Path, metavar="TOML", help="experiment file with further plots and numbers (see cmb run)"
    )
    parser.add_argument("--output", type=Path, required=True, metavar="HTML", help="file to write")


def run(arguments: Namespace) -> int:
    """Writes the report."""
    check_input(arguments.result, arguments.scene)
    from fmu_regression.report.simulation_report import write_report
    from fmu_regression.results.result import read_csv

    from cmb.experiment import Experiment, read_experiment

    experiment = read_experiment(arguments.experiment) if arguments.experiment else Experiment()
    notes = write_report(read_csv(arguments.result), arguments.scene, arguments.output, experiment.figures)
    for note in notes:
        print(f"cmb: note: {note}", file=sys.stderr)
    print(arguments.output)
    return 0
