"""`cmb generate`: a CAD assembly to a Modelica package."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from cad2modelica import GenerateOptions, generate

from cmb.assembly_file import find_assembly
from cmb.collision_arguments import add_collision_arguments
from cmb.terminal import progress_bars

NAME = "generate"
SUMMARY = "CAD assembly (XML and VRML, or URDF) to a Modelica package"
DESCRIPTION = (
    "Reads an assembly (XML with parts, joints, masses and inertias and VRML geometry; or URDF) and writes a Modelica "
    "package with the mechanical model and the mechatronic model that extends it."
)
EXAMPLES = """examples:
  cmb generate Resources/cad/hammer --output out/model
  cmb generate robot/robot.urdf --output out/robot --actuators robot/drives.toml
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument(
        "assembly", type=Path, metavar="ASSEMBLY", help="the assembly's XML or URDF file, or its folder"
    )
    parser.add_argument("--output", type=Path, required=True, metavar="FOLDER", help="folder to write the package into")
    parser.add_argument("--package", metavar="NAME", help="name of the Modelica package (the assembly's if left out)")
    parser.add_argument(
        "--actuators",
        type=Path,
        metavar="TOML",
        help="which actuators drive which joints (actuators.toml beside the assembly if left out)",
    )
    add_collision_arguments(parser)


def run(arguments: Namespace) -> int:
    """Generates the package and says what was written."""
    with progress_bars() as progress:
        package = generate(
            find_assembly(arguments.assembly),
            arguments.output,
            GenerateOptions(
                package=arguments.package,
                actuators=arguments.actuators,
                collision_error=arguments.collision_error,
                max_pieces=arguments.max_pieces,
            ),
            progress,
        )
    print(f"{package.name}: {package.root}")
    for note in package.notes:
        print(f"- {note}")
    return 0
