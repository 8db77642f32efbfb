"""The options that a survey of robots adds after a refusal."""

from __future__ import annotations

from pathlib import Path

from advised_options import advised_options


def test_density_comes_once(tmp_path: Path) -> None:
    said = "no link has mass\n  Add inertial elements, or: --density 2700 (kg/m3, aluminium)."
    assert advised_options(said, tmp_path / "a.urdf", []) == ["--density", "2700"]
    assert advised_options(said, tmp_path / "a.urdf", ["--density", "2700"]) == []


def test_folders_are_searched_before_geometry_is_done_without(tmp_path: Path) -> None:
    description = tmp_path / "robots" / "arm" / "urdf" / "arm.urdf"
    for file in (description, tmp_path / "robots" / "other" / "arm_meshes" / "link.stl", tmp_path / "robots" / "b.stl"):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    folder = str(tmp_path / "robots" / "other")
    advice = "--package-path FOLDER\n --allow-missing does without"
    package = f"names the package 'arm_meshes', which does not exist\n {advice}"
    assert advised_options(package, description, []) == ["--package-path", f"{folder}/arm_meshes"]
    file_missing = f"names the file 'arm_meshes/link.stl', which does not exist\n {advice}"
    assert advised_options(file_missing, description, []) == ["--package-path", folder]
    leaves = f"'../../b.stl' leaves the assembly's folder\n {advice}"
    assert advised_options(leaves, description, []) == ["--package-path", str(tmp_path / "robots")]
    assert advised_options(file_missing, description, ["--package-path", folder]) == ["--allow-missing"]
    assert advised_options(file_missing, description, ["--package-path", folder, "--allow-missing"]) == []
