"""What a second generation changes: only the mechanics, only the mechatronics, or nothing before the user agrees."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import Edited, GenerateOptions, generate
from contact_foundation.errors import InputError

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


# ----- names that have changed -----


def robot(folder: Path, names: dict[str, str], *, moved: float = 0.0) -> Path:
    """Two legs of thigh and shank, the left ones heavier; ``names`` says what is called otherwise."""

    def now(name: str) -> str:
        return names.get(name, name)

    parts, joints = [], []
    for side, mass in (("left", 2.0), ("right", 1.0)):
        y = 0.1 if side == "left" else -0.1
        thigh, shank = f"{side} thigh", f"{side} shank"
        parts += [
            part(now(thigh), position=(moved, y, 0), mass=mass, inertia=(0.02, 0.02, 0.02)),
            part(now(shank), position=(0, y, -0.4), mass=mass),
        ]
        joints += [
            joint(now(f"{side} hip"), "revolute", "ground", now(thigh), origin=(0, y, 0), axis=(0, 1, 0)),
            joint(now(f"{side} knee"), "revolute", now(thigh), now(shank), origin=(0, y, -0.4), axis=(0, 1, 0)),
        ]
    return write_assembly(folder / "robot.xml", parts, joints, name="Robot")


RENAMED = {
    "a part": (
        {"left thigh": "femur"},
        0.0,
        ["part 'left thigh' is gone; renamed 'femur', it seems: same mass, inertia"],
    ),
    "a part that was moved": ({"left thigh": "femur"}, 0.1, ["renamed 'femur', it seems: same mass and inertia"]),
    "two parts of one mass": (
        {"left thigh": "upper left", "left shank": "lower left"},
        0.0,
        ["'left thigh' is gone; renamed 'upper left'", "'left shank' is gone; renamed 'lower left'"],
    ),
    "a joint and both its parts": (
        {"left knee": "K1", "left thigh": "P1", "left shank": "P2"},
        0.0,
        ["'left knee' is gone; renamed 'K1', it seems: same type, parent and child", "renamed 'P1'", "renamed 'P2'"],
    ),
    "everything": (
        {
            f"{side} {name}": f"{name}_{side[0].upper()}"
            for side in ("left", "right")
            for name in ("thigh", "shank", "hip", "knee")
        },
        0.0,
        [
            f"'{side} {name}' is gone; renamed '{name}_{side[0].upper()}'"
            for side in ("left", "right")
            for name in ("thigh", "shank", "hip", "knee")
        ],
    ),
}


@pytest.mark.parametrize("case", RENAMED)
def test_new_names_are_recognised(tmp_path: Path, case: str) -> None:
    names, moved, words = RENAMED[case]
    generate(robot(tmp_path, {}), tmp_path / "out")
    with pytest.raises(InputError) as caught:
        generate(robot(tmp_path, names, moved=moved), tmp_path / "out")
    changes = str(caught.value).split("What no longer fits")[0].split("Nothing refers")[0]
    for word in words:
        assert word in changes
    # Each renamed thing has one line; that joints hold parts of other names is none of its own.
    assert changes.count("\n  - ") == len(names)


def test_parts_of_other_numbers_are_told_by_what_holds_them(tmp_path: Path, made: Path) -> None:
    text = leg(tmp_path, mass=1.7).read_text().replace('"thigh"', '"femur"')
    (tmp_path / "leg.xml").write_text(text)
    with pytest.raises(InputError, match="part 'thigh' is gone; renamed 'femur', it seems: held by the same joint"):
        generate(tmp_path / "leg.xml", tmp_path / "out")
    assert made.is_dir()


def test_what_has_nothing_in_common_is_no_renaming(tmp_path: Path, made: Path) -> None:
    foot = part("wheel", position=(3, 0, 0), mass=9.0)
    slide = joint("rail", "prismatic", "ground", "wheel", axis=(1, 0, 0))
    write_assembly(tmp_path / "leg.xml", [foot], [slide], name="Leg")
    (tmp_path / "actuators.toml").write_text(DRIVE.replace("hip", "rail").replace("Servo", "Force").split("param")[0])
    with pytest.raises(InputError) as caught:
        generate(tmp_path / "leg.xml", tmp_path / "out")
    assert "renamed" not in str(caught.value)
    assert "part 'thigh' is gone" in str(caught.value)
    assert "part 'wheel' is new" in str(caught.value)
    assert made.is_dir()


@pytest.mark.parametrize("scene", [None, "[1", '{"bodies": [{"label": "thigh", "mass": "much"}]}', '{"bodies": [7]}'])
def test_renaming_is_told_without_an_earlier_scene(tmp_path: Path, made: Path, scene: str | None) -> None:
    file = tmp_path / "out" / "scene.json"
    file.unlink() if scene is None else file.write_text(scene)
    with pytest.raises(InputError, match="joint 'knee' is gone; renamed 'kneecap'"):
        generate(leg(tmp_path, joints=("hip", "kneecap")), tmp_path / "out")
    assert made.is_dir()


def test_actuator_of_a_renamed_joint_is_told_the_new_name_and_nothing_is_lost(tmp_path: Path, made: Path) -> None:
    (made / "Drive.mo").write_text(
        "within Leg;\nmodel Drive\n  extends Mechatronics(hipServo(c=60), hip.phi);\nend Drive;\n"
    )
    before = files_of(tmp_path)
    file = leg(tmp_path, joints=("femoral joint", "knee"))
    with pytest.raises(InputError) as caught:
        generate(file, tmp_path / "out")
    message = str(caught.value)
    assert f"{tmp_path / 'actuators.toml'}: no joint 'hip'; it seems to be 'femoral joint' now" in message
    assert "Drive.mo:3 uses 'hip', which seems to be 'femoralJoint' now" in message
    with pytest.raises(InputError) as caught:
        generate(file, tmp_path / "out", GenerateOptions(accept_structure=True))
    assert "no such joint; renamed 'femoral joint', it seems: same type, parent and child" in str(caught.value)
    assert 'Write joint = "femoral joint"' in str(caught.value)
    assert changed(before, files_of(tmp_path)) == {"leg.xml"}

    (tmp_path / "actuators.toml").write_text(DRIVE.replace("hip", "femoral joint"))
    notes = generate(file, tmp_path / "out", GenerateOptions(accept_structure=True)).notes
    assert "no longer fits: Drive.mo:3 uses 'hipServo', which Mechatronics.mo had" in notes
    assert (made / "Drive.mo").read_bytes() == before["out/Leg/Drive.mo"]
    assert "Servo femoralJointServo(" in (made / "Mechatronics.mo").read_text()


def test_names_of_removed_actuators_are_told_where_they_are_used(tmp_path: Path, made: Path) -> None:
    (made / "Drive.mo").write_text("model Drive\n  extends Mechatronics(hipAngleReference=1);\nend Drive;\n")
    (tmp_path / "actuators.toml").write_text(DRIVE.replace("hip", "knee"))
    notes = generate(leg(tmp_path), tmp_path / "out").notes
    assert "no longer fits: Drive.mo:2 uses 'hipAngleReference', which Mechatronics.mo had" in notes
    assert not [note for note in generate(leg(tmp_path), tmp_path / "out").notes if "fits" in note]


def test_misspelt_joint_of_an_actuator_is_told_the_closest_name(tmp_path: Path) -> None:
    (tmp_path / "actuators.toml").write_text(DRIVE.replace("hip", "Knees"))
    with pytest.raises(InputError, match=r'no such joint\n  Write joint = "knee", if that is meant\.'):
        generate(leg(tmp_path), tmp_path / "out")


def test_many_changes_are_told_in_few_lines(tmp_path: Path) -> None:
    def swarm(count: int, prefix: str) -> Path:
        balls = [part(f"{prefix} {number}", position=(number, 0, 0)) for number in range(count)]
        slide = joint("slide", "prismatic", "ground", f"{prefix} 0", axis=(1, 0, 0))
        return write_assembly(tmp_path / "swarm.xml", balls, [slide], name="Swarm")

    generate(swarm(70, "ball"), tmp_path / "out")
    with pytest.raises(InputError) as caught:
        generate(swarm(70, "sphere"), tmp_path / "out")
    lines = str(caught.value).splitlines()
    assert sum("renamed 'sphere" in line for line in lines) == 50
    assert "  - and 20 more" in lines
    notes = generate(swarm(70, "sphere"), tmp_path / "out", GenerateOptions(accept_structure=True)).notes
    for number in range(70):
        assert any(
            note.startswith(f"structure: part 'ball {number}' is gone; renamed 'sphere {number}'") for note in notes
        )


# ----- folders in which nothing is -----


def test_empty_folders_of_the_modeller_stay(tmp_path: Path, made: Path) -> None:
    for name in ("Measurements/2026/autumn", "Resources/Images"):
        (made / name).mkdir(parents=True)
    for _ in range(2):
        generate(leg(tmp_path, mass=1.5), tmp_path / "out")
        for name in ("Measurements/2026/autumn", "Resources/Images"):
            assert (made / name).is_dir()
    (made / "Measurements" / "2026" / "autumn").rmdir()
    generate(leg(tmp_path), tmp_path / "out")
    assert (made / "Measurements" / "2026").is_dir()
    assert not (made / "Measurements" / "2026" / "autumn").exists()


def test_empty_folder_in_place_of_a_file_is_refused(tmp_path: Path, made: Path) -> None:
    (made / "Geometry.mo").unlink()
    (made / "Geometry.mo").mkdir()
    with pytest.raises(InputError, match=r"Geometry\.mo"):
        generate(leg(tmp_path), tmp_path / "out")
    assert (made / "Geometry.mo").is_dir()
