"""`cmb accuracy`: what accuracy costs in time."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from contact_foundation.output import check_file

from cmb.input_file import check_input
from cmb.simulation_arguments import add_simulation_arguments
from cmb.terminal import progress_bars

NAME = "accuracy"
SUMMARY = "show what accuracy costs: error against time over solver tolerances"
DESCRIPTION = (
    "Simulates an FMU over a sweep of solver tolerances and measures each run against a much more accurate one. "
    "Runs that fail stay in the table. With a scene file, the rise of the total energy is shown too."
)
EXAMPLES = """examples:
  cmb accuracy ball.fmu --output accuracy.html
  cmb accuracy out/hammer/hammer.fmu \\
    --scene out/hammer/model/scene.json --stop 0.5 \\
    --tolerance 1e-4 --tolerance 1e-6
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("fmu", type=Path, metavar="FMU", help="the FMU file")
    parser.add_argument("--output", type=Path, metavar="HTML", help="also write a page with plots")
    parser.add_argument("--scene", type=Path, metavar="JSON", help="scene file of the generated package")
    add_simulation_arguments(parser, repeats=True)
    parser.add_argument("--signal", action="append", metavar="NAME", help="variable to compare, repeatable")
    parser.add_argument("--mode", choices=("me", "cs"), action="append", help="repeatable (both if left out)")
    parser.add_argument("--repeats", type=int, default=1, metavar="N", help="runs of each, the shortest time counts")


def run(arguments: Namespace) -> int:
    """Makes the study and prints its table."""
    if arguments.output is not None:
        check_file(arguments.output)
    check_input(arguments.fmu, arguments.scene)
    from fmu_regression.compare.accuracy import DEFAULT_TOLERANCES, study_accuracy
    from fmu_regression.report.accuracy_report import accuracy_text, write_accuracy
    from fmu_regression.scene.scene_file import load_scene

    with progress_bars() as progress:
        study = study_accuracy(
            arguments.fmu,
            signals=arguments.signal,
            scene=load_scene(arguments.scene) if arguments.scene is not None else None,
            stop=arguments.stop,
            interval=arguments.interval,
            tolerances=arguments.tolerance or DEFAULT_TOLERANCES,
            modes=arguments.mode or ("me", "cs"),
            repeats=arguments.repeats,
            time_limit=arguments.time_limit,
            progress=progress,
        )
    print(accuracy_text(study))
    if arguments.output is not None:
        write_accuracy(study, arguments.output)
    return 0
