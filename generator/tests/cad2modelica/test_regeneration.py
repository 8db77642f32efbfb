"""What a second generation changes: only the mechanics, only the mechatronics, or nothing before the user agrees."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import Edited, GenerateOptions, generate
from cmb_base.errors import InputError

DRIVE = '[[actuator]]\njoint = "hip"\ncomponent = "Servo"\nparameters = { c = 50, d = 5 }\n'
RECORD = "Resources/generation.json"


def leg(folder: Path, *, mass: float = 1.0, joints: tuple[str, ...] = ("hip", "knee"), foot: bool = False) -> Path:
    parts = [part("thigh", mass=mass), part("shank", position=(0, 0, -0.4))]
    parts += [part("foot", position=(0, 0, -0.8))] if foot else []
    hinges = [
        joint(joints[0], "revolute", "ground", "thigh", axis=(0, 1, 0)),
        joint(joints[1], "revolute", "thigh", "shank", origin=(0, 0, -0.4), axis=(0, 1, 0)),
    ]
    hinges += [joint("ankle", "revolute", "shank", "foot", origin=(0, 0, -0.8), axis=(0, 1, 0))] if foot else []
    return write_assembly(folder / "leg.xml", parts, hinges, name="Leg")


def files_of(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def changed(before: dict[str, bytes], after: dict[str, bytes]) -> set[str]:
    return {name for name in {*before, *after} if before.get(name) != after.get(name)}


@pytest.fixture
def made(tmp_path: Path) -> Path:
    """A package with one servo, as generated; its folder."""
    (tmp_path / "actuators.toml").write_text(DRIVE)
    return generate(leg(tmp_path), tmp_path / "out").root


def test_changed_parameter_changes_the_mechanics_alone(tmp_path: Path, made: Path) -> None:
    before = files_of(made)
    generate(leg(tmp_path, mass=1.5), tmp_path / "out")
    assert changed(before, files_of(made)) == {"Mechanics.mo"}


def test_changed_assignment_changes_the_mechatronics_alone(tmp_path: Path, made: Path) -> None:
    before = files_of(made)
    (tmp_path / "actuators.toml").write_text(DRIVE.replace("50", "60"))
    generate(leg(tmp_path), tmp_path / "out")
    after = files_of(made)
    assert changed(before, after) == {"Mechatronics.mo", RECORD}
    assert b"c=60" in after["Mechatronics.mo"]
    (tmp_path / "actuators.toml").unlink()
    generate(leg(tmp_path), tmp_path / "out")
    assert b"extends Mechanics;" in files_of(made)["Mechatronics.mo"]


def test_comments_in_the_assignment_change_nothing(tmp_path: Path, made: Path) -> None:
    before = files_of(made)
    (tmp_path / "actuators.toml").write_text("# mine\n" + DRIVE.replace("50", "50.0"))
    generate(leg(tmp_path), tmp_path / "out")
    assert changed(before, files_of(made)) == set()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"joints": ("hip", "kneecap")}, ["joint 'knee' is gone; renamed 'kneecap'", "Drive.mo:2 uses 'knee'"]),
        ({"joints": ("femur", "knee")}, ["renamed 'femur'", "no joint 'hip'"]),
        ({"foot": True}, ["part 'foot' is new", "joint 'ankle' is new (revolute from 'shank' to 'foot')", "Nothing"]),
    ],
)
def test_changed_structure_is_not_written_without_consent(
    tmp_path: Path, made: Path, change: dict[str, object], words: list[str]
) -> None:
    (made / "Drive.mo").write_text("model Drive\n  extends Mechanics(knee(phi(start=1)));\nend Drive;\n")
    before = files_of(tmp_path / "out")
    with pytest.raises(InputError) as caught:
        generate(leg(tmp_path, **change), tmp_path / "out")
    for word in [*words, "Nothing was written", "--accept-structure", "nobody has edited"]:
        assert word in str(caught.value)
    assert "Mechatronics.mo:" not in str(caught.value)  # it is written anew, so what it uses does not matter
    assert files_of(tmp_path / "out") == before


@pytest.mark.usefixtures("made")
def test_type_and_partners_of_a_joint_are_structure(tmp_path: Path) -> None:
    text = leg(tmp_path).read_text()
    (tmp_path / "leg.xml").write_text(text.replace('name="knee" type="revolute"', 'name="knee" type="prismatic"'))
    with pytest.raises(InputError, match="'knee' was revolute from 'thigh' to 'shank', and is prismatic"):
        generate(tmp_path / "leg.xml", tmp_path / "out")


def test_accepted_structure_rewrites_both_models(tmp_path: Path, made: Path) -> None:
    file = leg(tmp_path, joints=("femur", "knee"))
    accept = GenerateOptions(accept_structure=True)
    with pytest.raises(InputError, match="no such joint"):
        generate(file, tmp_path / "out", accept)
    (tmp_path / "actuators.toml").write_text(DRIVE.replace("hip", "femur"))
    notes = generate(file, tmp_path / "out", accept).notes
    assert any("renamed 'femur'" in note for note in notes)
    assert not any("no longer fits" in note for note in notes)
    assert "Servo femurServo(" in (made / "Mechatronics.mo").read_text()
    assert not any("structure" in note for note in generate(file, tmp_path / "out").notes)


def test_edited_mechatronics_stays_when_the_structure_changes(tmp_path: Path, made: Path) -> None:
    own = made / "Mechatronics.mo"
    own.write_bytes(own.read_bytes() + b"// mine, \xc3\xa4\r\n")
    edited = own.read_bytes()
    with pytest.raises(InputError, match="stays as you edited it"):
        generate(leg(tmp_path, foot=True), tmp_path / "out")
    generate(leg(tmp_path, foot=True), tmp_path / "out", GenerateOptions(accept_structure=True))
    assert own.read_bytes() == edited
    with pytest.raises(InputError, match=r"Mechatronics\.mo:3 uses 'hip'"):
        generate(leg(tmp_path, joints=("femur", "knee")), tmp_path / "out")
    assert "foot" in (made / "Mechanics.mo").read_text()


def test_edited_mechatronics_is_not_lost_when_the_assignment_changes(tmp_path: Path, made: Path) -> None:
    own = made / "Mechatronics.mo"
    own.write_text(own.read_text().replace("c=50", "c=51"))
    edited = own.read_bytes()
    (tmp_path / "actuators.toml").write_text(DRIVE.replace("50", "60"))
    before = files_of(tmp_path / "out")
    for _ in range(2):
        with pytest.raises(InputError, match="edited by hand"):
            generate(leg(tmp_path), tmp_path / "out")
    assert files_of(tmp_path / "out") == before
    generate(leg(tmp_path), tmp_path / "out", GenerateOptions(edited=Edited.KEEP))
    assert own.read_bytes() == edited
    generate(leg(tmp_path, mass=2.0), tmp_path / "out")  # the choice is remembered
    assert own.read_bytes() == edited
    notes = generate(leg(tmp_path, mass=2.0), tmp_path / "out", GenerateOptions(edited=Edited.REPLACE)).notes
    assert any("move it away to have it written anew" in note for note in notes)
    assert own.read_bytes() == edited
    (tmp_path / "actuators.toml").write_text(DRIVE.replace("50", "70"))
    generate(leg(tmp_path), tmp_path / "out", GenerateOptions(edited=Edited.REPLACE))
    assert "c=70" in own.read_text()
    assert (made / "Mechatronics.mo.edited1").read_bytes() == edited
    generate(leg(tmp_path, mass=3.0), tmp_path / "out")
    assert (made / "Mechatronics.mo.edited1").read_bytes() == edited


def test_package_without_a_record_keeps_its_mechatronics(tmp_path: Path, made: Path) -> None:
    """Whatever wrote it: nobody can tell whether it was edited."""
    (made / RECORD).unlink()
    (made / "Mechatronics.mo").write_text("within Leg;\nmodel Mechatronics\n  extends Mechanics;\nend Mechatronics;\n")
    kept = (made / "Mechatronics.mo").read_bytes()
    notes = generate(leg(tmp_path), tmp_path / "out").notes
    assert (made / "Mechatronics.mo").read_bytes() == kept
    assert any("Mechatronics.mo" in note and "stays" in note for note in notes)


def test_record_is_what_the_documentation_says(made: Path) -> None:
    record = json.loads((made / RECORD).read_text())
    compact = json.dumps(record["structure"], sort_keys=True, separators=(",", ":"))
    assert record["signature"] == hashlib.sha256(compact.encode()).hexdigest()
    assert record["mechatronics"] == hashlib.sha256((made / "Mechatronics.mo").read_bytes()).hexdigest()
    assert [joint["source"] for joint in record["structure"]["joints"]] == ["hip", "knee"]
