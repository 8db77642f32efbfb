"""Constraints hold over a minute of simulated time, not only at its beginning."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from contact_data import checkout, core_subset
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.equations.blocks import Assignment
from modelica2fmu.equations.unit_vectors import unit_vectors
from modelica2fmu.symbolic import expression as ex

MODELS = checkout() / "Resources" / "reference" / "ReferenceModels.mo"


def minute(model: str, names: list[str], folder: Path, cache: Path, tolerance: float, kind: str):
    options = BuildOptions(msl=core_subset(), cache=cache)
    report = build_fmu(f"ReferenceModels.{model}", [MODELS], folder / "m.fmu", options)
    return simulate_fmu(
        str(report.fmu), fmi_type=kind, stop_time=60.0, relative_tolerance=tolerance, output=names,
        output_interval=0.05,
    )  # fmt: skip


KINDS = ["CoSimulation", "ModelExchange"]


@pytest.mark.full
@pytest.mark.parametrize("kind", KINDS)
def test_loop_of_a_four_bar_stays_closed(tmp_path, fmu_cache, kind):
    """Crank and coupler end where ground and rocker end, by the joints' angles alone."""
    result = minute("PlanarFourBar", ["j1.phi", "j2.phi", "j4.phi"], tmp_path, fmu_cache, 1e-6, kind)
    crank, coupler = result["j1.phi"], result["j1.phi"] + result["j2.phi"]
    chain = 0.2 * np.exp(1j * crank) + 0.5 * np.exp(1j * coupler)
    assert np.ptp(crank) > 0.5  # it moves
    assert np.abs(chain - (0.6 + 0.4 * np.exp(1j * result["j4.phi"]))).max() < 1e-8


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("tolerance", [1e-4, 1e-8])
def test_quaternion_of_a_tumbling_body_keeps_its_length(tmp_path, fmu_cache, tolerance, kind):
    """Also where an importer integrates and interpolates: what is shown is the state over its length."""
    names = [f"body.Q[{number}]" for number in (1, 2, 3, 4)]
    result = minute("TumblingBody", names, tmp_path, fmu_cache, tolerance, kind)
    quaternion = np.array([result[name] for name in names])
    assert np.abs(np.linalg.norm(quaternion, axis=0) - 1).max() < 1e-12
    assert np.ptp(quaternion, axis=1).min() > 0.5  # it tumbles


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_integrated_for_a_quaternion_does_not_drift_away(tmp_path, fmu_cache, kind):
    names = [f"body.Q_integrated[{number}]" for number in (1, 2, 3, 4)]
    result = minute("TumblingBody", names, tmp_path, fmu_cache, 1e-6, kind)
    length = np.linalg.norm([result[name] for name in names], axis=0)
    assert 0 < np.abs(length - 1).max() < 1e-4  # a few hundred times the tolerance, of a body that turns fast


def rotation(length: float) -> list[Assignment]:
    """der(Q) of a quaternion whose derivative keeps the given length."""
    q = [ex.symbol(f"Q[{number}]") for number in (1, 2, 3, 4)]
    w = [ex.symbol(f"w[{number}]") for number in (1, 2, 3)]
    square: float | ex.Node = -length
    for component in q:
        square = ex.add(square, ex.multiply(component, component))
    products = [
        [(q[3], w[0]), (q[1], w[2]), (q[2], ex.negate(w[1]))],
        [(q[3], w[1]), (q[2], w[0]), (q[0], ex.negate(w[2]))],
        [(q[3], w[2]), (q[0], w[1]), (q[1], ex.negate(w[0]))],
        [(q[0], ex.negate(w[0])), (q[1], ex.negate(w[1])), (q[2], ex.negate(w[2]))],
    ]
    result = []
    for component, terms in zip(q, products, strict=True):
        rate: float | ex.Node = ex.negate(ex.multiply(square, component))
        for a, b in terms:
            rate = ex.add(rate, ex.multiply(0.5, ex.multiply(a, b)))
        result.append(Assignment(f"der({component.name})", rate))
    return result


def test_unit_vectors_are_recognized_by_their_equations():
    names = [f"Q[{number}]" for number in (1, 2, 3, 4)]
    assert unit_vectors(names, rotation(1.0)) == [tuple(names)]
    assert unit_vectors(names, rotation(2.0)) == []  # keeps another length
    assert unit_vectors(names[:3], rotation(1.0)) == []
