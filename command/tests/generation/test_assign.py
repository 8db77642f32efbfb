"""`cmb assign` through a pipe: what it lists, asks and writes."""

from __future__ import annotations

import io
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from program import HAMMER, Cmb

Assign = Callable[[str], "subprocess.CompletedProcess[str]"]


@pytest.fixture
def assign_here(hammer_copy: Path, cmb_here: Cmb, monkeypatch: pytest.MonkeyPatch) -> Assign:
    """The same for answers in the tests' own process."""

    def call(answers: str) -> subprocess.CompletedProcess[str]:
        monkeypatch.setattr(sys, "stdin", io.StringIO(answers))
        return cmb_here("assign", hammer_copy)

    return call


@pytest.fixture
def hammer_copy(tmp_path: Path) -> Path:
    for name in ("hammer.xml", "hammer.wrl"):
        shutil.copy(HAMMER / name, tmp_path / name)
    return tmp_path


def assign(folder: Path, answers: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "cmb.main", "assign", str(folder)], input=answers, capture_output=True, text=True
    )


def test_answers_become_a_file_that_generates(hammer_copy: Path) -> None:
    done = assign(hammer_copy, "shoulder\nServo\n200\n5\n\nno\n0.3\n2\nFriction\n\n0.05\n\n")
    assert done.returncode == 0, done.stderr
    assert "shoulder" in done.stdout
    assert "PD" in done.stdout
    entries = tomllib.loads((hammer_copy / "actuators.toml").read_text())["actuator"]
    assert entries == [
        {
            "joint": "shoulder",
            "component": "Servo",
            "parameters": {"c": 200.0, "d": 5.0, "useSpeedReference": False},
            "inputs": {"phi_ref": 0.3},
        },
        {"joint": "elbow", "component": "Friction", "parameters": {"tau_dry": 0.05}},
    ]
    out = hammer_copy / "out"
    generated = subprocess.run(
        [sys.executable, "-m", "cmb.main", "generate", str(hammer_copy / "hammer.xml"), "--output", str(out)],
        capture_output=True,
        text=True,
    )
    assert generated.returncode == 0, generated.stderr
    text = (out / "Hammer" / "Mechatronics.mo").read_text()
    assert "Servo shoulderServo(" in text
    assert "start=0.3" in text


def test_what_is_there_stays_and_can_be_removed(hammer_copy: Path, assign_here: Assign) -> None:
    file = hammer_copy / "actuators.toml"
    assert assign_here("shoulder\nTorque\n\n\n").returncode == 0
    before = file.read_bytes()
    assert assign_here("").returncode == 0
    assert file.read_bytes() == before
    assert assign_here("elbow\nTorque\n7\n\nq\n").returncode == 0
    assert file.read_bytes() == before
    done = assign_here("elbow\nTorque\n7\n\n")
    assert "shoulder" in done.stdout
    assert [entry["joint"] for entry in tomllib.loads(file.read_text())["actuator"]] == ["shoulder", "elbow"]
    assert assign_here("1\n-\n2\n-\n\n").returncode == 0
    assert not file.exists()


def test_wrong_answers_are_asked_again(hammer_copy: Path, assign_here: Assign) -> None:
    done = assign_here("knee\n1\nMagic\nFriction\nmuch\n-3\n0.5\n\n\n\n")
    assert done.returncode == 0, done.stderr
    for words in ("no joint 'knee'", "no component 'Magic'", "d must be a finite number", "d must not be negative"):
        assert words in done.stdout
    entry = tomllib.loads((hammer_copy / "actuators.toml").read_text())["actuator"][0]
    assert entry == {"joint": "shoulder", "component": "Friction", "parameters": {"d": 0.5}}


def test_broken_off_answers_write_nothing(hammer_copy: Path) -> None:
    done = assign(hammer_copy, "shoulder\nServo\n200\n")
    assert done.returncode == 2
    assert "nothing was written" in done.stderr
    assert not (hammer_copy / "actuators.toml").exists()
