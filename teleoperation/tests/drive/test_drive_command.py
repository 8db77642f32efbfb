"""`cmb drive` as a user starts it."""

from __future__ import annotations

import importlib.util
import os
import re
import signal
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from cmb.main import main
from headless_browser import needs_bundle
from interactive_drive.benchmark.page_client import ReceivedFrame, open_page
from interactive_drive.server.listening import Listening

DESCRIPTION = Path(__file__).parent / "fixtures" / "pushed_mass.xml"


def hear_interrupts():
    """Tests may run in the background of a shell, which has its programs ignore Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@needs_bundle
def test_it_serves_until_interrupted(pushed_mass, tmp_path):
    words = [sys.executable, "-m", "cmb.main", "drive", str(pushed_mass), "--no-browser", "--port", "0"]
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    with subprocess.Popen(
        words,
        cwd=tmp_path,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=hear_interrupts,
    ) as process:
        try:
            address = re.search(r"PushedMass: (http://127\.0\.0\.1:\d+/\?token=\S+)", process.stdout.readline())[1]
            with open_page(address) as page:
                while not isinstance(page.receive(10), ReceivedFrame):
                    pass
            process.send_signal(signal.SIGINT)
            output, errors = process.communicate(timeout=20)
        finally:
            process.kill()
    assert (process.returncode, errors) == (0, "")
    assert "for a further operator: http://127.0.0.1:" in output
    assert not list(tmp_path.iterdir())  # what was unpacked is gone, nothing was recorded


def test_it_is_refused_without_the_viewers_scripts(pushed_mass, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("scene_viewer.bundle._file", lambda name: tmp_path / name)
    assert main(["drive", str(pushed_mass), "--no-browser", "--port", "0"]) == 2
    told = capsys.readouterr().err
    assert "the viewer's scripts are not installed" in told.lower()
    assert "scripts/setup" in told


def test_headless_measures(pushed_mass, capsys):
    assert main(["drive", str(pushed_mass), "--headless", "--minutes", "0.01", "--port", "0"]) == 0
    lines = {line[:46].strip(): line[46:].split() for line in capsys.readouterr().out.splitlines()}
    assert "PushedMass" in lines
    assert float(next(v for k, v in lines.items() if k.startswith("real-time factor"))[-1]) > 0.3
    assert any(k.startswith("deadlines missed") for k in lines)
    latency = next(v for k, v in lines.items() if k.startswith("input to frame"))
    assert 0 < float(latency[-6]) < 1000


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--tune", "dampin"], "did you mean damping?"),
        (["--plot", "speed"], "the FMU has no variable 'speed'"),
        (["--controls", "none.toml"], "none.toml: does not exist"),
        (["--scene", "none.json"], "none.json: does not exist"),
    ],
)
def test_wrong_words_are_told(pushed_mass, capsys, monkeypatch, tmp_path, words, told):
    monkeypatch.chdir(tmp_path)
    assert main(["drive", str(pushed_mass), "--no-browser", "--port", "0", *words]) == 2
    assert told in capsys.readouterr().err


@pytest.mark.parametrize("words", [["--step", "0"], ["--step", "2"], ["--port", "65536"], ["--minutes", "nan"]])
def test_numbers_out_of_range_are_told(pushed_mass, capsys, words):
    with pytest.raises(SystemExit) as ended:
        main(["drive", str(pushed_mass), *words])
    assert ended.value.code == 2
    assert words[0] in capsys.readouterr().err


def test_a_port_in_use_is_told(pushed_mass, capsys):
    with Listening().bind(0) as bound:
        port = bound.getsockname()[1]
        assert main(["drive", str(pushed_mass), "--no-browser", "--port", str(port)]) == 2
    error = capsys.readouterr().err
    assert f"port {port}: is in use by another program" in error
    assert "--port" in error


def test_an_fmu_for_model_exchange_alone_is_refused(tmp_path, pushed_mass, capsys):
    text = DESCRIPTION.read_text()
    fmu = tmp_path / "me.fmu"
    with zipfile.ZipFile(pushed_mass) as source, zipfile.ZipFile(fmu, "w") as target:
        description = re.sub(r"<CoSimulation [^>]*>", '<ModelExchange modelIdentifier="pushed_mass"/>', text)
        target.writestr("modelDescription.xml", description)
        for name in source.namelist():
            if name.startswith("binaries"):
                target.writestr(name, source.read(name))
    assert main(["drive", str(fmu), "--no-browser", "--port", "0"]) == 2
    assert "offers model exchange alone and cannot be driven" in capsys.readouterr().err


def test_without_the_packages_of_the_server_it_says_how_to_get_them(pushed_mass, capsys, monkeypatch):
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "uvicorn" else find(name))
    assert main(["drive", str(pushed_mass)]) == 1
    error = capsys.readouterr().err
    assert "cmb drive needs uvicorn" in error
    assert "pip install 'contactmultibody[drive]'" in error
