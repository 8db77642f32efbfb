"""Arguments of the commands that generate a package: actuators, and consent to replace what is there."""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError, BooleanOptionalAction, Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from cmb.collision_arguments import add_collision_arguments

if TYPE_CHECKING:
    from cad2modelica import GenerateOptions


def add_generation_arguments(parser: ArgumentParser) -> None:
    """Adds the arguments."""
    parser.add_argument("--package", metavar="NAME", help="name of the Modelica package (the assembly's if left out)")
    parser.add_argument(
        "--actuators",
        type=Path,
        metavar="TOML",
        help="which actuators drive which joints (actuators.toml beside the assembly if left out)",
    )
    parser.add_argument(
        "--assemble", action="store_true", help="move parts so that joints close which the exported poses leave open"
    )
    parser.add_argument(
        "--ground",
        action="append",
        default=[],
        metavar="PART",
        help="hold this part (URDF: link) in the world where it stands; may be given several times",
    )
    parser.add_argument(
        "--up",
        choices=("x", "y", "z", "-x", "-y", "-z"),
        help="the axis of the source that points up, which CAD systems do not say (if left out z, or what the XML "
        "format's gravity says); write --up=-y",
    )
    parser.add_argument(
        "--no-contacts", action="store_true", help="parts do not touch each other, except pairs that --include names"
    )
    parser.add_argument(
        "--clearances",
        action="store_true",
        help="the distances of parts that are apart are exact; without it they are lower bounds, which cost less",
    )
    parser.add_argument(
        "--contact-manager",
        choices=("auto", "pairs", "compiled"),
        default="auto",
        help="pairs: each pair that may touch has variables of its own; compiled: each body has, which builds and runs "
        "faster, without anchored friction, exact clearances and impact events; auto (if left out): compiled from 201 "
        "pairs on",
    )
    parser.add_argument(
        "--tessellation",
        type=float,
        metavar="MM",
        help="STEP: largest distance of the triangles from the faces (a thousandth of each part's size if left out)",
    )
    parser.add_argument(
        "--stops",
        action=BooleanOptionalAction,
        help="joints have elastic stops at the limits of their range, or not (XML: they do, URDF: they do not)",
    )
    parser.add_argument(
        "--couple",
        action=BooleanOptionalAction,
        default=True,
        help="joints that are to follow others (mimic of URDF) do, or move by themselves",
    )
    parser.add_argument(
        "--accept-structure",
        action="store_true",
        help="replace a package whose parts or joints are others than those of the assembly now",
    )
    parser.add_argument(
        "--mechatronics",
        choices=("keep", "replace"),
        help="what happens to a mechatronic model edited by hand when the assignment of actuators has changed",
    )
    parser.add_argument(
        "--strict",
        action="store_true",
        help="what the assembly gives and the model would be without (a missing mesh, geometry of no part, limits, "
        "start speeds that do not count) is an error instead of a note; nothing is written then",
    )
    parser.add_argument(
        "--package-path",
        type=Path,
        action="append",
        default=[],
        metavar="FOLDER",
        help="meshes may also be read from this folder: URDF: a package that the file names, or a folder that holds "
        "such packages; may be given several times",
    )
    parser.add_argument(
        "--allow-missing",
        action="store_true",
        help="leave out meshes that cannot be read, and mates that no joint stands for, with a note; without it they "
        "are an error",
    )
    parser.add_argument(
        "--density",
        type=float,
        metavar="KG/M3",
        help="density of parts that have geometry and no mass (2700: aluminium); URDF: the root stands in the world",
    )
    parser.add_argument(
        "--exclude",
        type=_pair,
        action="append",
        default=[],
        metavar="A,B",
        help="these two parts (URDF: links) do not touch each other; may be given several times",
    )
    parser.add_argument(
        "--include",
        type=_pair,
        action="append",
        default=[],
        metavar="A,B",
        help="these two touch each other, even if they overlap at the start; may be given several times",
    )
    add_collision_arguments(parser)


def _pair(text: str) -> tuple[str, str]:
    first, comma, second = (word.strip() for word in text.partition(","))
    if not (first and comma and second):
        raise ArgumentTypeError(f"{text!r} is no pair; write two names with a comma between them")
    return first, second


def generation_options(arguments: Namespace) -> GenerateOptions:
    """What the arguments say."""
    from cad2modelica import Decomposer, Edited, GenerateOptions, ManagerChoice, SourceChoices

    return GenerateOptions(
        package=arguments.package,
        actuators=arguments.actuators,
        collision_error=arguments.collision_error,
        max_pieces=arguments.max_pieces,
        decomposer=None if arguments.decomposer is None else Decomposer(arguments.decomposer),
        accept_structure=arguments.accept_structure,
        edited=Edited.ASK if arguments.mechatronics is None else Edited(arguments.mechatronics),
        assemble=arguments.assemble,
        ground=tuple(arguments.ground),
        stops=arguments.stops,
        couple=arguments.couple,
        strict=arguments.strict,
        source=SourceChoices(
            tuple(arguments.package_path),
            arguments.allow_missing,
            arguments.density,
            None if arguments.tessellation is None else arguments.tessellation / 1000,
        ),
        exclude=tuple(arguments.exclude),
        include=tuple(arguments.include),
        up=arguments.up,
        contacts=not arguments.no_contacts,
        clearances=arguments.clearances,
        manager=ManagerChoice(arguments.contact_manager),
    )
