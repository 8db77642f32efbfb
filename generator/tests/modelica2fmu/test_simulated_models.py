"""Small models through the whole builder, simulated by FMPy, against closed forms."""

from __future__ import annotations

import ctypes
import math
import re

import numpy as np
import pytest

OSCILLATOR = """model Oscillator "Undamped"
  parameter Real k = 4 "Stiffness";
  parameter Real m = 1 "Mass";
  parameter Real omega = sqrt(k/m) "Follows from the others";
  parameter Real x0 = 1.5;
  Real x(start = x0, fixed = true), v(start = 0, fixed = true);
  Real energy = 0.5*m*v^2 + 0.5*k*x^2;
  Real negative = -x;
equation
  der(x) = v;
  m*der(v) = -k*x;
  annotation(experiment(StopTime = 2, Tolerance = 1e-9, Interval = 0.1));
end Oscillator;
"""


@pytest.mark.parametrize("fmi_type", ["ModelExchange", "CoSimulation"])
def test_oscillator_has_its_closed_form(simulate, fmi_type):
    names = ["x", "v", "energy", "negative", "omega"]
    result = simulate(OSCILLATOR, names, stop=2.0, fmi_type=fmi_type)
    assert result["x"] == pytest.approx(1.5 * np.cos(2 * result["time"]), abs=2e-7)
    assert result["v"] == pytest.approx(-3.0 * np.sin(2 * result["time"]), abs=4e-7)
    assert result["energy"] == pytest.approx(4.5, abs=1e-6)
    assert result["negative"] == pytest.approx(-result["x"])


def test_parameters_change_what_depends_on_them(simulate):
    result = simulate(OSCILLATOR, ["x", "omega"], stop=2.0, start_values={"k": 9.0, "x0": 2.0})
    assert result["omega"] == pytest.approx(3.0)
    assert result["x"] == pytest.approx(2.0 * np.cos(3 * result["time"]), abs=5e-7)


def test_experiment_annotation_is_read(build):
    from fmpy import read_model_description

    experiment = read_model_description(str(build(OSCILLATOR).fmu)).defaultExperiment
    assert float(experiment.stopTime) == 2.0
    assert float(experiment.tolerance) == 1e-9


PENDULUM = """model Pendulum "Point mass on a rod, in Cartesian coordinates: index three"
  parameter Real g = 9.81, length = 1;
  Real x(start = 0.6, fixed = true, stateSelect = StateSelect.prefer), y(start = -0.8), f;
  Real vx(start = 0, fixed = true, stateSelect = StateSelect.prefer), vy;
equation
  der(x) = vx;
  der(y) = vy;
  der(vx) = -f*x;
  der(vy) = -f*y - g;
  x^2 + y^2 = length^2;
end Pendulum;
"""


def test_cartesian_pendulum_is_reduced_to_two_states(build, simulate):
    report = build(PENDULUM)
    assert set(report.states) == {"x", "vx"}
    # The rod's constraint once to speeds and once to accelerations.
    assert report.differentiations >= 2
    result = simulate(PENDULUM, ["x", "y", "vx", "vy"], stop=1.0, tolerance=1e-10)
    energy = 0.5 * (result["vx"] ** 2 + result["vy"] ** 2) + 9.81 * result["y"]
    assert result["x"] ** 2 + result["y"] ** 2 == pytest.approx(1.0, abs=1e-9)
    assert energy == pytest.approx(-9.81 * 0.8, abs=1e-6)


EVENTS = """model Events
  Real x(start = 1, fixed = true);
  discrete Real caught(start = 0, fixed = true);
  Integer samples(start = 0, fixed = true), choice(start = 0, fixed = true);
  Boolean low, rising;
  discrete Real last(start = -1, fixed = true);
equation
  der(x) = -2*x;
  low = x < 0.5;
  rising = edge(low);
  when low then
    caught = time;
  end when;
  when sample(0.1, 0.25) then
    samples = pre(samples) + 1;
    last = x;
  end when;
  when time >= 0.3 then
    choice = 1;
  elsewhen time >= 0.6 then
    choice = pre(choice) + 10;
  end when;
end Events;
"""


@pytest.mark.parametrize("fmi_type", ["ModelExchange", "CoSimulation"])
def test_events_come_at_their_times(simulate, fmi_type):
    names = ["x", "caught", "samples", "choice", "low", "last"]
    end = simulate(EVENTS, names, stop=1.0, fmi_type=fmi_type)[-1]
    assert end["caught"] == pytest.approx(math.log(2) / 2, abs=1e-7)
    assert end["samples"] == 4  # at 0.1, 0.35, 0.6, 0.85
    assert end["last"] == pytest.approx(math.exp(-2 * 0.85), abs=1e-7)
    assert end["choice"] == 11
    assert bool(end["low"])


BALL = """model Ball "Rigid bounces: reinit()"
  parameter Real e = 0.8;
  Real h(start = 1, fixed = true), v(start = 0, fixed = true);
  Integer bounces(start = 0, fixed = true);
equation
  der(h) = v;
  der(v) = -9.81;
  when h < 0 then
    reinit(v, -e*pre(v));
    bounces = pre(bounces) + 1;
  end when;
end Ball;
"""


@pytest.mark.parametrize("fmi_type", ["ModelExchange", "CoSimulation"])
def test_bouncing_ball_reaches_its_apexes(simulate, fmi_type):
    fall = math.sqrt(2 / 9.81)
    apex = fall + 0.8 * fall  # time of the first apex after the bounce
    result = simulate(BALL, ["h", "v", "bounces"], stop=apex, fmi_type=fmi_type)
    assert result["h"][-1] == pytest.approx(0.64, abs=1e-6)
    assert result["v"][-1] == pytest.approx(0.0, abs=1e-6)
    assert result["bounces"][-1] == 1


INITIAL = """model Initialization
  parameter Real p(fixed = false, start = 1) "Such that the start is steady";
  Real x(start = 2, fixed = true), y(start = 0.5), z;
  discrete Real d(start = 3);
initial equation
  der(x) = 0;
  d = 7;
equation
  der(x) = p - x^2;
  y^3 + y = x "Nonlinear, has the one real root 1";
  z = d + y;
  when time >= 0.5 then
    d = pre(d) + 1;
  end when;
end Initialization;
"""


def test_initial_equations_find_parameters_and_discrete_values(simulate):
    result = simulate(INITIAL, ["p", "x", "y", "z", "d"], stop=1.0)
    assert result["p"][0] == pytest.approx(4.0, abs=1e-9)
    assert result["y"] == pytest.approx(1.0, abs=1e-9)
    assert result["d"][0] == 7
    assert result["d"][-1] == 8
    assert result["x"] == pytest.approx(2.0, abs=1e-9)


INPUTS = """model Gain
  input Real u(start = 0.25);
  output Real y;
  Real x(start = 0, fixed = true);
  type Kind = enumeration(Off, On);
  parameter Kind kind = Kind.On;
  parameter Boolean doubled = false;
  parameter Integer offset = 3;
equation
  der(x) = u;
  y = (if kind == Kind.On then x else -1) * (if doubled then 2 else 1) + offset;
end Gain;
"""


def test_inputs_outputs_and_parameters_of_all_types(simulate):
    signal = np.array([(0.0, 1.0), (1.0, 1.0)], dtype=[("time", float), ("u", float)])
    result = simulate(INPUTS, ["x", "y"], input=signal)
    assert result["x"][-1] == pytest.approx(1.0, abs=1e-8)
    assert result["y"][-1] == pytest.approx(4.0, abs=1e-8)
    changed = simulate(INPUTS, ["y"], input=signal, start_values={"kind": 1, "doubled": True, "offset": 5})
    assert changed["y"][-1] == pytest.approx(3.0)


FUNCTIONS = """package Functions
  record Pair
    Real first, second[2];
  end Pair;
  function polynomial "Horner's rule"
    input Real coefficients[:];
    input Real x;
    output Real y = 0;
  algorithm
    for i in size(coefficients, 1):-1:1 loop
      y := y*x + coefficients[i];
    end for;
  end polynomial;
  function split
    input Real v[:];
    output Real total;
    output Real ends[2];
  algorithm
    total := sum(v);
    ends := {v[1], v[end]};
  end split;
  function pairOf
    input Real v[:];
    output Pair pair;
  protected
    Integer n = size(v, 1);
  algorithm
    pair := Pair(v[1], v[n - 1:n]);
  end pairOf;
  function branch
    input Real x;
    output Real y;
  algorithm
    if x > 1 then
      y := x;
    elseif x > 0 then
      y := x^2;
    else
      y := 0;
    end if;
  end branch;
  function factorial
    input Integer n;
    output Integer f;
  algorithm
    f := if n <= 1 then 1 else n*factorial(n - 1);
  end factorial;
  model Use
    Real x = time*2;
    Real p = polynomial({1, -2, 3}, x);
    Real total;
    Real ends[2];
    Pair pair = pairOf({x, 2*x, 3*x});
    Real b = branch(x - 0.5);
    parameter Integer n = factorial(4);
    Real m[2, 2] = [x, 1; 0, 2]*{{1, x}, {0, 1}};
    parameter Real grid[3] = {10*i + 2 for i in 1:3};
    Real s = grid[3]*x;
    Real w = cross({1.0, 0.0, x}, {0.0, 1.0, 0.0})*{1.0, 1.0, 1.0};
  equation
    (total, ends) = split({x, 2*x, 3*x});
  end Use;
end Functions;
"""


def test_functions_records_and_arrays_are_expanded(tmp_path, fmu_cache):
    from fmpy import simulate_fmu
    from modelica2fmu.build import BuildOptions, build_fmu

    source = tmp_path / "Functions.mo"
    source.write_text(FUNCTIONS, encoding="utf-8")
    report = build_fmu("Functions.Use", [source], tmp_path / "use.fmu", BuildOptions(cache=fmu_cache))
    names = ["x", "p", "total", "ends[2]", "pair.first", "pair.second[2]", "b", "n", "m[1,2]", "m[2,2]", "s", "w"]
    result = simulate_fmu(str(report.fmu), fmi_type="CoSimulation", stop_time=1.0, output=names, output_interval=0.1)
    x = result["x"]
    assert x == pytest.approx(2 * result["time"])
    assert result["p"] == pytest.approx(1 - 2 * x + 3 * x**2)
    assert result["total"] == pytest.approx(6 * x)
    assert result["ends[2]"] == pytest.approx(3 * x)
    assert result["pair.first"] == pytest.approx(x)
    assert result["pair.second[2]"] == pytest.approx(3 * x)
    shifted = x - 0.5
    assert result["b"] == pytest.approx(np.where(shifted > 1, shifted, np.where(shifted > 0, shifted**2, 0)))
    assert result["n"][0] == 24
    assert result["m[1,2]"] == pytest.approx(x * x + 1)
    assert result["m[2,2]"] == pytest.approx(2.0)
    assert result["s"] == pytest.approx(32 * x)
    assert result["w"] == pytest.approx(1 - x)


EXTERNAL = """package Outside
  pure function weigh "Row-major matrix, sizes, a string, two outputs and a return value"
    input Real matrix[:, :];
    input Integer flags[:];
    input String text;
    output Integer length;
    output Real sums[size(matrix, 1)];
    output Real total;
    external "C" length = weigh(matrix, size(matrix, 1), size(matrix, 2), flags, text, sums, total)
      annotation(Include = "#include \\"weigh.h\\"",
                 IncludeDirectory = "modelica://Outside/Resources/Include");
  end weigh;
  function label
    input Real radius;
    output String text;
  algorithm
    text := "sphere radius=" + String(radius, significantDigits = 17);
  end label;
  model Use
    parameter Real radius = 0.1 "Goes into a String, so it cannot be changed";
    parameter Real free = 2;
    parameter String text = label(radius);
    Integer length;
    Real sums[2], total;
    Real x(start = 0, fixed = true);
  equation
    (length, sums, total) = weigh({{time, 2, 3}, {free, 5, 6}}, {7, 8}, text);
    der(x) = total;
  end Use;
end Outside;
"""

WEIGH = """#include <stddef.h>
#include <string.h>
static int weigh(const double *matrix, size_t rows, size_t columns, const int *flags, const char *text,
                 double *sums, double *total)
{
  *total = flags[1];
  for (size_t i = 0; i < rows; ++i) {
    sums[i] = 0.0;
    for (size_t j = 0; j < columns; ++j) sums[i] += (double)(j + 1) * matrix[i * columns + j];
    *total += sums[i];
  }
  return (int)strlen(text);
}
"""


@pytest.fixture(scope="module")
def outside(tmp_path_factory, fmu_cache):
    from modelica2fmu.build import BuildOptions, build_fmu

    folder = tmp_path_factory.mktemp("outside") / "Outside"
    include = folder / "Resources" / "Include"
    include.mkdir(parents=True)
    (include / "weigh.h").write_text(WEIGH, encoding="utf-8")
    (folder / "package.mo").write_text(EXTERNAL, encoding="utf-8")
    return build_fmu("Outside.Use", [folder], folder.parent / "use.fmu", BuildOptions(cache=fmu_cache))


def test_external_functions_get_arrays_strings_and_sizes(outside):
    from fmpy import simulate_fmu

    result = simulate_fmu(
        str(outside.fmu), fmi_type="ModelExchange", stop_time=1.0, relative_tolerance=1e-9,
        output=["length", "sums[1]", "sums[2]", "x"], start_values={"free": 1.0},
    )  # fmt: skip
    assert result["length"][-1] == len("sphere radius=0.10000000000000001")
    assert result["sums[1]"] == pytest.approx(result["time"] + 13)
    assert result["sums[2]"] == pytest.approx(1 + 10 + 18)
    assert result["x"][-1] == pytest.approx(0.5 + 13 + 29 + 8, abs=1e-6)


def test_parameters_of_strings_are_constants(outside):
    from fmpy import read_model_description

    variables = {item.name: item for item in read_model_description(str(outside.fmu)).modelVariables}
    assert variables["radius"].variability == "constant"
    assert variables["free"].causality == "parameter"
    assert variables["text"].start == "sphere radius=0.10000000000000001"


def test_same_source_gives_the_same_code(translated):
    assert translated(EVENTS).generated.sources == translated(EVENTS).generated.sources


TERMINATED = """model Terminated
  Real x(start = 0, fixed = true);
equation
  der(x) = 1;
  when x >= 0.5 then
    terminate("half way");
  end when;
end Terminated;
"""


def test_terminate_ends_the_simulation(simulate):
    result = simulate(TERMINATED, ["x"], stop=1.0)
    assert result["time"][-1] == pytest.approx(0.5, abs=1e-6)


GUARDED = """model Guarded
  Real x(start = 0, fixed = true);
equation
  der(x) = 1;
  assert(x < 0.5, "x has grown to " + String(x));
end Guarded;
"""


def test_failing_assertion_stops_with_its_message(simulate, capfd):
    with pytest.raises(Exception, match="fmi2DoStep"):
        simulate(GUARDED, ["x"], stop=1.0, fmi_type="CoSimulation", debug_logging=False)
    assert "x has grown to" in capfd.readouterr().out


def test_description_obeys_the_standard(build, outside):
    from fmpy.validation import validate_fmu

    for fmu in (build(EVENTS).fmu, build(INPUTS).fmu, build(INITIAL).fmu, outside.fmu):
        assert validate_fmu(str(fmu)) == []


def test_tuned_parameter_moves_what_depends_on_it_and_no_state(build, tmp_path):
    from fmpy import extract, read_model_description
    from fmpy.fmi2 import FMU2Model

    fmu = str(build(OSCILLATOR).fmu)
    description = read_model_description(fmu)
    slots = {variable.name: variable.valueReference for variable in description.modelVariables}
    folder = extract(fmu, unzipdir=str(tmp_path))
    model = FMU2Model(
        guid=description.guid, unzipDirectory=folder, modelIdentifier=description.modelExchange.modelIdentifier
    )
    model.instantiate()
    model.setupExperiment(startTime=0.0)
    model.enterInitializationMode()
    model.exitInitializationMode()
    model.newDiscreteStates()
    model.enterContinuousTimeMode()
    model.setContinuousStates((ctypes.c_double * 2)(0.25, 1.0), 2)
    model.enterEventMode()
    model.setReal([slots["k"]], [16.0])
    assert model.getReal([slots["omega"]]) == [4.0]
    assert model.getReal([slots["x"]]) == [0.25]
    assert model.getReal([slots["der(v)"]]) == pytest.approx([-16.0 * 0.25])
    model.terminate()
    model.freeInstance()


WARNING = """model Warning "Warns between events, and has none"
  Real x(start = 0, fixed = true), y(start = 1, fixed = true);
equation
  der(x) = 1;
  der(y) = -50*(y - cos(x));
  assert(noEvent(x < 0.5 or x > 0.7), "x is " + String(x) + " %", AssertionLevel.warning);
  assert(x < 1e9, "never said", AssertionLevel.warning);
end Warning;
"""


@pytest.mark.parametrize("fmi_type", ["ModelExchange", "CoSimulation"])
def test_a_violated_warning_is_said_once_where_a_step_is_accepted(simulate, fmi_type):
    said: list[str] = []
    interval = 2.0 if fmi_type == "CoSimulation" else 0.08  # FMPy's steps in model exchange are its intervals
    simulate(
        WARNING, ["x"], stop=2.0, interval=interval, fmi_type=fmi_type,
        logger=lambda *words: said.append(words[-1].decode()),
    )  # fmt: skip
    about = [line for line in said if "x is" in line]
    assert len(about) == 1
    assert not any("never said" in line for line in said)
    x, time = re.fullmatch(r"x is (\S+) % \(first at (\S+) s\)", about[0]).groups()
    assert float(x) == pytest.approx(float(time), abs=1e-5)
    assert 0.5 <= float(x) < 0.7


NEAR_THE_END = """model NearTheEnd "Events just before the end"
  parameter Real last = 0.3;
  Real x(start = 0, fixed = true);
equation
  der(x) = if {relation} then 2 else 1;
  annotation(experiment(StopTime = 1, Tolerance = 1e-6, Interval = 0.1));
end NearTheEnd;
"""


@pytest.mark.parametrize("relation", [pytest.param("time > last", marks=pytest.mark.full), "x > last"])
@pytest.mark.parametrize("mode", ["me", "cs"])
def test_an_event_within_rounding_of_the_end_does_not_stop_a_run(build, mode, relation):
    from fmu_regression.simulate.simulation import simulate as run

    fmu = build(NEAR_THE_END.format(relation=relation)).fmu
    for stop in (0.1, 0.7, 123.4):
        for units in (0, 1, 2, 3, 5, 8, 20, 100, 1000):
            last = stop - units * math.ulp(stop)
            result = run(fmu, signals=["x"], stop=stop, interval=stop / 4, mode=mode, parameters={"last": last})
            assert result.signals["x"][-1] == pytest.approx(stop, rel=1e-9)


@pytest.mark.parametrize(
    "declared",
    [
        "Real y = i;\nequation\n  i = if u > 0 then integer(floor(u + 0.5)) else integer(ceil(u - 0.5));\n",
        "Real y;\nequation\n  y = i;\n  i = integer(u + 0.5);\n",
        "Real y;\nequation\n  -y = -i;\n  i = integer(u + 0.5);\n",
    ],
)
def test_a_real_that_is_an_integer_does_not_determine_it(simulate, declared):
    text = f"model Rounded\n  Real u = 4*time - 2;\n  Integer i;\n  {declared}end Rounded;\n"
    result = simulate(text, ["y", "u"])
    beside = np.abs(result["u"] % 1 - 0.5) > 1e-3
    np.testing.assert_allclose(result["y"][beside], np.floor(result["u"][beside] + 0.5), atol=1e-12)
