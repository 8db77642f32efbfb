"""Functions of generated code are of bounded length, since compilers need more than linear time for long ones."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from contact_data import modelica_library
from contact_foundation.progress import silent
from modelica2fmu.library.standard_library import find_standard_library
from modelica2fmu.phases import PhaseClock
from modelica2fmu.translation import translate

BODIES = 8  # of which each can touch each: the tangents of the manager's one call are some 1500 numbers
MODEL = """model Cloud "Spheres, each of which may touch each"
  inner Modelica.Mechanics.MultiBody.World world;
  ContactMultiBody.Parts.FreeBody ball[{n}](
    each m=1, each r_CM={{0,0,0}}, each I_11=0.004, each I_22=0.004, each I_33=0.004,
    each geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.ContactManager contacts(
    n={n},
    geometry={{ball[i].geometry for i in 1:{n}}},
    material={{ball[i].material for i in 1:{n}}});
equation
  for i in 1:{n} loop
    connect(ball[i].frame_a, contacts.frame[i]);
  end for;
end Cloud;
"""
FUNCTION = re.compile(r"^(?:static )?(?:int|fmurt_result) (fmurt_\w+)\(.*?^}", re.MULTILINE | re.DOTALL)
LONGEST = 120_000  # characters; a function of 1200 operations has about a third of that


@pytest.mark.full
def test_no_function_grows_with_the_model(tmp_path: Path) -> None:
    source = tmp_path / "Cloud.mo"
    source.write_text(MODEL.format(n=BODIES))
    sources = [source, modelica_library()]
    translation = translate("Cloud", sources, find_standard_library(), PhaseClock(silent))
    sizes = {
        found[1]: len(found[0])
        for part in translation.generated.sources
        if part.name.startswith("model_part")
        for found in FUNCTION.finditer(part.text)
    }
    assert any("tangent_numbers" in name for name in sizes)
    assert any("tangent_cluster" in name for name in sizes)
    too_long = {name: size for name, size in sizes.items() if size > LONGEST}
    assert not too_long
