"""The generated Jacobian against CasADi's and closed forms, read through the FMU's directional derivatives."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import casadi
import numpy as np
import pytest
from contact_data import checkout, core_subset
from fmpy import extract, instantiate_fmu, read_model_description
from modelica2fmu.build import BuildOptions, Translation, build_fmu, translate
from modelica2fmu.codegen.slots import Store
from modelica2fmu.equations.blocks import Assignment, Block, LinearBlock, needed_blocks
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.symbolic import expression as ex
from numpy.typing import NDArray

MODELS = checkout() / "Resources" / "reference" / "ReferenceModels.mo"


@contextmanager
def initialized(fmu: Path, folder: Path) -> Iterator[Any]:
    """An instance after its initialization."""
    directory = extract(str(fmu), unzipdir=str(folder))
    instance = instantiate_fmu(directory, read_model_description(directory), fmi_type="ModelExchange")
    try:
        instance.setupExperiment(startTime=0.0)
        instance.enterInitializationMode()
        instance.exitInitializationMode()
        instance.enterContinuousTimeMode()
        yield instance
    finally:
        instance.freeInstance()


def jacobian_of(instance: Any, states: Sequence[int], rates: Sequence[int]) -> NDArray[np.float64]:
    columns = [
        instance.getDirectionalDerivative(vUnknown_ref=rates, vKnown_ref=[state], dvKnown=[1.0]) for state in states
    ]
    return np.array(columns).T


def move(instance: Any, point: Sequence[float]) -> None:
    """Sets the states."""
    values = (ctypes.c_double * len(point))(*point)
    instance.setContinuousStates(values, len(point))


def rates_at(instance: Any, point: Sequence[float]) -> NDArray[np.float64]:
    move(instance, point)
    values = (ctypes.c_double * len(point))()
    instance.getDerivatives(values, len(point))
    return np.array(values)


class Casadi:
    """The right-hand side of a translation as a CasADi function of its states."""

    def __init__(self, translation: Translation, instance: Any) -> None:
        self._slots = translation.generated.slots.of
        self._instance = instance
        self._values: dict[str, Any] = {}
        states = translation.generated.states
        state = casadi.SX.sym("x", len(states))
        for position, name in enumerate(states):
            self._values[name] = state[position]
        rates = [f"der({name})" for name in states]
        for block in needed_blocks(translation.systems.simulation, rates):
            self._solve(block)
        rate = casadi.vertcat(*(self._symbol(name) for name in rates))
        self.jacobian = casadi.Function("jacobian", [state], [casadi.jacobian(rate, state)])
        self.rate = casadi.Function("rate", [state], [rate])

    def _solve(self, block: Block) -> None:
        if isinstance(block, Assignment):
            self._values[block.target] = self._expression(block.value)
            return
        assert isinstance(block, LinearBlock)
        assert block.system is not None
        rows = block.system.matrix
        matrix = casadi.vertcat(*(casadi.horzcat(*(self._expression(item) for item in row)) for row in rows))
        solution = casadi.solve(matrix, casadi.vertcat(*(self._expression(item) for item in block.system.right)))
        for position, name in enumerate(block.torn):
            self._values[name] = solution[position]
        for step in block.inner:
            self._solve(step)

    def _symbol(self, name: str) -> Any:
        if name == "time":
            return 0.0
        if name not in self._values:  # a parameter, input or discrete variable
            slot = self._slots[name]
            get = {
                Store.REAL: self._instance.getReal,
                Store.INTEGER: self._instance.getInteger,
                Store.BOOLEAN: self._instance.getBoolean,
            }[slot.store]
            self._values[name] = float(get([slot.index])[0])
        return self._values[name]

    def _expression(self, root: float | ex.Node) -> Any:
        values: dict[ex.Node, Any] = {}
        for node in ex.topological([root]):
            if node.op == "symbol":
                values[node] = self._symbol(node.name)
            elif node.op == "constant":
                values[node] = node.value
            else:
                values[node] = OPERATIONS[node.op](*(values[arg] for arg in node.args))
        return casadi.SX(values[root]) if isinstance(root, ex.Node) else casadi.SX(root)


OPERATIONS: dict[str, Any] = {
    "add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b,
    "neg": lambda a: -a, "sin": casadi.sin, "cos": casadi.cos, "sqrt": casadi.sqrt, "atan2": casadi.atan2,
    "pow": lambda a, b: a**b, "exp": casadi.exp, "abs": casadi.fabs, "select": casadi.if_else,
    "lt": lambda a, b: a < b, "le": lambda a, b: a <= b, "max": casadi.fmax, "min": casadi.fmin,
    "eq": lambda a, b: a == b, "or": casadi.logic_or, "tanh": casadi.tanh, "and": casadi.logic_and,
    "not": casadi.logic_not,
}  # fmt: skip


@pytest.mark.parametrize(
    "name", ["OffsetBody", *(pytest.param(name, marks=pytest.mark.full) for name in ("TumblingBody", "DoublePendulum"))]
)
def test_jacobian_is_that_of_casadi(name, tmp_path, fmu_cache):
    library = StandardLibrary(core_subset(), "", "core subset")
    translation = translate(f"ReferenceModels.{name}", [MODELS], library)
    options = BuildOptions(msl=core_subset(), cache=fmu_cache)
    report = build_fmu(f"ReferenceModels.{name}", [MODELS], tmp_path / "model.fmu", options)
    slots = translation.generated.slots.of
    states = [slots[item].index for item in report.states]
    rates = [slots[f"der({item})"].index for item in report.states]
    random = np.random.default_rng(1)
    with initialized(report.fmu, tmp_path / "fmu") as instance:
        start = np.array(instance.getReal(states))
        reference = Casadi(translation, instance)
        for _ in range(3):
            point = start + 0.3 * random.standard_normal(len(states))
            move(instance, point)
            rate = np.array(instance.getReal(rates))
            assert rate == pytest.approx(np.array(reference.rate(point)).ravel(), rel=1e-9, abs=1e-9)
            mine, expected = jacobian_of(instance, states, rates), np.array(reference.jacobian(point))
            assert mine == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.max(np.abs(expected)))


@pytest.mark.full
def test_jacobian_of_a_kinematic_loop_is_that_of_differences(tmp_path, fmu_cache):
    """Extrapolated central differences (Richardson), good to 1e-9 here."""
    options = BuildOptions(msl=core_subset(), cache=fmu_cache)
    report = build_fmu("ReferenceModels.PlanarFourBar", [MODELS], tmp_path / "m.fmu", options)
    assert any(block.kind == "nonlinear" and len(block.torn) > 1 for block in report.simulation_blocks)
    names = {item.name: item.valueReference for item in read_model_description(str(report.fmu)).modelVariables}
    states = [names[item] for item in report.states]
    rates = [names[f"der({item})"] for item in report.states]
    with initialized(report.fmu, tmp_path / "fmu") as instance:
        point = np.array(instance.getReal(states)) + np.array([0.2, 0.7])

        def central(column: int, step: float) -> NDArray[np.float64]:
            shift = step * np.eye(len(point))[column]
            return (rates_at(instance, point + shift) - rates_at(instance, point - shift)) / (2 * step)

        expected = np.array([(4 * central(k, 1e-3) - central(k, 2e-3)) / 3 for k in range(len(point))]).T
        move(instance, point)
        mine = jacobian_of(instance, states, rates)
        assert mine == pytest.approx(expected, rel=1e-7, abs=1e-7 * np.max(np.abs(expected)))


IMPLICIT = """model Implicit "Nonlinear blocks, an external function, a branch"
  pure function f
    input Real u[2];
    output Real y;
    external "C" y = f(u) annotation(Include = "#include <math.h>
static double f(const double *u) { return sin(u[0])*u[1]; }");
  end f;
  Real x(start = 0.7, fixed = true), z(start = 1.3, fixed = true);
  Real cubic(start = 0.5), a(start = 0.5), b(start = 0.5), outside;
equation
  cubic^3 + cubic = x;
  a + 0.2*exp(-b*a) = x;
  b + 0.3*a*cos(b) = z;
  outside = f({x*z, z});
  der(x) = -cubic + (if noEvent(x > 0) then x^2 else -x);
  der(z) = a*b + outside;
end Implicit;
"""


def test_jacobian_of_implicit_equations_and_external_functions(build, tmp_path):
    report = build(IMPLICIT)
    assert len(report.simulation_blocks) >= 2
    with initialized(report.fmu, tmp_path / "fmu") as instance:
        variables = read_model_description(str(report.fmu)).modelVariables
        names = {item.name: item.valueReference for item in variables}
        states, rates = [names["x"], names["z"]], [names["der(x)"], names["der(z)"]]
        for point in ((0.7, 1.3), (-0.4, 0.9)):
            move(instance, point)
            x, z, y, a, b = instance.getReal([names[item] for item in ("x", "z", "cubic", "a", "b")])
            mine = jacobian_of(instance, states, rates)
            dy = 1 / (3 * y**2 + 1)
            torn = np.array(
                [
                    [1 - 0.2 * b * math.exp(-b * a), -0.2 * a * math.exp(-b * a)],
                    [0.3 * math.cos(b), 1 - 0.3 * a * math.sin(b)],
                ]
            )
            (a_x, a_z), (b_x, b_z) = np.linalg.inv(torn)
            expected = [
                [-dy + (2 * x if x > 0 else -1), 0.0],
                [
                    a_x * b + a * b_x + math.cos(x * z) * z * z,
                    a_z * b + a * b_z + math.cos(x * z) * x * z + math.sin(x * z),
                ],
            ]
            # The external function is differentiated by difference quotients, all else exactly.
            assert mine[0] == pytest.approx(expected[0], rel=1e-9)
            assert mine[1] == pytest.approx(expected[1], rel=1e-6)


ROOT = """model Root "The derivative of the right-hand side is infinite at the start"
  Real x(start = 0, fixed = true), y(start = 1, fixed = true);
equation
  der(x) = 1 + sqrt(noEvent(max(x, 0)));
  der(y) = -100*y;
end Root;
"""


def test_integrator_survives_a_point_without_jacobian(simulate):
    result = simulate(ROOT, ["x", "y"], stop=1.0, tolerance=1e-8, fmi_type="CoSimulation")
    # With s = sqrt(x): t = 2 (s - log(1 + s)).
    s = np.sqrt(result["x"])
    assert 2 * (s - np.log1p(s)) == pytest.approx(result["time"], abs=1e-6)


CHAIN = """model Chain "Bodies that feel their neighbours, each by a system of two equations"
  Real x[7](start={0.1, 0.5, 0.9, 0.2, 0.7, 0.4, 0.3}, each fixed=true);
  Real v[7](start={1, 2, 3, 4, 5, 6, 7}, each fixed=true);
  Real a[7];
  Real b[7];
  Real force[6];
equation
  der(x) = v;
  der(v) = a;
  for i in 1:6 loop
    force[i] = sin(x[i + 1] - x[i]) * (1 + v[i] * v[i + 1]);
  end for;
  for i in 1:7 loop
    2 * a[i] + cos(x[i]) * b[i] = (if i < 7 then force[min(i, 6)] else 0) - (if i > 1 then force[max(i - 1, 1)] else 0);
    cos(x[i]) * a[i] + 3 * b[i] = v[i] ^ 2;
  end for;
end Chain;
"""


def test_passes_leave_out_what_their_directions_do_not_move(tmp_path, fmu_cache):
    source = tmp_path / "Chain.mo"
    source.write_text(CHAIN)
    translation = translate("Chain", [source], StandardLibrary(core_subset(), "", "core subset"))
    report = build_fmu("Chain", [source], tmp_path / "m.fmu", BuildOptions(msl=core_subset(), cache=fmu_cache))
    slots = translation.generated.slots.of
    states = [slots[item].index for item in report.states]
    rates = [slots[f"der({item})"].index for item in report.states]
    random = np.random.default_rng(2)
    with initialized(report.fmu, tmp_path / "fmu") as instance:
        reference = Casadi(translation, instance)
        for _ in range(3):
            point = random.standard_normal(len(states))
            move(instance, point)
            expected = np.array(reference.jacobian(point))
            assert np.sum(expected == 0.0) > len(states) ** 2 / 2
            assert jacobian_of(instance, states, rates) == pytest.approx(expected, rel=1e-9, abs=1e-9)
