"""Reading scene.json and choosing signals."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import pytest
from contact_foundation.errors import InputError
from fmu_regression.fmi.description import ModelDescription, Variable
from fmu_regression.scene.scene_file import load_scene
from fmu_regression.scene.signals import signals_for
from synthetic import hammer, write_scene


@pytest.fixture(scope="module")
def content() -> dict[str, Any]:
    return hammer(rows=10)[0]


def test_reads_what_was_written(content: dict[str, Any], tmp_path: Path) -> None:
    scene = load_scene(write_scene(content, tmp_path / "scene.json"))
    assert [body.name for body in scene.bodies] == ["arm", "hammer", "anvil", "stand"]
    assert [body.fixed for body in scene.bodies] == [False, False, True, True]
    assert scene.bodies[0].meshes[0].vertices.shape == (8, 3)
    assert scene.bodies[0].meshes[0].triangles.shape == (12, 3)
    assert scene.pairs[0].bodies == ("hammer", "anvil")
    assert scene.pairs[0].restitution == 0.5
    assert scene.manager == "contacts"
    assert scene.joints[1].rate == "wrist.w"


def change(content: dict[str, Any], path: str, value: Any) -> dict[str, Any]:
    changed = copy.deepcopy(content)
    *keys, last = [int(key) if key.isdigit() else key for key in path.split(".")]
    item: Any = changed
    for key in keys:
        item = item[key]
    item[last] = value
    return changed


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("format", 2, "format is 2, this program reads format 1"),
        ("gravity", [0, 0], "gravity has shape 2 instead of 3"),
        ("bodies", {}, "bodies is not a list"),
        ("bodies.0.mass", -1, r"bodies\[0\].mass is negative"),
        ("bodies.0.mass", "heavy", r"bodies\[0\].mass is not a number"),
        ("bodies.1.name", "arm", "has the name 'arm' twice"),
        ("bodies.0.rotation", [[1, 0, 0], [0, 1, 0], [0, 0, -1]], "is not a rotation matrix"),
        ("bodies.0.fixed", 1, r"bodies\[0\].fixed is not true or false"),
        ("bodies.0.inertia", [1, 2, 3], r"inertia has shape 3 instead of 3x3"),
        ("bodies.0.meshes.0.triangles", [[0, 1, 8]], r"meshes\[0\].triangles has an index outside 0 to 7"),
        ("bodies.0.meshes.0.triangles", [[0, 1, 1.5]], "has an index outside"),
        ("bodies.0.meshes.0.vertices", [[0, 1]], "vertices has shape 1x2 instead of nx3"),
        ("bodies.0.meshes.0.vertices", [[0, 1, None]], "vertices is not an array|not finite"),
        ("bodies.0.meshes.0.color", [0, 0, 2], "color is not between 0 and 1"),
        ("contacts.pairs.0.bodies", ["hammer", "moon"], r"pairs\[0\].bodies does not name two bodies"),
        ("contacts.pairs.0.index", 0, "index is not a positive whole number"),
        ("joints.0.variable", "", r"joints\[0\].variable is not a text"),
    ],
)
def test_wrong_values_are_named(content: dict[str, Any], tmp_path: Path, path: str, value: Any, message: str) -> None:
    file = write_scene(change(content, path, value), tmp_path / "scene.json")
    with pytest.raises(InputError, match=message) as caught:
        load_scene(file)
    assert str(file) in str(caught.value)


@pytest.mark.parametrize("text", ["{", "[]", '{"format": NaN}', "[" * 100_000])
def test_no_scene(tmp_path: Path, text: str) -> None:
    path = tmp_path / "scene.json"
    path.write_text(text)
    with pytest.raises(InputError, match=r"scene\.json"):
        load_scene(path)


def description(names: list[str]) -> ModelDescription:
    variables = {
        name: Variable(name, k, "Real", "Real", "local", "continuous", "", False) for k, name in enumerate(names)
    }
    return ModelDescription("2.0", "m", "g", {}, variables, (), 0, 0, False, True, 0.0, None, None, None, "")


def test_signals_are_those_of_the_scene_that_the_fmu_has(content: dict[str, Any], tmp_path: Path) -> None:
    scene = load_scene(write_scene(content, tmp_path / "scene.json"))
    poses = [f"arm.frame_a.r_0[{i}]" for i in (1, 2, 3)]
    known = [
        *poses,
        "other.x",
        "arm.body.w_a[1]",
        "arm.frame_a.R.w[1]",
        "arm.frame_a.R.w[2]",
        "arm.frame_a.R.w[3]",
        "shoulder.phi",
        "contacts.normalForce[1]",
        "contacts.elasticEnergy",
        *(f"contacts.{what}[1,{slot},{i}]" for what in ("point", "pointForce") for slot in (1, 2) for i in (1, 2, 3)),
        "contacts.point[1,3,1]",
        "anvil.frame_a.r_0[1]",
    ]
    names = signals_for(scene, description(known))
    assert set(names) == set(known) - {"other.x", "arm.body.w_a[1]", "contacts.point[1,3,1]", "anvil.frame_a.r_0[1]"}
    assert names[:3] == poses
    assert len(names) == len(set(names))
    assert json.dumps(names) == json.dumps(signals_for(scene, description(known[::-1])))
