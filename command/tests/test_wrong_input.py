"""Wrong input gets one clear message, exit status 2 and leaves nothing behind."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from cmb.commands import ALL_COMMANDS
from program import HAMMER, Cmb

XML = "hammer.xml"
VRML = "hammer.wrl"


def replace(file: str, old: str, new: str) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        text = (folder / file).read_text()
        assert old in text
        (folder / file).write_text(text.replace(old, new, 1))

    return change


def cut(file: str) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        text = (folder / file).read_text()
        (folder / file).write_text(text[: len(text) // 2])

    return change


def entity_bomb(folder: Path) -> None:
    entities = "".join(f'<!ENTITY a{i + 1} "{f"&a{i};" * 10}">' for i in range(9))
    bomb = f'<!DOCTYPE assembly [<!ENTITY a0 "aaaaaaaaaa">{entities}]>'
    text = (folder / XML).read_text()
    head, rest = text.split("?>", 1)
    (folder / XML).write_text(head + "?>" + bomb + rest.replace("A hammer", "&a9;", 1))


WRONG = {
    "not well formed": (cut(XML), [XML]),
    "breaks the schema": (replace(XML, '<part name="arm"', '<piece name="arm"'), [XML, "piece"]),
    "missing VRML file": (replace(XML, 'file="hammer.wrl" node="arm"', 'file="gone.wrl" node="arm"'), ["gone.wrl"]),
    "joint with an unknown part": (replace(XML, 'child="hammer head"', 'child="mallet"'), ["mallet"]),
    "mass of zero": (replace(XML, "<mass>0.565854757865</mass>", "<mass>0</mass>"), [XML, "arm", "mass"]),
    "negative inertia": (replace(XML, 'xx="150.783225199"', 'xx="-150.783225199"'), [XML, "inertia"]),
    "two parts with one name": (replace(XML, '<part name="arm"', '<part name="ball"'), ["ball"]),
    "VRML that ends in the middle": (cut(VRML), [VRML]),
    "entity bomb": (entity_bomb, [XML]),
    "path that leaves the folder": (
        replace(XML, 'file="hammer.wrl" node="arm"', 'file="../../../etc/passwd" node="arm"'),
        [XML, "passwd"],
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_assembly(case: str, cmb_here: Cmb, tmp_path: Path) -> None:
    change, words = WRONG[case]
    folder = tmp_path / "assembly"
    shutil.copytree(HAMMER, folder)
    change(folder)
    done = cmb_here("run", folder, "--output", tmp_path / "out", cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    assert done.stdout == ""
    assert "Traceback" not in done.stderr
    for word in words:
        assert word in done.stderr
    assert done.stderr.count("cmb:") == 1
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["assembly"]


def test_model_the_builder_cannot_translate(cmb: Cmb, tmp_path: Path) -> None:
    (tmp_path / "Conveyed.mo").write_text(
        'model Conveyed "Uses spatialDistribution"\n'
        "  Real x(start=1, fixed=true);\n"
        "  Real y, z;\n"
        "equation\n"
        "  der(x) = -x;\n"
        "  (z, y) = spatialDistribution(x, 0, x, true, {0.0, 1.0}, {0.0, 0.0});\n"
        "end Conveyed;\n"
    )
    done = cmb("fmu", "Conveyed", "--source", "Conveyed.mo", "--output", "conveyed.fmu", cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    assert "spatialDistribution" in done.stderr
    assert "Conveyed.mo:6" in done.stderr
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["Conveyed.mo"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["run", "nowhere"], "nowhere"),
        (["fmu", "No.Such.Model"], "no source holds No, of which No.Such.Model is a part"),
        (["fmu", "None"], "no source holds None\n"),
        (["fmu", "Ball.mo"], "Give the name, and the file as its source: Ball --source Ball.mo"),
        (["simulate", "no.fmu", "--output", "a.csv"], "no.fmu"),
        (["simulate", ".", "--output", "a.csv"], "is a folder, not an FMU"),
        (["report", "no.csv", "--output", "a.html"], "no.csv"),
        (["regress", "nocases"], "nocases"),
        (["msl", "--msl", "nowhere"], "nowhere"),
        (["msl", "install", "3.2.3"], "3.2.3"),
        (["msl", "install", "--from", "gone.zip"], "gone.zip"),
        (["msl", "install", "--msl", "."], "--msl"),
        (["msl", "show", "4.1.0"], "cmb msl install"),
        (["frobnicate"], "frobnicate"),
        (["fmu", "M", "--tolerance", "2"], "between 0 and 1"),
        (["fmu", "M", "--max-step", "nan"], "longest step"),
        (["fmu", "M", "--max-steps", "0"], "0 steps"),
        (["fmu", "M", "--output", "/dev/null/m.fmu"], "/dev/null is no folder"),
        (["fmu", "M", "--log", "/"], "is a folder"),
        (["simulate", "no.fmu", "--output", "/"], "is a folder"),
        (["regress", "--junit", "/"], "is a folder"),
        (["accuracy", "no.fmu", "--output", "/"], "is a folder"),
        (["effects", "--output", "/"], "is a folder"),
        (["generate", str(HAMMER), "--output", "/dev/null/h"], "/dev/null is no folder"),
        (["run", str(HAMMER), "--tolerance", "0"], "--tolerance: 0 must lie between 0 and 1"),
        (["run", str(HAMMER), "--time-limit", "0"], "--time-limit: 0 must be positive"),
        (["run", str(HAMMER), "--interval", "-1"], "--interval: -1 must be positive"),
        (["run", str(HAMMER), "--stop", "nan"], "--stop: nan is no finite time"),
        (["run", str(HAMMER), "--stop", "-1"], "stop time -1 s must be greater than the start time 0"),
        (["effects", "--tolerance", "two"], "--tolerance: 'two' is no number"),
        (["advise", "--time-limit", "inf"], "--time-limit: inf is no finite time"),
        (["accuracy", "no.fmu", "--tolerance", "1"], "--tolerance: 1 must lie between 0 and 1"),
        (["drive", "no.fmu", "--tolerance", "nan"], "--tolerance: nan must lie between 0 and 1"),
        (["regress", "--time-limit", "-3"], "--time-limit: -3 must be positive"),
        (["simulate", "no.fmu", "--output", "a.csv", "--max-step", "0"], "--max-step: 0 must be positive"),
    ],
)
def test_wrong_command_line(words: list[str], said: str, cmb_here: Cmb, tmp_path: Path) -> None:
    done = cmb_here(*words, cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_every_command_has_help_with_examples(cmb_here: Cmb, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    overview = cmb_here("--help")
    assert overview.returncode == 0
    for command in ALL_COMMANDS:
        assert command.NAME in overview.stdout
        lines = cmb_here(command.NAME, "--help").stdout.splitlines()
        assert "examples:" in lines
        assert [line for line in lines if len(line) > 80] == []
