"""`cmb simulate`: an FMU to a CSV of trajectories."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from dataclasses import asdict
from pathlib import Path

from contact_foundation.errors import Place
from contact_foundation.output import check_file

from cmb.assignments import parse_assignments
from cmb.input_file import check_input
from cmb.number_arguments import positive_seconds
from cmb.simulation_arguments import add_simulation_arguments
from cmb.terminal import progress_bars

NAME = "simulate"
SUMMARY = "simulate an FMU and write its trajectories as CSV"
DESCRIPTION = (
    "Simulates an FMU (FMI 2.0 or 3.0) through FMPy, by model exchange with CVODE or by the co-simulation solver "
    "inside it."
)
EXAMPLES = """examples:
  cmb simulate ball.fmu --output ball.csv
  cmb simulate ball.fmu --output ball.csv --stop 3 --tolerance 1e-8 --mode cs
  cmb simulate ball.fmu --output ball.csv \\
    --signal 'ball.r_0[3]' --set ball.m=2
  cmb simulate hammer.fmu --output hammer.csv --scene model/scene.json
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("fmu", type=Path, metavar="FMU", help="the FMU file")
    parser.add_argument("--output", type=Path, required=True, metavar="CSV", help="file to write")
    add_simulation_arguments(parser)
    parser.add_argument("--max-step", type=positive_seconds, metavar="S", help="longest solver step in s")
    parser.add_argument("--mode", choices=("me", "cs"), default="me", help="model exchange or co-simulation")
    parser.add_argument(
        "--signal", action="append", metavar="NAME", help="variable to record, repeatable (outputs and states if none)"
    )
    parser.add_argument(
        "--scene",
        type=Path,
        metavar="FILE",
        help="scene file of the generated package, or the FMU itself where its model is hand-written: what "
        "`cmb report --scene` needs is recorded too",
    )
    parser.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="start value of a parameter, repeatable"
    )


def run(arguments: Namespace) -> int:
    """Simulates and says what was written."""
    check_file(arguments.output)
    check_input(arguments.fmu, arguments.scene)
    parameters = parse_assignments(arguments.set)
    from fmu_regression.fmi.description import read_description
    from fmu_regression.results.result import write_csv
    from fmu_regression.results.undefined import undefined_remarks
    from fmu_regression.scene.fmu_scene import load_scene_of
    from fmu_regression.scene.signals import require_signals, signals_for
    from fmu_regression.simulate.simulation import default_signals, simulate

    signals = arguments.signal
    if arguments.scene is not None:
        scene, description = load_scene_of(arguments.scene), read_description(arguments.fmu)
        require_signals(
            scene, description.variables, Place(file=arguments.fmu), f"Is {arguments.scene} the scene of this FMU?"
        )
        chosen = signals if signals is not None else default_signals(description)
        signals = list(dict.fromkeys([*chosen, *signals_for(scene, description)]))
    with progress_bars() as progress:
        result = simulate(
            arguments.fmu,
            signals=signals,
            stop=arguments.stop,
            tolerance=arguments.tolerance,
            interval=arguments.interval,
            mode=arguments.mode,
            max_step=arguments.max_step,
            parameters=parameters,
            time_limit=arguments.time_limit,
            progress=progress,
        )
    write_csv(result, arguments.output)
    span = result.time[-1] - result.time[0]
    print(f"{arguments.output}: {len(result.time)} rows, {span:g} s simulated in {result.wall_time:.2f} s")
    if result.counters is not None:
        counters = ", ".join(f"{value} {name.replace('_', ' ')}" for name, value in asdict(result.counters).items())
        print(f"  {counters}")
    for line in undefined_remarks(result):
        print(f"cmb: {arguments.output.name}: {line}", file=sys.stderr)
    for line in result.log:
        print(f"cmb: {arguments.fmu.name} says: {line}", file=sys.stderr)
    return 0
