"""Numbers on the command line that can be told to be wrong before anything is built."""

from __future__ import annotations

import math
from argparse import ArgumentTypeError


def seconds(text: str) -> float:
    """A finite time, s."""
    value = _number(text)
    if not math.isfinite(value):
        raise ArgumentTypeError(f"{text} is no finite time")
    return value


def positive_seconds(text: str) -> float:
    """A positive, finite time, s."""
    value = seconds(text)
    if value <= 0.0:
        raise ArgumentTypeError(f"{text} must be positive")
    return value


def relative_tolerance(text: str) -> float:
    """A solver's relative tolerance."""
    return share(text)


def share(text: str) -> float:
    """A number between 0 and 1, both excluded."""
    value = _number(text)
    if not 0.0 < value < 1.0:
        raise ArgumentTypeError(f"{text} must lie between 0 and 1")
    return value


def count(text: str) -> int:
    """A whole number from 1 to 100000."""
    return _whole(text, 1, 100_000)


def seed(text: str) -> int:
    """What random numbers begin with: a whole number that is not negative, of 63 bits at most."""
    return _whole(text, 0, 2**63 - 1)


def port(text: str) -> int:
    """The number of a network port; 0 stands for any that is free."""
    return _whole(text, 0, 2**16 - 1)


def _whole(text: str, least: int, most: int) -> int:
    try:
        value = int(text)
    except ValueError as error:
        raise ArgumentTypeError(f"{text!r} is no whole number") from error
    if not least <= value <= most:
        raise ArgumentTypeError(f"{text} is not between {least} and {most}")
    return value


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        raise ArgumentTypeError(f"{text!r} is no number") from error
