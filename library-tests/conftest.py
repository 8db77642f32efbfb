"""Fixtures of the library's tests."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from library_compiler import PACKAGES, REPOSITORY, Compiler, make_compiler


@pytest.fixture(scope="session")
def packages_root(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the library's packages and nothing else, as a tool's library path has them."""
    root = tmp_path_factory.mktemp("packages")
    for package in PACKAGES:
        (root / package).symlink_to(REPOSITORY / package)
    return root


@pytest.fixture(scope="session")
def compilers(packages_root: Path) -> Callable[[str], Compiler]:
    """Compiler by version of the Standard Library; skips where that is not there."""
    made: dict[str, Compiler] = {}

    def compiler(version: str) -> Compiler:
        if version not in made:
            made[version] = make_compiler(version, packages_root)
        return made[version]

    return compiler


@pytest.fixture(scope="session")
def core(compilers: Callable[[str], Compiler]) -> Compiler:
    return compilers("core")
