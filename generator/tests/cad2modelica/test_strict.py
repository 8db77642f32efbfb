"""A strict generation refuses what would not be in the model, for all kinds of input, and writes nothing then."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import GenerateOptions, SourceChoices, generate
from cad2modelica.source.lost import Lost
from cmb.main import main
from contact_foundation.errors import InputError

INERTIA = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
INERTIAL = f'<inertial><mass value="1"/>{INERTIA}</inertial>'
BOX = '<visual><geometry><box size="1 1 1"/></geometry></visual>'
MESH = '<visual><geometry><mesh filename="gone.stl"/></geometry></visual>'

Write = Callable[[Path], Path]


def robot(*links: str, joints: str = "") -> Write:
    """Writes a robot whose links 'l0', 'l1', ... hold this, each joined to the one before as ``joints`` says."""

    def write(folder: Path) -> Path:
        lines = [f'<link name="l{number}">{text}</link>' for number, text in enumerate(links)]
        lines += [joints]
        (folder / "robot.urdf").write_text("\n".join(['<robot name="r">', *lines, "</robot>\n"]))
        return folder / "robot.urdf"

    return write


def hinge(number: int, inside: str = "", kind: str = "revolute") -> str:
    return (
        f'<joint name="j{number}" type="{kind}"><parent link="l{number - 1}"/><child link="l{number}"/>'
        f'<axis xyz="0 0 1"/>{inside}</joint>'
    )


def mechanism(*parts: str, joints: tuple[str, ...] = ()) -> Write:
    return lambda folder: write_assembly(folder / "test.xml", parts, joints)


def changed_pendulum(old: str, new: str, file: str = "pendulum.wrl") -> Write:
    def write(folder: Path) -> Path:
        fixtures = Path(__file__).parent / "fixtures"
        for name in ("pendulum.xml", "pendulum.wrl"):
            shutil.copy(fixtures / name, folder / name)
        text = (folder / file).read_text()
        assert old in text
        (folder / file).write_text(text.replace(old, new, 1))
        return folder / "pendulum.xml"

    return write


def flat(folder: Path) -> Path:
    corners = "".join(f"vertex {x} {y} 0\n" for x, y in ((0, 0), (1, 0), (0, 1)))
    (folder / "flat.stl").write_text(
        f"solid s\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\nendsolid s\n"
    )
    return robot(INERTIAL + MESH.replace("gone", "flat"))(folder)


SHAPE = "Shape { geometry Box { size 1 1 1 } }"
LIMIT = '<limit lower="-1" upper="1" effort="0" velocity="0"/>'
LOST: dict[str, tuple[Write, str]] = {
    "missing mesh": (robot(INERTIAL + MESH), "visual geometry left out"),
    "inertia without mass": (
        robot(INERTIAL + BOX, f"<inertial>{INERTIA}</inertial>", joints=hinge(1, kind="fixed")),
        "'l1' has inertia without mass",
    ),
    "joint without mass behind it": (robot(INERTIAL + BOX, BOX, joints=hinge(1)), "'j1' moves nothing that has mass"),
    "limits without stops": (
        robot(INERTIAL + BOX, INERTIAL + BOX, joints=hinge(1, LIMIT)),
        "1 joint moves without stops",
    ),
    "follower of nothing": (
        robot(INERTIAL + BOX, INERTIAL + BOX, joints=hinge(1, '<mimic joint="x"/>')),
        "'j1' is to follow joint 'x'",
    ),
    "leader taken as fixed": (
        robot(INERTIAL + BOX, INERTIAL + BOX, BOX, joints=hinge(1, '<mimic joint="j2"/>') + hinge(2)),
        "'j2' (mimic), which was taken as fixed",
    ),
    "too many numbers": (
        robot(INERTIAL.replace("<mass", '<origin xyz="0 0 0 1"/><mass') + BOX),
        "the first 3 numbers count",
    ),
    "friction of a joint that has none": (
        robot(INERTIAL + BOX, INERTIAL + BOX, joints=hinge(1, '<dynamics damping="0.1"/>', kind="planar")),
        "joint 'j1': damping and friction are left out",
    ),
    "limit that is no number": (
        robot(INERTIAL + BOX, INERTIAL + BOX, joints=hinge(1, LIMIT.replace('effort="0"', 'effort="much"'))),
        "effort='much' is no number",
    ),
    "start speed of a part that is held": (
        mechanism(
            part("rod", start='<start velocity="1 0 0"/>'),
            joints=(joint("j", "revolute", "ground", "rod", axis=(0, 1, 0)),),
        ),
        "part 'rod': its start speed was ignored",
    ),
    "geometry of no part": (
        changed_pendulum("#VRML V2.0 utf8", f"#VRML V2.0 utf8\nDEF Stray {SHAPE}\n"),
        "geometry 'Stray' (1 shape) belongs to no part",
    ),
    "unknown node": (
        changed_pendulum("#VRML V2.0 utf8", "#VRML V2.0 utf8\nVendorSolid { size 1 1 1 }\n"),
        "node type VendorSolid is not known",
    ),
    "hidden geometry": (
        changed_pendulum("#VRML V2.0 utf8", f"#VRML V2.0 utf8\nTransform {{ scale 0 0 0 children {SHAPE} }}\n"),
        "has scale 0",
    ),
    "flat body": (flat, "is flat and was left out of the contacts"),
}


@pytest.mark.parametrize("case", LOST)
def test_what_would_be_lost_is_refused(case: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write, words = LOST[case]
    file = write(tmp_path)
    assert main(["generate", str(file), "--output", str(tmp_path / "out"), "--strict", "--allow-missing"]) == 2
    message = capsys.readouterr().err
    assert words in message
    assert f"cmb: {file}: the model would be without" in message
    assert "--strict" in message
    assert not (tmp_path / "out").exists()
    assert main(["generate", str(file), "--output", str(tmp_path / "out"), "--allow-missing"]) == 0
    assert words in capsys.readouterr().out


def test_all_losses_are_told_at_once(tmp_path: Path) -> None:
    file = robot(INERTIAL + MESH, INERTIAL + BOX, joints=hinge(1, LIMIT))(tmp_path)
    with pytest.raises(InputError) as caught:
        generate(file, tmp_path / "out", GenerateOptions(strict=True, source=SourceChoices(allow_missing=True)))
    assert "without 2 things" in str(caught.value)
    assert f"does not exist in {tmp_path}. Copy the file" in str(caught.value)
    for words in ("gone.stl", "without stops"):
        assert words in str(caught.value)


@pytest.mark.parametrize("stops", [True, False])
def test_what_was_chosen_is_not_lost(tmp_path: Path, stops: bool) -> None:
    file = robot(INERTIAL + BOX, INERTIAL + BOX, joints=hinge(1, LIMIT))(tmp_path)
    notes = generate(file, tmp_path / "out", GenerateOptions(strict=True, stops=stops)).notes
    assert notes  # that the root moves freely is worth a note, and no loss
    assert not any(isinstance(note, Lost) for note in notes)


def test_what_is_whole_gives_the_same_bytes(hammer: Path, tmp_path: Path) -> None:
    for strict in (False, True):
        generate(hammer, tmp_path / str(strict), GenerateOptions(strict=strict))
    first, second = (
        {
            file.relative_to(tmp_path / name): file.read_bytes()
            for file in (tmp_path / name).rglob("*")
            if file.is_file()
        }
        for name in ("False", "True")
    )
    assert first == second


def test_an_earlier_package_stays(tmp_path: Path) -> None:
    whole = robot(INERTIAL + BOX)(tmp_path)
    generate(whole, tmp_path / "out")
    before = {file: file.read_bytes() for file in (tmp_path / "out").rglob("*") if file.is_file()}
    with pytest.raises(InputError):
        generate(robot(INERTIAL + MESH)(tmp_path), tmp_path / "out", GenerateOptions(strict=True))
    assert {file: file.read_bytes() for file in (tmp_path / "out").rglob("*") if file.is_file()} == before
