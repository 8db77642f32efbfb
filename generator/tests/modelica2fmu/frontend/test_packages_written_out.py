"""Packages that extend others with modifiers are written out for the front end with what they inherit.

Names mean what they mean where they are written (Modelica Language Specification 3.6, 5.3), values are those of the
modifiers (7.2).
"""

from __future__ import annotations

from pathlib import Path

import pytest
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.frontend.rewriting.packages.written_packages import packages_written_out

MATERIALS = """package P
  constant Real g = 10;
  package Units
    type Length = Real(unit = "m");
  end Units;
  package Bases
    constant Real scale = 2;
    function twice
      input Real u;
      output Real y;
    algorithm
      y := 2*u;
    end twice;
    partial package Material "What all
      materials have"
      import U = P.Units;
      import P.Bases.twice;
      constant Real E = 1 "stiffness, of 1; // no comment";
      constant Real rho = 1;
      constant Integer n(min = 1) = 1, m = 2*n /* of
        two lines */;
      constant Real table[:] = {1, 2};
      final constant Real speed = sqrt(E/rho)*scale;
      constant Real weight = rho*g;
      constant U.Length length = 3;
      type Density = Real(min = 0, start = 1);
      replaceable partial function stress
        input Real strain;
        output Real s;
      end stress;
      function doubled
        input Real strain;
        output Real s;
      algorithm
        s := twice(E*strain);
        for i in 1:n loop
          s := s + i;
        end for;
      end doubled;
      replaceable model Law
        parameter Real k = E;
        Real f = k*table[n];
      end Law;
      package Inner
        constant Real w = E + n;
        model Sub
          Real z = w;
        end Sub;
      end Inner;
      model Bar
        Law law;
        U.Length l = length;
        Real s = stress(0.5);
        Real t = doubled(2);
        Density d(fixed = true);
        Real v[m];
      equation
        der(d) = 0;
        for i in 1:m loop
          v[i] = i*rho;
        end for;
      end Bar;
    end Material;
  end Bases;
  package Metals
    extends Bases.Material(rho = 8);
    redeclare function extends stress
    algorithm
      s := E*strain;
    end stress;
  end Metals;
  package Steel
    extends Metals(E = 200, table = {1, 2, 3}, redeclare model Law = StiffLaw,
      Density(start = 7));
    constant Real g = -1000;
    constant Real scale = 77;
    model StiffLaw
      extends P.Bases.Material.Law;
      Real e = 2*E + g;
    end StiffLaw;
  end Steel;
  package Aluminium = Metals(E = 72, n = 2);
  model Part
    replaceable package Stuff = Metals constrainedby Bases.Material;
    Stuff.Bar bar;
    Real w = Stuff.weight;
    Real c = Stuff.speed;
  end Part;
  model M
    Part a(redeclare package Stuff = Steel);
    Part b(redeclare package Stuff = Aluminium);
    Aluminium.Bar t;
    Steel.Inner.Sub sub;
    Real v = Aluminium.Inner.w;
  end M;
end P;
"""
VALUES = {
    "a.w": 80,  # 8 * P.g, not Steel.g
    "a.c": 10,  # sqrt(200/8) * Bases.scale
    "a.bar.law.f": 1,  # of Bases.Material, which it extends by its full name
    "a.bar.law.e": -600,
    "a.bar.l": 3,
    "a.bar.s": 100,
    "a.bar.t": 801,
    "a.bar.d": 7,
    "a.bar.v[2]": 16,
    "b.w": 80,
    "b.bar.s": 36,
    "b.c": 6,
    "t.law.f": 144,
    "t.s": 36,
    "t.t": 291,
    "t.d": 1,
    "t.v[4]": 32,
    "sub.z": 201,
    "v": 74,
}


def written(folder: Path, text: str) -> str:
    """The text as the front end gets it; empty where it stays as it is."""
    file = folder / "P.mo"
    library = ClassLibrary(file, text.encode(), ())
    return packages_written_out("P.M", library).get(file, "")


def simulated(fmu: Path, values: dict[str, float]) -> dict[str, float]:
    result = simulate_fmu(str(fmu), output=list(values), stop_time=0.1)
    return {name: float(result[name][-1]) for name in values}


def test_values_and_names_are_those_of_the_language(tmp_path, fmu_cache):
    source = tmp_path / "P.mo"
    source.write_text(MATERIALS, encoding="utf-8")
    build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    assert simulated(tmp_path / "M.fmu", VALUES) == pytest.approx(VALUES)


@pytest.mark.full
def test_packages_of_several_files_are_written_out(tmp_path, fmu_cache):
    folder = tmp_path / "P"
    folder.mkdir()
    head, model = MATERIALS.split("  model M\n")
    (folder / "package.mo").write_text(f"{head}end P;\n", encoding="utf-8")
    (folder / "M.mo").write_text(f"within P;\nmodel M\n{model.removesuffix('end P;' + chr(10))}", encoding="utf-8")
    build_fmu("P.M", [folder], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    assert simulated(tmp_path / "M.fmu", VALUES) == pytest.approx(VALUES)


def test_lines_stay_where_they_are(tmp_path):
    before, after = MATERIALS.splitlines(), written(tmp_path, MATERIALS).splitlines()
    assert len(after) == len(before)
    wanted = ("model Part", "model M", "constant Real scale = 77", "Aluminium.Bar t;")
    for line in wanted:
        assert [line in each for each in after] == [line in each for each in before]


def test_a_package_without_modifiers_stays_as_it_is(tmp_path):
    assert not written(tmp_path, "package P package A constant Real c = 1; end A; package B extends A; end B; end P;")


REFUSED = {
    "iterators that are named like what is around the base": (
        "constant Real i = 5; package A constant Real c = 1; function f output Real y; algorithm y := i;"
        " for i in 1:2 loop y := y + c; end for; end f; end A;"
        " package Q constant Real i = 1; package B extends P.A(c = 2); end B; end Q;"
    ),
    "constants of a model around": (
        "model N constant Real k = 1; package A constant Real c = k; end A; end N;"
        " package B extends N.A(c = 2); constant Real k = 3; constant Real e = c; end B;"
    ).replace("constant Real c = k;", "constant Real c = 1; constant Real d = k;"),
    "a package that holds what extends it": (
        "package A constant Real c = 1; package B extends P.A(c = 2); end B; end A;"
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_written_out_stays_as_it_is(case, tmp_path):
    assert not written(tmp_path, f"package P {REFUSED[case]} model M end M; end P;")


def test_other_texts_of_a_packages_files_are_its_own_text(tmp_path):
    """Records that were written out again are looked for in what the front end gets."""
    package = tmp_path / "P"
    package.mkdir()
    (package / "package.mo").write_text("package P end P;")
    (package / "A.mo").write_text("within P; package A end A;")
    library = ClassLibrary(package / "package.mo", b"package P end P;", [package])
    written = library.with_texts({package / "A.mo": "within P; package A record R end R; end A;"})
    assert b"record R" in written.own_text
    assert b"record R" not in library.own_text
