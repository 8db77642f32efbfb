"""`cmb hard` as a user runs it."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from program import Cmb


@pytest.mark.full
@pytest.mark.usefixtures("engine")
def test_runs_are_judged_kept_and_told(cmb: Cmb, tmp_path: Path) -> None:
    done = cmb("hard", "--first", "3", "--runs", "2", "--output", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("2 runs, ")
    with (tmp_path / "out" / "table.csv").open(newline="") as stream:
        found = list(csv.DictReader(stream))
    assert [(row["seed"], row["kind"], row["verdict"]) for row in found] == [
        ("3", "ball", "right"),
        ("4", "ball", "right"),
    ]
    assert all(float(row["energy_gain"]) < 100 * float(row["tolerance"]) for row in found)
    assert (tmp_path / "out" / "hard.html").read_text().count("<table>") == 3
    run = tmp_path / "out" / "runs" / "3.json"
    before = run.stat().st_mtime_ns
    again = cmb("hard", "--first", "3", "--runs", "2", "--output", "out", cwd=tmp_path)
    assert again.stdout == done.stdout
    assert run.stat().st_mtime_ns == before


def test_wrong_arguments_are_refused(cmb_here: Cmb, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").touch()
    for words, said in (
        (["--runs", "0"], "number of runs"),
        (["--first", "-1"], "seed"),
        (["--cpu-limit", "nan"], "time in s"),
        (["--output", "mine"], "no folder of a study"),
    ):
        done = cmb_here("hard", *words, cwd=tmp_path)
        assert done.returncode == 2
        assert said in done.stderr
