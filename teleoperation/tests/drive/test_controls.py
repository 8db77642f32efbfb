"""Inputs, tunable parameters, and the keys and axes that set them."""

from __future__ import annotations

import shutil
import subprocess
from importlib.resources import files

import pytest
from contact_foundation.errors import InputError
from fmu_regression.fmi.description import read_description
from interactive_drive.machine.controls import choose_controls
from interactive_drive.operation.key_map import AxisBinding, KeyBinding, default_key_map, read_key_map

NODE = shutil.which("node")


@pytest.fixture
def description(pushed_mass):
    return read_description(pushed_mass)


@pytest.fixture
def controls(description):
    return choose_controls(description)


def test_inputs_and_tunable_parameters_become_controls(controls):
    found = {control.name: control for control in controls}
    assert list(found) == ["force", "damping", "pause"]
    assert (found["force"].is_input, found["force"].low, found["force"].high, found["force"].unit) == (
        True,
        -100,
        100,
        "N",
    )
    assert (found["damping"].is_input, found["damping"].start) == (False, 1.0)


def test_parameters_can_be_named(description):
    assert [control.name for control in choose_controls(description, ["pause"])] == ["force", "pause"]
    with pytest.raises(InputError, match="is no parameter that may change"):
        choose_controls(description, ["x"])
    with pytest.raises(InputError, match="did you mean damping"):
        choose_controls(description, ["dampin"])


def test_values_stay_within_the_ends(controls):
    force = controls[0]
    assert force.admitted(1e9) == 100
    with pytest.raises(InputError, match="nan is not a number"):
        force.admitted(float("nan"))


def test_the_default_map_has_arrows_and_axes_for_inputs(controls):
    key_map = default_key_map(controls)
    assert key_map.keys == (
        KeyBinding("ArrowUp", "force", 100, 0),
        KeyBinding("ArrowDown", "force", -100, 0),
    )
    assert key_map.axes == (AxisBinding(1, "force", 100, -100, 0.1),)


def test_a_map_is_read(tmp_path, controls):
    file = tmp_path / "controls.toml"
    file.write_text(
        '[[key]]\nkey = "KeyW"\ncontrol = "force"\nvalue = 20\nrest = 0\n'
        '[[axis]]\naxis = 3\ncontrol = "damping"\nlow = 1\nhigh = 5\ndead_zone = 0.2\n'
    )
    key_map = read_key_map(file, controls)
    assert key_map.keys == (KeyBinding("KeyW", "force", 20, 0),)
    assert key_map.axes == (AxisBinding(3, "damping", 1, 5, 0.2),)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[[key]", "is no TOML"),
        ("[[button]]", "button has no meaning"),
        ('[[key]]\nkey = "KeyW"\ncontrol = "forse"\nvalue = 1', "key 1: 'forse' is no input"),
        ('[[key]]\nkey = "KeyW"\ncontrol = "force"\nvalue = 200', "key 1: value = 200 is outside -100 to 100"),
        ('[[key]]\nkey = "Space"\ncontrol = "force"\nvalue = 1', "Space pauses, steps or resets"),
        ('[[key]]\nkey = "KeyW"\ncontrol = "force"\nvalue = nan', "value is no number"),
        ('[[key]]\nkey = "KeyW"\ncontrol = "force"\nvalue = 1\nhold = 2', "hold has no meaning"),
        ('[[axis]]\naxis = -1\ncontrol = "force"\nlow = 0\nhigh = 1', "axis 1: axis is no number from 0 to 63"),
        ('[[axis]]\naxis = 1\ncontrol = "force"\nlow = 0\nhigh = 1\ndead_zone = 1', "dead_zone is no share"),
    ],
)
def test_wrong_maps_are_told(tmp_path, controls, text, told):
    file = tmp_path / "controls.toml"
    file.write_text(text)
    with pytest.raises(InputError) as caught:
        read_key_map(file, controls)
    assert told in str(caught.value)
    assert "controls.toml" in str(caught.value)


@pytest.mark.skipif(NODE is None, reason="Node.js is not installed")
def test_the_dead_zone_counts_as_the_middle():
    script = files("interactive_drive.page").joinpath("assets", "drive_controls.js")
    code = (
        f"const {{axisValue}} = require({str(script)!r});"
        "const b = {low: 10, high: -10, dead_zone: 0.2};"
        "console.log([0, 0.19, -0.2, 0.6, 1, -1].map(p => axisValue(b, p)).join());"
    )
    run = subprocess.run([str(NODE), "-e", code], check=True, capture_output=True, text=True)
    assert [float(value) for value in run.stdout.split(",")] == pytest.approx([0, 0, 0, -5, -10, 10])
