"""The library under rumoca, with each Modelica Standard Library that can be found."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import pytest
import rumoca
from contact_data import checkout
from modelica2fmu.frontend.runner import without_modelicapath

REPOSITORY = checkout()
PACKAGES = ("ContactMultiBody", "ContactMultiBodyTest")
LIBRARIES = ("core", "4.0.0", "4.1.0")

Flat = dict[str, Any]


def standard_library(version: str) -> Path | None:
    """Folder that holds the package Modelica of that version: the project's core, or one on MODELICAPATH."""
    if version == "core":
        return REPOSITORY / "Resources" / "MultiBodyCore"
    for entry in filter(None, os.environ.get("MODELICAPATH", "").split(os.pathsep)):
        package = Path(entry) / "Modelica" / "package.mo"
        if package.is_file() and re.search(rf'\bversion\s*=\s*"{re.escape(version)}"', package.read_text("utf-8")):
            return Path(entry)
    return None


class Compiler:
    """Loads classes of the library with one Standard Library; flattened models are kept."""

    def __init__(self, standard: Path, root: Path) -> None:
        with without_modelicapath():
            self._session = rumoca.Session([str(standard), str(root)])
        self._flat: dict[str, Flat] = {}

    def model(self, name: str, modification: str = "") -> Any:
        # rumoca loads the root packages a source names; the constants make sure it names both.
        source = (
            f"model Flattened extends {name}({modification});"
            " constant Modelica.Units.SI.Time standardLibrary=0;"
            " constant ContactMultiBody.Types.Friction library=ContactMultiBody.Types.Friction.None; end Flattened;"
        )
        with without_modelicapath():
            return self._session.loads(source, model="Flattened")

    def flatten(self, name: str) -> Flat:
        if name not in self._flat:
            self._flat[name] = self.model(name).to_dict("flat")
        return self._flat[name]


def make_compiler(version: str, root: Path) -> Compiler:
    """Compiler with that version; skips the test where the version is not there."""
    folder = standard_library(version)
    if folder is None:
        pytest.skip(f"Modelica Standard Library {version} is not on MODELICAPATH")
    return Compiler(folder, root)
