"""Robot descriptions that are wrong or hostile: what is refused, what is left out, and that both name file and line."""

from __future__ import annotations

import os.path
import struct
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import SourceChoices, read_assembly
from cad2modelica.geometry.primitive_meshes import box_surface
from cad2modelica.meshio import mesh_files
from cmb.main import main
from contact_foundation.errors import CmbError

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'


def robot(*lines: str) -> str:
    """A description of one element a line; the first stands on line 2."""
    return "\n".join(['<robot name="r">', *lines, "</robot>\n"])


def link(name: str) -> str:
    return f'<link name="{name}">{INERTIAL}</link>'


def joint(name: str, parent: str, child: str) -> str:
    return f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/></joint>'


def write_stl(file: Path, announced: int | None = None) -> None:
    vertices, triangles = box_surface(np.ones(3))
    count = len(triangles) if announced is None else announced
    facets = b"".join(struct.pack("<12fH", *([0.0] * 3), *vertices[t].ravel(), 0) for t in triangles)
    file.write_bytes(b" " * 80 + struct.pack("<I", count) + facets)


@pytest.mark.parametrize(
    ("lines", "line", "words"),
    [
        ((link("a"), link("b"), link("c"), joint("j", "b", "c"), joint("k", "c", "b")), 5, "'c' hangs in a circle"),
        ((link("a"), joint("j", "a", "a")), 3, "'a' hangs in a circle"),
        ((link("a"), link("b"), joint("j", "a", "b"), link("c")), 5, "'c' hangs on nothing, as 'a' does"),
        ((link("a"), link("b"), link("c"), joint("j", "a", "c"), joint("k", "b", "c")), 6, "'c' has two parents"),
        ((link("a"), link("b"), joint("j", "a", "x"), joint("k", "a", "b")), 4, "'x' is no link"),
        ((link("a"), link("a")), 3, "name of its own"),
        ((link("a"), link("b"), joint("j", "a", "b"), joint("j", "a", "b")), 5, "name of its own"),
        (('<link name="a"><inertial><mass value="1e400"/></inertial></link>',), 2, "finite"),
        (('<link name="a"><inertial><mass value="1e300"/></inertial></link>',), 2, "of at most 1e+30"),
        (('<link name="a"><inertial><mass value="1_0"/></inertial></link>',), 2, "finite"),
        (('<link name="a"><inertial><mass value="1e-320"/></inertial></link>',), 2, "must be positive"),
    ],
)
def test_wrong_structure_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], lines: tuple[str, ...], line: int, words: str
) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text(robot(*lines))
    assert main(["generate", str(file), "--output", str(tmp_path / "out")]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert f"{file}:{line}" in said.replace(" ", "") or f"{file}:{line}" in said
    assert words in said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("filename", "words"),
    [
        ("missing.stl", "does not exist"),
        ("package://nowhere/box.stl", "the package 'nowhere', which does not exist"),
        ("package://arm/missing.stl", "does not exist"),
        ("package://../secret.stl", "names no package"),
        ("package://./secret.stl", "names no package"),
        ("package:///etc/secret.stl", "names no package"),
        ("package://arm/../secret.stl", "leaves"),
        ("package://arm/link.stl", "through a symbolic link"),
        ("package://arm/..\\secret.stl", "leaves"),
        ("..\\secret.stl", "leaves"),
        ("file:///etc/secret.stl", "not a relative path"),
        ("C:/secret.stl", "not a relative path"),
        ("model://nowhere/box.stl", "the package 'nowhere', which does not exist"),
        ("../secret.stl", "leaves"),
        pytest.param("x" * 5000, "does not exist", id="long-name"),
        pytest.param("package://" + "x" * 5000 + "/a.stl", "which does not exist", id="long-package"),
        ("announced.stl", "too early"),
        ("huge.stl", "is larger than 0 MiB"),
        ("nan.obj", "nan.obj:2: 3 finite numbers expected"),
    ],
)
def test_geometry_is_left_out_and_nothing_else_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, filename: str, words: str
) -> None:
    """Files that are missing, unsafe or too large: the note names file and line, and no byte outside is read."""
    package = tmp_path / "arm"
    (package / "urdf").mkdir(parents=True)
    write_stl(tmp_path / "secret.stl")
    write_stl(package / "urdf" / "announced.stl", announced=4_000_000_000)
    write_stl(package / "urdf" / "huge.stl")
    (package / "urdf" / "nan.obj").write_text("o cube\nv nan nan nan\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 3 4\n")
    (package / "link.stl").symlink_to(tmp_path / "secret.stl")
    monkeypatch.setattr(mesh_files, "MAXIMUM_BYTES", 500)
    if filename != "huge.stl":
        monkeypatch.undo()
    file = package / "urdf" / "robot.urdf"
    visual = f'<visual><geometry><mesh filename="{filename}"/></geometry></visual>'
    file.write_text(robot("", f'<link name="a">{INERTIAL}{visual}</link>'))
    assembly = read_assembly(file, choices=SourceChoices(allow_missing=True))
    assert assembly.part("a").meshes == ()
    (note,) = [note for note in assembly.notes if "geometry left out" in note]
    assert words in note
    assert "link 'a'" in note
    broken = file.parent / filename
    assert (str(broken) if os.path.isfile(broken) and broken.parent == file.parent else f"{file}:3") in note


@pytest.mark.full
def test_long_chains_written_backwards_are_read_in_order(tmp_path: Path) -> None:
    """Every joint stands before the one it hangs on: no pass over all joints for each of them."""
    count = 3000
    file = tmp_path / "robot.urdf"
    joints = [joint(f"j{k}", f"l{k}", f"l{k + 1}") for k in reversed(range(count))]
    file.write_text(robot(*joints, *(link(f"l{k}") for k in range(count + 1))))
    assembly = read_assembly(file)
    assert [item.name for item in assembly.joints] == [f"j{k}" for k in range(count)]


def test_deeply_nested_text_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text("<robot>" + "<link>" * 100 + "</link>" * 100 + "</robot>")
    with pytest.raises(CmbError, match="nested deeper") as caught:
        read_assembly(file)
    assert caught.value.exit_status == 2


def test_limits_in_the_wrong_order_are_left_out_with_a_note(tmp_path: Path) -> None:
    limited = joint("j", "a", "b").replace("</joint>", '<limit lower="1" upper="-1"/></joint>')
    (tmp_path / "robot.urdf").write_text(robot(link("a"), link("b"), limited))
    assembly = read_assembly(tmp_path / "robot.urdf")
    assert "joint 'j': limits are left out, for lower=1 is above upper=-1" in [str(note) for note in assembly.notes]
    assert assembly.joints[0].limits is None
