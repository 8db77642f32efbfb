"""Arguments of the commands that make collision shapes."""

from __future__ import annotations

from argparse import ArgumentParser


def add_collision_arguments(parser: ArgumentParser) -> None:
    """Adds what says how finely concave parts are decomposed."""
    parser.add_argument(
        "--collision-error",
        type=float,
        metavar="LENGTH",
        help="concavity a piece of a concave part may keep, in the assembly's unit of length (URDF: m); "
        "2.5 %% of the body's size if left out",
    )
    parser.add_argument(
        "--max-pieces", type=int, metavar="N", help="largest number of pieces of a concave part (16 if left out)"
    )
    parser.add_argument(
        "--decomposer",
        choices=("coacd", "vhacd"),
        help="what splits concave parts: coacd (along planes; if left out) or vhacd (by voxels; pieces with fewer "
        "corners)",
    )
