"""`cmb joints`: joints of a STEP assembly, proposed from its faces."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from contact_foundation.errors import InputError, Place

NAME = "joints"
SUMMARY = "propose the joints of a STEP assembly from its faces"
DESCRIPTION = (
    "Reads a STEP assembly and looks at which faces of its parts guide each other: shafts in holes (revolute, "
    "cylindrical), planes (prismatic, planar), balls in sockets (spherical). Parts without freedom against each other "
    "are one body. Writes NAME.joints.toml beside the file, with a confidence for each joint and the faces it was seen "
    "by; correct it, then `cmb generate` reads it. A file that was edited is never written anew without --overwrite."
)
EXAMPLES = """examples:
  cmb joints arm.step
  cmb generate arm.step --density 2700 --output out/arm
  cmb joints arm.step --output proposal.toml
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("step", type=Path, metavar="FILE.step", help="the assembly's STEP file")
    parser.add_argument(
        "--output", type=Path, metavar="TOML", help="file to write (NAME.joints.toml beside the assembly)"
    )
    parser.add_argument("--overwrite", action="store_true", help="replace a file that was edited")


def run(arguments: Namespace) -> int:
    """Proposes, writes the file and lists what it holds."""
    step: Path = arguments.step
    if not step.is_file() or step.suffix.lower() not in (".step", ".stp"):
        raise InputError(
            "is no STEP file" if step.exists() else "does not exist",
            place=Place(file=step),
            remedy="Name a file that ends with .step or .stp.",
        )
    from cad2modelica.brep.step_model import read_step
    from cad2modelica.step.joints_file import joints_file_of, require_unedited, write_proposal
    from cad2modelica.step.parts import named_parts, part_faces
    from cad2modelica.step.proposal import propose_joints

    file: Path = arguments.output or joints_file_of(step)
    if not arguments.overwrite:
        require_unedited(file)
    parts = named_parts(read_step(step))
    if not parts:
        raise InputError("holds no surface", place=Place(file=step), remedy="Export solids.")
    proposal = propose_joints(part_faces(parts))
    write_proposal(file, step.name, proposal)
    print(f"{file}: {len(parts)} parts, {len(proposal.bodies)} bodies of several, {len(proposal.joints)} joints")
    print(f"- {proposal.ground!r} is taken to stand in the world")
    for body in proposal.bodies:
        print(f"- one body: {', '.join(repr(name) for name in body.parts)}")
    for name in proposal.loose:
        print(f"- no face holds {name!r} to what stands: add its joint by hand")
    for joint in proposal.joints:
        used = "" if joint.use else " (not used)"
        print(
            f"- {joint.type.value}, {joint.confidence:.0%}{used}: {joint.child!r} to {joint.parent!r}; {joint.seen[0]}"
        )
    return 0
