"""Values as Modelica text."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

SIGNIFICANT_LENGTH = 12  # decimals of derived lengths (m): below the rounding of exported coordinates
SIGNIFICANT_DIRECTION = 15  # decimals of derived unit vectors


def number(value: float) -> str:
    """The shortest text that reads back to the same number; whole numbers without a point."""
    real = float(value)
    if real == 0.0:
        return "0"
    text = repr(real).removesuffix(".0")
    return text.replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def vector(values: ArrayLike) -> str:
    """A Modelica array of numbers."""
    return "{" + ",".join(number(value) for value in np.asarray(values, dtype=np.float64)) + "}"


def string(text: str) -> str:
    """A Modelica string literal on one line."""
    plain = " ".join(text.split())
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'


def array(items: Iterable[str]) -> str:
    """A Modelica array of expressions."""
    return "{" + ",".join(items) + "}"


def html(text: str) -> str:
    """Text for a documentation string: HTML special characters and Modelica's quotes escaped."""
    escaped = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return escaped.replace("\\", "\\\\").replace('"', "&quot;")


def tidy_length(values: ArrayLike) -> np.ndarray:
    """Rounds derived lengths (m) to what exported coordinates mean."""
    return np.round(np.asarray(values, dtype=np.float64), SIGNIFICANT_LENGTH) + 0.0


def tidy_direction(values: ArrayLike) -> np.ndarray:
    """Rounds a derived unit vector."""
    return np.round(np.asarray(values, dtype=np.float64), SIGNIFICANT_DIRECTION) + 0.0
