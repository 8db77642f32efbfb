"""Descriptors and pairs: what a tool is given and what a scene looks at, seen in the flattened model."""

from __future__ import annotations

import random

import pytest
from library_compiler import Compiler


def test_long_literal_descriptor_survives(core: Compiler) -> None:
    numbers = random.Random(1)
    vertices = ",".join(f"{numbers.uniform(-0.1, 0.1):.17g}" for _ in range(3 * 2000))
    descriptor = f"cmb/1 hull vertices={vertices}"
    flat = core.model("ContactMultiBody.Examples.BallOnFloor", f'ball(geometry="{descriptor}")').to_dict("flat")
    assert flat["variables"]["ball.geometry"]["binding"]["Literal"]["value"] == {"String": descriptor}


@pytest.mark.full
def test_pairs_default_to_all(core: Compiler) -> None:
    flat = core.flatten("ContactMultiBodyTest.Scenes.AllParts")
    assert flat["variables"]["contacts.distance"]["dims"] == [5]
    every = core.model("ContactMultiBodyTest.Scenes.AllParts", "contacts(pairs=fill(0,0,2))").to_dict("flat")
    assert every["variables"]["contacts.distance"]["dims"] == [15]
