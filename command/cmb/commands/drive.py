"""`cmb drive`: a machine simulated in real time, driven from a page in the browser."""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from pathlib import Path

from cmb.assignments import parse_assignments
from cmb.build_arguments import add_build_arguments
from cmb.generation_arguments import add_generation_arguments
from cmb.input_file import check_input
from cmb.number_arguments import port, relative_tolerance

NAME = "drive"
SUMMARY = "drive a machine in real time from a page in the browser"
DESCRIPTION = (
    "Simulates an FMU, or an assembly's, in real time and opens a page on this machine: the machine in 3-D with its "
    "contact forces, live plots, inputs as sliders, keys and gamepad axes; pause, step, speed, reset, saved states, "
    "records with a report. The page's address holds a token and opens once; the terminal shows one for a further "
    "operator, who watches. Ctrl-C ends it. Other machines reach it by --listen alone."
)
EXAMPLES = """examples:
  cmb drive Resources/cad/anton
  cmb drive Resources/missions/cart.toml
  cmb drive out/hammer/hammer.fmu --set shoulder.phi0=0.5
  cmb drive robot.fmu --controls controls.toml --tune gain
  cmb drive Resources/cad/anton --headless --minutes 1
  cmb drive robot.fmu --listen 192.168.1.5 --certificate a.pem --key a.key
  cmb drive robot.fmu --channel bandwidth=64kbit,delay=200ms,jitter=20ms,loss=1%
"""
_DEFAULT_STEP = 0.01


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument(
        "machine", type=Path, metavar="FMU|ASSEMBLY|MISSION", help="FMU, assembly or its folder, mission (TOML)"
    )
    parser.add_argument(
        "--scene", type=Path, metavar="JSON", help="what is drawn (model/scene.json beside the FMU if left out)"
    )
    parser.add_argument("--port", type=port, metavar="PORT", help="of this machine (8420; 0: any free one)")
    parser.add_argument(
        "--listen",
        metavar="ADDRESS",
        help="address or name of this machine by which others reach the page (127.0.0.1, for this machine alone)",
    )
    parser.add_argument("--certificate", type=Path, metavar="PEM", help="certificate of the address, for encryption")
    parser.add_argument("--key", type=Path, metavar="PEM", help="its key, if it is not in the certificate's file")
    parser.add_argument(
        "--insecure", action="store_true", help="listen for others without encryption, on a network that you trust"
    )
    parser.add_argument(
        "--channel", metavar="LIMITS", help="simulate a poor channel: bandwidth=64kbit,delay=200ms,jitter=20ms,loss=1%%"
    )
    parser.add_argument("--step", type=_step, default=_DEFAULT_STEP, metavar="S", help="communication step in s (0.01)")
    parser.add_argument(
        "--tolerance", type=relative_tolerance, metavar="TOL", help="relative tolerance of the FMU's solver"
    )
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="start value, repeatable")
    parser.add_argument(
        "--tune", action="append", default=[], metavar="NAME", help="tunable parameter to show as a slider, repeatable"
    )
    parser.add_argument("--controls", type=Path, metavar="TOML", help="keys and gamepad axes (see docs/drive.md)")
    parser.add_argument("--plot", action="append", metavar="NAME", help="signal plotted at first, repeatable")
    parser.add_argument("--output", type=Path, metavar="FOLDER", help="of records (out/NAME-drive if left out)")
    parser.add_argument("--no-browser", action="store_true", help="open no browser, show the address alone")
    parser.add_argument("--headless", action="store_true", help="measure deadlines, latency and jitter, print a table")
    parser.add_argument(
        "--minutes", type=_minutes, default=1.0, metavar="M", help="how long --headless measures, in minutes (1)"
    )
    add_build_arguments(parser)
    add_generation_arguments(parser)


def run(arguments: Namespace) -> int:
    """Serves until interrupted, or measures."""
    check_input(arguments.machine, arguments.scene, arguments.controls, arguments.certificate, arguments.key)
    parse_assignments(arguments.set)
    from cmb.drive_preparation import require_packages

    require_packages()
    from cmb.drive_preparation import drive, measure

    return measure(arguments) if arguments.headless else drive(arguments)


def _step(text: str) -> float:
    value = float(text)
    if not 1e-4 <= value <= 1.0:
        raise ArgumentTypeError(f"{text} is no step for driving: give 0.0001 to 1 s")
    return value


def _minutes(text: str) -> float:
    value = float(text)
    if not 0 < value <= 24 * 60:
        raise ArgumentTypeError(f"{text} is not between 0 and 1440")
    return value
