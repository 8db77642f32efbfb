"""What the user may choose against the source: parts held in the world, limits without stops."""

from __future__ import annotations

from pathlib import Path

import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import GenerateOptions, generate
from contact_foundation.errors import InputError

LIMITS = '<limits lower="-1" upper="2"/>'


def mechanics(folder: Path, options: GenerateOptions) -> str:
    joints = [joint("hinge", "revolute", "a", "b", axis=(0, 1, 0), extra=LIMITS)]
    file = write_assembly(folder / "pair.xml", [part("a"), part("b")], joints)
    return (generate(file, folder / "out", options).root / "Mechanics.mo").read_text()


@pytest.mark.parametrize(("stops", "count"), [(None, 1), (True, 1), (False, 0)])
def test_stops_of_an_assembly(tmp_path: Path, stops: bool | None, count: int) -> None:
    assert mechanics(tmp_path, GenerateOptions(stops=stops)).count("Actuators.Rotational.EndStop ") == count


def test_held_part_is_fixed_where_it_stands(tmp_path: Path) -> None:
    free = mechanics(tmp_path, GenerateOptions())
    assert "Parts.FreeBody a(" in free
    held = mechanics(tmp_path, GenerateOptions(ground=("a",), accept_structure=True))
    assert "Parts.FreeBody" not in held
    assert "connect(world.frame_b, a.frame_a)" in held


def test_unknown_part_is_refused_and_parts_are_listed(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no part 'c' to ground") as caught:
        mechanics(tmp_path, GenerateOptions(ground=("c",)))
    assert "a, b" in str(caught.value)
    assert not (tmp_path / "out").exists()
