"""What one branch of a conditional expression alone needs is computed where it is taken, with the same result."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import numpy as np
import pytest
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.codegen import branch_nodes
from random_expression import random_expression

STATES = 4
STOP = 0.2  # s
BRANCH = re.compile(r"^ +if \(.*\) \{\n +(?:const )?(?:double|fmurt_lanes) n\d+", re.MULTILINE)
LEAVES = ("x[1]", "x[2]", "x[3]", "x[4]", "p", "time", "0.7")
TEMPLATES = (
    "({a} + {b})", "({a} - {b})", "{a}*{b}", "{a}/(2 + cos({b}))", "sin({a})", "exp(-({a})^2)", "sqrt(1 + ({a})^2)",
    "noEvent(if {a} > {b} then {c} else exp(-({a})^2)*sin({c}))", "noEvent(if {a} > {b} then 0 else {c})",
    "(if {a} > 0.1 then log(2 + ({b})^2) else {c})",
)  # fmt: skip


def expression(draw: np.random.Generator, leaves: tuple[str, ...], depth: int) -> str:
    return random_expression(draw, TEMPLATES, leaves, depth, 0.1)


def random_model(seed: int) -> str:
    """States whose derivatives share conditional expressions, nested ones too."""
    draw = np.random.default_rng(seed)
    leaves, equations = LEAVES, []
    for k in range(1, STATES + 1):
        equations.append(f"  y[{k}] = noEvent(if {expression(draw, leaves, 2)} > 0 then {expression(draw, leaves, 4)}")
        equations.append(f"    else {expression(draw, leaves, 4)});")
        leaves += (f"y[{k}]",)
        equations.append(f"  der(x[{k}]) = sin({expression(draw, leaves, 3)}) - x[{k}];")
    body = "\n".join(equations)
    return f"""model Branches
  parameter Real p = 0.3;
  Real x[{STATES}](start = {{0.1, -0.2, 0.3, 0.6}}, each fixed = true), y[{STATES}];
equation
{body}
  annotation(experiment(StopTime = 1, Tolerance = 1e-6, Interval = 0.01));
end Branches;
"""


def check(seed: int, folder: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = folder / "Branches.mo"
    names = [f"{array}[{k}]" for array in "xy" for k in range(1, STATES + 1)]
    signals, branches = [], []
    for name, least in (("together", 1_000_000), ("branches", 1)):
        monkeypatch.setattr(branch_nodes, "_LEAST", least)
        source.write_text(f"{random_model(seed)}// {name}\n")  # another key of the cache
        fmu = folder / f"{name}.fmu"
        build_fmu("Branches", [source], fmu, BuildOptions(cache=cache))
        with zipfile.ZipFile(fmu) as archive:
            texts = [archive.read(each).decode() for each in archive.namelist() if "sources/model_part" in each]
        branches.append(sum(len(BRANCH.findall(text)) for text in texts))
        found = [simulate(fmu, signals=names, stop=STOP, mode=mode).signals for mode in ("me", "cs")]
        signals.append([values.tobytes() for each in found for values in each.values()])
    assert branches[0] == 0
    assert branches[1] > 0
    assert signals[0] == signals[1]


def test_branches_compute_the_same_numbers(tmp_path: Path, fmu_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    check(1, tmp_path, fmu_cache, monkeypatch)


@pytest.mark.full
@pytest.mark.parametrize("seed", range(2, 14))
def test_branches_of_random_models_compute_the_same_numbers(
    seed: int, tmp_path: Path, fmu_cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    check(seed, tmp_path, fmu_cache, monkeypatch)
