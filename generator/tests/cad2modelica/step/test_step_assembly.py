"""STEP assemblies: joints files, masses by density, bodies of several parts; with the CAD kernel where it is there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, generate
from cad2modelica.brep.kernel_run import INSTALL, kernel_is_installed
from cad2modelica.brep.step_model import read_step
from cad2modelica.geometry.spatial import IDENTITY, Pose, rotation_about
from cad2modelica.mechanism.model import Assembly
from cad2modelica.reading import read_assembly
from cad2modelica.source.choices import SourceChoices
from cad2modelica.step import reader
from cad2modelica.step.joints_file import joints_file_of, read_joints_file, was_edited
from cmb.main import main
from contact_foundation.errors import InputError
from step_models import box_model, write_hinge

needs_kernel = pytest.mark.skipif(not kernel_is_installed(), reason=f"the CAD kernel is not installed. {INSTALL}")
BOXES = {
    "base": IDENTITY,
    "arm": Pose(np.array([0.1, 0.0, 0.0]), rotation_about([0, 0, 1], 0.3)),
    "tip": Pose(np.array([0.2, 0.0, 0.0]), np.eye(3)),
}
HINGE = """
[[joint]]
name = "hinge"
type = "revolute"
parent = "base"
child = "arm"
origin = [50, 0, 0]
axis = [0, 2, 0]
limits = [-90, 45]
"""


@pytest.fixture
def boxes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A STEP file of three bars; what the kernel would say of it is put in its place."""
    monkeypatch.setattr(reader, "read_step", lambda _file, _deflection: box_model(BOXES))
    file = tmp_path / "boxes.step"
    file.write_text("ISO-10303-21;\n")
    return file


def _read(file: Path, joints: str, density: float | None = 2700.0) -> Assembly:
    joints_file_of(file).write_text(joints)
    return read_assembly(file, choices=SourceChoices(density=density))


def test_parts_joints_masses_and_units(boxes: Path) -> None:
    assembly = _read(boxes, f'ground = ["base"]\n[[body]]\nparts = ["arm", "tip"]\n{HINGE}')
    assert [(part.name, part.grounded) for part in assembly.parts] == [("base", True), ("arm", False)]
    (joint,) = assembly.joints
    assert joint.origin == pytest.approx([0.05, 0, 0])
    assert joint.axis == pytest.approx([0, 1, 0])
    assert joint.limits is not None
    assert joint.limits.lower == pytest.approx(-np.pi / 2)
    arm = assembly.part("arm")
    assert arm.mass_properties.mass == pytest.approx(2 * 2700 * 0.1 * 0.02 * 0.02)
    assert arm.pose.point(arm.mass_properties.center_of_mass) == pytest.approx([0.15, 0, 0])
    assert arm.meshes[0].color == (1.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("entry", "mass"),
    [
        ('[[part]]\nname = "arm"\nmass = 0.5', 0.5),
        ('[[part]]\nname = "arm"\ndensity = 1000', 0.04),
        ("", 0.108),
    ],
)
def test_masses_of_single_parts(boxes: Path, entry: str, mass: float) -> None:
    assembly = _read(boxes, f'ground = ["base"]\nleave_out = ["tip"]\n{HINGE}\n{entry}')
    assert [part.name for part in assembly.parts] == ["base", "arm"]
    assert assembly.part("arm").mass_properties.mass == pytest.approx(mass)


def test_the_files_density_counts_where_none_is_asked_for(boxes: Path) -> None:
    text = f'density = 1000.0\nground = ["base"]\n{HINGE}'
    assert _read(boxes, text, None).part("arm").mass_properties.mass == pytest.approx(0.04)
    assert _read(boxes, text, 500.0).part("arm").mass_properties.mass == pytest.approx(0.02)


def test_what_is_missing_is_told(boxes: Path) -> None:
    with pytest.raises(InputError, match=r"no boxes.joints.toml beside it(.|\n)*cmb joints"):
        read_assembly(boxes)
    with pytest.raises(InputError, match=r"'arm' would move, but has no mass(.|\n)*--density"):
        _read(boxes, f'ground = ["base"]\n{HINGE}', None)


def test_parts_without_joints_move_freely_with_a_note(boxes: Path) -> None:
    notes = _read(boxes, f'ground = ["base"]\n{HINGE}').notes
    assert "part 'tip' is held by no joint: it moves freely" in notes


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('ground = ["bse"]', r"ground: 'bse' is no part(.|\n)*Write 'base'"),
        ("grund = []", "'grund' is not known"),
        (HINGE.replace("revolute", "hinge"), "type is 'hinge'"),
        (HINGE.replace('"arm"', '"base"'), "the same part"),
        (HINGE.replace("[0, 2, 0]", "[0, 0, 0]"), "axis is the zero vector"),
        (HINGE.replace("[0, 2, 0]", "[0, nan, 0]"), "three finite numbers"),
        (HINGE.replace("[50, 0, 0]", "[50, 0]"), "origin must be three finite numbers"),
        (HINGE.replace("[-90, 45]", "[10, 45]"), "limits are two numbers around zero"),
        (HINGE + HINGE, "the name is given twice"),
        ("density = -1", "density must be a positive number"),
        ('[[part]]\nname = "arm"\nmass = true', "mass must be a positive number"),
        ("[[joint]\n", "is no TOML"),
    ],
)
def test_wrong_joints_files(boxes: Path, text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        _read(boxes, text)


def test_step_without_the_kernel_names_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("cad2modelica.brep.kernel_run.kernel_is_installed", lambda: False)
    file = tmp_path / "a.step"
    file.write_text("ISO-10303-21;\n")
    with pytest.raises(InputError, match="pip install 'cadquery-ocp-novtk"):
        read_step(file)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"solid x", "is no STEP file"),
        (b"ISO-10303-21;\nDATA;\n#1=DOCUMENT_FILE();#2=APPLIED_EXTERNAL_IDENTIFICATION_ASSIGNMENT();", "other files"),
    ],
)
def test_files_that_the_kernel_never_sees(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: bytes, message: str
) -> None:
    monkeypatch.setattr("cad2modelica.brep.kernel_run.kernel_is_installed", lambda: True)
    file = tmp_path / "a.step"
    file.write_bytes(content)
    with pytest.raises(InputError, match=message):
        read_step(file)


@needs_kernel
def test_a_hinge_from_the_kernel_to_a_package(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Volumes against closed forms, colours, and the joint that the pin and the bore make."""
    file = tmp_path / "hinge.step"
    write_hinge(file)
    assert main(["joints", str(file)]) == 0
    assert "revolute" in capsys.readouterr().out
    given = read_joints_file(joints_file_of(file), ["base:1", "arm:1"])
    (joint,) = given.joints
    assert (joint.type.value, joint.parent, joint.child) == ("revolute", "base:1", "arm:1")
    assert np.abs(joint.axis) == pytest.approx([0, 0, 1])  # type: ignore[arg-type]
    assert joint.origin[:2] == pytest.approx([0, 0])
    assembly = read_assembly(file, choices=SourceChoices(density=1000.0))
    expected = (100 * 20 * 10 - np.pi * 5.1**2 * 10) * 1e-9
    assert assembly.part("arm:1").mass_properties.mass == pytest.approx(1000 * expected)
    assert assembly.part("arm:1").meshes[0].color == pytest.approx((0.0, 1.0, 0.0), abs=0.01)
    generate(file, tmp_path / "out", GenerateOptions(source=SourceChoices(density=1000.0)))


@needs_kernel
def test_an_edited_joints_file_stays(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "hinge.step"
    write_hinge(file)
    joints = joints_file_of(file)
    assert main(["joints", str(file)]) == 0
    assert not was_edited(joints)
    assert main(["joints", str(file)]) == 0  # not edited: written anew
    edited = joints.read_text().replace("# density = 2700.0", "density = 1000.0")
    joints.write_text(edited)
    assert main(["joints", str(file)]) == 2
    assert "was edited" in capsys.readouterr().err
    assert joints.read_text() == edited
    assert main(["joints", str(file), "--overwrite"]) == 0
    assert not was_edited(joints)


@needs_kernel
def test_a_broken_file_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "hinge.step"
    write_hinge(file)
    file.write_text("ISO-10303-21;\nHEADER;\n" + "(((" * 1000)
    with pytest.raises(InputError, match="STEP"):
        read_step(file)
