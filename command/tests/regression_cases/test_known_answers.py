"""Contact scenes with known answers come out as the closed forms say."""

from __future__ import annotations

from pathlib import Path

import pytest
from program import CaseCheck, cases_of

QUICK = {
    "backspin_ball",
    "ball_against_wall_100",
    "bouncing_ball",
    "box_on_edge",
    "falling_domino",
    "free_impact_without_events",
    "heavy_on_light",
    "incline_slides",
    "incline_sticks",
    "off_centre_impact",
    "plate_pushed_turns",
    "rolling_sphere",
    "second_strike",
    "sliding_block_anchored",
    "spinning_faces",
    "stack_of_boxes",
    "volume_impact",
}


@pytest.mark.parametrize("path", cases_of("known_answers", QUICK))
def test_case(path: Path, check_case: CaseCheck) -> None:
    check_case(path)
