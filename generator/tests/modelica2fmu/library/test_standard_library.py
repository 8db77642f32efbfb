"""Where the Modelica Standard Library is looked for."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError
from modelica2fmu.library.standard_library import cache_folder, find_standard_library
from modelica2fmu.translation import translate


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


def test_the_latest_version_of_the_first_folder_of_a_path(tmp_path):
    """Versions are part of folder names, as tools install them; those before 4 are passed over."""
    old, first, second = (tmp_path / name for name in ("old", "first", "second"))
    package(old / "Modelica 3.2.3", "3.2.3")
    for version in ("4.0.0", "4.1.0", "4.0.0+maint.om"):
        package(first / f"Modelica {version}", version)
    package(second / "Modelica 4.2.0", "4.2.0")
    path = ":".join(map(str, (old, first, second)))
    found = find_standard_library(None, {"MODELICAPATH": path, "HOME": str(tmp_path)})
    assert (found.folder, found.version) == (first / "Modelica 4.1.0", "4.1.0")
    with pytest.raises(InputError, match=r"3\.2\.3 .* too old"):
        find_standard_library(old, {})
    assert find_standard_library(first / "Modelica 4.0.0", {}).version == "4.0.0"


def test_versioned_folders_look_unversioned_to_the_front_end(tmp_path):
    package(tmp_path / "Modelica 4.1.0", "4.1.0")
    package(tmp_path / "ModelicaServices 4.1.0", "4.1.0")
    package(tmp_path / "ModelicaServices 4.0.0", "4.0.0")
    (tmp_path / "Complex.mo").write_text("")
    library = find_standard_library(tmp_path, {})
    with library.root() as root:
        assert sorted(path.name for path in root.iterdir()) == ["Complex.mo", "Modelica", "ModelicaServices"]
        assert (root / "ModelicaServices" / "package.mo").samefile(tmp_path / "ModelicaServices 4.1.0" / "package.mo")
    assert not root.exists()


def test_a_model_is_built_with_a_library_in_versioned_folders(tmp_path):
    """The core subset under the names that tools give the library."""
    for path in core_subset().iterdir():
        (tmp_path / f"{path.stem} 4.1.0{path.suffix}").symlink_to(path)
    source = tmp_path / "Swing.mo"
    source.write_text(
        "model Swing\n"
        "  inner Modelica.Mechanics.MultiBody.World world;\n"
        "  Modelica.Mechanics.MultiBody.Joints.Revolute joint;\n"
        "  Modelica.Mechanics.MultiBody.Parts.Body body(m = 1, r_CM = {1, 0, 0});\n"
        "equation\n"
        "  connect(world.frame_b, joint.frame_a);\n"
        "  connect(joint.frame_b, body.frame_a);\n"
        "end Swing;\n"
    )
    translation = translate("Swing", [source], find_standard_library(tmp_path, {}))
    assert len(translation.description.states) == 2
