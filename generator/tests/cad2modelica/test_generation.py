"""The generated package: translates, is deterministic, moves as an independent computation says."""

from __future__ import annotations

import itertools
import json
import os
import re
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GeneratedPackage, GenerateOptions, generate, read_assembly
from contact_foundation.errors import InputError
from fmu_regression.scene.scene_file import load_scene
from lxml import etree
from mechanics_simulation import CORE, load, simulate
from scipy.spatial.transform import Rotation

NAMESPACE = "{urn:contactmultibody:assembly:1}"


def files_of(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted(folder.rglob("*")) if file.is_file()}


def without_contacts(hammer: Path, folder: Path) -> Path:
    """The sample with contacts switched off: free of external functions."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "hammer.wrl").write_bytes((hammer.parent / "hammer.wrl").read_bytes())
    text = hammer.read_text().replace('contacts default="all"', 'contacts default="none"')
    (folder / "hammer.xml").write_text(text)
    return folder / "hammer.xml"


@pytest.fixture(scope="module")
def package(hammer: Path, tmp_path_factory: pytest.TempPathFactory) -> GeneratedPackage:
    """What is made of the sample, to be looked at and not changed."""
    return generate(hammer, tmp_path_factory.mktemp("hammer") / "out")


def test_what_is_written(package: GeneratedPackage) -> None:
    assert package.name == "Hammer"
    assert (package.mechanics, package.mechatronics) == ("Hammer.Mechanics", "Hammer.Mechatronics")
    order = (package.root / "package.order").read_text().split()
    classes = {file.stem for file in package.root.glob("*.mo")} - {"package"}
    assert set(order) == classes
    for file in package.root.glob("*.mo"):
        text = file.read_text()
        assert text.startswith("within")
        assert "Documentation(info=" in text
        assert text.count("experiment(") == (1 if file.stem in ("Mechanics", "Mechatronics") else 0)
    assert any("convex pieces" in note and "'arm'" in note for note in package.notes)


def test_distances_are_bounds_unless_clearances_are_asked_for(
    package: GeneratedPackage, hammer: Path, tmp_path: Path
) -> None:
    found = re.search(r"exactWithin=([^,)\s]+)", (package.root / "Mechanics.mo").read_text())
    assert found is not None
    assert 0.0 < float(found[1]) < 0.01  # a fiftieth of the ball's radius
    exact = generate(hammer, tmp_path / "exact", GenerateOptions(clearances=True))
    assert "exactWithin" not in (exact.root / "Mechanics.mo").read_text()


def test_graph_shows_every_body_and_joint(package: GeneratedPackage) -> None:
    svg = etree.parse(package.root.parent / "graph.svg").getroot()
    texts = [element.text for element in svg.iter("{http://www.w3.org/2000/svg}text")]
    names = ["ground", "frame", "arm", "hammer head", "anvil", "ball", "shoulder", "revolute", "elbow", "revolute"]
    assert sorted(filter(None, texts)) == sorted(names)
    boxes = [
        tuple(float(element.get(key)) for key in ("x", "y", "width", "height"))
        for element in svg.iter("{http://www.w3.org/2000/svg}rect")
    ]
    for (x1, y1, w1, h1), (x2, y2, w2, h2) in itertools.combinations(boxes, 2):
        assert x1 + w1 <= x2 or x2 + w2 <= x1 or y1 + h1 <= y2 or y2 + h2 <= y1


def test_diagram_components_do_not_overlap(package: GeneratedPackage) -> None:
    text = (package.root / "Mechanics.mo").read_text()
    found = re.findall(r"transformation\(extent=\{\{(-?\d+),(-?\d+)\},\{(-?\d+),(-?\d+)\}\}", text)
    extents = [tuple(map(int, extent)) for extent in found]
    assert len(extents) == 13
    for (a, b, c, d), (e, f, g, h) in itertools.combinations(extents, 2):
        assert c <= e or g <= a or d <= f or h <= b


def test_same_input_same_bytes(package: GeneratedPackage, hammer: Path, tmp_path: Path) -> None:
    generate(hammer, tmp_path / "second")
    generate(hammer, tmp_path / "second")
    assert files_of(package.root.parent) == files_of(tmp_path / "second")


@pytest.mark.full
def test_geometry_beside_another_path_gives_the_same_bytes(
    package: GeneratedPackage, hammer: Path, tmp_path: Path
) -> None:
    copy = tmp_path / "elsewhere"
    copy.mkdir()
    for name in ("hammer.xml", "hammer.wrl"):
        (copy / name).write_bytes((hammer.parent / name).read_bytes())
    generate(copy / "hammer.xml", tmp_path / "second")
    assert files_of(package.root.parent) == files_of(tmp_path / "second")


@pytest.mark.full
def test_translates_with_the_core_library(hammer: Path, tmp_path: Path) -> None:
    """The mechatronic model, and with it the mechanical model it extends."""
    package = generate(hammer, tmp_path / "out")
    flat = load(tmp_path / "out", package.mechatronics).to_dict("flat")
    assert {"shoulder.phi", "elbow.phi", "contacts.distance"} <= set(flat["variables"])


def test_translates_with_the_standard_library(hammer: Path, tmp_path: Path) -> None:
    library = next(
        (Path(p) for p in os.environ.get("MODELICAPATH", "").split(":") if (Path(p) / "Modelica").is_dir()), None
    )
    if library is None:
        pytest.skip("the Modelica Standard Library is not on MODELICAPATH")
    package = generate(hammer, tmp_path / "out")
    flat = load(tmp_path / "out", package.mechatronics, library).to_dict("flat")
    assert {"shoulder.phi", "elbow.phi", "contacts.distance"} <= set(flat["variables"])


def test_motion_agrees_with_the_independent_pendulum(hammer: Path, tmp_path: Path) -> None:
    """Joint angles and speeds before the first impact against the Lagrange equations of make_expected.py."""
    generate(without_contacts(hammer, tmp_path / "in"), tmp_path / "out")
    found = simulate(tmp_path / "out", "Hammer.Mechanics", 0.3, 0.05)
    expected = tomllib.loads((hammer.parent / "expected.toml").read_text())
    assert len(expected["before_impact"]) >= 5
    for point in expected["before_impact"]:
        row = int(np.argmin(np.abs(found.time - point["time"])))
        assert found.time[row] == pytest.approx(point["time"], abs=1e-12)
        assert found.columns["shoulder.phi"][row] == pytest.approx(point["shoulder"], abs=1e-7)
        assert found.columns["elbow.phi"][row] == pytest.approx(point["elbow"], abs=1e-7)
        assert found.columns["shoulder.w"][row] == pytest.approx(point["shoulder_rate"], abs=1e-6)
        assert found.columns["elbow.w"][row] == pytest.approx(point["elbow_rate"], abs=1e-6)
    height = 0.141977260976 - 9.81 / 2 * found.time**2
    np.testing.assert_allclose(found.columns["ball.frame_a.r_0[3]"], height, atol=1e-9)


def reframed(file: Path, turns: dict[str, Rotation], shifts: dict[str, np.ndarray], *, swapped: bool) -> None:
    """Rewrites an assembly: other part coordinate systems, and joints with parent and child exchanged."""
    tree = etree.parse(file)
    for part in tree.getroot().iter(f"{NAMESPACE}part"):
        name = part.get("name")
        if name not in turns:
            continue
        turn, shift = turns[name], shifts[name]
        pose = part.find(f"{NAMESPACE}pose")
        given = pose.find(f"{NAMESPACE}axisAngle")
        rotation = Rotation.from_rotvec(
            np.radians(float(given.get("angle"))) * np.array(given.get("axis").split(), dtype=float)
        )
        position = np.array(pose.findtext(f"{NAMESPACE}position").split(), dtype=float) + rotation.apply(shift)
        pose.clear()
        etree.SubElement(pose, f"{NAMESPACE}position").text = " ".join(map(repr, position.tolist()))
        quaternion = np.roll((rotation * turn).as_quat(), 1)
        etree.SubElement(pose, f"{NAMESPACE}quaternion").text = " ".join(map(repr, quaternion.tolist()))
        properties = part.find(f"{NAMESPACE}massProperties")
        center = properties.find(f"{NAMESPACE}centerOfMass")
        moved = turn.inv().apply(np.array(center.text.split(), dtype=float) - shift)
        center.text = " ".join(map(repr, moved.tolist()))
        inertia = properties.find(f"{NAMESPACE}inertia")
        keys = [["xx", "xy", "xz"], ["xy", "yy", "yz"], ["xz", "yz", "zz"]]
        tensor = np.array([[float(inertia.get(key)) for key in row] for row in keys])
        tensor = turn.as_matrix().T @ tensor @ turn.as_matrix()
        for i, j in itertools.combinations_with_replacement(range(3), 2):
            inertia.set(keys[i][j], repr(float(tensor[i, j])))
        part.find(f"{NAMESPACE}geometry").set("coordinates", "assembly")
    if swapped:
        for joint in tree.getroot().iter(f"{NAMESPACE}joint"):
            parent, child = joint.get("parent"), joint.get("child")
            joint.set("parent", child)
            joint.set("child", parent)
            axis = joint.find(f"{NAMESPACE}axis")
            axis.text = " ".join(str(-float(word)) for word in axis.text.split())
    tree.write(file)


@pytest.mark.full
@pytest.mark.parametrize("swapped", [False, True])
def test_motion_does_not_depend_on_the_description(hammer: Path, tmp_path: Path, swapped: bool) -> None:
    """Turned and shifted part coordinate systems and exchanged joint partners describe the same mechanism.

    With exchanged partners the axis is turned round, so that the coordinate stays the same.
    """
    file = without_contacts(hammer, tmp_path / "in")
    original = read_assembly(file)
    turns = {"arm": Rotation.from_rotvec([0.4, -0.9, 0.2]), "hammer head": Rotation.from_rotvec([2.0, 1.0, -1.5])}
    shifts = {"arm": np.array([12.0, -7.0, 30.0]), "hammer head": np.array([-5.0, 8.0, 3.0])}
    reframed(file, turns, shifts, swapped=swapped)
    changed = read_assembly(file)
    for part in original.parts:
        ours, theirs = changed.part(part.name), part
        for mesh, other in zip(ours.meshes, theirs.meshes, strict=True):
            np.testing.assert_allclose(ours.pose.point(mesh.vertices), theirs.pose.point(other.vertices), atol=1e-9)
    generate(file, tmp_path / "out")
    found = simulate(tmp_path / "out", "Hammer.Mechanics", 0.3, 0.05)
    expected = tomllib.loads((hammer.parent / "expected.toml").read_text())["before_impact"]
    for point in expected:
        row = int(np.argmin(np.abs(found.time - point["time"])))
        assert found.columns["shoulder.phi"][row] == pytest.approx(point["shoulder"], abs=1e-7)
        assert found.columns["elbow.phi"][row] == pytest.approx(point["elbow"], abs=1e-7)


@pytest.mark.full
def test_start_poses_agree_with_the_scene_file(hammer: Path, tmp_path: Path) -> None:
    """What the animation shows at the start is where the model starts."""
    file = without_contacts(hammer, tmp_path / "in")
    package = generate(file, tmp_path / "out")
    found = simulate(tmp_path / "out", package.mechanics, 0.01, 0.01)
    scene = json.loads(package.scene.read_text())
    assert scene["format"] == 1
    bodies = [body for body in scene["bodies"] if body["meshes"]]
    assert len(bodies) == 5
    for body in bodies:
        position = found.vector(f"{body['variable']}.frame_a.r_0")[0]
        rotation = found.matrix(f"{body['variable']}.frame_a.R.T")[0]
        np.testing.assert_allclose(position, body["position"], atol=1e-9)
        np.testing.assert_allclose(rotation, body["rotation"], atol=1e-9)
    for joint in scene["joints"]:
        assert joint["variable"] in found.columns
        assert joint["rate"] in found.columns


def test_pairs_of_the_scene(package: GeneratedPackage) -> None:
    """All pairs but: joined neighbours, fixed with fixed, and the excluded one."""
    scene = json.loads(package.scene.read_text())
    pairs = {frozenset(pair["bodies"]) for pair in scene["contacts"]["pairs"]}
    names = ["frame", "arm", "hammerHead", "anvil", "ball", "floorPlane"]
    left_out = {("frame", "arm"), ("arm", "hammerHead"), ("frame", "hammerHead")}
    left_out |= set(itertools.combinations(["frame", "anvil", "floorPlane"], 2))
    expected = {frozenset(p) for p in itertools.combinations(names, 2)} - {frozenset(p) for p in left_out}
    assert pairs == expected
    text = (package.root / "Mechanics.mo").read_text()
    order = re.search(r"geometry=\{(.*)\}", text)
    table = re.search(r"pairs=\{(.*)\}", text)
    assert order is not None
    assert table is not None
    bodies = [item.removesuffix(".geometry") for item in order.group(1).split(",")]
    indices = [tuple(map(int, pair.split(","))) for pair in re.findall(r"\{([\d,]+)\}", table.group(1))]
    assert [[bodies[a - 1], bodies[b - 1]] for a, b in indices] == [p["bodies"] for p in scene["contacts"]["pairs"]]
    for a, b in indices:
        assert f"connect({bodies[a - 1]}.frame_a, contacts.frame[{a}])" in text
        assert f"connect({bodies[b - 1]}.frame_a, contacts.frame[{b}])" in text


def test_scene_without_contacts_can_be_read(pendulum: Path, tmp_path: Path) -> None:
    """The report's reader wants a manager's name wherever contacts are written at all."""
    pendulum.write_text(pendulum.read_text().replace("</assembly>", '<contacts default="none"/></assembly>'))
    package = generate(pendulum, tmp_path / "out")
    assert "contacts" not in json.loads(package.scene.read_text())
    scene = load_scene(package.scene)
    assert scene.manager == ""
    assert not scene.pairs


def test_mechatronics_is_never_overwritten(hammer: Path, tmp_path: Path) -> None:
    """A changed CAD parameter changes the mechanics; the modeller's file stays byte for byte."""
    file = without_contacts(hammer, tmp_path / "in")
    package = generate(file, tmp_path / "out")
    own = package.root / "Mechatronics.mo"
    own.write_bytes(own.read_bytes() + b"// edited by hand, \xc3\xa4\r\n")
    edited = own.read_bytes()
    before = files_of(package.root)
    text = file.read_text()
    assert "<mass>0.98" in text
    file.write_text(text.replace("<mass>0.98", "<mass>0.97"))
    generate(file, tmp_path / "out")
    after = files_of(package.root)
    assert after["Mechatronics.mo"] == edited
    assert [name for name in before if before[name] != after[name]] == ["Mechanics.mo"]


def test_own_classes_are_kept_and_listed(hammer: Path, tmp_path: Path) -> None:
    file = without_contacts(hammer, tmp_path / "in")
    package = generate(file, tmp_path / "out")
    drive = 'within Hammer;\nmodel Drive "Own"\n  extends Mechanics(elbow(useAxisFlange=true));\nend Drive;\n'
    (package.root / "Drive.mo").write_text(drive)
    (package.root / "Resources" / "table.txt").write_text("1 2 3")
    (package.root / "package.order").write_text("Drive\nMechanics\nMechatronics\nGeometry\n")
    file.write_text(file.read_text().replace('joint name="elbow"', 'joint name="wrist"'))
    again = generate(file, tmp_path / "out", GenerateOptions(accept_structure=True))
    assert (again.root / "Drive.mo").read_text() == drive
    assert (again.root / "Resources" / "table.txt").read_text() == "1 2 3"
    assert (again.root / "package.order").read_text().split() == ["Drive", "Mechanics", "Mechatronics", "Geometry"]
    assert any("Drive.mo" in note and "'elbow'" in note for note in again.notes)


def test_package_of_another_name_is_not_lost(pendulum: Path, tmp_path: Path) -> None:
    package = generate(pendulum, tmp_path / "out")
    before = files_of(package.root)
    with pytest.raises(InputError, match="holds the package 'Pendulum'"):
        generate(pendulum, tmp_path / "out", GenerateOptions(package="Press"))
    assert files_of(package.root) == before


def test_other_files_in_the_output_are_not_lost(pendulum: Path, tmp_path: Path) -> None:
    generate(pendulum, tmp_path / "out")
    generate(pendulum, tmp_path / "out")
    (tmp_path / "out" / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match=r"notes\.txt"):
        generate(pendulum, tmp_path / "out")
    assert (tmp_path / "out" / "notes.txt").read_text() == "mine"


@pytest.mark.parametrize(
    "name", ["scene.json", "Pendulum/Mechanics.mo", "Pendulum/Mechatronics.mo", "Pendulum/Resources"]
)
def test_folders_in_place_of_files_are_not_lost(pendulum: Path, tmp_path: Path, name: str) -> None:
    """And files in place of folders: nothing of the modeller's own goes, whatever its name."""
    generate(pendulum, tmp_path / "out")
    place = tmp_path / "out" / name
    is_file = place.is_file()
    if is_file:
        place.unlink()
        place.mkdir()
        (place / "mine").write_text("years of work")
    else:
        shutil.rmtree(place)
        place.write_text("years of work")
    with pytest.raises(InputError) as caught:
        generate(pendulum, tmp_path / "out")
    assert str(place) in str(caught.value)
    assert (place / "mine" if is_file else place).read_text() == "years of work"


def test_file_in_place_of_the_package_is_not_lost(pendulum: Path, tmp_path: Path) -> None:
    generate(pendulum, tmp_path / "out")
    shutil.rmtree(tmp_path / "out" / "Pendulum")
    (tmp_path / "out" / "Pendulum").write_text("years of work")
    with pytest.raises(InputError, match="is no folder"):
        generate(pendulum, tmp_path / "out")


def test_damaged_records_count_as_none(pendulum: Path, tmp_path: Path) -> None:
    root = generate(pendulum, tmp_path / "out").root
    before = {name: (root / name).read_bytes() for name in ("Resources/generation.json", "package.order")}
    (root / "Resources" / "generation.json").write_text("[" * 100_000)
    (root / "package.order").write_bytes(b"\xff\xfe\n")
    generate(pendulum, tmp_path / "out")
    assert {name: (root / name).read_bytes() for name in before} == before


@pytest.mark.parametrize("ending", ["xml", "urdf"])
def test_file_names_that_are_no_text(pendulum: Path, tmp_path: Path, ending: str) -> None:
    odd = pendulum.with_name(os.fsdecode(b"p\xff." + ending.encode()))
    inertia = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    robot = f'<robot><link name="a"><inertial><mass value="1"/>{inertia}</inertial></link></robot>'
    odd.write_text(pendulum.read_text() if ending == "xml" else robot)
    package = generate(odd, tmp_path / "out")
    assert f"p?.{ending}" in (package.root / "package.mo").read_text(encoding="utf-8")


def test_nested_assemblies_move_like_their_copies(pendulum: Path, tmp_path: Path) -> None:
    """Two instances of a pendulum, one turned and shifted, swing with the same angle in the same gravity direction."""
    text = pendulum.read_text()
    parts = text[text.index("  <parts>") : text.index("</assembly>")]
    instances = """<instances>
      <instance name="left" of="swing"><pose><position>-500 0 0</position></pose></instance>
      <instance name="right" of="swing"><pose><position>500 0 0</position>
        <axisAngle axis="0 0 1" angle="60"/></pose></instance>
    </instances>"""
    definitions = f'<definitions><definition name="swing">{parts}</definition></definitions>\n'
    text = text.replace(parts, instances).replace("  <ground>", definitions + "  <ground>")
    pendulum.write_text(text.replace("</assembly>", '<contacts default="none"/></assembly>'))
    package = generate(pendulum, tmp_path / "out")
    found = simulate(tmp_path / "out", package.mechanics, 0.5, 0.1)
    np.testing.assert_allclose(found.columns["leftHinge.phi"], found.columns["rightHinge.phi"], atol=1e-9)
    assert np.ptp(found.columns["leftHinge.phi"]) > 0.01
    np.testing.assert_allclose(found.vector("leftRod.frame_a.r_0")[0], [-0.5, 0, 0.3], atol=1e-12)
    turned = found.matrix("rightRod.frame_a.R.T")[0].T
    base = found.matrix("leftRod.frame_a.R.T")[0].T
    np.testing.assert_allclose(turned, Rotation.from_euler("z", 60, degrees=True).as_matrix() @ base, atol=1e-9)


def test_names_are_legal_unique_and_described(pendulum: Path, tmp_path: Path) -> None:
    text = pendulum.read_text()
    text = text.replace('"rod"', '"end"').replace('"block"', '"Block"').replace('"hinge"', '"block"')
    text = text.replace('node="end"', 'node="rod"').replace('node="Block"', 'node="block"')
    text = text.replace('name="floor"', 'name="Bödén 1"').replace(
        'name="Pendulum"', 'name="2. Pendel &quot;A\\B&quot;"'
    )
    pendulum.write_text(text)
    package = generate(pendulum, tmp_path / "out")
    mechanics = (package.root / "Mechanics.mo").read_text()
    for name, label in (("endPart", "end"), ("blockPart", "Block"), ("blockJoint", "block"), ("boden1", "Bödén 1")):
        assert re.search(rf'\b{name}\b[^;]*"{label}"', mechanics), name
    assert re.fullmatch(r"[A-Z]\w*", package.name)
    assert '2. Pendel \\"A\\\\B\\"' in mechanics
    load(tmp_path / "out", package.mechatronics)


@pytest.mark.full
def test_package_name_can_be_chosen(hammer: Path, tmp_path: Path) -> None:
    package = generate(hammer, tmp_path / "out", GenerateOptions(package="MyPress"))
    assert package.name == "MyPress"
    load(tmp_path / "out", package.mechatronics)


@pytest.mark.parametrize("name", ["my press", "Modelica", "end"])
def test_impossible_package_names_are_refused(hammer: Path, tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match="cannot be the package's name"):
        generate(hammer, tmp_path / "out", GenerateOptions(package=name))
    assert not (tmp_path / "out").exists()


def test_unmatched_geometry_and_bodies_without_geometry_are_reported(pendulum: Path, tmp_path: Path) -> None:
    text = pendulum.read_text()
    line = '<geometry file="pendulum.wrl" node="rod" coordinates="node" length="mm"/>'
    assert line in text
    pendulum.write_text(text.replace(line, ""))
    notes = generate(pendulum, tmp_path / "out").notes
    assert any("'pendulum/rod'" in note and "belongs to no part" in note for note in notes)
    assert any("'rod'" in note and "no geometry" in note for note in notes)


def test_core_library_is_the_projects_own() -> None:
    assert (CORE / "Modelica" / "package.mo").is_file()
