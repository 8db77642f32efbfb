"""The command line program `cmb`: reads its arguments, runs one subcommand, turns errors into messages."""

from __future__ import annotations

import argparse
import errno
import io
import os
import signal
import sys
import textwrap
import threading
import time
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import FrameType

from contact_foundation.errors import EXIT_FAILURE, EXIT_INPUT, NO_ROOM, CmbError

# Errors of the operating system that come from a path the user gave.
_WRONG_PATHS = {
    errno.ENOENT,
    errno.EEXIST,
    errno.ENOTDIR,
    errno.EISDIR,
    errno.EACCES,
    errno.EPERM,
    errno.EROFS,
    errno.ELOOP,
    errno.ENAMETOOLONG,
}


_REMOVAL = 5.0  # s, in which what is half-written is removed


class _Interrupted(KeyboardInterrupt):
    """A signal that ends the program; ``number`` is the signal's."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number


class _HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """Folds prose to the terminal's width; lines that are indented, such as examples, stay as they are."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        lines = (line if line.startswith(" ") else textwrap.fill(line, width) for line in text.splitlines())
        return "\n".join(indent + line for line in lines)


def build_parser() -> argparse.ArgumentParser:
    """The argument parser with every subcommand."""
    from cmb.commands import ALL_COMMANDS  # here, so that an interruption while packages load is told as any other

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
            formatter_class=_HelpFormatter,
        )
        command.add_arguments(sub)
        sub.set_defaults(run=command.run)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs `cmb`.

    Args:
        arguments: the words after the program's name; those of the process if left out.

    Returns:
        The exit status: 0, 2 for wrong input, 1 for any other failure, 128 and its number when a signal interrupted it.
    """
    try:
        _prepare_streams()
        parsed = build_parser().parse_args(arguments)
        with _signals_interrupt():  # not before: Python drops what is raised in callbacks of some imports
            return _run(parsed)
    except KeyboardInterrupt as interruption:
        number = interruption.number if isinstance(interruption, _Interrupted) else signal.SIGINT
        print("cmb: interrupted; nothing half-written was left behind", file=sys.stderr)
        return 128 + number


def _run(parsed: argparse.Namespace) -> int:
    try:
        status: int = parsed.run(parsed)
        sys.stdout.flush()
    except CmbError as error:
        if parsed.debug:
            raise
        print(f"cmb: {error}", file=sys.stderr)
        return error.exit_status
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_FAILURE
    except OSError as error:
        if parsed.debug:
            raise
        print(f"cmb: {_told(error)}", file=sys.stderr)
        return EXIT_INPUT if error.errno in _WRONG_PATHS else EXIT_FAILURE
    return status


def _told(error: OSError) -> str:
    """What the system refuses, with the file; where there is no room, the file that was to be written."""
    is_full = error.errno in NO_ROOM
    file = (error.filename2 if is_full else None) or error.filename
    remedy = "\n  Make room there; the variable TMPDIR names another folder for temporary files." if is_full else ""
    return f"{f'{file}: ' if file else ''}{error.strerror or error}{remedy}"


def _prepare_streams() -> None:
    """Standard streams that were closed lead nowhere; characters that the output's encoding lacks become escapes."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115
    if not sys.warnoptions:  # what a user should know is a note or an error, never a line of a library's source
        warnings.simplefilter("ignore")
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")


@contextmanager
def _signals_interrupt() -> Iterator[None]:
    """Lets SIGTERM and SIGHUP end the program as Ctrl-C does, so that what is half-written is removed.

    Signals soon after the first are those of a user who is impatient, and do not interrupt the removal.
    """
    first = -_REMOVAL

    def interrupt(number: int, _frame: FrameType | None) -> None:
        nonlocal first
        now = time.monotonic()
        if now - first >= _REMOVAL:
            first = now
            raise KeyboardInterrupt if number == signal.SIGINT else _Interrupted(number)

    is_main = threading.current_thread() is threading.main_thread()
    numbers = [signal.SIGTERM, signal.SIGHUP, signal.SIGINT] if is_main else []
    usual = (signal.SIG_DFL, signal.default_int_handler)  # nohup ignores SIGHUP
    taken = {number: signal.getsignal(number) for number in numbers if signal.getsignal(number) in usual}
    for number in taken:
        signal.signal(number, interrupt)
    try:
        yield
    finally:
        for number, handler in taken.items():
            signal.signal(number, handler)


if __name__ == "__main__":
    sys.exit(main())
