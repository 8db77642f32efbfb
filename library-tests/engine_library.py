"""The installed contact engine."""

from __future__ import annotations

from cad2modelica.collision.contact_engine import ContactEngine
from cad2modelica.geometry.spatial import Array, Pose
from contact_data import contact_engine

__all__ = ["LIBRARY", "Array", "Engine", "Pose"]

LIBRARY = contact_engine()


class Engine:
    """Distances of one pair."""

    def __init__(self) -> None:
        self._engine = ContactEngine(LIBRARY)

    def signed_distance(self, first: str, first_pose: Pose, second: str, second_pose: Pose) -> float:
        """Of two bodies given by descriptors, in m; negative where they overlap."""
        return float(self._engine.signed_distances([first, second], [first_pose, second_pose], [(0, 1)])[0])
