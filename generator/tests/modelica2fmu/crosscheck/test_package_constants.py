"""Constants that packages inherit with other values have them, or the model is refused.

Modelica Language Specification 3.6, section 7.2: a modifier in ``extends`` holds for all that is inherited.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_foundation.errors import UnsupportedModelError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

PACKAGES = """
  package Medium
    constant Real c = 2;
    constant Real d = 5 + 2*c;
    constant Integer n = 2;
    constant Boolean b = c > 3;
    constant Real v[2] = {c, 2*c};
    type Coordinate = Real(start = d);
    function scaled
      input Real u;
      output Real y;
    algorithm
      y := u*d;
    end scaled;
    record State
      Real a = c;
      Real b;
    end State;
    function together
      input Real u;
      output Real y;
    protected
      State s = State(b = u);
    algorithm
      y := s.a + s.b;
    end together;
    model Vessel
      State s = State(b = 10);
    end Vessel;
    model Part
      parameter Real q = d;
    end Part;
    model Loop
      Real x[4];
    equation
      for i in 1:n loop
        x[i] = i;
      end for;
      for i in n + 1:4 loop
        x[i] = 0;
      end for;
    end Loop;
    model Choice
      Real y;
    equation
      if c > 3 then
        y = 1;
      else
        y = 2;
      end if;
    end Choice;
    model Folded
      Real y = if b then 1 else 2;
    end Folded;
    model Started
      Coordinate x(fixed = true);
    equation
      der(x) = 0;
    end Started;
  end Medium;
  package Heavy
    extends Medium(c = 5, n = 3);
    constant Real own = 3*d;
  end Heavy;
  package Light = Medium(c = 1, n = 1);
  model Fluids
    replaceable package Fluid = Medium constrainedby Medium;
    Real y = Fluid.d + Fluid.v[2];
    Real z = if Fluid.b then 1 else 2;
    Real x[4];
  equation
    for i in 1:Fluid.n loop
      x[i] = i;
    end for;
    for i in Fluid.n + 1:4 loop
      x[i] = 0;
    end for;
  end Fluids;
  model Loops
    replaceable package Fluid = Medium constrainedby Medium;
    Fluid.Loop loop_;
    Fluid.Choice choice;
  end Loops;
"""

RIGHT = {
    "one package alone": ("Real y = Heavy.d; Real z = Heavy.v[2];", {"y": 15, "z": 10}),
    "its function": ("Real y = Heavy.scaled(2);", {"y": 30}),
    "the declaration alone": ("import P.Medium; Medium.Loop l; Medium.Choice c;", {"l.x[3]": 0, "c.y": 2}),
    "redeclared": ("Fluids f(redeclare package Fluid = Heavy);", {"f.y": 25, "f.z": 1, "f.x[3]": 3}),
    "two redeclared": (
        "Fluids f(redeclare package Fluid = Heavy); Fluids g(redeclare package Fluid = Light);",
        {"f.y": 25, "f.x[3]": 3, "g.y": 9, "g.z": 2, "g.x[2]": 0},
    ),
    "classes of a redeclared one": (
        "Loops f(redeclare package Fluid = Heavy);",
        {"f.loop_.x[3]": 3, "f.choice.y": 1},
    ),
}
# What the front end mixes up, so that packages are written out for it.
WRITTEN_OUT = {
    "computed": ("Real y = Medium.d; Real z = Heavy.d;", {"y": 9, "z": 15}),
    "array": ("Real y = Medium.v[2]; Real z = Heavy.v[2];", {"y": 4, "z": 10}),
    "computed from inherited": ("Real y = Medium.d; Real z = Heavy.own;", {"y": 9, "z": 45}),
    "short class": ("Real y = Medium.d; Real z = Light.d;", {"y": 9, "z": 7}),
    "two that inherit": ("Real y = Heavy.d; Real z = Light.d;", {"y": 15, "z": 7}),
    "function": ("Real y = Medium.scaled(2); Real z = Heavy.scaled(2);", {"y": 18, "z": 30}),
    "record in a function": ("Real y = Medium.together(10); Real z = Heavy.together(10);", {"y": 12, "z": 15}),
    "record in a model": (
        "import P.Medium; import P.Heavy; Medium.Vessel v; Heavy.Vessel w;",
        {"v.s.a": 2, "w.s.a": 5},
    ),
    "parameter": ("import P.Medium; import P.Heavy; Medium.Part p; Heavy.Part q;", {"p.q": 9, "q.q": 15}),
    "inherited class": (
        "import P.Medium; import P.Heavy; extends Heavy.Part; Medium.Part p;",
        {"q": 15, "p.q": 9},
    ),
    "condition": ("import P.Medium; import P.Heavy; Medium.Folded f; Heavy.Folded g;", {"f.y": 2, "g.y": 1}),
    "start of a type": ("import P.Medium; import P.Heavy; Medium.Started s; Heavy.Started t;", {"s.x": 9, "t.x": 15}),
    "loop": ("import P.Heavy; Heavy.Loop l;", {"l.x[3]": 3, "l.x[4]": 0}),
    "if-equation": ("import P.Heavy; Heavy.Choice c;", {"c.y": 1}),
    "loop in an alias": ("import P.Light; Light.Loop l;", {"l.x[1]": 1, "l.x[2]": 0}),
    "default beside a redeclared one": (
        "Fluids f(redeclare package Fluid = Heavy); Fluids g;",
        {"f.y": 25, "f.x[3]": 3, "g.y": 13, "g.x[2]": 2, "g.x[3]": 0},
    ),
}
# What it does not take when it is written out: a record of another package, and constants of what is redeclared.
REFUSED = {
    "records of two packages": (
        "package N model S constant Integer k = 1; package Q constant Real c = k; constant Real d = 2*c; end Q; end S;"
        " package T extends S.Q(c = 4); constant Integer k = 3; end T; end N; Real y = N.S.Q.d; Real z = N.T.d;"
    ),
}


QUICK = {"redeclared", "computed", "record in a function", "loop", "default beside a redeclared one"}


def built(folder: Path, declarations: str, cache: Path | None = None) -> Path:
    source = folder / "P.mo"
    text = declarations.replace("; ", ";\n    ")
    source.write_text(f"package P{PACKAGES}\n  model M\n    {text}\n  end M;\nend P;\n", encoding="utf-8")
    build_fmu("P.M", [source], folder / "M.fmu", BuildOptions(cache=cache))
    return folder / "M.fmu"


def quick_or_full(cases):
    return [each if each in QUICK else pytest.param(each, marks=pytest.mark.full) for each in cases]


@pytest.mark.parametrize("case", quick_or_full({**RIGHT, **WRITTEN_OUT}))
def test_constants_have_the_values_of_their_packages(case, tmp_path, fmu_cache):
    declarations, values = {**RIGHT, **WRITTEN_OUT}[case]
    result = simulate_fmu(str(built(tmp_path, declarations, fmu_cache)), output=list(values), stop_time=0.1)
    assert {name: float(result[name][-1]) for name in values} == pytest.approx(values)


@pytest.mark.parametrize("case", REFUSED)
def test_what_it_mixes_up_is_refused(case, tmp_path):
    with pytest.raises(UnsupportedModelError) as caught:
        built(tmp_path, REFUSED[case])
    assert "the front end does not keep them apart" in str(caught.value)
    assert caught.value.place.file == tmp_path / "P.mo"
    assert "declare the constant in each package" in str(caught.value)
