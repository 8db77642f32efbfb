"""Functions are written without control flow for the front end, and have it again behind it."""

from __future__ import annotations

import numpy as np
import pytest
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.frontend.rewriting.straight_line import straight_line

COUNT = """  function count "counts"
    input Integer m;
    output Integer n;
  algorithm
    n := 0; // so far
    for i in 1:10 loop
      if i > m then
        break;
      end if;
      n := n + 1
        "one more";
    end for;
    annotation(Inline = false);
  end count;
"""


def test_lines_and_all_else_stay():
    text = f"package P\n{COUNT}  model M\n    Real x = 2*time; /* function f */\n  end M;\nend P;\n"
    written = straight_line(text)
    assert "loop" not in written
    assert written.count("\n") == text.count("\n")
    before, after = text.splitlines(), written.splitlines()
    assert [place for place, line in enumerate(before) if line != after[place]] == [*range(4, 13)]


@pytest.mark.parametrize(
    "function",
    [
        "function f = g(a = 2);",
        'function f input Real x; output Real y; external "C" y = sin(x); end f;',
        "function f input Real x; output Real y = x; end f;",
        "function f input Real x; output Real y; algorithm when x > 1 then y := 1; end when; end f;",
        "function f input Real i; output Real y; algorithm for i in 1:3 loop y := i; end for; end f;",
        "function f output Real y; algorithm for n in 1:3 loop y := n; end for; y := n; end f;",
        "function f output Real y; algorithm for n in 1:n loop y := n; end for; end f;",
        "function f output Real y = n; algorithm y := sum(n for n in 1:3); end f;",
        "function f input Real x; output Real y; algorithm if x > 1 then y := 1;",
        "function f input Real x; output Real y; algorithm y := (x",
        "function",
    ],
)
def test_what_is_not_understood_stays(function):
    assert straight_line(function) == function


def test_functions_of_a_package_of_files(tmp_path, fmu_cache):
    package = tmp_path / "P"
    package.mkdir()
    package.joinpath("package.mo").write_text("package P\nend P;\n", encoding="utf-8")
    package.joinpath("count.mo").write_text(f"within P;\n{COUNT}", encoding="utf-8")
    model = "within P;\nmodel M\n  Real x = time*count(4);\nend M;\n"
    package.joinpath("M.mo").write_text(model, encoding="utf-8")
    build_fmu("P.M", [package], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    result = simulate_fmu(str(tmp_path / "M.fmu"), stop_time=1, output=["x"])
    np.testing.assert_allclose(result["x"], 4 * result["time"])


@pytest.mark.parametrize(
    ("size", "said"), [("n", "size of v cannot be"), ("count(3)", "size of v depends on the function count")]
)
def test_sizes_are_not_guessed(size, said, tmp_path, fmu_cache):
    """The front end computes sizes, and must not take what stands for outputs of functions that it cannot follow."""
    text = f"package P\n{COUNT}  model M\n    parameter Integer n = count(3);\n    Real v[{size}] = fill(time, 3);\n"
    source = tmp_path / "P.mo"
    source.write_text(f"{text}  end M;\nend P;\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"P\.mo:\d+") as caught:
        build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    assert said in str(caught.value)


def test_an_error_behind_it_has_its_line(tmp_path, fmu_cache):
    text = f"package P\n{COUNT}  model M\n    Real x = count(1)*time;\n    Real y = x + unknown;\n  end M;\nend P;\n"
    source = tmp_path / "P.mo"
    source.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="unknown") as caught:
        build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    assert caught.value.place is not None
    assert caught.value.place.line == 18


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("y := u[1:2]", "y has 4 elements, and what it is given has 2 elements"),
        ("v[1:2] := {1}", "a part of v has 2 elements, and what it is given has 1 element"),
        ("y[1] := u", "a part of y has no dimensions, and what it is given has 4 elements"),
        ("v := 3", "v has 3 elements, and what it is given has no dimensions"),
        ("y[1] := count(u[1:2])", "u wants 3 elements in dimension 1, not 2"),
    ],
)
def test_sizes_are_checked_behind_it(statement, said, tmp_path, fmu_cache):
    text = f"""package P
  function f
    input Real u[:];
    output Real y[size(u, 1)];
  protected
    Real v[3];
  algorithm
    y := u;
    {statement};
    if u[1] > 5 then
      return;
    end if;
  end f;
  function count
    input Real u[3];
    output Real y;
  algorithm
    y := 3;
    if u[1] > 5 then
      return;
    end if;
  end count;
  model M
    Real y = sum(f({{time, 2, 3, 4}}));
  end M;
end P;
"""
    source = tmp_path / "P.mo"
    source.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    assert said in str(caught.value)
