"""Volume and moments of inertia of primitives in closed form."""

from __future__ import annotations

import numpy as np

from cad2modelica.geometry.spatial import Array


def solid_moments(kind: str, size: Array) -> tuple[float, Array]:
    """Volume and principal moments about the centre at density 1.

    Args:
        kind: box, ellipsoid, sphere, cylinder, capsule, or cone (about z, its tip up, the centre a quarter up).
        size: half lengths, semi-axes, or radius and half the height, shape (3,), m.
    """
    a, b, c = size
    if kind in ("box", "ellipsoid"):
        share = 3.0 if kind == "box" else 5.0
        volume = 8.0 * a * b * c if kind == "box" else 4.0 / 3.0 * np.pi * a * b * c
        return float(volume), volume / share * np.array([b * b + c * c, a * a + c * c, a * a + b * b])
    ball = 4.0 / 3.0 * np.pi * a**3
    if kind == "sphere":
        return float(ball), np.full(3, 0.4 * ball * a * a)
    if kind == "cone":
        third = np.pi * a * a * 2 * b / 3.0
        across = third * (0.15 * a * a + 0.15 * b * b)  # 3/20 r^2 + 3/80 h^2
        return float(third), np.array([across, across, 0.3 * third * a * a])
    tube = np.pi * a * a * 2 * b
    across = tube * (3 * a * a + 4 * b * b) / 12.0
    along = tube * a * a / 2.0
    if kind == "cylinder":
        return float(tube), np.array([across, across, along])
    # Two half balls, whose centres lie 3/8 of the radius beyond the cylinder's ends.
    across += ball * (0.4 * a * a + 0.75 * a * b + b * b)
    return float(tube + ball), np.array([across, across, along + 0.4 * ball * a * a])
