"""Colliders in another order than the frames are noticed where a Ground or a Fixed says where its frame is.

What the FMU builder notices beyond that: test_collider_order of its tests.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_foundation.errors import CmbError
from fmu_regression.simulate.simulation import simulate
from library_compiler import REPOSITORY
from modelica2fmu.build import BuildOptions, build_fmu

MODEL = """model Colliders
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  ContactMultiBody.Parts.Body ball(m=1, r_CM={0,0,0}, geometry=ContactMultiBody.Shapes.sphere(0.1),
    r_0(start={0,0,0.5}, each fixed=true), v_0(each fixed=true), angles_fixed=true, w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.Parts.Fixed wall(r={1,0,0}, geometry=ContactMultiBody.Shapes.box({0.1,1,1}));
  parameter ContactMultiBody.Parts.Collider listed[3]={ORDER} "So that a builder cannot see whose they are";
  ContactMultiBody.MANAGER contacts(n=3, collider=listed);
equation
  connect(ball.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  connect(wall.frame_b, contacts.frame[3]);
end Colliders;
"""
RIGHT = "ball.collider, floor.collider, wall.collider"
GROUND_FIRST = "floor.collider, ball.collider, wall.collider"
TWO_FIXED_SWAPPED = "ball.collider, wall.collider, floor.collider"


def built_and_run(folder: Path, cache: Path, manager: str, order: str) -> None:
    source = folder / "Colliders.mo"
    source.write_text(MODEL.replace("ORDER", order).replace("MANAGER", manager))
    options = BuildOptions(msl=REPOSITORY / "Resources" / "MultiBodyCore", cache=cache)
    fmu = folder / "Colliders.fmu"
    build_fmu("Colliders", [source, REPOSITORY / "ContactMultiBody"], fmu, options)
    simulate(fmu, stop=0.1)


@pytest.mark.full
@pytest.mark.parametrize(
    ("manager", "order"),
    [
        ("ContactManager", GROUND_FIRST),
        ("ContactManager", TWO_FIXED_SWAPPED),
        ("CompiledContactManager", GROUND_FIRST),
    ],
)
def test_another_order_is_noticed(tmp_path: Path, fmu_cache: Path, manager: str, order: str) -> None:
    with pytest.raises(CmbError) as caught:
        built_and_run(tmp_path, fmu_cache, manager, order)
    assert "is not where collider[" in str(caught.value)
    assert "order of the frames" in str(caught.value)


@pytest.mark.full
@pytest.mark.parametrize("manager", ["ContactManager", "VolumeContactManager", "CompiledContactManager"])
def test_the_right_order_raises_no_alarm(tmp_path: Path, fmu_cache: Path, manager: str) -> None:
    built_and_run(tmp_path, fmu_cache, manager, RIGHT)
