"""`cmb mission`: a mission driven by its scripted operator, or a record of it, and the score."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from cmb.build_arguments import add_build_arguments
from cmb.generation_arguments import add_generation_arguments
from cmb.input_file import check_input
from cmb.run_folder import REPORT, RESULT
from cmb.terminal import progress_bars

NAME = "mission"
SUMMARY = "drive a mission by its scripted operator, or score a record of it"
DESCRIPTION = (
    "Builds the machine and the course of a mission (Resources/missions), lets its scripted operator drive it as fast "
    "as it can be computed, and tells goal, time, path and collisions by positions and contact forces. With --score, a "
    "record that cmb drive made of the mission is scored instead."
)
EXAMPLES = """examples:
  cmb mission Resources/missions/cart.toml
  cmb mission Resources/missions/anton.toml --output out/anton-mission
  cmb mission Resources/missions/cart.toml --score out/cart/result.csv
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("mission", type=Path, metavar="TOML", help="the mission")
    parser.add_argument("--score", type=Path, metavar="CSV", help="record to score, instead of driving")
    parser.add_argument("--output", type=Path, metavar="FOLDER", help="to write to (out/NAME-mission if left out)")
    add_build_arguments(parser)
    add_generation_arguments(parser)


def run(arguments: Namespace) -> int:
    """Drives or scores, and prints the score; the status is 1 where the goal is not reached."""
    check_input(arguments.mission, arguments.score)
    from fmu_regression.report.simulation_report import write_report
    from fmu_regression.results.result import read_csv, write_csv
    from fmu_regression.scene.signals import signals_for
    from interactive_drive.mission.mission_file import read_mission
    from interactive_drive.mission.play import play
    from interactive_drive.mission.score import score, table

    from cmb.mission_machine import build_mission

    mission = read_mission(arguments.mission)
    folder = arguments.output or Path("out") / f"{arguments.mission.stem}-mission"
    with progress_bars() as progress:
        built = build_mission(arguments, mission, folder, progress)
        if arguments.score is not None:
            result = read_csv(arguments.score)
        else:
            result = play(mission, built.fmu, built.scene, signals_for(built.scene, built.description), progress)
            write_csv(result, folder / RESULT)
            write_report(result, built.scene_file, folder / REPORT)
    made = score(mission, built.scene, result)
    print(table(made))
    if arguments.score is None:
        print(f"  {'written':<15}{folder}: {RESULT}, {REPORT}")
    return 0 if made.reached is not None else 1
