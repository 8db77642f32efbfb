"""The program answers what needs no work before it loads the packages that work."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from cmb.commands import ALL_COMMANDS

# What takes most of a second to load; and the project's packages that load them.
HEAVY = {"casadi", "fmpy", "jinja2", "lark", "lxml", "networkx", "numpy", "rich", "rumoca", "scipy", "urllib.request"}
HEAVY |= {"cad2modelica", "depth_study", "fmu_regression", "modelica2fmu.build"}

START = """
import sys
from cmb.main import main
try:
    status = main(sys.argv[1:])
except SystemExit as end:
    status = end.code or 0
print(status, *sorted(set(sys.modules)), file=sys.stderr)
"""


def status_and_modules(words: tuple[str, ...], folder: Path) -> tuple[int, set[str]]:
    """Exit status of ``cmb`` with these arguments, and the heavy modules that it loaded."""
    done = subprocess.run([sys.executable, "-c", START, *words], cwd=folder, capture_output=True, text=True, check=True)
    status, *modules = done.stderr.splitlines()[-1].split()
    return int(status), HEAVY & set(modules)


@pytest.mark.parametrize("words", [(), *((command.NAME,) for command in ALL_COMMANDS)])
def test_help_is_told_at_once(words, tmp_path):
    assert status_and_modules((*words, "--help"), tmp_path) == (0, set())


@pytest.mark.parametrize(
    "words",
    [
        (),
        ("frobnicate",),
        ("fmu",),
        ("fmu", "M", "--fmi", "1"),
        ("fmu", "M", "--source", "gone.mo"),
        ("run", "gone.xml"),
        ("run", ".", "--decomposer", "quickhull"),
        ("generate", "gone.urdf", "--output", "out"),
        ("assign", "gone.xml"),
        ("simulate", "gone.fmu", "--output", "a.csv"),
        ("accuracy", "gone.fmu"),
        ("report", "gone.csv", "--output", "a.html"),
        ("regress", "gone"),
        ("effects", "M", "--source", "gone.mo"),
        ("advise", "M", "--source", "gone.mo"),
        ("depth-study",),
        ("depth-study", "sequence", "--observers", "0"),
        ("depth-study", "evaluate", "gone.db"),
        ("depth-study", "simulate", "--design", "gone.toml"),
        ("msl", "install", "4.1.0", "--msl", "gone"),
    ],
)
def test_wrong_arguments_and_missing_files_are_told_at_once(words, tmp_path):
    assert status_and_modules(words, tmp_path) == (2, set())


def test_choices_are_those_of_the_generator():
    from argparse import ArgumentParser

    from cad2modelica import Decomposer, Edited, GenerateOptions
    from cmb.generation_arguments import add_generation_arguments, generation_options

    parser = ArgumentParser()
    add_generation_arguments(parser)
    assert generation_options(parser.parse_args([])) == GenerateOptions()
    for decomposer in Decomposer:
        assert generation_options(parser.parse_args(["--decomposer", decomposer.value])).decomposer is decomposer
    for edited in (Edited.KEEP, Edited.REPLACE):
        assert generation_options(parser.parse_args(["--mechatronics", edited.value])).edited is edited
