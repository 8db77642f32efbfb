"""`cmb study` as a user runs it."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from program import ROOT, Cmb

STUDIES = ROOT / "Resources" / "studies"

# A steel ball falls 1 cm onto a floor; contact without friction, so that all is known.
BALL = """\
[study]
grid = "one at a time"
repeats = 1
[knobs]
tolerance = [1e-4, 1e-6]
[[scene]]
name = "ball"
model = "ContactMultiBody.Examples.BallOnFloor"
parameters = {{ height = 0.05 }}
stop = 0.15
interval = 0.005
knobs = {{ {knobs} }}
"""


def rows(folder: Path) -> list[dict[str, str]]:
    with (folder / "table.csv").open(newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.mark.usefixtures("engine")
def test_numbers_are_set_on_one_fmu(cmb: Cmb, tmp_path: Path) -> None:
    (tmp_path / "ball.toml").write_text(BALL.format(knobs="stiffness = [1e6, 1e4]"))
    done = cmb("study", "ball.toml", "--output", "out", "--jobs", "2", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("ball: An error below ")
    found = rows(tmp_path / "out")
    assert [row["stiffness"] for row in found] == ["1e6", "1e6", "1e4", "1e4"]
    assert not any(row["failure"] for row in found)
    # It falls 5 cm: m g (h + x) = K x^2/2.
    for row, stiffness in ((found[1], 1e6), (found[3], 1e4)):
        weight = 9.81
        depth = (weight + (weight**2 + 2 * stiffness * weight * 0.05) ** 0.5) / stiffness
        assert 0.8 * depth < float(row["penetration"]) <= depth
    assert float(found[0]["model_error"]) == 0.0
    assert float(found[3]["model_error"]) > 1e-2
    assert len(list((tmp_path / "out" / "fmus").glob("*.fmu"))) == 1
    assert (tmp_path / "out" / "pictures" / "ball.svg").exists()
    again = cmb("study", "ball.toml", "--output", "out", cwd=tmp_path)
    assert "runs: 0 done now" in again.stderr
    assert again.stdout == done.stdout


@pytest.mark.full
@pytest.mark.usefixtures("engine")
def test_structure_becomes_variants(cmb: Cmb, tmp_path: Path) -> None:
    knobs = (
        'friction = ["None", "Anchored"], restitution = ["ImpactSpeed", "Memoryless", "None"],'
        'law = ["Exact", "Flores"],'
        'geometry = ["as modelled", "hull 8", "mesh 16", "small"], points = [1, 4], exponent = [1, 1.5]'
    )
    small = 'geometries = { small = "ball(geometry=ContactMultiBody.Shapes.sphere(0.09))" }\nknobs = {'
    (tmp_path / "ball.toml").write_text(BALL.format(knobs=knobs).replace("knobs = {", small))
    done = cmb("study", "ball.toml", "--output", "out", "--jobs", "2", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    found = rows(tmp_path / "out")
    assert len(found) == 2 * (1 + 1 + 2 + 1 + 3 + 1 + 1)
    assert not any(row["failure"] for row in found)
    by = {tuple(row[name] for name in ("restitution", "geometry", "points")): row for row in found}
    assert float(by["ImpactSpeed", "as modelled", "4"]["geometry_error"]) < 1e-6  # a sphere has one point
    # Poles are vertices of both polyhedra: straight down the ball touches where the sphere does.
    assert float(by["ImpactSpeed", "hull 8", "1"]["model_error"]) == 0.0
    # A smaller ball strikes later: sqrt(2 h/g) with h = 5 and 6 cm.
    assert float(by["ImpactSpeed", "small", "1"]["geometry_error"]) > 0.1
    # Restitution without events is the same to what the weight does in a contact; without restitution it is not.
    assert float(by["Memoryless", "as modelled", "1"]["model_error"]) < 0.02
    assert float(by["None", "as modelled", "1"]["model_error"]) > 0.1


@pytest.mark.usefixtures("engine")
def test_what_the_scene_does_not_have_is_refused(cmb_here: Cmb, tmp_path: Path) -> None:
    text = BALL.format(knobs='parameter = { "contacts.mu" = [1] }')
    (tmp_path / "ball.toml").write_text(text)
    done = cmb_here("study", "ball.toml", "--output", "out", cwd=tmp_path)
    assert done.returncode == 2
    assert "ball.toml: scene[1].knobs.parameter.contacts.mu: 1:" in done.stderr
    (tmp_path / "ball.toml").write_text(text.replace("BallOnFloor", "BallOnCeiling"))
    done = cmb_here("study", "ball.toml", "--output", "out", cwd=tmp_path)
    assert done.returncode == 2
    assert "BallOnCeiling" in done.stderr
    for words in (["study", "missing.toml"], ["study", "ball.toml", "--jobs", "0"]):
        done = cmb_here(*words, cwd=tmp_path)
        assert done.returncode == 2
        assert done.stderr
    assert not (tmp_path / "out" / "runs").exists()


@pytest.mark.full
@pytest.mark.usefixtures("engine")
def test_ready_study(cmb: Cmb, tmp_path: Path) -> None:
    done = cmb("study", STUDIES / "quick.toml", "--output", tmp_path / "out", "--jobs", "2")
    assert done.returncode == 0, done.stderr
    assert "what limits you is the stiffness, not the solver" in done.stdout
    assert "Stiffness, model error: 1e5: 1.0e-02, 1e7: 1.0e-03, 1e9: 1.0e-04." in done.stdout
