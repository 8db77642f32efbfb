"""Loops over similar statements compute what the statements would, to the last bit."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import numpy as np
import pytest
from contact_data import core_subset
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu, translate
from modelica2fmu.codegen import similar_statements
from modelica2fmu.library.standard_library import StandardLibrary
from random_expression import random_expression

ELEMENTS = 12
ARRAYS = 5
STOP = 0.05  # s; random relations may be crossed ever more often later
LOOP = re.compile(r"for \(int k = 0; k < \d+; \+\+k\)")
LEAVES = ("x[i]", "p[i]", "q[i]", "s", "k", "time", "0.7", "count[i].d", "x[{n} + 1 - i]")
TEMPLATES = (
    "({a} + {b})", "({a} - {b})", "{a}*{b}", "{a}/(2 + cos({b}))", "sin({a})",
    "noEvent(max({a}, {b}))", "noEvent(min({a}, 0.5*{b}))",
    "noEvent(if {a} > {b} then {c} else {a}*{c})", "(if up[i] then {a} else {b})", "sqrt(1 + ({a})^2)",
)  # fmt: skip


def expression(draw: np.random.Generator, leaves: tuple[str, ...], depth: int) -> str:
    return random_expression(draw, TEMPLATES, leaves, depth, 0.15)


def random_model(seed: int) -> str:
    """Elements of the same equations, with states, events, a sum over all, and terms that several equations share."""
    draw = np.random.default_rng(seed)
    leaves = tuple(leaf.format(n=ELEMENTS) for leaf in LEAVES)
    equations = []
    for number in range(ARRAYS):
        equations.append(f"    y{number}[i] = sin({expression(draw, leaves, 3)});")
        leaves += (f"y{number}[i]",)
    shared = expression(draw, leaves, 2)
    body = "\n".join(equations)
    arrays = ", ".join(f"y{number}[n]" for number in range(ARRAYS))
    values = ", ".join(f"{value:.3f}" for value in draw.uniform(-1, 1, ELEMENTS))
    return f"""model Similar
  model Count
    Boolean up;
    Real s;
    discrete Real d(start = 0, fixed = true);
  equation
    when up then
      d = pre(d) + 0.1*s;
    end when;
  end Count;
  constant Integer n = {ELEMENTS};
  parameter Real k = 0.3;
  parameter Real p[n] = {{{values}}};
  parameter Real q[n] = {{p[i]*k + i for i in 1:n}};
  Real x[n](start = p, each fixed = true), {arrays}, z[n], v[n], s;
  Boolean up[n];
  Count count[n];
equation
  s = sum(x)/n;
  der(x) = v;
  for i in 1:n loop
    up[i] = sin(40*time + i) > 0.3;
{body}
    z[i] = {shared} + y0[i];
    v[i] = z[i] - ({shared})*0.5 - x[i];
    count[i].up = up[i];
    count[i].s = s;
  end for;
  annotation(experiment(StopTime = 1, Tolerance = 1e-6, Interval = 0.005));
end Similar;
"""


def compared(
    model: str, names: list[str], folder: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> tuple[list[dict[str, np.ndarray]], list[str]]:
    """Signals of a model without and with loops, and its code."""
    source = folder / "Similar.mo"
    signals, codes = [], []
    monkeypatch.setattr(similar_statements, "_SMALL", 0)
    for name, least in (("single", 2.0), ("loops", -1.0)):
        monkeypatch.setattr(similar_statements, "_SAVED", least)
        fmu = folder / f"{name}.fmu"
        source.write_text(f"{model}// {name}\n")  # another key of the cache
        build_fmu("Similar", [source], fmu, BuildOptions(cache=cache))
        with zipfile.ZipFile(fmu) as archive:
            texts = [archive.read(each).decode() for each in archive.namelist() if "sources/model_part" in each]
        codes.append("".join(texts))
        signals.append(simulate(fmu, signals=names, stop=STOP).signals)
    return signals, codes


def check(seed: int, folder: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recorded = ("x[{}]", "z[{}]", "up[{}]", "y0[{}]", "count[{}].d")
    names = [array.format(i) for array in recorded for i in range(1, ELEMENTS + 1)]
    (single, loops), (plain, text) = compared(random_model(seed), names, folder, cache, monkeypatch)
    assert not LOOP.search(plain)
    assert LOOP.search(text)
    different = [name for name, values in single.items() if values.tobytes() != loops[name].tobytes()]
    assert not different


@pytest.mark.full
@pytest.mark.parametrize("seed", range(1, 14))
def test_loops_of_random_models_compute_the_same_numbers(
    seed: int, tmp_path: Path, fmu_cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    check(seed, tmp_path, fmu_cache, monkeypatch)


def guarded_model(seed: int) -> str:
    """Elements of which most compute nothing most of the time, but what is looked at does."""
    draw = np.random.default_rng(seed)
    leaves = tuple(leaf for leaf in LEAVES if "count" not in leaf and "{n}" not in leaf)
    templates = tuple(template for template in TEMPLATES if "up[i]" not in template)
    names = ("near", "far", "all")
    texts = {
        f"{name}{number}": random_expression(draw, templates, leaves, 2, 0.15) for name in names for number in range(4)
    }
    values = ", ".join(f"{value:.3f}" for value in draw.uniform(-1, 1, ELEMENTS))
    return """model Similar
  constant Integer n = {n};
  parameter Real k = 0.3;
  parameter Real p[n] = {{{values}}};
  parameter Real q[n] = {{p[i]*k + i for i in 1:n}};
  Real x[n](start = p, each fixed = true), v[n], gap[n], near[n], nearer[n], far[n], farther[n], z[n], y0[n], s;
equation
  s = sum(x)/n;
  der(x) = v;
  for i in 1:n loop
    gap[i] = sin(150*time + 2*i) - 0.6 + 0.01*x[i];
    near[i] = noEvent(if gap[i] > 0 then (x[i] - q[i])*sin({near0}) + ({near1}) else 0);
    nearer[i] = noEvent(if gap[i] > 0 then (x[i] - q[i])*cos({near0})/(2 + near[i]^2) else 0);
    far[i] = noEvent(if gap[i] > 0 then 0.1 else (x[i] + q[i])*sin({far0}));
    farther[i] = noEvent(if gap[i] > 0 then x[i] else (x[i] + q[i])*cos({far0}) + sin({far1}));
    z[i] = noEvent(if s > 0.01 then sin({all0})*x[i] else 0) + noEvent(if s > 0.01 then cos(({all0})*x[i]) else 0);
    y0[i] = (x[i] - q[i])*sin({near0}) + (x[i] + q[i])*sin({far0}) + sin({all0})*x[i] + ({all1});
    v[i] = sin(near[i] + nearer[i] + far[i] + farther[i] + z[i]) - x[i];
  end for;
  annotation(experiment(StopTime = 1, Tolerance = 1e-6, Interval = 0.005));
end Similar;
""".format(n=ELEMENTS, values=values, **texts)


@pytest.mark.parametrize("seed", [1, *(pytest.param(seed, marks=pytest.mark.full) for seed in range(2, 14))])
def test_what_branches_alone_need_is_computed_where_these_are_taken(
    seed: int, tmp_path: Path, fmu_cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    names = [f"{array}[{i}]" for array in ("x", "near", "farther", "z", "y0") for i in range(1, ELEMENTS + 1)]
    (single, loops), (plain, text) = compared(guarded_model(seed), names, tmp_path, fmu_cache, monkeypatch)
    assert "holding" not in plain
    assert "k < first[holding[h] + 1]" in text
    assert ") continue;" in text
    different = [name for name, values in single.items() if values.tobytes() != loops[name].tobytes()]
    assert not different


GROWING = """model Growing
  constant Integer n = {n};
  parameter Real c[n] = {{1 + 0.1*i for i in 1:n}};
  Real x[n](each start = 1, each fixed = true), f[n], g[n], v[n];
equation
  for i in 1:n loop
    f[i] = c[i]*sin(x[i]) + max(0, x[i] - 0.5)^1.5*exp(-c[i]*x[i]);
    g[i] = f[i]*cos(x[i])/(1 + abs(f[i]));
    v[i] = -f[i] - g[i];
  end for;
  der(x) = v;
end Growing;
"""


@pytest.mark.full
def test_code_does_not_grow_with_the_number_of_similar_equations(tmp_path: Path) -> None:
    lines = []
    for n in (200, 400):
        source = tmp_path / f"Growing{n}.mo"
        source.write_text(GROWING.format(n=n).replace("Growing", f"Growing{n}"))
        translation = translate(f"Growing{n}", [source], StandardLibrary(core_subset(), "", "core subset"))
        parts = [item.text for item in translation.generated.sources if item.name.startswith("model_part")]
        simulate_parts = [text for part in parts for text in re.findall(r"int fmurt_part_simulate_.*?\n}", part, re.S)]
        lines.append(sum(text.count("\n") for text in simulate_parts))
    assert lines[1] < 1.3 * lines[0]
