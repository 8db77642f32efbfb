"""Managers in which nothing can touch are refused with what to do."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_foundation.errors import InputError
from library_compiler import REPOSITORY
from modelica2fmu.build import BuildOptions, build_fmu

MODEL = """model Lonely
  inner Modelica.Mechanics.MultiBody.World world;
  ContactMultiBody.Parts.Body ball(m=1, r_CM={0,0,0}, geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.Parts.Body other(m=1, r_CM={0,0,0}, GEOMETRY);
  ContactMultiBody.MANAGER contacts(n=COUNT, COLLIDERS);
equation
  connect(ball.frame_a, contacts.frame[1]);
end Lonely;
"""
SECOND = "  connect(other.frame_a, contacts.frame[2]);\nend"
SHAPE = "geometry=ContactMultiBody.Shapes.sphere(0.2)"


def refused(folder: Path, text: str) -> str:
    """What the builder says about a model that it refuses."""
    source = folder / "Lonely.mo"
    source.write_text(text)
    options = BuildOptions(msl=REPOSITORY / "Resources" / "MultiBodyCore", cache=None)
    with pytest.raises(InputError) as caught:
        build_fmu("Lonely", [source, REPOSITORY / "ContactMultiBody"], folder / "Lonely.fmu", options)
    return str(caught.value)


OTHERS = [pytest.param(each, marks=pytest.mark.full) for each in ("VolumeContactManager", "CompiledContactManager")]


@pytest.mark.parametrize("manager", ["ContactManager", *OTHERS])
def test_one_body(tmp_path: Path, manager: str) -> None:
    text = MODEL.replace("MANAGER", manager).replace("COUNT", "1").replace("COLLIDERS", "collider={ball.collider}")
    said = refused(tmp_path, text.replace("GEOMETRY", SHAPE))
    assert "contacts.n is 1" in said


def test_one_body_in_tools_that_pass_over_bounds(tmp_path: Path) -> None:
    text = """model Lonely
  parameter Integer numbers=sum(ContactMultiBody.Internal.pairsLookedAt(fill(0, 0, 2), 1, 0));
end Lonely;
"""
    said = refused(tmp_path, text)
    assert "n = 1, and a contact takes two bodies" in said
    assert "Parts.Ground" in said


@pytest.mark.full
@pytest.mark.parametrize("manager", ["ContactManager", OTHERS[0]])
@pytest.mark.parametrize(
    ("geometry", "colliders"),
    [(SHAPE, "pairs={{1,2}}"), ('geometry=""', "collider={ball.collider, other.collider}")],
    ids=["colliders not given", "one shape"],
)
def test_no_pair_of_shapes(tmp_path: Path, manager: str, geometry: str, colliders: str) -> None:
    text = MODEL.replace("MANAGER", manager).replace("COUNT", "2").replace("COLLIDERS", colliders)
    said = refused(tmp_path, text.replace("GEOMETRY", geometry).replace("\nend", f"\n{SECOND}"))
    assert "Nothing can touch" in said
    assert "collider={body1.collider, ...}" in said
