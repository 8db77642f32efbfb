"""Folders stay small enough to be taken in at once."""

from __future__ import annotations

import subprocess
from collections import Counter
from pathlib import Path

from contact_data import checkout

PROJECT = checkout()
MOST_FILES = 25
# Data, of which one looks at a file by its name: cases, corpora, reference trajectories.
DATA = ("external-c/fuzz/corpus/", "regression/cases/", "Resources/reference/")
# Packages of Modelica, which has a class a file and takes the packages' names from the Standard Library.
MODELICA = ("Resources/MultiBodyCore/", "Resources/tests/models/")


def test_no_folder_holds_more_files_than_one_takes_in() -> None:
    listed = subprocess.run(["git", "ls-files"], cwd=PROJECT, capture_output=True, text=True, check=True).stdout
    files = Counter(str(Path(name).parent) for name in listed.splitlines() if not name.startswith(DATA + MODELICA))
    assert {folder: count for folder, count in files.items() if count > MOST_FILES} == {}
    assert len(files) > 100


def test_test_files_have_names_of_their_own() -> None:
    """pytest takes two of one name for one, where their folders are no packages."""
    listed = subprocess.run(["git", "ls-files"], cwd=PROJECT, capture_output=True, text=True, check=True).stdout
    names = Counter(Path(name).name for name in listed.splitlines() if Path(name).match("test_*.py"))
    assert [name for name, count in names.items() if count > 1] == []
    assert len(names) > 100
