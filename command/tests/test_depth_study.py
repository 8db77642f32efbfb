"""`cmb depth-study` from the design to the table beside the published one."""

from __future__ import annotations

import csv

import contact_data
import pytest
from depth_study.design.design_file import load_design
from depth_study.design.sequences import make_sequences
from depth_study.evaluation.published import load_published
from depth_study.simulation.observers import Population
from depth_study.simulation.simulated_study import write_simulated_study


def test_the_design_is_shown(cmb_here):
    done = cmb_here("depth-study", "design")
    assert done.returncode == 0
    assert "20 constellations, 52 edges (technique 24, camera 18, scene 10)" in done.stdout
    assert "Hamiltonian paths start at every constellation" in done.stdout


def test_sequences_are_written(cmb_here, tmp_path):
    done = cmb_here("depth-study", "sequence", "--observers", "3", "--output", tmp_path / "s.csv")
    assert done.returncode == 0
    with (tmp_path / "s.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 60
    assert {row["step"] for row in rows if row["position"] != "1"} == {"edge"}


def test_a_simulated_study_is_evaluated_beside_the_published_one(cmb_here, tmp_path):
    study, page = tmp_path / "study.db", tmp_path / "study.html"
    done = cmb_here("depth-study", "simulate", "--studies", "20", "--observers", "20", "--output", study)
    assert done.returncode == 0, done.stderr
    assert "20 simulated studies of 20 observers" in done.stdout
    assert "Studies of 20 that find a difference of 0.5" in done.stdout
    done = cmb_here("depth-study", "evaluate", study, "--output", page)
    assert done.returncode == 0, done.stderr
    assert "20 observers, 400 answers" in done.stdout
    assert "published" in done.stdout
    assert "- parallel against central: the levels give +1.87, the words say +2.5" in done.stdout
    text = page.read_text()
    assert "Levels of depth seen" in text
    assert "polarised/parallel/moving" in text
    assert "http://" not in text.replace("http://www.w3.org", "")


def test_an_observer_is_deleted(cmb_here, tmp_path):
    study, folder = tmp_path / "study.db", contact_data.depth_study()
    design = load_design(folder / "design.toml")
    levels = load_published(folder / "published.toml", design).levels
    write_simulated_study(study, folder / "design.toml", make_sequences(design, 4, 1), levels, Population(), 1)
    assert cmb_here("depth-study", "delete", study, "--observer", "3").returncode == 0
    assert "3 observers, 60 answers" in cmb_here("depth-study", "evaluate", study).stdout
    done = cmb_here("depth-study", "delete", study, "--observer", "3")
    assert done.returncode == 2
    assert "there is no observer 3" in done.stderr
    assert "Known are 1, 2, 4." in done.stderr


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("design", "--design", "README.md"), "is no TOML"),
        (("evaluate", "README.md"), "is damaged (file is not a database)"),
        (("simulate", "--carry-over", "2"), "--carry-over 2 is no share"),
        (("simulate", "--output", "README.md"), "is there already"),
    ],
)
def test_wrong_input_is_told(cmb_here, tmp_path, words, told):
    (tmp_path / "README.md").write_text("no study\n" * 200)
    done = cmb_here("depth-study", *words, cwd=tmp_path)
    assert done.returncode == 2
    assert told in done.stderr
