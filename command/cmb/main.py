"""The command line program `cmb`: reads its arguments, runs one subcommand, turns errors into messages."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence

from cmb_base.errors import EXIT_FAILURE, EXIT_INPUT, CmbError

from cmb.commands import ALL_COMMANDS


def build_parser() -> argparse.ArgumentParser:
    """The argument parser with every subcommand."""
    parser = argparse.ArgumentParser(
        prog="cmb",
        description="From a CAD assembly to a Modelica model that collides, an FMU and a report.",
        epilog="`cmb COMMAND --help` shows a command's options and examples.",
    )
    parser.add_argument("--debug", action="store_true", help="show the Python traceback of an error")
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    for command in ALL_COMMANDS:
        sub = commands.add_parser(
            command.NAME,
            help=command.SUMMARY,
            description=command.DESCRIPTION,
            epilog=command.EXAMPLES,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        command.add_arguments(sub)
        sub.set_defaults(run=command.run)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs `cmb`.

    Args:
        arguments: the words after the program's name; those of the process if left out.

    Returns:
        The exit status: 0, 2 for wrong input, 1 for any other failure, 130 when interrupted.
    """
    parsed = build_parser().parse_args(arguments)
    try:
        status: int = parsed.run(parsed)
    except CmbError as error:
        if parsed.debug:
            raise
        print(f"cmb: {error}", file=sys.stderr)
        return error.exit_status
    except KeyboardInterrupt:
        print("cmb: interrupted; nothing half-written was left behind", file=sys.stderr)
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_FAILURE
    except (FileNotFoundError, NotADirectoryError, PermissionError) as error:
        if parsed.debug:
            raise
        print(f"cmb: {error.filename}: {error.strerror}", file=sys.stderr)
        return EXIT_INPUT
    return status


if __name__ == "__main__":
    sys.exit(main())
