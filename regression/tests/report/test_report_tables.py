"""Tables of a report hold all that happened."""

from __future__ import annotations

from pathlib import Path

import pytest
from fmu_regression.report.contacts import contact_section, impact_section
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.impacts import find_impacts
from fmu_regression.scene.scene_file import load_scene
from synthetic import bouncing_ball, hammer, write_scene


def test_many_impacts_are_all_in_the_table(tmp_path: Path) -> None:
    content, result = hammer(rows=200)
    scene = load_scene(write_scene(content, tmp_path / "scene.json"))
    impacts = find_impacts(scene, result)
    assert impacts
    many = (impacts * (2000 // len(impacts) + 1))[:2000]
    section = impact_section(scene, many)
    assert section is not None
    assert len(section.tables[0].rows) == 2000
    assert not [note for note in section.notes if "left out" in note]


@pytest.mark.parametrize(("distance", "told"), [(-0.0095, True), (-1e-12, False), (0.2, False)])
def test_an_overlap_at_the_start_is_named(tmp_path: Path, distance: float, told: bool) -> None:
    content, result, _ = bouncing_ball(0.5)
    scene = load_scene(write_scene(content, tmp_path / "scene.json"))
    shifted = result["contacts.distance[1]"].copy()
    shifted[0] = distance
    signals = {**result.signals, "contacts.distance[1]": shifted}
    section = contact_section(scene, SimulationResult(time=result.time, signals=signals))
    assert section is not None
    assert bool([note for note in section.notes if "overlap at the start by 9.5 mm" in note]) == told
