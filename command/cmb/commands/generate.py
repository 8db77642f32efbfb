"""`cmb generate`: a CAD assembly to a Modelica package."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from cad2modelica import generate

from cmb.assembly_file import find_assembly
from cmb.terminal import progress_bars

NAME = "generate"
SUMMARY = "CAD assembly (XML and VRML) to a Modelica package"
DESCRIPTION = (
    "Reads an assembly (XML with parts, joints, masses and inertias; VRML geometry) and writes a Modelica "
    "package with the mechanical model and the mechatronic model that extends it."
)
EXAMPLES = """examples:
  cmb generate Resources/cad/hammer --output out/model
  cmb generate robot/robot.xml --output out/robot
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument(
        "assembly", type=Path, metavar="ASSEMBLY", help="the assembly's XML file, or the folder with it"
    )
    parser.add_argument("--output", type=Path, required=True, metavar="FOLDER", help="folder to write the package into")


def run(arguments: Namespace) -> int:
    """Generates the package and says what was written."""
    with progress_bars() as progress:
        package = generate(find_assembly(arguments.assembly), arguments.output, progress=progress)
    print(f"{package.name}: {package.root}")
    for note in package.notes:
        print(f"- {note}")
    return 0
