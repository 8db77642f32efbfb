"""Volume, surface and moments of inertia of primitives in closed form."""

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


def shell_moments(kind: str, size: Array) -> tuple[float, Array]:
    """Surface and principal moments about the centre of a thin shell at 1 kg/m2.

    An ellipsoid's surface is Thomsen's approximation (within 1.1 %), and its shell lies between it and one whose
    semi-axes are all longer by the same: as MuJoCo has it.

    Args:
        kind: box, ellipsoid, sphere, cylinder, or capsule, as ``solid_moments``.
        size: likewise.
    """
    a, b, c = size
    if kind == "box":
        faces = np.array([b * c, a * c, a * b])  # a quarter of one, and each is there twice
        squares = np.array([a * a, b * b, c * c])
        # About the centre: those at a right angle lie a half length away, all others are spread along it.
        spread = 8.0 * np.array([faces[k] * squares[k] + (faces.sum() - faces[k]) * squares[k] / 3 for k in range(3)])
        return float(8.0 * faces.sum()), spread.sum() - spread
    if kind == "ellipsoid":
        power = 1.6075
        products = np.array([a * b, a * c, b * c])
        area = 4.0 * np.pi * float(np.mean(products**power)) ** (1.0 / power)
        sums = np.array([b * b + c * c, a * a + c * c, a * a + b * b])
        growth = 2.0 * a * b * c / products.sum() * np.array([b + c, a + c, a + b])
        return area, area / 5.0 * (sums + growth)
    ball = 4.0 * np.pi * a * a
    if kind == "sphere":
        return float(ball), np.full(3, ball * a * a / 1.5)
    tube = 4.0 * np.pi * a * b
    across, along = tube * (a * a / 2.0 + b * b / 3.0), tube * a * a
    if kind == "cylinder":
        caps = 2.0 * np.pi * a * a
        across += caps * (a * a / 4.0 + b * b)
        return float(tube + caps), np.array([across, across, along + caps * a * a / 2.0])
    # Two half spheres, whose centres lie half the radius beyond the tube's ends.
    across += ball * (a * a / 1.5 + b * b + a * b)
    return float(tube + ball), np.array([across, across, along + ball * a * a / 1.5])
