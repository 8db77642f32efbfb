"""The Standard Library's filters, whose coefficients its functions find by loops, are those of SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from msl_examples import library_folder
from scipy import optimize, signal

LIBRARY = library_folder()
pytestmark = pytest.mark.skipif(
    LIBRARY is None, reason="needs the complete Modelica Standard Library (MODELICAPATH names none)"
)
MODEL = """model Filters
  import Modelica.Blocks.Types.*;
  Modelica.Blocks.Continuous.Filter butterworth(f_cut=2, order=3, analogFilter=AnalogFilter.Butterworth);
  Modelica.Blocks.Continuous.Filter chebyshev(
    f_cut=2, order=4, analogFilter=AnalogFilter.ChebyshevI, filterType=FilterType.HighPass);
  Modelica.Blocks.Continuous.Filter bessel(f_cut=2, order=2, analogFilter=AnalogFilter.Bessel);
  Modelica.Blocks.Continuous.Filter critical(f_cut=2, order=2, analogFilter=AnalogFilter.CriticalDamping);
equation
  butterworth.u = sin(10*time);
  chebyshev.u = butterworth.u;
  bessel.u = butterworth.u;
  critical.u = butterworth.u;
end Filters;
"""
CUT = 4 * np.pi
RIPPLE = 0.5  # dB, the library's default
REDUCED = 10 ** (-3 / 20)  # of an amplitude of 1, at the cut-off frequency


def normalized(numerator, denominator):
    """Coefficients of a low pass of amplitude 1 at rest, and where its amplitude is reduced by 3 dB."""
    numerator = np.asarray(numerator) * denominator[-1] / numerator[-1]

    def excess(frequency):
        return abs(signal.freqs(numerator, denominator, [frequency])[1][0]) - REDUCED

    return numerator, denominator, optimize.brentq(excess, 0.3, 3)


def test_they_are_those_of_scipy(tmp_path, fmu_cache):
    source, fmu = tmp_path / "Filters.mo", tmp_path / "Filters.fmu"
    source.write_text(MODEL, encoding="utf-8")
    build_fmu("Filters", [source], fmu, BuildOptions(msl=LIBRARY, cache=fmu_cache))
    low_passes = {
        "butterworth": signal.butter(3, 1, analog=True),
        "chebyshev": signal.cheby1(4, RIPPLE, 1, analog=True),
        "bessel": signal.bessel(2, 1, analog=True),
        "critical": ([1.0], [1.0, 2.0, 1.0]),
    }
    names = [f"{name}.y" for name in low_passes]
    result = simulate_fmu(str(fmu), stop_time=2, relative_tolerance=1e-8, output_interval=0.01, output=names)
    time = np.linspace(0, 2, 20001)
    for name, low_pass in low_passes.items():
        numerator, denominator, frequency = normalized(*low_pass)
        if name == "butterworth":  # whose amplitude is the root of a half there
            frequency = 1.0
        if name == "chebyshev":
            system = signal.lp2hp(numerator, denominator, CUT * frequency)
        else:
            system = signal.lp2lp(numerator, denominator, CUT / frequency)
        _, expected, _ = signal.lsim(system, np.sin(10 * time), time)
        np.testing.assert_allclose(
            result[f"{name}.y"], np.interp(result["time"], time, expected), atol=2e-6, err_msg=name
        )
