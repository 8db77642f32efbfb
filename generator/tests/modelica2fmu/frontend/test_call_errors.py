"""Calls with wrong arguments are told at their line, with what the function takes, whatever else the model has."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.translation import translate

# The front end takes the concatenation only when it is written out; what else is wrong must not be hidden by that.
MODEL = """model M
  function twice
    input Real factor;
    input Real b = 1;
    output Real y;
  protected
    Real z;
  algorithm
    y := 2*factor*b;
  end twice;
  record Material
    Real mu = 0.1;
  end Material;
  model Body
    parameter Material material;
  end Body;
  model Manager
    parameter Material material[3];
    Real mu = sum(material.mu)*time;
  end Manager;
  Body ball[2];
  Body floor;
  Manager contacts(material = {material});
  Real x(start = 0, fixed = true);
equation
  der(x) = twice(1, 2) +
    {call};
end M;
"""
ARRAYS = ["{ball[1].material, ball[2].material, floor.material}", "cat(1, ball.material, {floor.material})"]


def refused(folder: Path, material: str, call: str) -> InputError:
    text = MODEL.replace("{material}", material).replace("{call}", call)
    (folder / "M.mo").write_text(text)
    with pytest.raises(InputError) as caught:
        translate("M", [folder / "M.mo"], StandardLibrary(core_subset(), "", "core subset"))
    return caught.value


@pytest.mark.parametrize("material", ARRAYS, ids=["plain", "cat"])
@pytest.mark.parametrize(
    ("call", "line", "message"),
    [
        ("twice(1, c=2)", 27, "twice has no input c"),
        ("twice(1, 2, 3)", 26, "twice takes at most 2 arguments, not 3"),
        ("twice(b=2)", 26, "a call of twice gives no value to factor"),
        ("twice(1, factor=2)", 27, "a call of twice gives a value to factor more than once"),
    ],
)
def test_wrong_arguments(tmp_path: Path, material: str, call: str, line: int, message: str) -> None:
    error = refused(tmp_path, material, call)
    assert error.message == message
    assert error.place is not None
    assert (error.place.file, error.place.line) == (tmp_path / "M.mo", line)
    assert error.remedy == "it takes factor, b"


@pytest.mark.parametrize("material", ARRAYS, ids=["plain", "cat"])
def test_sizes_are_told_where_they_do_not_fit(tmp_path: Path, material: str) -> None:
    error = refused(tmp_path, material, "{1, 2}*time")
    assert "sizes of arrays do not fit each other" in error.message
    assert error.place is not None
    assert error.place.line in (26, 27)


def test_a_function_of_a_library_is_told_with_its_inputs(tmp_path: Path) -> None:
    error = refused(tmp_path, ARRAYS[0], "Modelica.Math.Vectors.length(w={1, 2, 3})")
    assert error.message == "Modelica.Math.Vectors.length has no input w"
    assert error.remedy == "it takes v"
