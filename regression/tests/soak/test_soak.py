"""The campaign of random scenes: scenes repeat, verdicts see what is wrong, rows are kept and not repeated."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import BuildError, SimulationError
from contact_promises.soak.campaign import Row, all_runs, read, soak, summary
from contact_promises.soak.machines import random_machine
from contact_promises.soak.runs import Run, Trace, first_touch, judge, stopped
from contact_promises.soak.scenes import random_scene


def bounce(lost: float = 0.0, gained: float = 0.0, off: float = 0.0) -> Trace:
    """A contact from 0.1 s on that takes a fifth of the energy; optionally some is lost or gained, or it is off."""
    time = np.linspace(0.0, 0.6, 601)
    after = np.clip((time - 0.1) / 0.1, 0.0, 1.0)
    work = -2.0 * after
    mechanical = 10.0 + work - lost * after + gained * (time > 0.4)
    position = np.column_stack([time + off * (time > 0.05), time, np.ones_like(time)])
    return Trace(time, mechanical, np.where((time > 0.1) & (time < 0.2), 1e-9, 0.0), work, position)


def test_a_scene_is_the_same_each_time_and_another_for_another_seed():
    assert random_scene(5) == random_scene(5)
    assert len({random_scene(seed).text for seed in range(50)}) == 50


def test_scenes_have_every_law_friction_and_restitution():
    scenes = [random_scene(seed) for seed in range(100)]
    assert {scene.friction for scene in scenes} == {"None", "Regularised", "Anchored"}
    assert {scene.restitution for scene in scenes} == {"ImpactSpeed", "Memoryless", "none"}
    assert len({scene.law for scene in scenes}) == 4
    assert {body for scene in scenes for body in scene.bodies} == {
        "sphere",
        "box",
        "capsule",
        "cylinder",
        "cone",
        "ellipsoid",
    }
    assert {scene.ground for scene in scenes} == {"halfSpace", "box", "hull", "mesh", "heightField"}


def test_machines_have_every_hold_and_ground():
    machines = [random_machine(seed) for seed in range(100)]
    assert random_machine(5) == machines[5]
    holds = {body.split(".")[0] for machine in machines for body in machine.bodies}
    assert holds == {"free", "hung", "sliding", "round", "linked"}
    assert {machine.ground.split(".")[0] for machine in machines} == {"still", "shaken", "turned", "sprung"}


def test_a_right_run_is_right():
    assert judge(bounce(), bounce(), 1e-6).failure == ""
    assert first_touch(bounce()) == pytest.approx(0.101)


@pytest.mark.parametrize(
    ("trace", "names"),
    [(bounce(lost=0.1), ("balance",)), (bounce(gained=0.1), ("balance", "rise")), (bounce(off=1e-3), ("deviation",))],
)
def test_what_is_wrong_is_named(trace: Trace, names: tuple[str, ...]):
    assert [part.split()[0] for part in judge(trace, bounce(), 1e-5).failure.split("; ")] == list(names)
    assert judge(trace, bounce(), 1e-2).failure == ""  # the tolerance allows as much


def test_a_message_is_no_failure_but_no_end_is():
    assert stopped(SimulationError("the integrator failed after t = 0.1")).failure == ""
    assert stopped(SimulationError("the integrator failed after t = 0.1")).message
    assert stopped(SimulationError("given up after 60 s of wall time")).failure
    assert stopped(SimulationError("the simulation crashed: signal SIGSEGV in the FMU")).failure


def test_rows_are_written_at_once_and_not_repeated(tmp_path: Path):
    def build(model: str, source: Path, output: Path) -> None:
        raise BuildError(f"{model} of {source.name} gives no {output.name}")

    table = tmp_path / "rows.csv"
    runs = [Run("cmb", "cs", 1e-4), Run("cmb", "me", 1e-4)]
    campaign = soak(random_scene, [1, 2], runs, table, build)
    first = next(campaign)
    assert read(table) == [first]
    campaign.close()
    rest = list(soak(random_scene, [1, 2], runs, table, build))
    assert [(row["seed"], row["mode"]) for row in rest] == [("1", "me"), ("2", "cs"), ("2", "me")]
    assert list(soak(random_scene, [1, 2], runs, table, build)) == []
    assert all("SoakScene" in row["failure"] for row in read(table))


def test_the_summary_counts_and_lists():
    def row(seed: int, failure: str = "", message: str = "") -> Row:
        scene = random_scene(seed)
        return {
            "seed": str(seed), "bodies": "+".join(scene.bodies), "ground": scene.ground, "law": scene.law,
            "friction": scene.friction, "restitution": scene.restitution, "importer": "cmb", "mode": "me",
            "tolerance": "1e-04", "balance": "1", "rise": "0", "deviation": "0", "failure": failure, "message": message,
        }  # fmt: skip

    text = summary([row(1), row(2, failure="rise 60 tolerances"), row(3, message="stops")])
    assert "| cmb | me | 1e-04 | 3 | 1 | 1 | 1 |" in text
    assert "| 2 |" in text
    assert "rise 60 tolerances" in text


def test_runs_are_of_both_importers_modes_and_all_tolerances():
    assert len(all_runs()) == 2 * 2 * 7
