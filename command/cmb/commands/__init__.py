"""The subcommands of `cmb`, one module each.

A command module has `NAME`, `SUMMARY`, `DESCRIPTION`, `EXAMPLES`, `add_arguments(parser)` and
`run(arguments) -> exit status`.
"""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Protocol

from cmb.commands import (
    accuracy,
    advise,
    assign,
    depth_study,
    drive,
    effects,
    fmu,
    generate,
    hard,
    joints,
    mission,
    msl,
    regress,
    report,
    run,
    simulate,
    study,
)


class Command(Protocol):
    """What a command module provides."""

    NAME: str
    SUMMARY: str
    DESCRIPTION: str
    EXAMPLES: str

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Adds the command's arguments."""

    def run(self, arguments: Namespace) -> int:
        """Carries the command out and returns the exit status."""


ALL_COMMANDS: tuple[Command, ...] = (
    run,
    generate,
    joints,
    assign,
    fmu,
    simulate,
    report,
    regress,
    accuracy,
    study,
    hard,
    effects,
    advise,
    drive,
    mission,
    depth_study,
    msl,
)
