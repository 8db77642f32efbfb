"""Motions that tables prescribe, whose speeds and accelerations are the tables' slopes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import UnsupportedModelError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.library.standard_library import core_subset, find_standard_library
from modelica2fmu.translation import translate
from scipy.interpolate import Akima1DInterpolator

POINTS = np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 1.5], [3.0, 0.0], [4.0, -0.5]])
SMOOTH = "smoothness=Modelica.Blocks.Types.Smoothness.ContinuousDerivative"
MODEL = """model Cam
  Modelica.Mechanics.Translational.Sources.Position prescribed(exact=true);
  Modelica.Mechanics.Translational.Components.Mass mass(m=2);
  Modelica.Blocks.Sources.CombiTimeTable overTime(table=[{rows}], {smoothness});
  Modelica.Blocks.Tables.CombiTable1Ds cam(table=[{rows}], {smoothness});
  Modelica.Blocks.Tables.CombiTable2Ds surface(table=[0, 0, 4; 0, 1, 2; 4, 3, 7]);
  Real angle = 2 - 1.5*cos(time), lift = cam.y[1], speed = der(lift), acceleration = der(speed);
  Real slope = der(surface.y);
equation
  cam.u = angle;
  surface.u1 = angle;
  surface.u2 = time;
  connect(overTime.y[1], prescribed.s_ref);
  connect(prescribed.flange, mass.flange_a);
end Cam;
"""


@pytest.fixture(autouse=True)
def _standard_library() -> None:
    if find_standard_library().folder == core_subset():
        pytest.skip("no Modelica Standard Library is installed")


def written(folder: Path, smoothness: str) -> Path:
    rows = "; ".join(", ".join(map(str, row)) for row in POINTS)
    (folder / "Cam.mo").write_text(MODEL.format(rows=rows, smoothness=smoothness))
    return folder / "Cam.mo"


def test_speeds_and_accelerations_are_those_of_the_curve(tmp_path: Path, fmu_cache: Path) -> None:
    """Against SciPy's derivatives of Akima's curve; those of a surface by the product rule."""
    build_fmu("Cam", [written(tmp_path, SMOOTH)], tmp_path / "m.fmu", BuildOptions(cache=fmu_cache))
    names = ["mass.s", "mass.v", "mass.a", "mass.flange_a.f", "angle", "lift", "speed", "acceleration", "slope"]
    result = simulate_fmu(str(tmp_path / "m.fmu"), output=names, stop_time=3.5, output_interval=0.01)
    time, angle = result["time"], result["angle"]
    curve = Akima1DInterpolator(*POINTS.T, method="akima")
    beside = np.abs(time - np.round(time)) > 1e-6
    for order, name in enumerate(["mass.s", "mass.v", "mass.a"]):
        np.testing.assert_allclose(result[name][beside], curve.derivative(order)(time)[beside], atol=1e-9, err_msg=name)
    np.testing.assert_allclose(result["mass.flange_a.f"], 2 * result["mass.a"], atol=1e-9)
    rate, second = 1.5 * np.sin(time), 1.5 * np.cos(time)
    inside = np.abs(angle - np.round(angle)) > 1e-6
    chain = curve.derivative(2)(angle) * rate**2 + curve.derivative()(angle) * second
    np.testing.assert_allclose(result["lift"], curve(angle), atol=1e-9)
    np.testing.assert_allclose(result["speed"], curve.derivative()(angle) * rate, atol=1e-9)
    np.testing.assert_allclose(result["acceleration"][inside], chain[inside], atol=1e-9)
    # z = 1 + u1/2 + u2/4 + 3 u1 u2/16 through the four corners
    np.testing.assert_allclose(result["slope"], (0.5 + 3 / 16 * time) * rate + 0.25 + 3 / 16 * angle, atol=1e-9)


@pytest.mark.parametrize(
    ("smoothness", "words"),
    [
        ("verboseRead=true", "slope of a table that jumps"),
        (SMOOTH.replace("ContinuousDerivative", "ConstantSegments"), "jumps"),
    ],
)
def test_accelerations_without_bound_are_refused(smoothness: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError, match=words) as refused:
        translate("Cam", [written(tmp_path, smoothness)], find_standard_library())
    assert refused.value.remedy is not None
