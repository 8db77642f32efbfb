"""The program answers what needs no work before it loads the packages that work."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from cmb.commands import ALL_COMMANDS

# What takes most of a second to load; and the project's packages that load them.
HEAVY = {"casadi", "fmpy", "jinja2", "lark", "lxml", "networkx", "numpy", "rich", "rumoca", "scipy", "urllib.request"}
HEAVY |= {"cad2modelica", "depth_study", "fmu_regression", "modelica2fmu.build"}

START = """
import json
import sys
from cmb.main import main
loaded, answers = set(), []
for words in json.load(sys.stdin):
    try:
        status = main(words)
    except SystemExit as end:
        status = end.code or 0
    answers.append([status, sorted(set(sys.modules) - loaded)])
    loaded = set(sys.modules)
print(json.dumps(answers), file=sys.stderr)
"""
HELP = [(*words, "--help") for words in [(), *((command.NAME,) for command in ALL_COMMANDS)]]
WRONG = [
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
]
Answers = dict[tuple[str, ...], tuple[int, set[str]]]


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> Answers:
    """Exit status of ``cmb`` with each of these arguments, one after another, and the heavy modules that it loaded."""
    asked = [*HELP, *WRONG]
    done = subprocess.run(
        [sys.executable, "-c", START],
        input=json.dumps(asked),
        cwd=tmp_path_factory.mktemp("start"),
        capture_output=True,
        text=True,
        check=True,
    )
    told = json.loads(done.stderr.splitlines()[-1])
    return {words: (status, HEAVY & set(modules)) for words, (status, modules) in zip(asked, told, strict=True)}


@pytest.mark.parametrize("words", HELP)
def test_help_is_told_at_once(words, answers):
    assert answers[words] == (0, set())


@pytest.mark.parametrize("words", WRONG)
def test_wrong_arguments_and_missing_files_are_told_at_once(words, answers):
    assert answers[words] == (2, set())


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
