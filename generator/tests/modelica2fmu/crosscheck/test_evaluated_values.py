"""Parameters that have their value from another one follow it when that is set on the FMU."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_data import modelica_library
from contact_foundation.errors import InputError
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu

CLASSES = """package Classes
  record R
    parameter Real k=1;
  end R;
  record Outer
    parameter R inside;
    parameter Real other=1;
  end Outer;
  model B
    parameter Real k=1;
    Real x(start=0, fixed=true);
  equation
    der(x) = k;
  end B;
  model C
    parameter R r;
    Real x(start=0, fixed=true);
  equation
    der(x) = r.k;
  end C;
  model D
    parameter Outer o;
    Real x(start=0, fixed=true);
  equation
    der(x) = o.inside.k;
  end D;
  model A
    parameter Real k=2;
    parameter Real v[2]={k,0};
    final parameter R r(k=k);
    final parameter Outer o(inside=r);
    final parameter Real h=k;
    B b(k=k);
    B half(k=0.5*k);
    B named(k=h);
    C c(r=r);
    C d(r(k=k));
    C e(r=R(k=k));
    D f(o=o);
    B first(k=v[1]);
  end A;
  model Deeper
    parameter Real q=4;
    A a(k=q);
  end Deeper;
  model Changed
    extends A(k=6);
  end Changed;
{model}
end Classes;
"""
SHARES = {"b": 1, "half": 0.5, "named": 1, "c": 1, "d": 1, "e": 1, "f": 1}


def rates(model: str, names: list[str], parameters: dict[str, float], folder: Path, cache: Path) -> list[float]:
    """How fast components' x grow in a model of these classes, with parameters set on its FMU."""
    source = folder / "Classes.mo"
    source.write_text(CLASSES.replace("{model}", model))
    fmu = build_fmu("Classes.Whole", [source], folder / "whole.fmu", BuildOptions(cache=cache)).fmu
    result = simulate(fmu, signals=[f"{name}.x" for name in names], stop=1, interval=1, parameters=parameters)
    return [float(result[f"{name}.x"][-1]) for name in names]


@pytest.mark.parametrize(
    ("declared", "component", "parameter"),
    [
        ("A a;", "a", "a.k"),
        pytest.param("A a(k=5);", "a", "a.k", marks=pytest.mark.full),
        ('A a(k(min=0)=5 /* kg */ "a;b");', "a", "a.k"),
        ("parameter Real p=3; A a(k=p);", "a", "p"),
        ("Deeper z(q=7);", "z.a", "z.q"),
        ("Changed a;", "a", "a.k"),
        pytest.param("A a[2](each k=8);", "a[2]", "a[2].k", marks=pytest.mark.full),
        ("A a[2](k={8,9});", "a[1]", "a[1].k"),
    ],
)
def test_a_parameter_reaches_all_that_is_bound_to_it(
    declared: str, component: str, parameter: str, tmp_path: Path, fmu_cache: Path
) -> None:
    names = [f"{component}.{name}" for name in SHARES]
    found = rates(f"  model Whole\n    {declared}\n  end Whole;", names, {parameter: 10.0}, tmp_path, fmu_cache)
    assert found == pytest.approx([10 * share for share in SHARES.values()])


OTHER_TYPES = """  type Mode = enumeration(One, Two);
  model Inside
    parameter Integer n=1;
    parameter Boolean up=false;
    parameter Real v[2]={0,0};
    parameter Mode mode=Mode.One;
    Real x(start=0, fixed=true);
  equation
    der(x) = n + (if up then 100 else 0) + 1000*v[1] + v[2] + (if mode == Mode.Two then 1e5 else 0);
  end Inside;
  model Around
    parameter Integer n=2;
    parameter Boolean up=false;
    parameter Real v[2]={0,0};
    parameter Mode mode=Mode.One;
    Inside inside(n=n, up=up, v=v, mode=mode);
  end Around;
  model Whole
    Around a(n=3, up=false, v={1,1}, mode=Mode.One);
  end Whole;
"""


@pytest.mark.parametrize(
    ("parameter", "value", "rate"),
    [("a.n", 7, 1008), ("a.up", 1, 1104), ("a.v[1]", 5, 5004), ("a.v[2]", 5, 1008), ("a.mode", 2, 101004)],
)
def test_parameters_of_all_types_reach_what_is_bound_to_them(
    parameter: str, value: float, rate: float, tmp_path: Path, fmu_cache: Path
) -> None:
    found = rates(OTHER_TYPES, ["a.inside"], {parameter: value}, tmp_path, fmu_cache)
    assert found == pytest.approx([rate])


SEPARATE = """  model Inside
    extends B(k=3);
  end Inside;
  model Both
    extends B(k=3);
    Inside inside;
  end Both;
  model Plain
    extends B;
    B inside;
  end Plain;
  model Whole
    Both both;
    Plain plain;
    B one(k=2);
    B two(k=2);
  end Whole;
"""


def test_parameters_of_the_same_value_stay_apart(tmp_path: Path, fmu_cache: Path) -> None:
    parameters = {"both.k": 10.0, "plain.k": 10.0, "one.k": 10.0}
    names = ["both", "both.inside", "plain", "plain.inside", "one", "two"]
    assert rates(SEPARATE, names, parameters, tmp_path, fmu_cache) == pytest.approx([10, 3, 10, 1, 10, 2])


BALL = """model Whole "A ball whose mass is set where it is used"
  parameter Modelica.Units.SI.Mass mass=1;
  inner Modelica.Mechanics.MultiBody.World world(n={0,0,-1});
  ContactMultiBody.Parts.FreeBody ball({mass}, r_CM={0,0,0}, I_11=0.004, I_22=0.004, I_33=0.004,
    r_0(start={0,0,0.2}, each fixed=true), v_0(each fixed=true), angles_fixed=true, w_0_fixed=true,
    geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(n=2, collider={ball.collider, floor.collider},
    restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
equation
  connect(ball.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
end Whole;
"""


@pytest.mark.full
@pytest.mark.parametrize(("written", "parameter"), [("m=mass", "mass"), ("m=1", "ball.m")])
def test_contacts_know_the_mass_that_is_set(written: str, parameter: str, tmp_path: Path, fmu_cache: Path) -> None:
    source = tmp_path / "Whole.mo"
    speeds = []
    for number, text in ((1, written), (2, "m=50")):
        source.write_text(BALL.replace("{mass}", text))
        sources = [source, modelica_library()]
        fmu = build_fmu("Whole", sources, tmp_path / f"{number}.fmu", BuildOptions(cache=fmu_cache)).fmu
        set_values = {parameter: 50.0} if number == 1 else {}
        speeds.append(simulate(fmu, signals=["ball.v_0[3]"], stop=0.25, parameters=set_values)["ball.v_0[3]"])
    assert max(speeds[1]) > 0.3  # it bounces
    assert speeds[0] == pytest.approx(speeds[1], abs=1e-3)


FINAL_RECORDS = """  record Inertia
    parameter Real m=1;
    parameter Real v[2]={0,0};
  end Inertia;
  record Derived
    extends Inertia;
    parameter Real w=2*m;
  end Derived;
  model Body
    parameter Real m=1;
    parameter Real v[2]={1,2};
    parameter Inertia data;
    final parameter Inertia inertia(m=m, v=v);
    final parameter Inertia copy=data;
    final parameter Inertia made=Inertia(m=m);
    Real x(start=0, fixed=true);
  equation
    der(x) = inertia.m + 10*inertia.v[2] + 100*copy.m + 1000*made.m;
  end Body;
  model Fixed
    parameter Real m=3;
    parameter Real other=4;
    final parameter Derived derived(m=m);
    Real x(start=0, fixed=true);
  equation
    der(x) = derived.w + other;
  end Fixed;
  model Whole
    final parameter Real f=4;
    parameter Inertia given(m=2);
    Body a(m=f);
    Body b(m=3, data(m=5));
    Body c(data=given);
    Body d[2](m={1,2});
    Fixed g(m=3);
  end Whole;
"""


@pytest.mark.parametrize(
    ("component", "parameter", "rate"),
    [
        ("a", "a.m", 7 + 20 + 100 + 7000),
        ("b", "b.m", 7 + 20 + 500 + 7000),
        ("b", "b.data.m", 3 + 20 + 700 + 3000),
        ("b", "b.v[2]", 3 + 70 + 500 + 3000),
        ("c", "given.m", 1 + 20 + 700 + 1000),
        ("d[2]", "d[2].m", 7 + 20 + 100 + 7000),
        ("g", "g.other", 6 + 7),
    ],
)
def test_parameters_reach_the_fields_of_final_records(
    component: str, parameter: str, rate: float, tmp_path: Path, fmu_cache: Path
) -> None:
    found = rates(FINAL_RECORDS, [component], {parameter: 7.0}, tmp_path, fmu_cache)
    assert found == pytest.approx([rate])


def test_what_a_number_was_computed_from_cannot_be_set(tmp_path: Path, fmu_cache: Path) -> None:
    with pytest.raises(InputError, match="cannot be set"):
        rates(FINAL_RECORDS, ["g"], {"g.m": 7.0}, tmp_path, fmu_cache)
