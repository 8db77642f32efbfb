"""Modifiers and redeclarations hold as the language says, or the model is refused with the place and a way out.

Values are those of the Modelica Language Specification 3.6, sections 7.2 (modification) and 7.3 (redeclaration; 7.3.2
for the modifiers of constraining clauses), worked out by hand.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import pytest
from contact_data import core_subset
from contact_foundation.errors import UnsupportedModelError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu, translate
from modelica2fmu.frontend.loading import load_flat_model
from modelica2fmu.library.source_map import SourceMap
from modelica2fmu.library.standard_library import StandardLibrary

CLASSES = """
  partial model Law
    parameter Real k = 1;
    parameter Real c = 0;
    Real f;
  end Law;
  model Linear
    extends Law;
  equation
    f = k;
  end Linear;
  model Damped
    extends Law;
  equation
    f = 100*k + c;
  end Damped;
  model Stiff = Damped(k = 2);
  model Holder
    replaceable Linear x;
  end Holder;
  model HolderWithModifier
    replaceable Linear x(k = 3);
  end HolderWithModifier;
  model Constrained
    parameter Real q = 3;
    replaceable Linear x
      constrainedby Law(k = q);
  end Constrained;
  model Repeated
    parameter Real q = 3;
    replaceable Linear x(k = q) constrainedby Law(k = q);
  end Repeated;
  model Both
    replaceable Linear x(k = 2) constrainedby Law(c = 4);
  end Both;
  model ClassHolder
    replaceable model M = Linear constrainedby Law;
    M x;
  end ClassHolder;
  model ConstrainedClass
    replaceable model M = Linear
      constrainedby Law(k = 3);
    M x;
  end ConstrainedClass;
  model Extending
    extends Holder;
  end Extending;
  model Around
    Holder h;
  end Around;
  model Part
    Linear a;
  end Part;
  partial function Shape
    input Real u;
    output Real y;
  end Shape;
  function single
    extends Shape;
  algorithm
    y := u;
  end single;
  function scaled
    extends Shape;
    input Real a = 2;
  algorithm
    y := a*u;
  end scaled;
  model Calling
    replaceable function f = single constrainedby Shape;
    Real y = f(3);
  end Calling;
  model CallingAround
    Calling g;
  end CallingAround;
  package Medium
    constant Real c = 2;
    function value
      output Real y;
    algorithm
      y := c;
    end value;
  end Medium;
  package Heavy
    extends Medium(c = 3);
  end Heavy;
  partial package AnyFluid
    constant Real c = 1;
    replaceable partial function density
      output Real y;
    end density;
  end AnyFluid;
  package Water
    extends AnyFluid(c = 3);
    redeclare function extends density
    algorithm
      y := 2*c;
    end density;
  end Water;
  package Oil
    extends AnyFluid(c = 4);
    redeclare function extends density
    algorithm
      y := 20*c;
    end density;
  end Oil;
  package ThickOil
    extends AnyFluid(c = 5);
    redeclare function extends density
    algorithm
      y := 20*c;
    end density;
  end ThickOil;
  model Pipe
    replaceable package Fluid = Water constrainedby AnyFluid;
    Real y = Fluid.density();
    Real z = Fluid.c;
  end Pipe;
  record Data
    parameter Real a = 1;
    parameter Real b = 2;
  end Data;
  record MoreData
    extends Data(a = 10);
    parameter Real d = 4;
  end MoreData;
  record Outer
    parameter Data data(a = 4);
  end Outer;
  model WithData
    parameter Data data;
    Real y = data.a + data.b;
  end WithData;
  model WithOuter
    parameter Outer data;
    Real y = data.data.a;
  end WithOuter;
  model ByName
    parameter Data d(a = 7);
    WithData w(data = d);
  end ByName;
  model ByConstructor
    WithData w(data = Data(a = 7));
  end ByConstructor;
  record Sevens
    extends Data(a = 7);
  end Sevens;
  model ByClass
    WithData w(data = Sevens());
  end ByClass;
  package Shelf
    constant Data d(a = 7);
  end Shelf;
  model ByArray
    parameter Data d(a = 7);
    WithTwo w(data = {d, d});
  end ByArray;
  model WithTwo
    parameter Data data[2];
    Real y = data[1].a + data[2].b;
  end WithTwo;
  model HoldsData
    replaceable parameter Data data;
    Real y = data.a + data.b;
  end HoldsData;
  model Empty
  end Empty;
  model Filled
    extends Empty;
    Real y = 3;
  end Filled;
  model HoldsEmpty
    replaceable Empty x;
  end HoldsEmpty;
  model ExtendsEmpty
    extends HoldsEmpty;
  end ExtendsEmpty;
  partial model AnyLatch
    discrete Real y(start = 0, fixed = true);
  end AnyLatch;
  model LatchToOne
    extends AnyLatch;
  equation
    when time > 0.5 then
      y = 1;
    end when;
  end LatchToOne;
  model LatchToTwo
    extends AnyLatch;
  equation
    when time > 0.5 then
      y = 2;
    end when;
  end LatchToTwo;
  model HoldsLatch
    replaceable LatchToOne x constrainedby AnyLatch;
  end HoldsLatch;
  model ExtendsLatch
    extends HoldsLatch;
  end ExtendsLatch;
  model Falling
    Real x(start = 1, fixed = true);
  equation
    der(x) = 0;
  end Falling;
  partial model Moving
    Real s;
  end Moving;
  model Drifting
    extends Moving(s(start = 2, fixed = true));
  equation
    der(s) = 0;
  end Drifting;
  model Carrier
    Real s(start = 0, fixed = true);
    Drifting m(s(fixed = true));
  equation
    der(s) = 1;
  end Carrier;
  model Subject
    outer Linear law;
    Real y = law.f;
  end Subject;
  model Scene
    inner replaceable Linear law constrainedby Law;
    Subject s;
  end Scene;
"""


@dataclass(frozen=True)
class Honoured:
    """A model that is built.

    Attributes:
        name: of the model.
        text: its declarations.
        values: of its variables.
    """

    name: str
    text: str
    values: dict[str, float]


@dataclass(frozen=True)
class Refused:
    """A model that is refused.

    Attributes:
        name: of the construct.
        text: declarations of the model.
        named: what the message quotes.
        variable: that it names.
        remedy: what it says, in part.
        line: the text in whose line the place is; ``named`` where it is not given.
    """

    name: str
    text: str
    named: str
    variable: str
    remedy: str
    line: str = ""


HONOURED = [
    Honoured("Default", "Holder h;", {"h.x.f": 1}),
    Honoured("InModifier", "Holder h(redeclare Damped x(k = 2));", {"h.x.f": 200}),
    Honoured("InExtends", "extends Holder(redeclare Damped x(k = 2));", {"x.f": 200}),
    Honoured("AsElement", "extends Holder; redeclare Damped x(k = 2);", {"x.f": 200}),
    Honoured("AsElementTwoLevels", "extends Extending; redeclare Damped x;", {"x.f": 100}),
    Honoured("InModifierTwoLevels", "Extending h(redeclare Damped x);", {"h.x.f": 100}),
    Honoured("DeclarationsModifiers", "HolderWithModifier h(redeclare Damped x);", {"h.x.f": 300}),
    Honoured("Constraint", "Constrained h(redeclare Damped x);", {"h.x.f": 300}),
    Honoured("ConstraintOfParameter", "Constrained h(q = 8, redeclare Damped x);", {"h.x.f": 800}),
    Honoured("ConstraintOverridden", "Constrained h(redeclare Damped x(k = 5));", {"h.x.f": 500}),
    Honoured("ConstraintOverriddenInDefault", "Constrained h(x(k = 5));", {"h.x.f": 5}),
    Honoured("ConstraintRepeated", "Repeated h;", {"h.x.f": 3}),
    Honoured("RepeatedAndRedeclared", "Repeated h(redeclare Damped x(k = 7));", {"h.x.f": 700}),
    Honoured("ClassInModifier", "ClassHolder h(redeclare model M = Stiff);", {"h.x.f": 200}),
    Honoured("ClassInExtends", "extends ClassHolder(redeclare model M = Stiff);", {"x.f": 200}),
    Honoured("ClassAsElement", "extends ClassHolder; redeclare model M = Damped(k = 2);", {"x.f": 200}),
    Honoured("LongClass", "extends ClassHolder; redeclare model M extends Law; equation f = 7; end M;", {"x.f": 7}),
    Honoured("Function", "Calling g(redeclare function f = scaled(a = 5));", {"g.y": 15}),
    Honoured("FunctionInExtends", "extends Calling(redeclare function f = scaled);", {"y": 6}),
    Honoured("TwoFunctions", "Calling g; Calling h(redeclare function f = scaled);", {"g.y": 3, "h.y": 6}),
    Honoured("Package", "Pipe p(redeclare package Fluid = Oil);", {"p.y": 80, "p.z": 4}),
    Honoured("PackageWrittenOut", "Pipe p(redeclare package Fluid = ThickOil);", {"p.y": 100, "p.z": 5}),
    Honoured("PackageModified", "Pipe p(redeclare package Fluid = Oil(c = 5));", {"p.y": 100, "p.z": 5}),
    Honoured("Constants", "Real y = Heavy.c; Real z = Medium.c; Real w = Heavy.value();", {"y": 3, "z": 2, "w": 3}),
    Honoured("Record", "HoldsData h(redeclare parameter MoreData data(b = 3));", {"h.y": 13}),
    Honoured("RecordByConstructor", "WithData w(data = Data(a = 7, b = 8)); WithData v(data = Data(9));",
             {"w.y": 15, "v.y": 11}),
    Honoured("RecordByName", "parameter Data d(a = 7); WithData w(data = d);", {"w.y": 9}),
    Honoured("RecordAgain", "extends ByName(w(data = Data(a = 9, b = 3)));", {"w.y": 12}),
    Honoured("RecordOfClass", "extends ByClass;", {"w.data.a": 7}),
    Honoured("RecordsOfArray", "extends ByArray(d(a = 8)); WithTwo v(data = {Data(), Sevens()});",
             {"w.data[1].a": 8, "v.data[2].a": 7}),
    Honoured("RecordOfPackage", "WithData w(data = Shelf.d); WithTwo v(data = {Shelf.d, Shelf.d});",
             {"w.y": 9, "v.y": 9}),
    Honoured("RecordModified", "WithOuter w(data(data(a = 9)));", {"w.y": 9}),
    Honoured("Arrays", "Linear a[2](k = {3, 4}); Linear b[2](each k = 5);", {"a[2].f": 4, "b[1].f": 5}),
    Honoured("NestedArrays", "Part p[2](each a(k = 6)); Holder h[2](redeclare Damped x);",
             {"p[2].a.f": 6, "h[2].x.f": 100}),
    Honoured("Parentheses", "Part p(a(k = 2)); Part q(a(final k = 3));", {"p.a.f": 2, "q.a.f": 3}),
    Honoured("Inner", "extends Scene(redeclare Damped law(k = 4));", {"s.y": 400}),
    Honoured("Removed", "extends Two(break b); model Two Linear a(k = 8); Linear b; end Two;", {"a.f": 8}),
    Honoured("Intermediate", "model Inward = Holder(redeclare Damped x); Inward h;", {"h.x.f": 100}),
]  # fmt: skip

CONSTRAINT = "repeat it in the declaration and in each redeclaration"
OWN_CLASS = "in a class of its own, as in `model Stiff = Spring(k = 2)`"
WHOLE_RECORD = "give the whole record"
DIRECTLY = "redeclare it in a class that extends the one with the declaration directly"

REFUSED = [
    Refused("constraint of an element", "extends Constrained; redeclare Damped x;", "k = q", "x.k", CONSTRAINT,
            "constrainedby Law(k = q)"),
    Refused("declaration's modifier, element", "extends HolderWithModifier; redeclare Damped x;", "k = 3", "x.k",
            CONSTRAINT, "Linear x(k = 3)"),
    Refused("modifier that must go", "Both h(redeclare Damped x);", "redeclare Damped x", "h.x.k", DIRECTLY),
    Refused("two levels of extends", "extends Extending(redeclare Damped x);", "redeclare Damped x", "x", DIRECTLY),
    Refused("nested", "Around a(h(redeclare Damped x));", "redeclare Damped x", "a.h.x", DIRECTLY),
    Refused("nested with modifiers", "Around a(h(redeclare Stiff x));", "redeclare Stiff x", "a.h.x", DIRECTLY),
    Refused("class with modifiers", "ClassHolder h(redeclare model M = Damped(k = 2));", "k = 2", "h.x.k", OWN_CLASS),
    Refused("class with modifiers, extends", "extends ClassHolder(redeclare model M = Damped(k = 2));", "k = 2", "x.k",
            OWN_CLASS),
    Refused("constraint of a redeclared class", "ConstrainedClass h(redeclare model M = Damped);", "k = 3", "h.x.k",
            CONSTRAINT, "constrainedby Law(k = 3)"),
    Refused("nested function", "CallingAround a(g(redeclare function f = scaled));", "redeclare function f = scaled",
            "a.g.f", DIRECTLY),
    Refused("nested function, extends", "extends CallingAround(g(redeclare function f = scaled));",
            "redeclare function f = scaled", "g.f", DIRECTLY),
    Refused("record class with modifiers",
            "model H replaceable record D = Data; parameter D d; Real y = d.b; end H;"
            " H h(redeclare record D = MoreData(b = 6));",
            "b = 6", "h.d.b", OWN_CLASS),
    Refused("record two levels", "model E extends HoldsData; end E; extends E(redeclare parameter MoreData data);",
            "redeclare parameter MoreData data", "data.a", DIRECTLY),
    Refused("record in a record", "WithOuter w(data = Outer(data = Data(a = 8)));", "8", "w.data.data.a", OWN_CLASS),
    Refused("record in a record, by place", "WithOuter w(data = Outer(Data(8)));", "8", "w.data.data.a", OWN_CLASS),
    Refused("record by name, then a field", "extends ByName(w(data(b = 3)));", "data = d", "w.data.a", WHOLE_RECORD,
            "extends ByName"),
    Refused("record by constructor, then a field", "extends ByConstructor(w(data(b = 3)));", "7", "w.data.a",
            WHOLE_RECORD, "extends ByConstructor"),
    Refused("record of a class, then a field", "extends ByClass(w(data(b = 3)));", "data = Sevens()", "w.data.a",
            WHOLE_RECORD, "extends ByClass"),
    Refused("records in an array, then a field", "extends ByArray(w(data(b = {3, 3})));", "data = {d, d}",
            "w.data[1].a", WHOLE_RECORD, "extends ByArray"),
    Refused("dotted modifier", "Part p(a.k = 2);", "a.k = 2", "p.a.k", "write it with parentheses"),
    Refused("dotted start", "Falling p(x.start = 2);", "x.start = 2", "start of p.x", "write it with parentheses"),
    Refused("no variables", "extends ExtendsEmpty(redeclare Filled x);", "redeclare Filled x", "x", DIRECTLY),
    Refused("when-clauses", "extends ExtendsLatch(redeclare LatchToTwo x);", "redeclare LatchToTwo x", "x", DIRECTLY),
]  # fmt: skip


def written(folder: Path, models: str) -> Path:
    file = folder / "Laws.mo"
    file.write_text(f"package Laws{CLASSES}{models}\nend Laws;\n", encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def honoured_values(tmp_path_factory, fmu_cache):
    """Values of all models that are built, simulated as components of one model."""
    folder = tmp_path_factory.mktemp("honoured")
    models = "\n".join(f"  model {case.name}\n    {case.text}\n  end {case.name};" for case in HONOURED)
    parts = "\n".join(f"    {case.name} part{case.name};" for case in HONOURED)
    file = written(folder, f"{models}\n  model All\n{parts}\n  end All;")
    build_fmu("Laws.All", [file], folder / "all.fmu", BuildOptions(cache=fmu_cache))
    names = [f"part{case.name}.{name}" for case in HONOURED for name in case.values]
    result = simulate_fmu(str(folder / "all.fmu"), output=names, stop_time=0.1)
    return {name: result[name][-1] for name in names}


@pytest.mark.parametrize("case", HONOURED, ids=lambda case: case.name)
def test_modifiers_hold_as_the_language_says(case, honoured_values):
    for name, value in case.values.items():
        assert honoured_values[f"part{case.name}.{name}"] == pytest.approx(value, rel=1e-12), name


def test_modifiers_of_constraining_clauses_hold_in_the_default(tmp_path, fmu_cache):
    file = written(
        tmp_path, "  model Wanted\n    extends Constrained(q = 5); Constrained h; ConstrainedClass c;\n  end Wanted;"
    )
    build_fmu("Laws.Wanted", [file], tmp_path / "wanted.fmu", BuildOptions(cache=fmu_cache))
    values = {"x.f": 5, "h.x.f": 3, "c.x.f": 3}
    result = simulate_fmu(str(tmp_path / "wanted.fmu"), output=list(values), stop_time=0.1)
    assert {name: float(result[name][-1]) for name in values} == values


@pytest.mark.parametrize("case", REFUSED, ids=lambda case: case.name)
def test_what_the_front_end_leaves_out_is_refused(case, tmp_path):
    file = written(tmp_path, f"  model Wanted\n    {case.text}\n  end Wanted;")
    with pytest.raises(UnsupportedModelError) as caught:
        translate("Laws.Wanted", [file], StandardLibrary(core_subset(), "", "core subset"))
    error = caught.value
    assert error.exit_status == 2
    assert case.named in error.message
    assert re.search(rf"\b{re.escape(case.variable)}\b", error.message)
    assert case.remedy in (error.remedy or "")
    lines = file.read_text(encoding="utf-8").splitlines()
    assert error.place is not None
    assert error.place.file == file
    assert error.place.line is not None
    assert (case.line or case.named) in lines[error.place.line - 1]


def test_fixed_holds_beside_a_component_of_that_name_that_is_not(tmp_path):
    file = written(tmp_path, "  model Wanted\n    Carrier c(s(fixed = false));\n  end Wanted;")
    flat = load_flat_model("Laws.Wanted", file, [], SourceMap([file]), [].append, Path)
    fixed = {variable.name: variable.fixed for variable in flat.variables.values()}
    assert fixed["c.s"] == (False,)
    assert fixed["c.m.s"] == (True,)


def test_places_are_right_behind_letters_of_several_bytes(tmp_path):
    file = written(tmp_path, '  model Wanted "Größe, 大きさ"\n    Part p(a.k = 2) "ß";\n  end Wanted;')
    with pytest.raises(UnsupportedModelError) as caught:
        translate("Laws.Wanted", [file], StandardLibrary(core_subset(), "", "core subset"))
    assert caught.value.place is not None
    assert "a.k = 2" in file.read_text(encoding="utf-8").splitlines()[(caught.value.place.line or 0) - 1]


def test_classes_in_folders_are_found(tmp_path):
    package = tmp_path / "Laws"
    (package / "Inner").mkdir(parents=True)
    (package / "package.mo").write_text("package Laws\nend Laws;\n")
    (package / "package.order").write_text("Spring\nInner\n")
    (package / "Spring.mo").write_text(
        "within Laws;\nmodel Spring\n  parameter Real k = 1;\n  Real f = k;\nend Spring;\n"
    )
    (package / "Inner" / "package.mo").write_text("within Laws;\npackage Inner\nend Inner;\n")
    (package / "Inner" / "package.order").write_text("Holder\nWanted\n")
    (package / "Inner" / "Holder.mo").write_text(
        "within Laws.Inner;\nmodel Holder\n  replaceable Spring x\n    constrainedby Spring(k = 3);\nend Holder;\n"
    )
    (package / "Inner" / "Wanted.mo").write_text(
        "within Laws.Inner;\nmodel Wanted\n  extends Holder;\n  redeclare Spring x;\nend Wanted;\n"
    )
    with pytest.raises(UnsupportedModelError, match="k = 3") as caught:
        translate("Laws.Inner.Wanted", [package], StandardLibrary(core_subset(), "", "core subset"))
    assert caught.value.place is not None
    assert (caught.value.place.file, caught.value.place.line) == (package / "Inner" / "Holder.mo", 4)


def test_functions_that_call_others_by_statements_are_looked_into(tmp_path):
    functions = """
  function split
    input Real u;
    output Real half;
    output Real rest;
  algorithm
    half := u/2;
    rest := u - half;
  end split;
  function joined
    input Real u;
    output Real y;
  protected
    Real half;
    Real rest;
  algorithm
    (half,rest) := split(u);
    y := half + rest;
  end joined;
"""
    file = written(tmp_path, f"{functions}\n  model Wanted\n    Real x = joined(time);\n  end Wanted;")
    assert translate("Laws.Wanted", [file], StandardLibrary(core_subset(), "", "core subset"))
