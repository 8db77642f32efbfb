"""One convex shape and its text for the contact engine."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cad2modelica.geometry.spatial import IDENTITY, Array, Pose

PRISM_SIDES = 32
INLINE_CORNERS = 12  # of a hull that stays in the text: a block with a chamfered face
FILE_ERROR = 1e-6  # of a hull's size: what single precision may move a corner


@dataclass(frozen=True, eq=False)
class CollisionShape:
    """One convex shape of a body.

    Attributes:
        kind: "sphere", "box", "cylinder", "cone", "capsule" or "hull".
        pose: of the shape's frame in the body's.
        radius: of spheres, cylinders, cones (of the base) and capsules, m.
        length: of a cylinder, a cone or a capsule's segment, m.
        size: full lengths of a box, m.
        vertices: corners of a hull in the body's frame, shape (n, 3), m.
    """

    kind: str
    pose: Pose = IDENTITY
    radius: float = 0.0
    length: float = 0.0
    size: tuple[float, float, float] = (0.0, 0.0, 0.0)
    vertices: Array | None = None

    @staticmethod
    def hull(corners: Array) -> CollisionShape:
        """A convex hull; many corners, which go into a file, are rounded to that file's single precision.

        Args:
            corners: in the body's frame, shape (n, 3), m.
        """
        rounded = corners.astype(np.float32).astype(np.float64)
        coarse = np.abs(rounded - corners).max() > FILE_ERROR * np.ptp(corners, axis=0).max()
        return CollisionShape("hull", vertices=corners if len(corners) <= INLINE_CORNERS or coarse else rounded)

    @property
    def file_corners(self) -> Array | None:
        """Corners of a hull that belongs into a file, which are single precision numbers; None of all else."""
        corners = self.vertices
        if corners is None or len(corners) <= INLINE_CORNERS:
            return None
        return corners if (corners.astype(np.float32) == corners).all() else None

    @property
    def outline(self) -> tuple[Array, float]:
        """Points of the body's frame, shape (n, 3), whose convex hull, grown by a margin (m), holds the shape.

        It is the shape, but for cylinders and cones, about which it is a prism or a pyramid.
        """
        if self.vertices is not None:
            return self.pose.point(self.vertices), 0.0
        if self.kind == "box":
            signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
            return self.pose.point(signs * np.array(self.size) / 2), 0.0
        if self.kind in ("cylinder", "cone"):
            angles = 2 * np.pi * np.arange(PRISM_SIDES) / PRISM_SIDES
            around = self.radius / np.cos(np.pi / PRISM_SIDES)
            ring = np.column_stack([around * np.cos(angles), around * np.sin(angles), np.zeros(PRISM_SIDES)])
            half = np.array([0.0, 0.0, self.length / 2])
            top = ring + half if self.kind == "cylinder" else half[None]
            return self.pose.point(np.concatenate([ring - half, top])), 0.0
        return self.pose.point(np.array([[0, 0, -self.length / 2], [0, 0, self.length / 2]])), self.radius

    @property
    def descriptor(self) -> str:
        """The contact engine's text for the shape."""
        words = ["cmb/1", self.kind]
        if self.kind == "box":
            words.append(f"size={_numbers(np.array(self.size))}")
        elif self.kind == "hull" and self.vertices is not None:
            words.append(f"vertices={_numbers(self.vertices.ravel())}")
        else:
            words.append(f"radius={_number(self.radius)}")
        if self.kind in ("cylinder", "cone", "capsule"):
            words.append(f"length={_number(self.length)}")
        if self.pose.position.any():
            words.append(f"position={_numbers(self.pose.position)}")
        if (self.pose.rotation != np.eye(3)).any():
            words.append(f"rotation={_numbers(self.pose.rotation.T.ravel())}")
        return " ".join(words)


def _number(value: float) -> str:
    number = float(value)
    return "0" if number == 0.0 else repr(number).removesuffix(".0")


def _numbers(values: Array) -> str:
    return ",".join(_number(value) for value in values)
