"""Gravity against the axis that a CAD system calls up, and mechanisms whose parts do not touch."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from cad2modelica.mechanism.assembly_choices import with_up, without_contacts
from cad2modelica.reading import read_assembly
from contact_foundation.errors import InputError


@pytest.mark.parametrize(
    ("up", "gravity"), [(None, [0, 0, -9.81]), ("y", [0, -9.81, 0]), ("-x", [9.81, 0, 0]), ("z", [0, 0, -9.81])]
)
def test_gravity_points_against_up(pendulum: Path, up: str | None, gravity: list[float]) -> None:
    assembly = read_assembly(pendulum)
    assert with_up(assembly, up).gravity == pytest.approx(gravity)


def test_the_sources_strength_of_gravity_is_kept(pendulum: Path) -> None:
    moon = read_assembly(pendulum)
    moon = replace(moon, gravity=moon.gravity / 6)
    assert with_up(moon, "y").gravity == pytest.approx([0, -9.81 / 6, 0])


def test_other_axes_are_refused(pendulum: Path) -> None:
    with pytest.raises(InputError, match="'w' is no axis"):
        with_up(read_assembly(pendulum), "w")


def test_without_contacts_only_named_pairs_touch(pendulum: Path) -> None:
    assembly = read_assembly(pendulum)
    assert without_contacts(assembly, True) is assembly
    assert not without_contacts(assembly, False).contacts.all_pairs
