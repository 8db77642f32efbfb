"""Bodies that sink deep into each other are told of, in model exchange and co-simulation, and no others are."""

from __future__ import annotations

import math
import random
from pathlib import Path

import pytest
from contact_data import core_subset
from fmu_regression.simulate.simulation import simulate
from library_compiler import REPOSITORY
from modelica2fmu.build import BuildOptions, build_fmu

MODEL = """model Fall
  parameter Real K = 1e6, v = 1;
  constant Modelica.Units.SI.Length size[3] = {0.4, 0.6, 0.2};
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity);
  ContactMultiBody.Parts.Body body(
    m=1, r_CM={0,0,0}, I_11=1, I_22=1, I_33=1, geometry=ContactMultiBody.Shapes.box(size),
    material=ContactMultiBody.Materials.Material(restitution=1),
    r_0(start={0,0,size[3]/2 + 0.1*v}, each fixed=true), v_0(start={0,0,-v}, each fixed=true));
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=1));
  ContactMultiBody.MANAGER;
equation
  connect(body.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
end Fall;
"""
POINTS = """ContactManager contacts(n=2, collider={body.collider, floor.collider}, exponent=1,
    friction=ContactMultiBody.Types.Friction.None,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given, stiffness={K})"""
MANAGERS = {
    "points": POINTS,
    "without events": POINTS[:-1]
    + ", restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless, inertia={body.inertia, floor.inertia})",
    "volume": """VolumeContactManager contacts(n=2, collider={body.collider, floor.collider},
    friction=ContactMultiBody.Types.Friction.None, foundationModulus={K/(size[1]*size[2])})""",
    "compiled": """CompiledContactManager contacts(n=2, geometry={body.geometry, floor.geometry}, exponent=1,
    material={body.material, floor.material}, inertia={body.inertia, floor.inertia}, useFriction=false,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given, stiffness={K, Modelica.Constants.inf})""",
}
HEIGHT, SAMPLES = 0.2, 6


@pytest.mark.full
@pytest.mark.parametrize("manager", MANAGERS)
def test_what_sinks_by_half_its_thickness_is_told(manager: str, fmu_cache: Path, tmp_path: Path) -> None:
    """A box falls flat: the greatest depth is v sqrt(m/K)."""
    source, fmu = tmp_path / "Fall.mo", tmp_path / "Fall.fmu"
    source.write_text(MODEL.replace("MANAGER", MANAGERS[manager]))
    build_fmu("Fall", [source, REPOSITORY / "ContactMultiBody"], fmu, BuildOptions(msl=core_subset(), cache=fmu_cache))
    draw = random.Random(7)
    for sample in range(SAMPLES):
        is_deep, mode = sample % 2 == 1, ("cs", "me")[sample // 2 % 2]
        speed = 10 ** draw.uniform(-2, 2)
        depth = HEIGHT * (draw.uniform(0.55, 0.8) if is_deep else draw.uniform(0.01, 0.45))
        stiffness = (speed / depth) ** 2
        result = simulate(
            fmu,
            mode=mode,  # type: ignore[arg-type]
            stop=0.1 + 0.5 * math.pi * depth / speed,
            tolerance=1e-6,
            parameters={"K": stiffness, "v": speed},
        )
        told = [line for line in result.log if "half the thickness" in line]
        assert len(told) == int(is_deep), (sample, mode, result.log)
        if is_deep and manager != "compiled":
            assert "pair 1" in told[0]
