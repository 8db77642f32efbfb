"""Bodies of ContactMultiBody stand in for those of the Standard Library: without contacts nothing else changes."""

from __future__ import annotations

import os
import re
from pathlib import Path

import numpy as np
import pytest
from contact_data import modelica_library
from fmu_regression.fmi.description import ModelDescription
from fmu_regression.fmi.fmu import open_fmu
from fmu_regression.results.result import SimulationResult
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu

THEIRS = "Modelica.Mechanics.MultiBody.Parts"
OURS = "ContactMultiBody.Parts"
PARTS = "PARTS"

# Name: declarations, connections, signals that are compared.
SOME = ("DoublePendulum",)
MODELS: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "TumblingBody": (
        """PARTS.Body body(m=2, r_CM={0.1,0,0}, I_11=0.1, I_22=0.2, I_33=0.3, I_21=0.01, r_0(each fixed=true),
  v_0(start={1,0,2}, each fixed=true), angles_fixed=true, w_0_fixed=true, w_0_start={1,2,3});""",
        "",
        ("body.r_0[1]", "body.r_0[3]", "body.w_a[2]", "body.frame_a.R.T[1,2]"),
    ),
    "Pendulum": (
        """J.Revolute joint(n={0,1,0}, phi(start=0.5, fixed=true), w(fixed=true));
PARTS.Fixed fixed(r={0,0,1});
PARTS.BodyShape body(m=1, r={0.5,0,0}, r_CM={0.3,0,0}, I_22=0.02);""",
        "connect(fixed.frame_b, joint.frame_a); connect(joint.frame_b, body.frame_a);",
        ("joint.phi", "joint.w", "body.frame_b.r_0[3]"),
    ),
    "DoublePendulum": (
        """J.Revolute upper(n={0,1,0}, phi(start=1, fixed=true), w(fixed=true));
J.Revolute lower(n={0,1,0}, phi(start=-0.5, fixed=true), w(fixed=true));
PARTS.BodyBox first(r={0.4,0,0}, width=0.05, height=0.03);
PARTS.BodyCylinder second(r={0.3,0,0}, diameter=0.04);""",
        """connect(world.frame_b, upper.frame_a); connect(upper.frame_b, first.frame_a);
connect(first.frame_b, lower.frame_a); connect(lower.frame_b, second.frame_a);""",
        ("upper.phi", "lower.phi", "second.frame_b.r_0[1]"),
    ),
    "Slider": (
        """J.Prismatic joint(n={1,0,0}, s(start=0.2, fixed=true), v(fixed=true));
PARTS.Body body(m=3, r_CM={0,0,0});
J.Revolute hinge(n={0,1,0}, phi(start=0.3, fixed=true), w(fixed=true));
PARTS.BodyShape bob(m=1, r={0,0,-0.4}, r_CM={0,0,-0.4}, I_11=0.01, I_22=0.01, I_33=0.01);""",
        """connect(world.frame_b, joint.frame_a); connect(joint.frame_b, body.frame_a);
connect(joint.frame_b, hinge.frame_a); connect(hinge.frame_b, bob.frame_a);""",
        ("joint.s", "hinge.phi", "bob.frame_b.r_0[3]"),
    ),
    "Throw": (
        """PARTS.BodyBox box(r={0.2,0,0}, r_0(start={0,0,1}, each fixed=true), v_0(start={2,0,3}, each fixed=true),
  angles_fixed=true, w_0_fixed=true, w_0_start={0.1,4,0.2});
discrete Real passed(start=0, fixed=true);""",
        "when box.r_0[3] < 0 then passed = time; end when;",
        ("box.r_0[1]", "box.r_0[3]", "passed"),
    ),
}


def libraries() -> dict[str, Path | None]:
    """The core subset, and every Standard Library on MODELICAPATH."""
    found: dict[str, Path | None] = {"core": None}
    for entry in filter(None, os.environ.get("MODELICAPATH", "").split(os.pathsep)):
        package = Path(entry) / "Modelica" / "package.mo"
        version = re.search(r'\bversion\s*=\s*"([\d.]+)"', package.read_text("utf-8")) if package.is_file() else None
        if version is not None:
            found[version[1]] = Path(entry)
    return found


def built(folder: Path, name: str, parts: str, options: BuildOptions) -> Path:
    declarations, equations, _ = MODELS[name]
    text = f"""model {name}
  import ContactMultiBody;
  import J = Modelica.Mechanics.MultiBody.Joints;
  inner Modelica.Mechanics.MultiBody.World world(n={{0,0,-1}});
  {declarations}
equation
  {equations}
end {name};
"""
    home = folder / parts
    home.mkdir()
    source = home / f"{name}.mo"
    source.write_text(text.replace(PARTS, parts), encoding="utf-8")
    build_fmu(name, (source, modelica_library()), home / f"{name}.fmu", options)
    return home / f"{name}.fmu"


def described(fmu: Path) -> ModelDescription:
    with open_fmu(fmu) as opened:
        return opened.description


def run(fmu: Path, signals: tuple[str, ...]) -> SimulationResult:
    return simulate(fmu, signals=signals, stop=1.0, tolerance=1e-8, interval=0.01)


@pytest.mark.full
@pytest.mark.parametrize("library", libraries())
@pytest.mark.parametrize(
    "name", [name if name in SOME else pytest.param(name, marks=pytest.mark.full) for name in MODELS]
)
def test_nothing_changes(tmp_path: Path, fmu_cache: Path, name: str, library: str) -> None:
    options = BuildOptions(msl=libraries()[library], cache=fmu_cache)
    theirs = built(tmp_path, name, THEIRS, options)
    ours = built(tmp_path, name, OURS, options)
    before, after = described(theirs), described(ours)
    added = set(after.variables) - set(before.variables)
    assert set(before.variables) <= set(after.variables)
    assert added
    assert all(after.variables[v].variability in {"constant", "fixed", "tunable"} for v in added), added
    assert (after.states, after.indicator_count) == (before.states, before.indicator_count)
    signals = MODELS[name][2]
    one, other = run(theirs, signals), run(ours, signals)
    assert one.counters == other.counters
    assert np.array_equal(one.time, other.time)
    for signal in signals:
        assert np.ptp(one[signal]) > 1e-3, "nothing moves"
        assert np.abs(one[signal] - other[signal]).max() <= 1e-12 * max(1.0, np.abs(one[signal]).max())
