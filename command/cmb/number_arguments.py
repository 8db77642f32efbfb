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
    value = _number(text)
    if not 0.0 < value < 1.0:
        raise ArgumentTypeError(f"{text} must lie between 0 and 1")
    return value


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        raise ArgumentTypeError(f"{text!r} is no number") from error
