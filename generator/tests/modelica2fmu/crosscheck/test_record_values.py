"""Fields of a record that has a value as a whole keep it where other fields are modified, or the model is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_data import core_subset
from contact_foundation.errors import UnsupportedModelError
from modelica2fmu.build import translate
from modelica2fmu.library.standard_library import StandardLibrary

LIBRARY = StandardLibrary(core_subset(), "", "core subset")
PACKAGE = """package R
  record Base
    parameter Real e = 0.5;
    parameter Real mu = 0.4;
    parameter Real E = 1e7;
  end Base;
  record Steel
    extends Base(E = 2e11);
  end Steel;
  model Body
    parameter Base material;
    Real y = material.e + 10*material.mu + material.E;
  end Body;
  model Scene
    parameter Real k = 0.7;
    parameter Base bronze(mu = 0.2);
    Body ball(material = Base(e = k));
    Body box(material = Steel(e = 0.3));
    Body cup(material = bronze);
    Body jar(material(mu = 0.1, E = 3));
  end Scene;
  model Changed
    extends Scene(CHANGE);
  end Changed;
end R;
"""


def changed(folder: Path, change: str) -> None:
    file = folder / "R.mo"
    file.write_text(PACKAGE.replace("(CHANGE)", f"({change})" if change else ""))
    translate("R.Changed", [file], LIBRARY)


@pytest.mark.parametrize(
    "change",
    [
        "",
        "k = 0.6",
        "ball(material = Steel(e = 0.2))",
        "box(material = Base(mu = 2*k))",
        "cup(material = Base(k, 0.1, 2e9))",
        "jar(material = Steel(e = 0.2))",  # over fields that the class below gives
    ],
)
def test_whole_records_and_other_parameters_may_be_modified(tmp_path: Path, change: str) -> None:
    changed(tmp_path, change)


@pytest.mark.parametrize(
    ("change", "lost"),
    [
        # Only the argument, which is a name, tells that the record's value is forgotten.
        ("ball(material(E = 3))", "k through to ball.material.e, which would be 0.5"),
        ('ball(material(E(displayUnit = "GPa")))', "k through to ball.material.e, which would be 0.5"),
        ("ball(material(mu(min = 0.1)))", "k through to ball.material.e, which would be 0.5"),
        ("box(material(mu(min = 0.1)))", "0.3 through to box.material.e, which would be 0.5"),
        ("cup(material(e(min = 0.1)))", "bronze through to cup.material.mu, which would be 0.4"),
    ],
)
def test_a_record_that_would_lose_its_value_is_refused(tmp_path: Path, change: str, lost: str) -> None:
    with pytest.raises(UnsupportedModelError) as caught:
        changed(tmp_path, change)
    assert lost in caught.value.message
    assert caught.value.place is not None
    assert caught.value.place.line == (23 if "E = 3" in change else caught.value.place.line)
    assert "give the whole record there" in (caught.value.remedy or "")


@pytest.mark.parametrize("change", ["ball(material(e = 0.9))", "ball(material(e = k/2))", "box(material(e = k))"])
def test_a_field_beside_the_value_of_its_record_is_refused_where_it_is_modified(tmp_path: Path, change: str) -> None:
    with pytest.raises(UnsupportedModelError) as caught:
        changed(tmp_path, change)
    assert "has one as a whole: tools differ in which one holds" in caught.value.message
    assert caught.value.place is not None
    assert caught.value.place.line == 23
