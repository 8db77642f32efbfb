"""Models that are too large are refused with what makes them so."""

from __future__ import annotations

import pytest
from contact_foundation.errors import Place, UnsupportedModelError
from modelica2fmu.expand.size_check import MOST_SCALARS, require_tractable
from modelica2fmu.frontend import ir
from modelica2fmu.library.source_map import Span


def place(_: Span | None, name: str) -> Place:
    return Place(component=name)


def variables(count: int, *, are_contacts: bool) -> list[ir.Variable]:
    found = [ir.Variable("scene.contacts.pointForce", "Real", (count, 4, 3))]
    if are_contacts:
        found.append(ir.Variable("scene.contacts.pairDistance", "Real", (count,)))
    return found


def test_pairs_that_are_too_many_are_told_with_what_to_do() -> None:
    with pytest.raises(UnsupportedModelError) as refused:
        require_tractable(variables(MOST_SCALARS // 12, are_contacts=True), place)
    assert f"scene.contacts watches {MOST_SCALARS // 12} pairs of bodies" in refused.value.remedy
    assert "--exclude" in refused.value.remedy
    assert "CompiledContactManager" in refused.value.remedy


def test_other_arrays_are_told_to_be_made_smaller() -> None:
    require_tractable(variables(MOST_SCALARS // 12, are_contacts=False), place)
    with pytest.raises(UnsupportedModelError) as refused:
        require_tractable(variables(MOST_SCALARS // 12 + 1, are_contacts=False), place)
    assert "Make it smaller" in refused.value.remedy
