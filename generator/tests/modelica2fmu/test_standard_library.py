"""Where the Modelica Standard Library is looked for."""

from __future__ import annotations

from pathlib import Path

import pytest
from cmb_base.errors import InputError
from modelica2fmu.standard_library import cache_folder, core_subset, find_standard_library


def package(folder: Path, version: str) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text(f'package Modelica annotation(version="{version}"); end Modelica;')
    return folder


def test_explicit_folder_or_its_package_come_first(tmp_path):
    inner = package(tmp_path / "msl" / "Modelica", "4.1.0")
    package(tmp_path / "path" / "Modelica", "4.0.0")
    environment = {"MODELICAPATH": str(tmp_path / "path"), "HOME": str(tmp_path)}
    for explicit in (inner, inner.parent):
        found = find_standard_library(explicit, environment)
        assert (found.folder, found.version, found.origin) == (inner.parent, "4.1.0", "--msl")


def test_modelicapath_before_openmodelica_before_cache_before_core(tmp_path):
    home = tmp_path / "home"
    environment = {"MODELICAPATH": str(tmp_path / "path"), "HOME": str(home)}
    assert find_standard_library(None, environment).origin == "core subset"
    assert find_standard_library(None, environment).folder == core_subset()
    package(cache_folder(environment) / "4.1.0" / "Modelica", "4.1.0")
    assert find_standard_library(None, environment).origin == "cache"
    package(home / ".openmodelica" / "libraries" / "Modelica 4.0.0", "4.0.0")
    package(home / ".openmodelica" / "libraries" / "Modelica 4.1.0", "4.1.0")
    found = find_standard_library(None, environment)
    assert (found.origin, found.version) == ("OpenModelica", "4.1.0")
    package(tmp_path / "path" / "Modelica", "4.0.0")
    assert find_standard_library(None, environment).origin == "MODELICAPATH"


def test_folder_without_library_is_an_error(tmp_path):
    with pytest.raises(InputError, match="no Modelica Standard Library"):
        find_standard_library(tmp_path, {})
