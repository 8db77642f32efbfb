"""Temporary folders of killed processes are removed by the next one that needs some."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from contact_foundation.scratch import scratch_folder

HELD = """
import sys
from contact_foundation.scratch import scratch_folder
with scratch_folder("test") as folder:
    (folder / "a").write_text("half")
    print(folder, flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of temporary files, where nothing is too young to be abandoned."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("contact_foundation.abandoned._NEW", -1.0)
    return tmp_path


def test_a_folder_lives_as_long_as_its_block(place: Path) -> None:
    with scratch_folder("test") as folder:
        assert folder.parent == place
        assert folder.stat().st_mode & 0o777 == 0o700
        (folder / "a").write_text("a")
    assert not list(place.iterdir())


def test_folders_of_killed_processes_go_and_those_in_use_stay(place: Path) -> None:
    words = [sys.executable, "-c", HELD]
    processes = [subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    try:
        killed, used = (Path(process.stdout.readline().strip()) for process in processes if process.stdout)
        processes[0].kill()
        processes[0].wait(timeout=60)
        (place / "cmb-mine").mkdir()
        assert killed.is_dir()
        with scratch_folder("test"):
            assert not killed.exists()
            assert (used / "a").read_text() == "half"
    finally:
        for process in processes:
            process.kill()
            process.communicate(timeout=60)
    assert (place / "cmb-mine").is_dir()
