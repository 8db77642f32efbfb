"""Missions: what their files say, courses, scores of made-up records, and the two that come with the project."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from cmb.main import main
from contact_data import checkout
from contact_foundation.errors import InputError
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.scene_file import ContactPair, Scene, SceneBody
from interactive_drive.mission.course import write_course
from interactive_drive.mission.mission_file import Goal, Phase, Steering, read_mission
from interactive_drive.mission.score import score, table
from interactive_drive.mission.scripted_operator import ScriptedOperator
from lxml import etree

ROOT = checkout()
MISSIONS = ROOT / "Resources" / "missions"
ANTON = ROOT / "Resources" / "cad" / "anton" / "anton.xml"


@pytest.fixture
def mission():
    return read_mission(MISSIONS / "anton.toml")


def body(name):
    zero = np.zeros(3)
    return SceneBody(name, name, name, False, zero, np.eye(3), 1.0, zero, np.eye(3), ())


@pytest.fixture
def scene():
    bodies = [body(name) for name in ("torso", "frontLeftFoot", "floorPlane", "firstBox", "secondBox")]
    pairs = [("frontLeftFoot", "floorPlane"), ("frontLeftFoot", "firstBox"), ("firstBox", "floorPlane")]
    made = [ContactPair(k, names, 0.0) for k, names in enumerate(pairs, 1)]
    return Scene("Course", np.array([0, 0, -9.81]), tuple(bodies), pairs=tuple(made), manager="contacts")


def record(place, force):
    """A record at 10 Hz of a torso at places, shape (n, 2), while a foot presses on the first box, shape (n,)."""
    count = len(place)
    signals = {f"torso.frame_a.r_0[{k + 1}]": np.asarray(place)[:, k] for k in range(2)}
    signals |= {"torso.frame_a.r_0[3]": np.full(count, 0.11), "contacts.normalForce[2]": np.asarray(force, float)}
    return SimulationResult(time=0.1 * np.arange(count), signals=signals)


class TestScore:
    def test_a_straight_way_to_the_goal(self, mission, scene):
        mission = replace(mission, goal=Goal("torso", (1.0, 0.0), 0.1, -math.inf))
        way = [(0.1 * k, 0.0) for k in range(15)]
        made = score(mission, scene, record(way, np.zeros(15)))
        assert made.reached == pytest.approx(0.9)
        assert made.path == made.shortest == pytest.approx(0.9)
        assert made.distance == 0
        assert made.collisions == ()

    def test_a_detour_that_does_not_arrive(self, mission, scene):
        mission = replace(mission, goal=Goal("torso", (1.0, 0.0), 0.1, -math.inf))
        made = score(mission, scene, record([(0, 0), (0, 1), (1, 1)], np.zeros(3)))
        assert made.reached is None
        assert (made.path, made.distance) == pytest.approx((2.0, 0.9))
        assert "not reached" in table(made)

    def test_a_goal_after_the_time_limit_or_too_low_does_not_count(self, mission, scene):
        way = [(0.1 * k, 0.0) for k in range(15)]
        late = replace(mission, goal=Goal("torso", (1.0, 0.0), 0.1, -math.inf), time_limit=0.5)
        low = replace(mission, goal=Goal("torso", (1.0, 0.0), 0.1, 0.2))
        assert score(late, scene, record(way, np.zeros(15))).reached is None
        assert score(low, scene, record(way, np.zeros(15))).reached is None

    def test_touches_are_counted_with_their_impulse(self, mission, scene):
        force = np.zeros(20)
        force[2:5] = 3.0  # 0.2 s at 3 N
        force[6] = 1.0  # soon after: the same one
        force[12:14] = 5.0
        made = score(mission, scene, record(np.zeros((20, 2)), force))
        assert [round(each.time, 6) for each in made.collisions] == [0.2, 1.2]
        assert made.collisions[0].impulse == pytest.approx(0.6 + 0.15 + 0.05)
        assert [each.largest for each in made.collisions] == [3.0, 5.0]
        assert made.collisions[0].bodies == ("frontLeftFoot", "firstBox")
        assert "frontLeftFoot and firstBox, up to 5.0 N" in table(made)

    def test_what_lies_on_the_floor_is_no_collision(self, mission, scene):
        result = record(np.zeros((5, 2)), np.zeros(5))
        signals = {**result.signals, "contacts.normalForce[3]": np.full(5, 4.0)}
        made = score(mission, scene, SimulationResult(time=result.time, signals=signals))
        assert made.collisions == ()

    def test_names_that_do_not_exist_are_told(self, mission, scene):
        with pytest.raises(InputError, match=r"anton\.toml: the machine has no body head"):
            score(replace(mission, goal=Goal("head", (0, 0), 1, 0)), scene, record(np.zeros((2, 2)), [0, 0]))
        with pytest.raises(InputError, match=r"the record has no torso\.frame_a\.r_0\[1\]"):
            score(mission, scene, SimulationResult(time=np.zeros(2), signals={}))


class TestOperator:
    def test_it_turns_to_the_point_and_walks_as_far_as_it_looks_there(self, mission):
        steering = Steering("torso", "speed", "turning", "heading", 0.1, 0.5, 0.2)
        phases = (Phase((1.0, 0.0), 100, {}), Phase((1.0, 1.0), 100, {"height": 0.01}))
        operator = ScriptedOperator(replace(mission, steering=steering, phases=phases))
        assert operator.inputs(0.0, (0, 0), 0.0) == {"speed": 0.1, "turning": 0.0}
        aside = operator.inputs(0.1, (0, 0), 2 * math.pi - 0.2)
        assert aside["turning"] == pytest.approx(0.1)
        assert 0 < aside["speed"] < 0.1
        assert operator.inputs(0.2, (0, 0), 1.0)["speed"] == 0
        north = operator.inputs(10, (0.9, 0.0), 0.0)  # the first point is reached
        assert north["height"] == 0.01
        assert north["turning"] > 0
        assert operator.inputs(20, (1.0, 0.9), 0.0) == {"speed": 0.0, "turning": 0.0}

    def test_a_phase_ends_after_its_time(self, mission):
        phases = (Phase(None, 1.0, {"speed": 0.1}), Phase(None, 2.0, {"speed": -0.1}))
        operator = ScriptedOperator(replace(mission, steering=None, phases=phases))
        given = [dict(operator.inputs(time, (0, 0), 0.0)) for time in (0.0, 0.9, 1.0, 2.9, 3.0)]
        assert given == [{"speed": 0.1}, {"speed": 0.1}, {"speed": -0.1}, {"speed": -0.1}, {}]


class TestFile:
    @pytest.mark.parametrize(
        ("old", "new", "told"),
        [
            ("time_limit = 60", "time_limt = 60", "time_limit is missing"),
            ("time_limit = 60", "time_limit = 60\ntime_limt = 1", "time_limt has no meaning"),
            ("radius = 0.15", "radius = 0", "goal: radius is not positive"),
            ("radius = 0.15", "radius = nan", "goal: radius is no number"),
            ("position = [1.9, 0.75]", "position = [1.9]", "position is no list of 2 numbers"),
            ("density = 400", "density = -1", "obstacle firstBox: size must be positive, and density not negative"),
            ('"../cad/anton"', '"../cad/antn"', "../cad/antn does not exist"),
            ('forward = "speed"', "", "operator: forward is missing"),
        ],
    )
    def test_what_is_wrong_is_told(self, tmp_path, old, new, told):
        (tmp_path / "cad" / "anton").mkdir(parents=True)
        file = tmp_path / "missions" / "mission.toml"
        file.parent.mkdir()
        text = (MISSIONS / "anton.toml").read_text()
        assert old in text
        file.write_text(text.replace(old, new, 1))
        with pytest.raises(InputError, match=re.escape(told)) as refused:
            read_mission(file)
        assert "mission.toml" in str(refused.value)

    def test_a_course_is_an_assembly_with_boxes(self, mission, tmp_path):
        assembly = write_course(mission, ANTON, tmp_path / "course")
        root = etree.parse(assembly).getroot()
        schema = etree.XMLSchema(file=ROOT / "Resources" / "schema" / "assembly.xsd")
        assert schema.validate(root), schema.error_log
        space = {"a": "urn:contactmultibody:assembly:1"}
        first = root.find(".//a:part[@name='firstBox']", space)
        assert float(first.find(".//a:mass", space).text) == pytest.approx(0.4)
        assert float(first.find(".//a:inertia", space).get("xx")) == pytest.approx(0.4 * (100**2 + 100**2) / 12)
        assert first.get("grounded") is None
        assert root.find(".//a:part[@name='ramp']", space).get("grounded") == "true"
        pairs = {(p.get("first"), p.get("second")) for p in root.iterfind(".//a:include", space)}
        assert {("firstBox", "floor"), ("firstBox", "ramp"), ("rearLeft/foot", "firstBox")} <= pairs
        assert f"pairs={len(pairs)}, points=4" in (assembly.parent / "Course.mo").read_text()
        assert 'sources = ["AntonWalk", "Course.mo"]' in (assembly.parent / "experiment.toml").read_text()

    def test_a_plane_that_the_assembly_has_not_is_told(self, mission, tmp_path):
        with pytest.raises(InputError, match=r"anton\.xml: has no plane ground"):
            write_course(replace(mission, ground="ground"), ANTON, tmp_path / "course")


@pytest.mark.full
@pytest.mark.parametrize(("name", "limit", "detour"), [("anton", 25.0, 1.15), ("cart", 15.0, 1.1)])
def test_the_scripted_operator_reaches_the_goal_without_a_collision(tmp_path, capsys, name, limit, detour):
    assert main(["mission", str(MISSIONS / f"{name}.toml"), "--output", str(tmp_path / name)]) == 0
    told = capsys.readouterr().out
    assert float(re.search(r"reached after ([\d.]+) s", told)[1]) < limit
    assert float(re.search(r"m, ([\d.]+) times the shortest", told)[1]) < detour
    assert re.search(r"collisions +0\n", told)
    assert (tmp_path / name / "report.html").is_file()
    words = ["mission", str(MISSIONS / f"{name}.toml"), "--output", str(tmp_path / name)]
    assert main([*words, "--score", str(tmp_path / name / "result.csv")]) == 0
    assert capsys.readouterr().out.splitlines()[:5] == told.splitlines()[:5]
