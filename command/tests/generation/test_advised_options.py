"""The options that a survey of robots adds after a refusal."""

from __future__ import annotations

from pathlib import Path

from advised_options import advised_options


def test_density_comes_once(tmp_path: Path) -> None:
    said = "no link has mass\n  Add inertial elements, or: --density 2700 (kg/m3, aluminium)."
    assert advised_options(said, tmp_path / "a.urdf", []) == ["--density", "2700"]
    assert advised_options(said, tmp_path / "a.urdf", ["--density", "2700"]) == []


def test_folders_are_searched_before_geometry_is_done_without(tmp_path: Path) -> None:
    robots = tmp_path / "robots"
    description = robots / "arm" / "urdf" / "arm.urdf"
    files = ("other/arm_meshes/link.stl", "other/meshes/hand.stl", "arm/meshes/link.stl", "b.stl")
    for file in (description, *(robots / name for name in files)):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    advice = "--package-path FOLDER\n --allow-missing does without"
    package = f"names the package 'arm_meshes', which does not exist\n {advice}"
    assert advised_options(package, description, []) == ["--package-path", str(robots / "other" / "arm_meshes")]
    missing = f"names the file 'meshes/link.stl', which does not exist\n {advice}"
    given = ["--package-path", str(robots / "arm")]
    assert advised_options(missing, description, []) == given
    of_another = f"names the file 'meshes/hand.stl', which does not exist\n {advice}"
    assert advised_options(of_another, description, []) == ["--allow-missing"]
    leaves = f"'../../b.stl' leaves the assembly's folder\n {advice}"
    assert advised_options(leaves, description, []) == ["--package-path", str(robots)]
    assert advised_options(missing, description, given) == ["--allow-missing"]
    assert advised_options(missing, description, [*given, "--allow-missing"]) == []
