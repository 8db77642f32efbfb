"""The argument of commands that run on several processes."""

from __future__ import annotations

import os
from argparse import ArgumentParser, ArgumentTypeError


def add_jobs_argument(parser: ArgumentParser, remark: str = "") -> None:
    """Adds ``--jobs``; the remark says what one process is good for."""
    text = f"worker processes (1 if left out{remark and f', {remark}'})"
    parser.add_argument("--jobs", type=_jobs, default=1, metavar="N", help=text)


def _jobs(text: str) -> int:
    most = 4 * (os.cpu_count() or 1)
    if not text.isdecimal() or not 1 <= int(text) <= most:
        raise ArgumentTypeError(f"{text!r} is not a number of processes from 1 to {most}")
    return int(text)
