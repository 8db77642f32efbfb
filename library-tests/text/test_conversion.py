"""The scripts that convert models of earlier states name classes and components as they are."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from library_compiler import REPOSITORY
from library_files import class_files
from modelica_syntax import read_class

LIBRARY = REPOSITORY / "ContactMultiBody"
SCRIPTS = sorted((LIBRARY / "Resources" / "Scripts").glob("Convert*.mos"))
CLASSES = {file.full_name: file.text for file in class_files()}


def calls(function: str, text: str) -> list[list[str]]:
    """Arguments of the calls of a function, all of which are Strings."""
    return [
        re.findall(r'"([^"]*)"', arguments) for arguments in re.findall(rf"^{function}\((.*)\);$", text, re.MULTILINE)
    ]


def test_the_package_names_every_script_and_only_these() -> None:
    package = (LIBRARY / "package.mo").read_text("utf-8")
    named = re.findall(r'script="modelica://ContactMultiBody/([^"]*)"', package)
    assert SCRIPTS
    assert sorted(LIBRARY / name for name in named) == SCRIPTS


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_classes_have_the_new_names_alone(script: Path) -> None:
    converted = dict(calls("convertClass", script.read_text("utf-8")))
    assert converted
    for old, new in converted.items():
        assert old not in CLASSES
        assert new in CLASSES, new
    for old, before, after in calls("convertElement", script.read_text("utf-8")):
        bases = [converted[old]]
        components: set[str] = set()
        while bases:
            definition = read_class(CLASSES[bases.pop()])
            components |= definition.components.keys()
            bases += [f"ContactMultiBody.Interfaces.{base.rpartition('.')[2]}" for base in definition.bases]
        assert after in components, f"{before} of {old}"
