"""`cmb depth-study` from the design to the table beside the published one."""

from __future__ import annotations

import csv
import signal
import socket
import subprocess
import sys
import urllib.request

import contact_data
import pytest
from depth_study.design.design_file import load_design
from depth_study.design.sequences import make_sequences
from depth_study.evaluation.published import load_published
from depth_study.record.database import create_database
from depth_study.simulation.observers import Population
from depth_study.simulation.simulated_study import write_simulated_study
from headless_browser import needs_bundle


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


@pytest.mark.full
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


def hear_interrupts():
    """Tests may run in the background of a shell, which has its programs ignore Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@needs_bundle
def test_the_page_is_served_until_it_is_interrupted(tmp_path):
    study = tmp_path / "study.db"
    words = ["depth-study", "run", str(study), "--port", "0", "--no-browser"]
    command = [sys.executable, "-m", "cmb.main", *words]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, preexec_fn=hear_interrupts) as process:
        try:
            address = process.stdout.readline().split()[0]
            with urllib.request.urlopen(address + "start", timeout=10) as reply:
                assert b'"free": 1' in reply.read()
            process.send_signal(signal.SIGINT)
            rest, _ = process.communicate(timeout=20)
        finally:
            process.kill()
    assert process.returncode == 0
    assert f"0 answers are kept in {study}" in rest
    assert study.exists()


@needs_bundle
def test_a_port_in_use_is_told_and_no_study_is_made(cmb_here, tmp_path):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        done = cmb_here("depth-study", "run", tmp_path / "study.db", "--port", port, "--no-browser")
    assert done.returncode == 2
    assert f"port {port} is in use" in done.stderr
    assert not (tmp_path / "study.db").exists()


@needs_bundle
def test_a_study_goes_on_with_its_own_design_and_seed_alone(cmb_here, tmp_path):
    study, design = tmp_path / "study.db", tmp_path / "design.toml"
    text = (contact_data.depth_study() / "design.toml").read_text()
    create_database(study, text, seed=3).close()
    design.write_text(text.replace("central", "middle"))
    for words in (("--seed", "4"), ("--design", design)):
        done = cmb_here("depth-study", "run", study, "--port", "0", "--no-browser", *words)
        assert done.returncode == 2
        assert "was begun with another design or seed" in done.stderr


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("design", "--design", "README.md"), "is no TOML"),
        (("evaluate", "README.md"), "is damaged (file is not a database)"),
        (("run", "study.db", "--port", "0", "--eye-distance", "nan"), "eye_distance is nan"),
        pytest.param(("run", "README.md", "--port", "0"), "is damaged", marks=needs_bundle),
        (("simulate", "--carry-over", "2"), "--carry-over 2 is no share"),
        (("simulate", "--output", "README.md"), "is there already"),
    ],
)
def test_wrong_input_is_told(cmb_here, tmp_path, words, told):
    (tmp_path / "README.md").write_text("no study\n" * 200)
    done = cmb_here("depth-study", *words, cwd=tmp_path)
    assert done.returncode == 2
    assert told in done.stderr
