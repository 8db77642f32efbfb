"""`cmb fmu`: a Modelica model to an FMU."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.packaging import FmiVersion

from cmb.modelica_sources import find_sources
from cmb.terminal import progress_bars

NAME = "fmu"
SUMMARY = "build an FMU from a Modelica model, with the contact engine inside"
DESCRIPTION = (
    "Translates a Modelica model into an FMU (FMI 2.0 or 3.0) for model exchange and co-simulation. No Modelica tool "
    "is needed; the Modelica Standard Library is used where one is found (see `cmb msl`)."
)
EXAMPLES = """examples:
  cmb fmu ContactMultiBody.Examples.BallOnFloor --output ball.fmu
  cmb fmu Robot.Mechatronics --source ./Robot --output robot.fmu
  cmb fmu Robot.Mechatronics --source ./Robot --fmi 3 --output robot3.fmu
  cmb fmu ReferenceModels.DoublePendulum --source ReferenceModels.mo --msl /opt/ModelicaStandardLibrary
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("model", metavar="MODEL", help="qualified name of the model")
    parser.add_argument(
        "--source", type=Path, action="append", default=[], metavar="PATH", help="Modelica file or package folder"
    )
    parser.add_argument("--output", type=Path, metavar="FMU", help="file to write (the model's last name if left out)")
    parser.add_argument(
        "--fmi", choices=("2", "3"), default="2", help="version of the FMI standard: 2.0 (if left out) or 3.0"
    )
    parser.add_argument("--msl", type=Path, metavar="FOLDER", help="folder that holds the Modelica Standard Library")
    parser.add_argument("--log", action="store_true", help="print what was chosen: states, blocks, index reduction")


def run(arguments: Namespace) -> int:
    """Builds the FMU and says what was built."""
    output = arguments.output or Path(arguments.model.split(".")[-1] + ".fmu")
    with progress_bars() as progress:
        report = build_fmu(
            arguments.model,
            find_sources(arguments.model, arguments.source),
            output,
            BuildOptions(msl=arguments.msl, fmi=FmiVersion(f"{arguments.fmi}.0")),
            progress,
        )
    print(f"{output}: {len(report.states)} states, {report.event_indicators} event indicators")
    if arguments.log:
        print(report.text())
    return 0
