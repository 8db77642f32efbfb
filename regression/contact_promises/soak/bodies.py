"""Random bodies of small scenes."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass


@dataclass(frozen=True)
class Body:
    """A body: call of its shape, mass in kg, principal moments in kg.m2, radius of its bounding sphere in m."""

    shape: str
    mass: float
    moments: tuple[float, float, float]
    radius: float


def random_body(source: random.Random) -> Body:
    """Of any analytic shape, a few centimetres large; its frame is in its centre of mass."""
    kind = source.choice(("sphere", "box", "capsule", "cylinder", "cone", "ellipsoid"))
    mass = 10.0 ** source.uniform(-1.5, 0.7)
    if kind == "sphere":
        r = source.uniform(0.02, 0.1)
        return Body(f"sphere({r:.4g})", mass, (0.4 * mass * r**2,) * 3, r)
    if kind in ("capsule", "cylinder"):
        r, length = source.uniform(0.01, 0.05), source.uniform(0.03, 0.2)
        across = mass * (3.0 * r**2 + length**2) / 12.0
        return Body(f"{kind}({r:.4g}, {length:.4g})", mass, (across, across, mass * r**2 / 2.0), r + length / 2.0)
    if kind == "cone":  # its frame in its centre of mass
        r, length = source.uniform(0.02, 0.07), source.uniform(0.03, 0.15)
        across = mass * (12.0 * r**2 + 3.0 * length**2) / 80.0
        shape = f"cone({r:.4g}, {length:.4g}, position={{0,0,{length / 4.0:.6g}}})"
        return Body(shape, mass, (across, across, 0.3 * mass * r**2), max(0.75 * length, math.hypot(r, length / 4.0)))
    x, y, z = (source.uniform(0.03, 0.15) for _ in range(3))
    share = 12.0 if kind == "box" else 20.0
    moments = tuple(mass * s / share for s in (y**2 + z**2, x**2 + z**2, x**2 + y**2))
    radius = (x**2 + y**2 + z**2) ** 0.5 / 2.0
    return Body(f"{kind}({{{x:.4g},{y:.4g},{z:.4g}}})", mass, (moments[0], moments[1], moments[2]), radius)
