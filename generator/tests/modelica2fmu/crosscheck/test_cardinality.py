"""Connectors that are connected as whole arrays count as connected, or the model is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError, UnsupportedModelError
from modelica2fmu.build import translate
from modelica2fmu.library.standard_library import StandardLibrary

LIBRARY = StandardLibrary(core_subset(), "", "core subset")

# A part that asserts that it is connected, as elementary joints of the Standard Library do, and one that chooses its
# equations so, as forces along a line do there.
PARTS = """
  connector Pin
    Real x;
    flow Real f;
  end Pin;
  model Source
    Pin p;
  equation
    p.x = time;
  end Source;
  model Load
    Pin p;
  equation
    assert(cardinality(p) > 0, "Connector p is not connected");
    p.f = 3*p.x;
  end Load;
  model Chooser
    Pin p;
    Real y;
  equation
    p.f = 3*p.x;
    if cardinality(p) > 0 then
      y = p.x;
    else
      y = 0;
    end if;
  end Chooser;
"""
EACH = "for i in 1:2 loop connect({0}[i].p, {1}[i].p); end for;"


def test_arrays_count_as_connected(simulate) -> None:
    text = f"model Whole\n  Source s[2];\n  Load load[2];\n  Real y = load[2].p.f;{PARTS}equation\n"
    result = simulate(text + "  connect(s.p, load.p);\nend Whole;\n", ["y"])
    np.testing.assert_allclose(result["y"], 3 * result["time"], atol=1e-9)


def test_one_element_that_is_not_connected_is_told(tmp_path: Path) -> None:
    text = f"model Some\n  Source s[2];\n  Load load[3];{PARTS}equation\n  connect(s.p, load[1:2].p);\nend Some;\n"
    (tmp_path / "Some.mo").write_text(text)
    with pytest.raises(InputError, match="Connector p is not connected"):
        translate("Some", [tmp_path / "Some.mo"], LIBRARY)


@pytest.mark.parametrize("declared", ["Chooser load[2];", "Chooser[2] load;"])
def test_equations_that_depend_on_connections_are_refused(tmp_path: Path, declared: str) -> None:
    text = f"model Whole\n  Source s[2];\n  {declared}{PARTS}equation\n  connect(s.p, load.p);\nend Whole;\n"
    (tmp_path / "Whole.mo").write_text(text)
    with pytest.raises(UnsupportedModelError, match="cardinality") as caught:
        translate("Whole", [tmp_path / "Whole.mo"], LIBRARY)
    assert "connect(s[i].p, load[i].p)" in (caught.value.remedy or "")
    assert caught.value.place is not None
    assert caught.value.place.line == 3 + PARTS.count("\n") + 1


def test_what_the_message_says_works(simulate) -> None:
    text = f"model Each\n  Source s[2];\n  Chooser load[2];\n  Real y = load[2].y;{PARTS}equation\n"
    result = simulate(text + f"  {EACH.format('s', 'load')}\nend Each;\n", ["y"])
    np.testing.assert_allclose(result["y"], result["time"], atol=1e-9)
