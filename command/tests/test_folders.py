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


def test_files_of_tests_have_names_of_their_own() -> None:
    """pytest puts all their folders on one path, which has one module of a name."""
    listed = subprocess.run(["git", "ls-files", "*.py"], cwd=PROJECT, capture_output=True, text=True, check=True).stdout
    paths = [Path(name) for name in listed.splitlines() if "tests" in name and not name.startswith(DATA)]
    names = Counter(path.name for path in paths if path.name not in ("conftest.py", "__init__.py"))
    assert [name for name, count in names.items() if count > 1] == []
    assert len(names) > 100
