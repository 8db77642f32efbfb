"""Modelica constructs, what they have to compute, and which the builder refuses: data of test_constructs and the docs.

``python construct_table.py`` prints the table of docs/fmu-builder.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]


@dataclass(frozen=True)
class Covered:
    """Constructs that one model has.

    Attributes:
        name: of the model.
        text: its declarations and equations.
        expected: closed form over time of a variable that a construct determines, by the construct.
        classes: functions and types beside the model.
    """

    name: str
    text: str
    expected: Mapping[str, tuple[str, Callable[[Values], Values]]]
    classes: str = ""


@dataclass(frozen=True)
class Refused:
    """A construct that is refused.

    Attributes:
        construct: for the table.
        text: declarations and equations.
        message: part of the error's message.
        by: who refuses it: ``builder`` or ``front end``.
        classes: functions and types beside the model.
    """

    construct: str
    text: str
    message: str
    by: str = "builder"
    classes: str = field(default="")


def const(value: float) -> Callable[[Values], Values]:
    return lambda t: np.full_like(t, value)


def step(at: float, before: float, after: float) -> Callable[[Values], Values]:
    return lambda t: np.where(t < at, before, after)


# Simulated from 0 to 2; expected values are compared 1e-3 beside every multiple of 0.05.
COVERED = (
    Covered(
        "Data",
        """
  parameter Pair pair = Pair(2, {3, 4});
  Pair moving = Pair(time, {1.0, 2.0}*time);
  Real matrix[2, 2] = {{1.0, time}, {0.0, 1.0}}*[1.0, 0.0; 2.0, 1.0];
  Real empty[0];
  Real total = sum(empty) + sum({i*j*time for i in 1:2, j in 1:2});
  parameter Choice choice = Choice.Second;
  Real chosen = if choice == Choice.Second then time else -1;
  parameter String word = "ab" + String(pair.second[1]);
  parameter Boolean same = word == "ab3";
  Real text = if same then time else 0;
  Real slice[2] = {pair.second[3 - i]*time for i in 1:2};
  Real record_sum = pair.first + moving.second[2];
  Real cross3[3] = cross({1.0, 0.0, 0.0}, {0.0, time, 0.0});
  Real filled[3];
  Real least = min({time, 1.0}), size_ = abs(time - 1);
algorithm
  for i in 1:3 loop
    filled[i] := i*time;
  end for;
""",
        {
            "records": ("record_sum", lambda t: 2 + 2 * t),
            "arrays, matrix products, `[a, b; c, d]`": ("matrix[1,1]", lambda t: 1 + 2 * t),
            "arrays of size 0, array constructors with iterators": ("total", lambda t: 9 * t),
            "enumerations": ("chosen", lambda t: t),
            "String parameters, `+`, `String()`, comparisons": ("text", lambda t: t),
            "slices and index expressions": ("slice[1]", lambda t: 4 * t),
            "for-loops in algorithm sections of models": ("filled[3]", lambda t: 3 * t),
            "`cross`, `skew`, `sum`, `product`, `transpose`, ...": ("cross3[3]", lambda t: t),
            "`min`, `max` of arrays and scalars (no event)": ("least", lambda t: np.minimum(t, 1)),
            "`abs` (no event)": ("size_", lambda t: np.abs(t - 1)),
        },
        """
  record Pair
    Real first;
    Real second[2];
  end Pair;
  type Choice = enumeration(First, Second);
""",
    ),
    Covered(
        "Loops",
        """
  parameter Integer order[3] = {3, 1, 2};
  Real v[3] = {time, 2.0, 3.0*time};
  Real picked[3] = {v[i] for i in {3, 1, 2}};
  Real squares[3] = {x^2 for x in v};
  Real most = max(abs(x - 4) for x in v);
  Real listed[3], ordered[3], added, counted, chosen[Choice];
  Real gathered = totalOf(v);
  Real turned[3] = cross({0, 0, 1}, v);
algorithm
  added := 0;
  for i in 1:size(v, 1) loop
    if i <> 2 then
      added := added + i*v[i];
    end if;
  end for;
algorithm
  counted := 0;
  for x in v loop
    for k in {1, 2} loop
      counted := counted + k*x;
    end for;
  end for;
equation
  for i in {3, 1, 2} loop
    listed[i] = i*time; // "i"
  end for;
  for e in Choice loop
    chosen[e] = if e == Choice.Second then 2*time else 0;
  end for;
  for i in order loop
    ordered[i] = v[order[i]];
  end for;
""",
        {
            "array constructors over lists": ("picked[2]", lambda t: t),
            "array constructors over vectors": ("squares[3]", lambda t: 9 * t**2),
            "reductions over vectors": (
                "most",
                lambda t: np.maximum(np.maximum(np.abs(t - 4), 2), np.abs(3 * t - 4)),
            ),
            "loops over lists": ("listed[3]", lambda t: 3 * t),
            "loops over enumerations": ("chosen[2]", lambda t: 2 * t),
            "loops over vectors": ("ordered[1]", lambda t: 3 * t),
            "loops over vectors in functions": ("gathered", lambda t: 4 * t + 2),
            "loops in algorithm sections of models that add up": ("added", lambda t: 10 * t),
            "loops over vectors in algorithm sections": ("counted", lambda t: 12 * t + 6),
            "`cross`, `skew` of Integers": ("turned[1]", lambda t: np.full_like(t, -2.0)),
        },
        """
  type Choice = enumeration(First "x, y", Second);
  function totalOf
    input Real v[:];
    output Real y = 0;
  algorithm
    for x in v loop
      y := y + x;
    end for;
  end totalOf;
""",
    ),
    Covered(
        "Functions",
        """
  Real looped = horner({1, 2, 3}, time);
  Real guarded = early(time - 1);
  Real counted = count(time);
  Real first, second;
  Real recursive = factorial(4)*time;
  Real fromC = outside({time, 2});
  Bounds bounds = spread(time);
  Real fields = bounds.high;
  Real folded = fold(time);
equation
  (first, second) = two(time);
""",
        {
            "functions with for-loops": ("looped", lambda t: 1 + 2 * t + 3 * t**2),
            "`return` under a condition of variables": ("guarded", lambda t: np.where(t < 1, -1.0, t)),
            "while-loops that a counter bounds": ("counted", lambda t: np.ceil(t)),
            "functions with several outputs": ("second", lambda t: 2 * t),
            "recursion of known depth": ("recursive", lambda t: 24 * t),
            "external C, code in Include": ("fromC", lambda t: t * 2),
            "functions that return records": ("fields", lambda t: t + 1),
            "if-statements in functions": ("folded", lambda t: np.where(t > 1.5, 1.5, t)),
        },
        """
  record Bounds
    Real low;
    Real high;
  end Bounds;
  function horner
    input Real c[:];
    input Real x;
    output Real y = 0;
  algorithm
    for i in size(c, 1):-1:1 loop
      y := y*x + c[i];
    end for;
  end horner;
  function early
    input Real x;
    output Real y;
  algorithm
    y := 1;
    if x < 0 then
      y := -1;
      return;
    end if;
    y := y + x;
  end early;
  function count
    input Real x;
    output Integer n;
  algorithm
    n := 0;
    while n < 5 and n < x loop
      n := n + 1;
    end while;
  end count;
  function two
    input Real x;
    output Real a;
    output Real b;
  algorithm
    a := x;
    b := 2*x;
  end two;
  function factorial
    input Integer n;
    output Integer f;
  algorithm
    f := if n <= 1 then 1 else n*factorial(n - 1);
  end factorial;
  function spread
    input Real x;
    output Bounds b;
  algorithm
    b := Bounds(x - 1, x + 1);
  end spread;
  function fold
    input Real x;
    output Real y;
  algorithm
    if x > 1.5 then
      y := 1.5;
    else
      y := x;
    end if;
  end fold;
  pure function outside
    input Real u[2];
    output Real y;
    external "C" y = cmb_test_product(u) annotation(Include = "static double cmb_test_product(const double *u)
{ return u[0]*u[1]; }");
  end outside;
""",
    ),
    Covered(
        "Events",
        """
  Real x(start = 0, fixed = true);
  Integer samples(start = 0, fixed = true), branch(start = 0, fixed = true);
  discrete Real caught(start = -1, fixed = true);
  Boolean late = x > 0.975, rising = edge(late), changing = change(late);
  Integer rises(start = 0, fixed = true), changes(start = 0, fixed = true);
  Boolean initially(start = false, fixed = true);
  Integer down = integer(3*x);
  Real up = ceil(2*x), low = floor(-2*x), remainder = mod(3*x, 1), signed = rem(-3*x, 2), quotient = div(3*x - 3, 1);
  Real chosen, smoothed = smooth(0, noEvent(if x > 1 then 1 else x));
  Real throttle = semiLinear(x - 1, 2, 3);
  Real blend = homotopy(actual = x, simplified = 0);
  Real saw(start = 0, fixed = true);
equation
  der(x) = 1;
  der(saw) = 1;
  when saw > 0.775 then
    reinit(saw, 0);
  end when;
  when sample(0.125, 0.5) then
    samples = pre(samples) + 1;
  end when;
  when x > 1.525 then
    branch = 2;
  elsewhen {x > 0.525, x > 1.025} then
    branch = pre(branch) + 1;
  end when;
  when late then
    caught = x;
  end when;
  when rising then
    rises = pre(rises) + 1;
  end when;
  when changing then
    changes = pre(changes) + 1;
  end when;
  when initial() then
    initially = true;
  end when;
  if x > 0.725 then
    chosen = 2*x;
  else
    chosen = -x;
  end if;
""",
        {
            "`when`, `sample`, `pre`": ("samples", lambda t: np.floor((t - 0.125) / 0.5) + 1),
            "`elsewhen`, vectors of conditions": (
                "branch",
                lambda t: np.select([t < 0.525, t < 1.025, t < 1.525], [0, 1, 2], 2),
            ),
            "`discrete Real` that a when-equation catches": ("caught", step(0.975, -1, 0.975)),
            "`edge`": ("rises", step(0.975, 0, 1)),
            "`change`": ("changes", step(0.975, 0, 1)),
            "`when initial()`": ("initially", const(1)),
            "`integer` with events": ("down", lambda t: np.floor(3 * t)),
            "`ceil` with events": ("up", lambda t: np.ceil(2 * t)),
            "`floor` with events": ("low", lambda t: np.floor(-2 * t)),
            "`mod` with events": ("remainder", lambda t: np.mod(3 * t, 1)),
            "`rem` with events": ("signed", lambda t: np.fmod(-3 * t, 2)),
            "`div` with events": ("quotient", lambda t: np.trunc(3 * t - 3)),
            "if-equations": ("chosen", lambda t: np.where(t > 0.725, 2 * t, -t)),
            "`smooth`, `noEvent`": ("smoothed", lambda t: np.minimum(t, 1)),
            "`semiLinear`": ("throttle", lambda t: np.where(t > 1, 2 * (t - 1), 3 * (t - 1))),
            "`homotopy` (its actual argument)": ("blend", lambda t: t),
            "`reinit`": ("saw", lambda t: np.mod(t, 0.775)),
        },
    ),
    Covered(
        "Start",
        """
  parameter Real found(fixed = false, start = 1);
  Real x(start = 2, fixed = true), cubic(start = 0.5);
  discrete Real counted(start = 0);
  Integer chosen;
  parameter Real k = 2;
  final parameter Real twice = 2*k;
  Real y = twice*time;
initial equation
  der(x) = 0;
  counted = 7;
initial algorithm
  chosen := 3;
equation
  der(x) = found - x^2;
  cubic^3 + cubic = x;
  when time >= 0.525 then
    counted = pre(counted) + 1;
    chosen = pre(chosen) + 1;
  end when;
  assert(x < 5, "never");
""",
        {
            "initial equations, parameters with `fixed = false`": ("found", const(4)),
            "nonlinear equations": ("cubic", const(1)),
            "initial equations of discrete variables": ("counted", step(0.525, 7, 8)),
            "initial algorithms": ("chosen", step(0.525, 3, 4)),
            "dependent parameters": ("y", lambda t: 4 * t),
        },
    ),
    Covered(
        "Delays",
        """
          discrete Real steps(start = 0, fixed = true);
          Real smooth = delay(sin(3*time), 0.37);
          Real jumping = delay(steps + time, 0.31);
          Real varying = delay(time^2, 0.1 + 0.2*time, 1.0);
          Real x(start = 1, fixed = true);
        equation
          when sample(0.5, 0.5) then
            steps = pre(steps) + 1;
          end when;
          der(x) = -delay(x, 1.0);
        """,
        {
            "`delay`": ("smooth", lambda t: np.where(t < 0.37, 0, np.sin(3 * (t - 0.37)))),
            "`delay` of what jumps": (
                "jumping",
                lambda t: np.where(t < 0.31, 0, np.floor(2 * np.maximum(t - 0.31, 0)) + t - 0.31),
            ),
            "`delay` that changes": ("varying", lambda t: np.maximum(0.8 * t - 0.1, 0) ** 2),
            "delay-differential equations": (
                "x",
                lambda t: np.where(t < 1, 1 - t, 1 - t + (t - 1) ** 2 / 2),
            ),
        },
    ),
    Covered(
        "ControlFlow",
        """
  Real found = 1.0*search({0, 0.5, 1.5}, time);
  Law law = lawOf(time);
  Real damping = law.d;
  Real placed = sum(marked(time));
  Real sums = last(time);
  Real named = second(time);
  Real checked = if time < 1.5 then below(time) else below(1);
  Real slopes = sum(partialSums({time, 1, 2}));
""",
        {
            "`break` under a condition of variables": (
                "found",
                lambda t: np.select([t < 0.5, t < 1.5], [1.0, 2.0], 3.0),
            ),
            "records that branches change": ("damping", lambda t: np.where(t < 1, 2 * t, 3.0)),
            "assignments to elements whose index changes": ("placed", lambda t: np.where(t < 1, 2 + t, 1 + t)),
            "loops in functions over lists and vectors, in which elements change": ("sums", lambda t: 6 * t + 3),
            "calls in functions with outputs left out, arguments named": ("named", lambda t: 2 * t),
            "assertions in functions, where they are called": ("checked", lambda t: np.where(t < 1.5, t, 1.0)),
            "loops in functions from one index to another": ("slopes", lambda t: 3 * t + 2 + 2),
        },
        """
  record Law
    Real k;
    Real d;
  end Law;
  function search
    input Real table[:];
    input Real x;
    output Integer index = 0;
  algorithm
    for i in 1:size(table, 1) loop
      if table[i] > x then
        break;
      end if;
      index := i;
    end for;
  end search;
  function lawOf
    input Real x;
    output Law law;
  algorithm
    law := Law(k = 1, d = 3);
    if x < 1 then
      law.d := 2*x;
    end if;
  end lawOf;
  function marked
    input Real x;
    output Real v[2];
  algorithm
    v := {1, 2}; // the one that x names is written over
    v[integer(x) + 1] := x;
  end marked;
  function last
    input Real x;
    output Real y = 0;
  protected
    Real v[3] = {1, 2, 3};
  algorithm
    for factor in {x, 2*x} loop
      for each_ in v loop
        y := y + factor*each_/3;
      end for;
    end for;
    y := y + (if x < 0 then 1 else v[3]);
    if x < 0 then
      return;
    end if;
  end last;
  function both
    input Real a = 5;
    input Real b;
    output Real first = a;
    output Real twice;
  algorithm
    twice := 2*b;
    if b < 0 then
      return;
    end if;
  end both;
  function second
    input Real x;
    output Real y;
  algorithm
    (, y) := both(b = x);
  end second;
  function below
    input Real x;
    output Real y;
  algorithm
    if x > 5 then
      assert(false, "never called so");
    end if;
    assert(x < 1.6, "too large: " + String(x));
    y := x;
  end below;
  function partialSums
    input Real x[:];
    output Real s[size(x, 1)];
  algorithm
    for i in 1:size(x, 1) loop
      s[i] := 0;
      for k in i:size(x, 1) loop
        s[i] := s[i] + (if k == 2 then 1 elseif k == 1 then 3*x[1] else x[3]/3);
      end for;
    end for;
  end partialSums;
""",
    ),
)

REFUSED = (
    Refused("String variables that change", 'String s = if time > 0.5 then "a" else "b";', "String"),
    Refused(
        "while-loops without a bound that is known at translation",
        "Real x = root(time);",
        "more than 200 times",
        "builder",
        classes="""
  function root
    input Real a;
    output Real x = 1;
  algorithm
    while abs(x*x - a) > 1e-9 loop
      x := (x + a/x)/2;
    end while;
  end root;
""",
    ),
    Refused(
        "String outputs of external functions",
        'parameter String s = name(2);\n  Real x = if s == "a" then time else 0;',
        "String output",
        classes="""
  pure function name
    input Real u;
    output String y;
    external "C" y = name(u);
  end name;
""",
    ),
    Refused(
        "derivatives of outputs of external functions",
        "Real x = f(time);\n  Real v = der(x);",
        "external function",
        classes="""
  pure function f
    input Real x;
    output Real y;
    external "C" y = sin(x) annotation(Include = "#include <math.h>");
  end f;
""",
    ),
    Refused(
        "outputs left out in equations: `(, b) = f(x)`",
        "Real b;\nequation\n  (, b) = two(time);",
        "left out",
        "front end",
        classes="""
  function two
    input Real x;
    output Real a;
    output Real b;
  algorithm
    a := x;
    b := 2*x;
  end two;
""",
    ),
    Refused(
        "elements of arrays that a when-clause sets",
        "discrete Real v[2](each start = 0);\nequation\n  when time > 1 then\n    v[1] = 1;\n  end when;",
        "element of an array",
        "front end",
    ),
    Refused(
        "`reinit` of elements of arrays",
        "Real v[2](each start = 1);\nequation\n  der(v) = -v;\n  when time > 1 then\n    reinit(v[1], 1);\n  end when;",
        "element of an array",
        "front end",
    ),
    Refused("`der` of an expression", "Real x = time, v = der(x^2);", "der of an expression", "front end"),
    Refused(
        "outer variables (records that hold them are taken)",
        "S s;\n  inner Real g = time;",
        "inner variable",
        "builder",
        classes="""
  model S
    outer Real g;
    Real y = g;
  end S;
""",
    ),
    Refused("derivatives of inputs", "input Real u;\n  Real x = der(u);", "", "front end"),
    Refused(
        "algebraic loops over discrete variables", "Boolean a = b and time > 0.5, b = not a;", "cycle", "front end"
    ),
    Refused("`spatialDistribution`", "Real y = spatialDistribution(time, 0, 1, true);", "spatial", "front end"),
    Refused(
        "synchronous operators (`Clock`, `previous`, `hold`)",
        "Real x(start = 0);\nequation\n  when Clock(0.1) then\n    x = previous(x) + 1;\n  end when;",
        "previous",
        "front end",
    ),
    Refused(
        "external objects other than the Standard Library's tables",
        "Table table = Table(1);",
        "",
        "front end",
        classes="""
  class Table
    extends ExternalObject;
    function constructor
      input Real x;
      output Table table;
      external "C" table = make(x);
    end constructor;
    function destructor
      input Table table;
      external "C" drop(table);
    end destructor;
  end Table;
""",
    ),
)


def rows() -> list[str]:
    """The lines of the table of the documentation."""
    lines = ["| construct | |", "|---|---|"]
    lines += [f"| {construct} | yes |" for case in COVERED for construct in case.expected]
    lines += [f"| {case.construct} | refused by the {case.by} |" for case in REFUSED]
    return lines


if __name__ == "__main__":
    import sys

    sys.stdout.write("\n".join(rows()) + "\n")
