"""The file of a study: what is read, and what is refused with file and key."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from accuracy_study.answers import ClosedForm
from accuracy_study.definition import load_study
from accuracy_study.grid import base_geometry, base_variant, runs, variants
from accuracy_study.knobs import BACKENDS, FRICTIONS, LAWS
from contact_data import checkout
from contact_foundation.errors import CmbError, InputError

STUDIES = checkout() / "Resources" / "studies"
TYPES = checkout() / "ContactMultiBody" / "Types"

GOOD = """\
[study]
grid = "{grid}"
[knobs]
tolerance = [1e-6, 1e-2, 1e-4]
solver = ["me", "cs"]
stiffness = ["as modelled", 1e5, 1e7]
points = [4, 1]
[[scene]]
model = "Library.Ball"
[[scene]]
name = "second"
model = "Library.Block"
[scene.knobs]
points = []
friction = ["None", "Anchored"]
parameter = {{ "block.mu" = [0.1, 0.2] }}
[scene.reference]
source = "Coulomb"
value = [{{ name = "x", expected = 2.0 }}]
event = [{{ name = "v", threshold = 0, times = [0.5, 0.75] }}]
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text(text)
    return path


def test_every_value_meets_every_other(tmp_path):
    study = load_study(written(tmp_path, GOOD.format(grid="full")))
    ball, block = study.scenes
    assert (ball.name, block.name) == ("Ball", "second")
    assert len(variants(study, ball)) == 3 * 2
    assert len(variants(study, block)) == 3 * 2 * 2
    every = runs(study, block)
    assert len(every) == len(set(every)) == 12 * 2 * 3
    assert [run.tolerance for run in every[:3]] == [1e-2, 1e-4, 1e-6]
    assert variants(study, block)[0] == base_variant(block)
    assert dict(base_variant(block).settings) == {
        "stiffness": "as modelled",
        "friction": "None",
        "parameter.block.mu": 0.1,
    }
    assert isinstance(block.reference, ClosedForm)
    assert block.reference.values[0].scale == 2.0
    assert block.reference.events[0].scale == 0.75
    assert block.reference.signals == ("x", "v")


def test_a_scene_names_geometries_of_its_own(tmp_path):
    text = GOOD.format(grid="full").replace(
        'model = "Library.Ball"',
        'model = "Library.Ball"\ngeometries = { fine = "n=65" }\n'
        'knobs = { geometry = ["as modelled", "fine", "hull 8"] }',
    )
    ball = load_study(written(tmp_path, text)).scenes[0]
    assert dict(ball.geometries) == {"fine": "n=65"}
    assert ball.knobs["geometry"] == ("as modelled", "fine", "hull 8")


@pytest.mark.parametrize("path", sorted(STUDIES.glob("*.toml")), ids=lambda path: path.stem)
def test_studies_of_the_project_are_read(path):
    study = load_study(path)
    assert all(scene.sources or scene.model.startswith("ContactMultiBody.") for scene in study.scenes)


def test_a_study_of_some_scenes_alone(tmp_path):
    study = load_study(written(tmp_path, GOOD.format(grid="full")))
    assert [scene.name for scene in study.only(["second"]).scenes] == ["second"]
    assert study.only([]) == study
    with pytest.raises(InputError, match=r"(?s)has no scene 'third'.*It has: Ball, second"):
        study.only(["second", "third"])


def test_one_knob_at_a_time(tmp_path):
    study = load_study(written(tmp_path, GOOD.format(grid="one at a time")))
    ball, block = study.scenes
    base = base_variant(ball)
    assert variants(study, ball) == (
        base,
        base.changed("stiffness", 1e5),
        base.changed("stiffness", 1e7),
        base.changed("points", 1),
    )
    assert len(variants(study, block)) == 1 + 2 + 1 + 1
    for scene in study.scenes:
        every = variants(study, scene)
        assert all(base_geometry(scene, variant) in every for variant in every)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("stiffness =", "stiffnes ="), "knobs.stiffnes: is no knob; there are tolerance, solver"),
        (('"as modelled", 1e5', '"soft"'), "knobs.stiffness: 'soft' is not a number"),
        (("1e5, 1e7", "-1.0"), "knobs.stiffness: -1.0 must lie between"),
        (("1e5, 1e7", "1e5, 1e5"), "knobs.stiffness: a value is given twice"),
        (("[4, 1]", "[4, 0]"), "knobs.points: 0 is not a count"),
        (("[4, 1]", "4"), "knobs.points: is not a list"),
        (("[4, 1]", "[]"), "knobs.points: the grid is empty"),
        (("tolerance = [1e-6, 1e-2, 1e-4]", ""), "scene[1].knobs.tolerance: the grid is empty"),
        (('["me", "cs"]', '["rk4"]'), "knobs.solver: 'rk4' is none of me, cs"),
        (('["None", "Anchored"]', '["Coulomb"]'), "scene[2].knobs.friction: 'Coulomb' is none of None"),
        (("points = [4, 1]", 'geometry = ["hull 2"]'), "knobs.geometry: 'hull 2' must have 4 to 256 segments"),
        (("points = [4, 1]", 'geometry = ["pieces 0"]'), "knobs.geometry: 'pieces 0' must have an error above 0"),
        (("points = [4, 1]", 'geometry = ["sphere"]'), "knobs.geometry: 'sphere' is none of"),
        (
            ('model = "Library.Ball"', 'model = "A"\ngeometries = { fine = 3 }'),
            "scene[1].geometries.fine: is not a Modelica",
        ),
        (
            ('model = "Library.Ball"', 'model = "A"\nknobs = { geometry = ["fine"] }'),
            "scene[1].knobs.geometry: 'fine' is",
        ),
        (('grid = "full"', 'grid = "some"'), "study.grid: 'some' is none of full"),
        (('grid = "full"', "repeats = 0"), "study.repeats: every run is needed"),
        (('name = "second"', 'name = "Ball"'), "scene[1].name: 'Ball' is the name of two scenes"),
        (('model = "Library.Ball"', ""), "scene[1].model: is missing"),
        (('model = "Library.Ball"', 'model = "A"\nsources = ["nowhere"]'), "scene[1].sources:"),
        (('model = "Library.Ball"', 'model = "A"\ncolour = 1'), "scene[1].colour: is not a key"),
        (('source = "Coulomb"', ""), "scene[2].reference.source: is missing"),
        (('source = "Coulomb"', 'source = "a"\ntrajectory = "no.csv"'), "scene[2].reference: give either trajectory"),
        (("expected = 2.0", "expected = 0.0"), "scene[2].reference.value[1].scale: is missing"),
        (("times = [0.5, 0.75]", "times = []"), "scene[2].reference.event[1].times: is missing"),
        (("[knobs]", "[knops]"), "knops: is not a table of a study"),
    ],
)
def test_wrong_files_are_refused_with_file_and_key(tmp_path, change, said):
    text = GOOD.format(grid="full")
    assert change[0] in text
    path = written(tmp_path, text.replace(*change))
    with pytest.raises(CmbError) as caught:
        load_study(path)
    assert isinstance(caught.value, InputError)
    assert str(path) in str(caught.value)
    assert said in str(caught.value)


def test_no_scene_and_no_file(tmp_path):
    with pytest.raises(InputError, match=r"scene: the grid is empty"):
        load_study(written(tmp_path, "[knobs]\ntolerance = [1e-3]\n"))
    with pytest.raises(InputError, match="is no TOML"):
        load_study(written(tmp_path, "[knobs"))
    with pytest.raises(InputError, match="cannot be read"):
        load_study(tmp_path / "missing.toml")


@pytest.mark.parametrize(("name", "known"), [("NormalLaw", LAWS), ("Friction", FRICTIONS), ("Backend", BACKENDS)])
def test_words_are_the_library_s(name, known):
    text = (TYPES / f"{name}.mo").read_text()
    literals = re.findall(r'^\s*(?:type \w+ = enumeration\()?\s*(\w+) "', text.split("annotation")[0], re.MULTILINE)
    assert tuple(literals) == known
