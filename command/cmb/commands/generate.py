"""`cmb generate`: a CAD assembly to a Modelica package."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from contact_foundation.output import check_folder

from cmb.assembly_file import ASSEMBLY_HELP, find_assembly
from cmb.generation_arguments import add_generation_arguments, generation_options
from cmb.notes import grouped
from cmb.terminal import progress_bars

NAME = "generate"
SUMMARY = "CAD assembly (XML and VRML, URDF, Simscape XML) to a Modelica package"
DESCRIPTION = (
    "Reads an assembly (XML with parts, joints, masses and inertias and VRML geometry; URDF; or what CAD plug-ins "
    "export for Simscape Multibody) and writes a Modelica package with the mechanical model and the mechatronic model "
    "that extends it. In a package that is there already "
    "the mechanical model is written anew; the mechatronic one only if the assignment of actuators has changed. Where "
    "parts or joints are others than before, nothing is written without consent."
)
EXAMPLES = """examples:
  cmb generate Resources/cad/hammer --output out/model
  cmb generate robot/robot.urdf --output out/robot \\
    --actuators robot/drives.toml
  cmb generate arm/arm.urdf --output out/arm --ground base_link --stops
  cmb generate arm/arm.urdf --output out/arm --stops --strict
  cmb generate robot/robot.xml --output out/robot --accept-structure
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("assembly", type=Path, metavar="ASSEMBLY", help=ASSEMBLY_HELP)
    parser.add_argument("--output", type=Path, required=True, metavar="FOLDER", help="folder to write the package into")
    add_generation_arguments(parser)


def run(arguments: Namespace) -> int:
    """Generates the package and says what was written."""
    assembly = find_assembly(arguments.assembly)
    check_folder(arguments.output)
    from cad2modelica import generate

    with progress_bars() as progress:
        package = generate(
            assembly,
            arguments.output,
            generation_options(arguments),
            progress,
        )
    print(f"{package.name}: {package.root}")
    for note in grouped(package.notes):
        print(f"- {note}")
    return 0
