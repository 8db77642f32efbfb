"""Linear systems too large for a closed form, against numpy: a row of masses whose forces add up along it."""

from __future__ import annotations

import ctypes
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract, instantiate_fmu, read_model_description
from fmpy.fmi1 import FMICallException
from modelica2fmu.equations.blocks import LinearBlock

COUNT = 30
# With L the lower triangle of ones and c = cos(x): a = L (c z), f = L' a, k c f + z = x + 1, where z = der(v).
ROW = f"""model Row "Forces add up along a row of masses"
  constant Integer n = {COUNT};
  parameter Real k = 1;
  parameter Real direct = 1;
  Real x[n](start = {{0.02*i for i in 1:n}}, each fixed = true), v[n](each start = 0, each fixed = true);
  Real z[n] "der(v)", a[n], f[n], c[n];
equation
  der(x) = v;
  der(v) = z;
  c = cos(x);
  a[1] = c[1]*z[1];
  for i in 2:n loop
    a[i] = a[i - 1] + c[i]*z[i];
  end for;
  for i in 1:n - 1 loop
    f[i] = f[i + 1] + a[i];
  end for;
  f[n] = a[n];
  for i in 1:n loop
    k*c[i]*f[i] + direct*z[i] = x[i] + 1;
  end for;
end Row;
"""


def rates(x: np.ndarray, k: float) -> np.ndarray:
    ones = np.tri(len(x))
    matrix = k * np.cos(x)[:, None] * (ones.T @ ones) * np.cos(x) + np.eye(len(x))
    return np.linalg.solve(matrix, x + 1)


@pytest.fixture(scope="module")
def report(build):
    return build(ROW)


@pytest.fixture
def instance(report, tmp_path: Path):
    directory = extract(str(report.fmu), unzipdir=str(tmp_path / "fmu"))
    made = instantiate_fmu(directory, read_model_description(directory), fmi_type="ModelExchange")
    made.setupExperiment(startTime=0.0)
    made.enterInitializationMode()
    yield made
    made.freeInstance()


def references(report) -> dict[str, int]:
    return {item.name: item.valueReference for item in read_model_description(str(report.fmu)).modelVariables}


def test_the_system_is_torn_to_the_masses_and_has_no_closed_form(translated):
    (block,) = (item for item in translated(ROW).systems.simulation if isinstance(item, LinearBlock))
    assert len(block.torn) == COUNT
    assert block.system is None


@pytest.mark.parametrize("k", [1.0, 0.3])
def test_rates_and_jacobian_are_those_of_numpy(report, instance, k):
    names = references(report)
    instance.setReal([names["k"]], [k])
    instance.exitInitializationMode()
    instance.enterContinuousTimeMode()
    random = np.random.default_rng(5)
    order = list(report.states)
    for _ in range(3):
        x, v = random.uniform(-1, 1, COUNT), random.uniform(-1, 1, COUNT)
        values = {f"x[{i + 1}]": x[i] for i in range(COUNT)} | {f"v[{i + 1}]": v[i] for i in range(COUNT)}
        instance.setContinuousStates((ctypes.c_double * len(order))(*(values[name] for name in order)), len(order))
        z = np.array(instance.getReal([names[f"z[{i + 1}]"] for i in range(COUNT)]))
        assert z == pytest.approx(rates(x, k), rel=1e-12, abs=1e-12)
        for column in (0, 6, COUNT - 1):
            unit = np.eye(COUNT)[column]
            # Complex steps give derivatives to rounding (Squire and Trapp 1998).
            expected = rates(x + 1e-30j * unit, k).imag / 1e-30
            mine = instance.getDirectionalDerivative(
                vUnknown_ref=[names[f"der(v[{i + 1}])"] for i in range(COUNT)],
                vKnown_ref=[names[f"x[{column + 1}]"]],
                dvKnown=[1.0],
            )
            assert np.array(mine) == pytest.approx(expected, rel=1e-10, abs=1e-10)


def test_a_singular_system_is_named(report, instance, capfd):
    names = references(report)
    instance.setReal([names["k"], names["direct"]], [0.0, 0.0])
    with pytest.raises(FMICallException):
        instance.exitInitializationMode()
    assert f"A linear system of {COUNT} equations is singular" in capfd.readouterr().out
