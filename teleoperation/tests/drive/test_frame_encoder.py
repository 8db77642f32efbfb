"""Frames against the scene they are of, in Python and in the page's own script."""

from __future__ import annotations

import json
import math
import shutil
import subprocess
from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest
from fmu_regression.scene.scene_file import load_scene
from fmu_regression.scene.signals import (
    point_force_names,
    point_names,
    position_names,
    rotation_names,
)
from interactive_drive.picture.frame_encoder import HEADER, FrameEncoder
from interactive_drive.process.messages import Frame

NODE = shutil.which("node")
MESH = {"name": "m", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]], "color": [1, 0, 0]}
STILL = {"position": [0, 0, 0], "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "meshes": [MESH]}


@pytest.fixture
def scene(tmp_path):
    file = tmp_path / "scene.json"
    bodies = [
        {"name": "floor", "fixed": True, **STILL},
        {"name": "box", **STILL},
        {"name": "weight", **STILL, "meshes": []},
    ]
    contacts = {"manager": "contacts", "pairs": [{"index": 1, "bodies": ["box", "floor"]}]}
    file.write_text(
        json.dumps({"format": 1, "name": "S", "gravity": [0, 0, -9.81], "bodies": bodies, "contacts": contacts})
    )
    return load_scene(file)


@pytest.fixture
def signals(scene):
    box, pair = scene.bodies[1], scene.pairs[0]
    points = [name for k in (1, 2) for name in point_names(scene, pair, k) + point_force_names(scene, pair, k)]
    return [*points, *rotation_names(box), "other", *position_names(box)]


@pytest.fixture
def values(signals):
    """The box at 1, 2, 3, turned by 90 degrees about z; the second contact point carries 4 N."""
    row = dict.fromkeys(signals, 0.0)
    row.update({"contacts.point[1,2,1]": 0.5, "contacts.pointForce[1,2,3]": 4.0, "other": 7.0})
    row.update({f"box.frame_a.r_0[{i}]": float(i) for i in (1, 2, 3)})
    row.update({"box.frame_a.R.T[1,2]": 1.0, "box.frame_a.R.T[2,1]": -1.0, "box.frame_a.R.T[3,3]": 1.0})
    return np.array([row[name] for name in signals])


@pytest.fixture
def message(scene, signals, values):
    encoder = FrameEncoder(scene, signals)
    frame = Frame(1.5, values, 8.0, 3, 0.75, 20, 4)
    earlier = Frame(1.25, values + 1, 8.0, 2, 0.75, 19, 4)
    return encoder.message(frame, encoder.picture(values), [earlier, frame], encoder.places(["other", "unknown"]), 1e12)


def test_bodies_that_move_are_sent(scene, signals, message):
    assert FrameEncoder(scene, signals).moving == (1,)
    assert HEADER.size == 48
    header = HEADER.unpack_from(message)
    assert header == (1.5, 8.0, 1e12, 0.75, 3, 20, 4, 1, 1, 1, 2)
    numbers = np.frombuffer(message, "<f4", offset=48)
    assert numbers[:3] == pytest.approx([1, 2, 3])
    assert numbers[3:7] == pytest.approx([0, 0, math.sqrt(0.5), math.sqrt(0.5)])  # body to world
    assert numbers[7:13] == pytest.approx([0.5, 0, 0, 0, 0, 4])
    assert numbers[13:] == pytest.approx([-0.25, 8, 0, 7])


@pytest.mark.skipif(NODE is None, reason="Node.js is not installed")
def test_the_page_knows_the_servers_clock_by_the_quickest_round_trip():
    script = files("interactive_drive.page").joinpath("assets", "drive_link.js")
    # The server is 1000 ms ahead. Trips of 40 + 60 ms and 5 + 5 ms; then one of 10 + 300 ms that is not to be believed.
    code = (
        f"const {{ServerClock}} = require({str(script)!r}); const clock = new ServerClock();"
        "const before = clock.age(1, 2);"
        "clock.hear(0, 1040, 100); clock.hear(200, 1205, 210); clock.hear(400, 1410, 710);"
        "console.log(JSON.stringify({before, age: clock.age(1500, 800), trip: clock.trip}));"
    )
    run = subprocess.run([str(NODE), "-e", code], check=True, capture_output=True, text=True)
    assert json.loads(run.stdout) == {"before": None, "age": 300, "trip": 10}


@pytest.mark.skipif(NODE is None, reason="Node.js is not installed")
def test_the_page_reads_the_same(message):
    script = files("interactive_drive.page").joinpath("assets", "drive_link.js")
    code = (
        f"const {{decodeFrame}} = require({str(script)!r});"
        f"const frame = decodeFrame(Uint8Array.from({list(message)}).buffer);"
        "console.log(JSON.stringify({...frame, poses: frame.poses.map(p => Array.from(p)),"
        "forces: frame.forces.map(f => Array.from(f)), samples: frame.samples.map(s => [s.time, ...s.signals])}));"
    )
    run = subprocess.run([str(NODE), "-e", code], check=True, capture_output=True, text=True)
    frame = json.loads(run.stdout)
    assert {name: frame[name] for name in ("time", "stamp", "heard", "factor", "number", "steps", "missed")} == {
        "time": 1.5, "stamp": 8, "heard": 1e12, "factor": 0.75, "number": 3, "steps": 20, "missed": 4,
    }  # fmt: skip
    assert frame["poses"][0] == pytest.approx([1, 2, 3, 0, 0, math.sqrt(0.5), math.sqrt(0.5)])
    assert frame["forces"] == [pytest.approx([0.5, 0, 0, 0, 0, 4])]
    assert frame["samples"] == [[1.25, 8], [1.5, 7]]


@pytest.mark.skipif(NODE is None, reason="Node.js is not installed")
@pytest.mark.parametrize("name", ["drive.js", "drive_link.js", "drive_controls.js"])
def test_syntax_of_the_scripts(name):
    script = files("interactive_drive.page").joinpath("assets", name)
    subprocess.run([str(NODE), "--check", str(script)], check=True, capture_output=True)


def test_a_pair_without_points_shows_its_force_at_the_body(scene, signals):
    names = [name for name in signals if "oint" not in name] + [f"contacts.force[1,{i}]" for i in (1, 2, 3)]
    encoder = FrameEncoder(scene, names)
    values = np.zeros(len(names))
    values[[names.index(f"box.frame_a.r_0[{i}]") for i in (1, 2, 3)]] = [1, 2, 3]
    values[[names.index(f"box.frame_a.R.T[{i},{i}]") for i in (1, 2, 3)]] = 1
    values[-1] = 9.0
    picture = encoder.picture(values)
    assert np.frombuffer(picture.forces, "<f4") == pytest.approx([1, 2, 3, 0, 0, 9])


def test_the_force_on_the_body_that_moves_is_drawn(scene, signals, values):
    exchanged = replace(scene, pairs=(replace(scene.pairs[0], bodies=("floor", "box")),))
    drawn = [np.frombuffer(FrameEncoder(each, signals).picture(values).forces, "<f4") for each in (scene, exchanged)]
    assert drawn[0] == pytest.approx([0.5, 0, 0, 0, 0, 4])
    assert drawn[1] == pytest.approx([0.5, 0, 0, 0, 0, -4])
