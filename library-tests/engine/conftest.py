"""The installed contact engine, asked through the C interface."""

from __future__ import annotations

import pytest
from cad2modelica.collision.contact_engine import ContactEngine
from cad2modelica.geometry.spatial import Pose
from contact_data import contact_engine
from distance_samples import SignedDistance


@pytest.fixture(scope="session")
def signed_distance() -> SignedDistance:
    """Of two bodies given by descriptors and poses, in m; negative where they overlap."""
    library = contact_engine()
    if not library.is_file():
        pytest.skip("the contact engine is not installed (scripts/setup)")
    engine = ContactEngine(library)

    def distance(first: str, first_pose: Pose, second: str, second_pose: Pose) -> float:
        return float(engine.signed_distances([first, second], [first_pose, second_pose], [(0, 1)])[0])

    return distance
