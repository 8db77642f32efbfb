"""Simscape Multibody import files: masses, poses and joints as the file says, and refusals that name the line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cad2modelica import generate
from cad2modelica.brep.kernel_run import kernel_is_installed
from cad2modelica.mechanism.model import Assembly
from cad2modelica.reading import read_assembly
from cad2modelica.source.choices import SourceChoices
from contact_foundation.errors import InputError
from import_files import frame_joint, instance, mate, part, side, write

BASE = part("base", center="0 0 0", inertia="0.1 0.1 0.1 0 0 0")
GROUNDED = 'grounded="true"'
QUARTER = "0 -1 0 1 0 0 0 0 1"  # x to y, in rows


def _hinge(first: str, second: str, at_first: str, at_second: str, name: str = "hinge") -> list[str]:
    return [
        mate(
            "Concentric", f"{name} axis", side(first, "cylinder", at_first), side(second, "line", at_second, "0 0 -1")
        ),
        mate("Coincident", f"{name} face", side(first, "plane", at_first), side(second, "plane", at_second, "0 0 -1")),
    ]


def _pendulum(folder: Path, **more: object) -> Path:
    return write(
        folder,
        [instance("base-1", "base", "0 0 1", more=GROUNDED), instance("arm-1", "arm", "0 0 1", QUARTER)],
        [BASE, part("arm")],
        mates=_hinge("base-1", "arm-1", "0 0 0", "0 0 0"),
        **more,  # type: ignore[arg-type]
    )


def _read(file: Path, **choices: object) -> Assembly:
    return read_assembly(file, choices=SourceChoices(**choices))  # type: ignore[arg-type]


def test_mates_become_a_hinge_with_masses_and_poses(tmp_path: Path) -> None:
    assembly = _read(_pendulum(tmp_path))
    (joint,) = assembly.joints
    assert (joint.type.value, joint.parent, joint.child) == ("revolute", "base-1", "arm-1")
    assert joint.origin == pytest.approx([0, 0, 1])
    assert joint.axis is not None
    assert np.abs(joint.axis) == pytest.approx([0, 0, 1])
    arm = assembly.part("arm-1")
    assert arm.pose.point([1, 0, 0]) == pytest.approx([0, 1, 1])
    assert arm.mass_properties.mass == 2
    assert assembly.part("base-1").grounded
    assert any("hinge axis, hinge face" in note for note in assembly.notes)


def test_products_of_inertia_are_the_tensors_elements(tmp_path: Path) -> None:
    """Order xx, yy, zz, yz, zx, xy: as kernels integrate the geometry of exports of four CAD systems."""
    file = write(tmp_path, [instance("a", "p")], [part("p", inertia="0.3 0.4 0.5 0.01 0.02 0.03")])
    expected = [[0.3, 0.03, 0.02], [0.03, 0.4, 0.01], [0.02, 0.01, 0.5]]
    assert _read(file).parts[0].mass_properties.inertia == pytest.approx(np.array(expected))


@pytest.mark.parametrize(
    ("units", "length", "mass"),
    [
        ('<ModelUnits mass="kg" length="mm"/>', 1e-3, 1.0),
        ('<ModelUnits mass="pound" length="inch"/>', 0.0254, 0.45359237),
        ('<ModelUnits mass="lbm" length="inch"/><DataUnits mass="gram" length="centimeter"/>', 0.01, 1e-3),
    ],
)
def test_units(tmp_path: Path, units: str, length: float, mass: float) -> None:
    file = write(tmp_path, [instance("a", "p", "1 2 3")], [part("p")], units=units)
    found = _read(file).parts[0]
    assert found.pose.position == pytest.approx(np.array([1, 2, 3]) * length)
    assert found.mass_properties.mass == pytest.approx(2 * mass)
    assert found.mass_properties.inertia[1, 1] == pytest.approx(0.2 * mass * length**2)


def test_an_unknown_unit_is_refused(tmp_path: Path) -> None:
    file = write(tmp_path, [instance("a", "p")], [part("p")], units='<ModelUnits mass="kg" length="cubit"/>')
    with pytest.raises(InputError, match="'cubit' is not known"):
        _read(file)


def test_parts_that_mates_lock_are_one_body(tmp_path: Path) -> None:
    planes = [("1 0 0", "x"), ("0 1 0", "y"), ("0 0 1", "z")]
    locked = [
        mate("Coincident", name, side("arm-1", "plane", "1 0 0", axis), side("tip-1", "plane", "0 0 0", axis))
        for axis, name in planes
    ]
    file = write(
        tmp_path,
        [
            instance("base-1", "base", more=GROUNDED),
            instance("arm-1", "arm"),
            instance("tip-1", "tip", "1 0 0"),
        ],
        [BASE, part("arm"), part("tip", "1", "0 0 0", "0.1 0.1 0.1 0 0 0")],
        mates=[*_hinge("base-1", "arm-1", "0 0 0", "0 0 0"), *locked],
    )
    assembly = _read(file)
    assert [item.name for item in assembly.parts] == ["base-1", "arm-1"]
    properties = assembly.part("arm-1").mass_properties
    assert properties.mass == pytest.approx(3)
    assert properties.center_of_mass == pytest.approx([2 / 3, 0, 0])
    # Parallel axes: 0.2 + 2 (1/6)^2 + 0.1 + 1 (1/3)^2.
    assert properties.inertia[1, 1] == pytest.approx(0.2 + 2 / 36 + 0.1 + 1 / 9)
    assert assembly.aliases["tip-1"] == "arm-1"


def test_joints_of_the_file_keep_frames_and_coordinates(tmp_path: Path) -> None:
    file = write(
        tmp_path,
        [instance("base-1", "base", more=GROUNDED), instance("arm-1", "arm", "0 0 0.5", QUARTER)],
        [BASE, part("arm")],
        joints=[frame_joint("Revolute", "elbow", ("base-1", "0 0 0.5"), ("arm-1", "0 0 0"))],
    )
    (joint,) = _read(file).joints
    assert (joint.name, joint.type.value) == ("elbow", "revolute")
    assert joint.position == pytest.approx(np.pi / 2)
    assert joint.axis == pytest.approx([0, 0, 1])


def test_a_joint_that_does_not_close_is_told_and_assembled(tmp_path: Path) -> None:
    file = write(
        tmp_path,
        [instance("base-1", "base", more=GROUNDED), instance("arm-1", "arm")],
        [BASE, part("arm")],
        joints=[frame_joint("Revolute", "elbow", ("base-1", "0 0 0.01"), ("arm-1", "0 0 0"))],
    )
    with pytest.raises(InputError, match="'elbow' does not close at the start: its parts are 10 mm"):
        generate(file, tmp_path / "out")


def test_welds_make_one_body_and_pin_slots_a_row_of_joints(tmp_path: Path) -> None:
    file = write(
        tmp_path,
        [instance("base-1", "base", more=GROUNDED), instance("arm-1", "arm"), instance("arm-2", "arm", "1 0 0")],
        [BASE, part("arm")],
        joints=[
            frame_joint("Weld", "glue", ("arm-1", "1 0 0"), ("arm-2", "0 0 0")),
            frame_joint("PinSlot", "slot", ("base-1", "0 0 0"), ("arm-1", "0 0 0")),
        ],
    )
    assembly = _read(file)
    assert [(joint.type.value, joint.parent, joint.child) for joint in assembly.joints] == [
        ("prismatic", "base-1", "slot carrier 1"),
        ("revolute", "slot carrier 1", "arm-1"),
    ]
    assert assembly.part("arm-1").mass_properties.mass == pytest.approx(4)


def test_assemblies_in_assemblies_are_unfolded(tmp_path: Path) -> None:
    """Poses multiply; joints of a flexible assembly are there once for each instance; a rigid one is one body."""
    inner = [instance("bar", "arm"), instance("tip", "arm", "1 0 0")]
    hinge = mate("Concentric", "axis", side("bar", "line", "1 0 0"), side("tip", "line", "0 0 0"))
    file = write(
        tmp_path,
        [
            instance("base-1", "base", more=GROUNDED),
            instance("left", "leg", "0 1 0", QUARTER, inner="".join(inner)),
            instance("right", "leg", "0 -1 0", more='rigid="true"', inner="".join(inner)),
        ],
        [BASE, part("arm")],
        assemblies=[f'<Assembly name="leg" uid="leg"><Constraints>{hinge}</Constraints></Assembly>'],
    )
    assembly = _read(file)
    assert assembly.part("left/tip").pose.position == pytest.approx([0, 2, 0])
    assert [(joint.type.value, joint.child) for joint in assembly.joints] == [("cylindrical", "left/tip")]
    assert {item.name for item in assembly.parts} == {"base-1", "left/bar", "left/tip", "right/bar"}


def test_mates_with_a_range_are_left_out_with_a_note(tmp_path: Path) -> None:
    file = write(
        tmp_path,
        [instance("base-1", "base", more=GROUNDED), instance("arm-1", "arm")],
        [BASE, part("arm")],
        mates=[
            mate("Concentric", "c", side("base-1", "line", "0 0 0"), side("arm-1", "line", "0 0 0")),
            mate("Distance", "LimitDistance1", side("base-1", "plane", "0 0 0"), side("arm-1", "plane", "0 0 0.1")),
        ],
    )
    assembly = _read(file)
    assert [joint.type.value for joint in assembly.joints] == ["cylindrical"]
    assert any("LimitDistance1" in note for note in assembly.notes)


def test_mates_without_a_joint_are_named(tmp_path: Path) -> None:
    file = write(
        tmp_path,
        [instance("base-1", "base", more=GROUNDED), instance("arm-1", "arm")],
        [BASE, part("arm")],
        mates=[
            mate("Distance", "rod", side("base-1", "line", "0 0 0"), side("arm-1", "line", "0.3 0 0")),
            mate("Gear", "pinion", side("base-1", "line", "0 0 0"), side("arm-1", "line", "0.3 0 0")),
        ],
    )
    with pytest.raises(InputError) as caught:
        _read(file)
    assert "'rod' (Distance)" in str(caught.value)
    assert "'pinion' (Gear)" in str(caught.value)
    assert "assembly.xml:1" in str(caught.value)
    assembly = _read(file, allow_missing=True)
    assert not assembly.joints
    assert sum("cannot be reduced to joints: left out" in note for note in assembly.notes) == 2


def test_a_mate_that_is_not_fulfilled_is_refused(tmp_path: Path) -> None:
    file = write(
        tmp_path,
        [instance("base-1", "base", more=GROUNDED), instance("arm-1", "arm")],
        [BASE, part("arm")],
        mates=[mate("Concentric", "c", side("base-1", "line", "0 0 0"), side("arm-1", "line", "0.01 0 0"))],
    )
    with pytest.raises(InputError, match="'c' is not fulfilled where the parts stand: 10 mm"):
        _read(file)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("<Uid>arm-1</Uid>", "<Uid>leg-1</Uid>"), "names the instance 'leg-1'"),
        (('entityUid="arm"', 'entityUid="leg"'), "is an instance of 'leg'"),
        (("0 -1 0 1 0 0 0 0 1", "0 -1 0 1 0 0 0 0 -1"), "mirrors"),
        (("0 -1 0 1 0 0 0 0 1", "0 -1 0 1 0"), "Rotation must be 9 finite numbers"),
        (("<Mass>2</Mass>", "<Mass>nan</Mass>"), "Mass must be 1 finite number"),
        (("<Mass>2</Mass>", "<Mass>-2</Mass>"), "mass is -2 kg"),
        (('version="2.0"', 'version="1.0"'), "Simscape Multibody Link 4.8"),
        (("<RootAssembly", "<Root"), "well-formed"),
    ],
)
def test_what_is_wrong_is_told(tmp_path: Path, change: tuple[str, str], message: str) -> None:
    file = _pendulum(tmp_path)
    file.write_text(file.read_text().replace(*change))
    with pytest.raises(InputError, match=message):
        _read(file)


@pytest.mark.parametrize("name", ["../arm.stl", "/etc/passwd", "..\\arm.stl", "file:///etc/passwd"])
def test_geometry_stays_in_the_folder(tmp_path: Path, name: str) -> None:
    (tmp_path / "arm.stl").write_text("solid x\nendsolid x\n")
    folder = tmp_path / "inside"
    folder.mkdir()
    geometry = f'<GeometryFile name="{name}" type="STL"/>'
    file = write(folder, [instance("a", "p")], [part("p", more=geometry)])
    with pytest.raises(InputError, match=r"relative path|leaves the assembly's folder"):
        _read(file)
    assert any("geometry left out" in note for note in _read(file, allow_missing=True).notes)


def test_entities_are_refused(tmp_path: Path) -> None:
    file = _pendulum(tmp_path)
    file.write_text('<!DOCTYPE a [<!ENTITY b "c">]>' + file.read_text())
    with pytest.raises(InputError, match="DOCTYPE"):
        _read(file)


@pytest.mark.skipif(kernel_is_installed(), reason="the CAD kernel is installed")
def test_step_geometry_without_the_kernel_names_the_command(tmp_path: Path) -> None:
    (tmp_path / "arm.step").write_text("ISO-10303-21;\n")
    file = write(tmp_path, [instance("a", "p")], [part("p", more='<GeometryFile name="arm.step" type="STEP"/>')])
    with pytest.raises(InputError, match="pip install"):
        _read(file)


def test_a_package_is_generated(tmp_path: Path) -> None:
    package = generate(_pendulum(tmp_path), tmp_path / "out")
    text = (package.root / "Mechanics.mo").read_text()
    assert text.count("Modelica.Mechanics.MultiBody.Joints.Revolute") == 1
