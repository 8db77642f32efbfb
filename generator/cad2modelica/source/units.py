"""Factors from the units of CAD exports to SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

LENGTH = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
MASS = {"kg": 1.0, "g": 0.001, "t": 1000.0, "lb": 0.45359237}
ANGLE = {"rad": 1.0, "deg": math.pi / 180.0}


Quantity = TypeVar("Quantity", float, NDArray[np.float64])


def to_si(value: Quantity, factor: float) -> Quantity:
    """Multiplies by a unit's factor; divides where its reciprocal is whole (mm, cm, g), which rounds only once."""
    reciprocal = round(1.0 / factor)
    exact = reciprocal > 1 and abs(1.0 / factor - reciprocal) < 1e-9 * reciprocal
    return value / reciprocal if exact else value * factor


@dataclass(frozen=True)
class UnitSystem:
    """Factors to metre, kilogram and radian."""

    length: float
    mass: float
    angle: float

    @property
    def inertia(self) -> float:
        """Factor to kg.m2."""
        return self.mass * self.length**2
