"""The library under rumoca, with each Modelica Standard Library that can be found."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import rumoca

REPOSITORY = Path(__file__).resolve().parents[2]
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
        self._session = rumoca.Session([str(standard), str(root)])
        self._flat: dict[str, Flat] = {}

    def model(self, name: str, modification: str = "") -> Any:
        # rumoca loads the root packages a source names; the constants make sure it names both.
        source = (
            f"model Flattened extends {name}({modification});"
            " constant Modelica.Units.SI.Time standardLibrary=0;"
            " constant ContactMultiBody.Types.Friction library=ContactMultiBody.Types.Friction.None; end Flattened;"
        )
        return self._session.loads(source, model="Flattened")

    def flatten(self, name: str) -> Flat:
        if name not in self._flat:
            self._flat[name] = self.model(name).to_dict("flat")
        return self._flat[name]


@pytest.fixture(scope="session")
def packages_root(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the library's packages and nothing else, as a tool's library path has them."""
    root = tmp_path_factory.mktemp("packages")
    for package in PACKAGES:
        (root / package).symlink_to(REPOSITORY / package)
    return root


@pytest.fixture(scope="session")
def compilers(packages_root: Path) -> Iterator[Callable[[str], Compiler]]:
    """Compiler by version of the Standard Library; skips where that is not there."""
    made: dict[str, Compiler] = {}

    def compiler(version: str) -> Compiler:
        if version not in made:
            folder = standard_library(version)
            if folder is None:
                pytest.skip(f"Modelica Standard Library {version} is not on MODELICAPATH")
            made[version] = Compiler(folder, packages_root)
        return made[version]

    yield compiler
    made.clear()


@pytest.fixture(scope="session")
def core(compilers: Callable[[str], Compiler]) -> Compiler:
    return compilers("core")
