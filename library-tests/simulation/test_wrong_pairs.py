"""Pairs that name no two bodies of the scene are told by their row, before anything indexes with them."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_foundation.errors import InputError
from library_compiler import REPOSITORY
from modelica2fmu.build import BuildOptions, build_fmu

MODEL = """model Pairs
  inner Modelica.Mechanics.MultiBody.World world;
  ContactMultiBody.Parts.Body ball(m=1, r_CM={0,0,0}, geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(n=2, pairs={PAIRS}, geometry={ball.geometry, floor.geometry},
    material={ball.material, floor.material});
equation
  connect(ball.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
end Pairs;
"""


@pytest.mark.parametrize(
    ("pairs", "row"),
    [
        ("{1,2},{2,2}", "row 2 of pairs is {2,2}"),
        pytest.param("{1,3}", "row 1 of pairs is {1,3}", marks=pytest.mark.full),
        pytest.param("{0,2}", "{0,2}", marks=pytest.mark.full),
    ],
)
def test_wrong_row_is_named(tmp_path: Path, pairs: str, row: str) -> None:
    source = tmp_path / "Pairs.mo"
    source.write_text(MODEL.replace("PAIRS", pairs))
    options = BuildOptions(msl=REPOSITORY / "Resources" / "MultiBodyCore", cache=None)
    with pytest.raises(InputError) as caught:
        build_fmu("Pairs", [source, REPOSITORY / "ContactMultiBody"], tmp_path / "Pairs.fmu", options)
    assert row in str(caught.value)
    assert "two different numbers between 1 and n = 2" in str(caught.value)
    assert not (tmp_path / "Pairs.fmu").exists()
