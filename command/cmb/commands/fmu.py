"""`cmb fmu`: a Modelica model to an FMU."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from contact_foundation.errors import InputError
from contact_foundation.output import check_file, whole_file
from contact_foundation.progress import Progress

from cmb.build_arguments import add_build_arguments, build_options, fmi_version
from cmb.modelica_sources import find_sources
from cmb.terminal import progress_bars

if TYPE_CHECKING:
    from modelica2fmu.build import BuildReport
    from modelica2fmu.openmodelica import OpenModelicaReport

NAME = "fmu"
SUMMARY = "build an FMU from a Modelica model, with the contact engine inside"
DESCRIPTION = (
    "Translates a Modelica model into an FMU (FMI 2.0 or 3.0) for model exchange and co-simulation. No Modelica tool "
    "is needed, but OpenModelica can be asked for; the Modelica Standard Library is used where one is found (see "
    "`cmb msl`). An FMU of the same files is taken from the user's cache."
)
EXAMPLES = """examples:
  cmb fmu ContactMultiBody.Examples.BallOnFloor --output ball.fmu
  cmb fmu Robot.Mechatronics --source ./Robot --fmi 3 --output robot.fmu --log
  cmb fmu Robot.Mechatronics --source ./Robot \\
    --tolerance 1e-5 --max-step 0.001 --log build.log
  cmb fmu Robot.Mechatronics --source ./Robot --outputs poses,forces
  cmb fmu Robot.Mechatronics --source ./Robot --tool omc
  cmb fmu Robot.Mechatronics --source ./Robot --platform linux64,win64
  cmb fmu ReferenceModels.DoublePendulum \\
    --source ReferenceModels.mo --msl /opt/ModelicaStandardLibrary
"""

_PRINT = Path("-")
_WARNINGS = 5  # that are shown; --log has all


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("model", metavar="MODEL", help="qualified name of the model")
    parser.add_argument(
        "--source", type=Path, action="append", default=[], metavar="PATH", help="Modelica file or package folder"
    )
    parser.add_argument("--output", type=Path, metavar="FMU", help="file to write (the model's last name if left out)")
    parser.add_argument(
        "--platform",
        default="linux64",
        metavar="NAMES",
        help="platforms to build for, separated by commas: linux64 (if left out), win64, aarch64-linux; the last two "
        "need scripts/setup cross",
    )
    parser.add_argument(
        "--tool",
        choices=("builtin", "omc"),
        default="builtin",
        help="translate by the built-in translator or by OpenModelica, which must be installed",
    )
    parser.add_argument(
        "--tolerance",
        type=float,
        metavar="TOL",
        help="relative tolerance of co-simulation (the model's own)",
    )
    parser.add_argument(
        "--max-step", type=float, metavar="S", help="longest step of co-simulation in s (the communication step)"
    )
    parser.add_argument(
        "--max-steps", type=int, metavar="N", help="steps after which co-simulation gives up a communication step"
    )
    parser.add_argument(
        "--log",
        type=Path,
        nargs="?",
        const=_PRINT,
        metavar="FILE",
        help="print what was chosen (states, blocks, index reduction, times), or write it to a file",
    )
    add_build_arguments(parser)


def run(arguments: Namespace) -> int:
    """Builds the FMU and says what was built."""
    output = arguments.output or Path(arguments.model.split(".")[-1] + ".fmu")
    check_file(output)
    if arguments.log is not None and arguments.log != _PRINT:
        check_file(arguments.log)
    build = _by_openmodelica if arguments.tool == "omc" else _by_translator
    with progress_bars() as progress:
        report = build(arguments, output, progress)
    for warning in report.warnings[:_WARNINGS]:
        print(f"cmb: warning: {warning}", file=sys.stderr)
    if len(report.warnings) > _WARNINGS:
        print(f"cmb: {len(report.warnings) - _WARNINGS} more warnings: see --log", file=sys.stderr)
    print(report.summary())
    if arguments.log == _PRINT:
        sys.stdout.write(report.text() + "\n")
    elif arguments.log is not None:
        with whole_file(arguments.log) as staging:
            staging.write_text(report.text() + "\n", encoding="utf-8")
    return 0


def _by_translator(arguments: Namespace, output: Path, progress: Progress) -> BuildReport:
    sources = find_sources(arguments.model, arguments.source)
    from modelica2fmu.build import build_fmu
    from modelica2fmu.packaging import SolverOptions
    from modelica2fmu.packaging.platforms import find_platforms

    platforms = tuple(arguments.platform.split(","))
    find_platforms(platforms)
    given = {
        "relative_tolerance": arguments.tolerance,
        "maximum_step": arguments.max_step,
        "maximum_steps": arguments.max_steps,
    }
    solver = SolverOptions(**{name: value for name, value in given.items() if value is not None})
    options = replace(build_options(arguments, solver), platforms=platforms)
    return build_fmu(arguments.model, sources, output, options, progress)


def _by_openmodelica(arguments: Namespace, output: Path, progress: Progress) -> OpenModelicaReport:
    if arguments.platform != "linux64":
        raise InputError("--platform is for the built-in translator", remedy="leave it out, or --tool omc")
    for option in ("tolerance", "max_step", "max_steps", "outputs"):
        if getattr(arguments, option) is not None:
            name = option.replace("_", "-")
            raise InputError(f"--{name} is for the built-in translator", remedy="leave it out, or --tool omc")
    sources = find_sources(arguments.model, arguments.source)
    from modelica2fmu.library.standard_library import find_standard_library
    from modelica2fmu.openmodelica import export_fmu

    return export_fmu(
        arguments.model,
        sources,
        output,
        find_standard_library(arguments.msl),
        fmi_version(arguments),
        progress=progress,
    )
