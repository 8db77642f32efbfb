"""`cmb assign`: which components stand at which joints, by questions and answers."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from contact_foundation.errors import InputError, Place

from cmb.assembly_file import ASSEMBLY_HELP, find_assembly

NAME = "assign"
SUMMARY = "assign actuators to the joints of an assembly by questions and answers"
DESCRIPTION = (
    "Lists the joints of an assembly and the components of ContactMultiBody.Actuators, asks which stand where and with "
    "which parameters, and writes actuators.toml beside the assembly. `cmb generate` writes the mechatronic model from "
    "it. Answers may also come from a pipe."
)
EXAMPLES = """examples:
  cmb assign Resources/cad/hammer
  printf 'shoulder\\nServo\\n200\\n5\\n\\n\\n\\n' | \\
    cmb assign robot/robot.xml --actuators robot/servos.toml
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("assembly", type=Path, metavar="ASSEMBLY", help=ASSEMBLY_HELP)
    parser.add_argument(
        "--actuators", type=Path, metavar="TOML", help="file to read and write (actuators.toml beside the assembly)"
    )


def run(arguments: Namespace) -> int:
    """Asks, and writes the file."""
    path = find_assembly(arguments.assembly)
    from cad2modelica import SourceChoices, read_assembly
    from cad2modelica.actuators.file import FILE_NAME, drivable_joints, read_assignments, write_assignments
    from cad2modelica.kinematics.kinematic_graph import kinematic_tree
    from cad2modelica.kinematics.loops import analyse_loops

    from cmb.assignment_dialog import Dialog

    file: Path = arguments.actuators or path.parent / FILE_NAME
    assembly = read_assembly(path, choices=SourceChoices(allow_missing=True))
    loops = analyse_loops(assembly, kinematic_tree(assembly))
    joints = drivable_joints(assembly, loops)
    if not joints:
        raise InputError(
            "has no joint that can be driven",
            place=Place(file=path),
            remedy="Revolute, screw and prismatic joints can be, if they do not close a planar loop.",
        )
    earlier = read_assignments(file, assembly, loops) if file.is_file() else ()
    assignments = Dialog(joints, earlier, input, print).run()
    if assignments is None or assignments == earlier:
        print(f"{file}: not changed")
    elif assignments:
        write_assignments(file, assembly.name, assignments)
        print(f"{file}: {len(assignments)} component{'s' if len(assignments) != 1 else ''}")
    else:
        file.unlink(missing_ok=True)
        print(f"{file}: no component is left; the file was removed")
    return 0
