"""Every kind of loop, generated, built as an FMU and simulated, against free bodies with constraint forces."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import generate, read_assembly
from cad2modelica.kinematics.kinematic_graph import kinematic_tree
from cad2modelica.kinematics.loops import analyse_loops
from cad2modelica.kinematics.spherical_axes import with_spherical_axes
from cad2modelica.mechanism.model import JointType
from constrained_bodies import ConstrainedBodies
from fmpy import simulate_fmu
from loop_mechanisms import GROUPS, Mechanism, body, concurrent, reach
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu

TIMES = np.linspace(0.0, 0.4, 5)
KINDS = [(group, name) for group, mechanisms in GROUPS.items() for name in mechanisms]


@dataclass(frozen=True)
class Simulated:
    """Rows of an FMU's result, and its variables by the names of parts."""

    rows: Any
    variables: dict[str, str]

    def pose(self, part: str) -> tuple[np.ndarray, np.ndarray]:
        """Origin (times, 3) and rotation into the world (times, 3, 3)."""
        name = f"{self.variables[part]}.frame_a"
        origin = np.column_stack([self.rows[f"{name}.r_0[{k}]"] for k in (1, 2, 3)])
        turn = np.array([[self.rows[f"{name}.R.T[{i},{j}]"] for j in (1, 2, 3)] for i in (1, 2, 3)])
        return origin, turn.transpose(2, 1, 0)


def simulated_group(group: str, folder: Path, cache: Path) -> Simulated:
    mechanisms = GROUPS[group].values()
    parts = [text for mechanism in mechanisms for text in mechanism.parts]
    joints = [text for mechanism in mechanisms for text in mechanism.joints]
    file = write_assembly(folder / "loops.xml", parts, joints, name=f"{group} loops")
    package = generate(file, folder / "out")
    sources, options = [package.root, ROOT / "ContactMultiBody"], BuildOptions(cache=cache)
    fmu = build_fmu(package.mechanics, sources, folder / "loops.fmu", options).fmu
    bodies = json.loads(package.scene.read_text())["bodies"]
    variables = {body["label"]: body["variable"] for body in bodies}
    names = [f"{variable}.frame_a.r_0[{k}]" for variable in variables.values() for k in (1, 2, 3)]
    names += [f"{v}.frame_a.R.T[{i},{j}]" for v in variables.values() for i in (1, 2, 3) for j in (1, 2, 3)]
    step = float(TIMES[1])
    rows = simulate_fmu(
        str(fmu), stop_time=float(TIMES[-1]), relative_tolerance=1e-9, output_interval=step, output=names
    )
    np.testing.assert_allclose(rows["time"], TIMES, atol=1e-12)
    return Simulated(rows, variables)


class SimulatedGroups:
    """Groups, each built once, when the first of its mechanisms is looked at; what failed is not tried again."""

    def __init__(self, factory: pytest.TempPathFactory, cache: Path) -> None:
        self._factory = factory
        self._cache = cache
        self._found: dict[str, Simulated | Exception] = {}

    def __getitem__(self, group: str) -> Simulated:
        if group not in self._found:
            try:
                self._found[group] = simulated_group(group, self._factory.mktemp(group), self._cache)
            except Exception as error:
                self._found[group] = error
        found = self._found[group]
        if isinstance(found, Exception):
            raise found
        return found


@pytest.fixture(scope="module")
def groups(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> SimulatedGroups:
    return SimulatedGroups(tmp_path_factory, fmu_cache)


@pytest.mark.full
@pytest.mark.parametrize(("group", "name"), KINDS)
def test_loop_moves_as_free_bodies_with_constraint_forces_do(
    groups: SimulatedGroups, group: str, name: str, tmp_path: Path
) -> None:
    mechanism = GROUPS[group][name]
    assembly = read_assembly(write_assembly(tmp_path / "loop.xml", mechanism.parts, mechanism.joints))
    expected = ConstrainedBodies(assembly).simulate(mechanism.speeds, list(TIMES), mechanism.free)
    assert expected.gap < 1e-8
    simulated = groups[group]
    way = 0.0
    for item in assembly.parts:
        origin, turn = simulated.pose(item.name)
        center = origin + turn @ item.mass_properties.center_of_mass
        np.testing.assert_allclose(center, expected.position[item.name], atol=1e-6, err_msg=item.name)
        np.testing.assert_allclose(turn, expected.rotation[item.name], atol=1e-6, err_msg=item.name)
        way = max(way, float(np.ptp(center, axis=0).max()), float(np.ptp(turn, axis=0).max()))
    assert way > 0.05


def test_no_type_of_joint_is_left_out(tmp_path: Path) -> None:
    """Each stands in a loop, and each closes one."""
    closing: set[JointType] = set()
    inside: set[JointType] = set()
    for group, name in KINDS:
        mechanism = GROUPS[group][name]
        assembly = read_assembly(write_assembly(tmp_path / "loop.xml", mechanism.parts, mechanism.joints))
        closing |= {joint.type for joint in kinematic_tree(assembly).cut_joints}
        inside |= {joint.type for joint in assembly.joints}
    assert closing == inside == set(JointType) - {JointType.FREE}


# ----- which coordinates are the states -----


def states(mechanism: Mechanism, folder: Path) -> tuple[set[str], str]:
    """Joints whose coordinates are states, and all remarks."""
    assembly = read_assembly(write_assembly(folder / "loop.xml", mechanism.parts, mechanism.joints))
    assembly = with_spherical_axes(assembly)
    loops = analyse_loops(assembly, kinematic_tree(assembly))
    return {name for name, flags in loops.independent.items() if any(flags)}, "\n".join(loops.notes)


@pytest.mark.full
def test_state_is_a_coordinate_that_comes_to_no_dead_centre_soon(tmp_path: Path) -> None:
    """The crank's angle would be chosen, for it starts with a speed; after 0.89 rad it goes back."""
    mechanism = reach("universal", "universal")
    found, notes = states(mechanism, tmp_path)
    assert found == {"universal joint 2"}
    assert "those of 'universal joint 1', chosen first, come to a dead centre sooner" in notes
    assembly = read_assembly(tmp_path / "loop.xml")
    times = list(np.linspace(0.0, 0.35, 36))
    motion = ConstrainedBodies(assembly).simulate(mechanism.speeds, times)
    turn = motion.rotation["universal1"]
    angle = np.arccos(np.clip((np.trace(turn @ turn[0].T, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert 0 < int(np.argmax(angle)) < len(angle) - 1  # it does turn back


def test_crank_that_turns_all_the_way_stays_the_state(tmp_path: Path) -> None:
    found, notes = states(GROUPS["planar"]["slider-crank"], tmp_path)
    assert found == {"slider joint 1"}
    assert "dead centre" not in notes


def test_dead_centre_that_no_state_avoids_is_announced(tmp_path: Path) -> None:
    """A linkage whose longest bar is too long for a crank: Grashof's rule. Its coupler's angle goes on longest."""
    _, notes = states(GROUPS["planar"]["Peaucellier's inversor"], tmp_path)
    assert "comes to a dead centre at about" in notes


def test_dead_centre_of_a_slide_is_told_in_millimetres(tmp_path: Path) -> None:
    found, notes = states(GROUPS["spatial"]["closed by a universal joint"], tmp_path)
    assert found == {"pcuu joint 1"}
    assert "mm from its start" in notes


@pytest.mark.parametrize("slope", [0.4, 1e-12])
def test_slide_gives_way_to_the_crank_that_can_pass(tmp_path: Path, slope: float) -> None:
    """Rod and crank of one length, bent or stretched: the slide has dead centres, the angles have none."""
    reach_x = 2 * float(np.cos(slope))
    parts = [part("slide", position=(reach_x, 0, 0)), part("rod", position=(1, 0, 0.5)), part("crank")]
    joints = [
        joint("guide", "prismatic", "ground", "slide", axis=(1, 0, 0), start='speed="0.1"'),
        joint("eye", "revolute", "slide", "rod", origin=(reach_x, 0, 0), axis=(0, 1, 0)),
        joint("pin", "revolute", "rod", "crank", origin=(reach_x / 2, 0, np.sin(slope)), axis=(0, 1, 0)),
        joint("shaft", "revolute", "ground", "crank", axis=(0, 1, 0)),
    ]
    found, notes = states(Mechanism(parts, joints), tmp_path)
    assert len(found) == 1
    assert "guide" not in found
    assert "which the model cannot pass" not in notes


# ----- sizes -----


def test_size_of_a_spherical_linkage_is_that_of_its_parts(tmp_path: Path) -> None:
    """Axes that miss their common point by the digits of an export do not make a mechanism of that size."""
    linkage = concurrent("sphere", 4)
    places = ((0.4, 0, 0.1), (0.1, 0.4, 0), (-0.3, 0.2, 0.2))  # of the links, 0.4 m around the point
    exact = Mechanism([body(f"sphere{k}", place) for k, place in enumerate(places, 1)], linkage.joints, linkage.speeds)
    generator = np.random.default_rng(7)
    joints = [
        text.replace(
            "<origin>0.0 0.0 0.0</origin>", "<origin>{} {} {}</origin>".format(*generator.uniform(-1, 1, 3) * 1e-7)
        )
        for text in exact.joints
    ]
    rounded = Mechanism(exact.parts, joints, exact.speeds)
    assert states(rounded, tmp_path)[0] == states(exact, tmp_path)[0]
