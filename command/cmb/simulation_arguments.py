"""The arguments of commands that simulate: how far, how exactly, how often and how long."""

from __future__ import annotations

from argparse import ArgumentParser

from cmb.number_arguments import positive_seconds, relative_tolerance, seconds


def add_simulation_arguments(parser: ArgumentParser, *, stop: str = "the model's own", repeats: bool = False) -> None:
    """Adds ``--stop``, ``--tolerance``, ``--interval`` and ``--time-limit``.

    Args:
        parser: to add them to.
        stop: whose stop time counts if none is given.
        repeats: whether several tolerances may be given.
    """
    parser.add_argument("--stop", type=seconds, metavar="S", help=f"stop time in s ({stop} if left out)")
    parser.add_argument(
        "--tolerance",
        type=relative_tolerance,
        action="append" if repeats else "store",
        metavar="TOL",
        help="relative tolerance of the solver" + (", repeatable (1e-3 to 1e-10)" if repeats else ""),
    )
    parser.add_argument("--interval", type=positive_seconds, metavar="S", help="output interval in s")
    add_time_limit(parser)


def add_time_limit(parser: ArgumentParser) -> None:
    """Adds ``--time-limit``."""
    parser.add_argument(
        "--time-limit", type=positive_seconds, metavar="S", help="wall time in s after which a simulation is given up"
    )
