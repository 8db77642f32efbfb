"""Robot descriptions as they circulate: references to meshes, prefixes, links fixed to each other, no masses."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, SourceChoices, generate, read_assembly
from cad2modelica.geometry.primitive_meshes import box_surface
from cad2modelica.mechanism.model import GROUND, Assembly
from cmb.main import main
from contact_foundation.errors import InputError
from scipy.spatial.transform import Rotation

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'


def stl(size: tuple[float, float, float] = (1.0, 2.0, 3.0)) -> bytes:
    vertices, triangles = box_surface(np.array(size))
    facets = b"".join(struct.pack("<12fH", *([0.0] * 3), *vertices[t].ravel(), 0) for t in triangles)
    return b" " * 80 + struct.pack("<I", len(triangles)) + facets


def joint(name: str, kind: str, parent: str, child: str, inner: str = "") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}<axis xyz="0 1 0"/>{inner}</joint>'


def link(name: str, mass: float | None = 1.0, inner: str = "", origin: str = "") -> str:
    inertia = '<inertia ixx="0.1" iyy="0.2" izz="0.25" ixy="0.01" ixz="0" iyz="0"/>'
    inertial = "" if mass is None else f'<inertial>{origin}<mass value="{mass}"/>{inertia}</inertial>'
    return f'<link name="{name}">{inertial}{inner}</link>'


def write(folder: Path, *elements: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "robot.urdf"
    file.write_text('<robot name="r">' + "\n".join(elements) + "</robot>")
    return file


def with_mesh(folder: Path, reference: str) -> Path:
    return write(folder, link("a", inner=f'<visual><geometry><mesh filename="{reference}"/></geometry></visual>'))


# ----- references -----


@pytest.mark.parametrize(
    ("reference", "opened"),
    [
        ("package://arm/meshes/box.stl", "elsewhere"),
        ("package://arm/meshes/box.stl", "elsewhere/arm"),
        ("model://arm/meshes/box.stl", "elsewhere"),
        ("file://{folder}/elsewhere/arm/meshes/box.stl", "elsewhere"),
        ("file:///home/somebody/arm/meshes/box.stl", "elsewhere/arm"),
        ("{folder}/elsewhere/arm/meshes/box.stl", "elsewhere/arm/meshes"),
        ("../../meshes/box.stl", "elsewhere/arm"),
        ("../elsewhere/arm/meshes/box.stl", "elsewhere"),
        ("meshes/box.stl", "elsewhere/arm"),
        ("meshes\\box.stl", "elsewhere/arm"),
        ("package://arm\\meshes\\box.stl", "elsewhere"),
    ],
)
def test_opened_folder_is_read_and_nothing_without_it(tmp_path: Path, reference: str, opened: str) -> None:
    meshes = tmp_path / "elsewhere" / "arm" / "meshes"
    meshes.mkdir(parents=True)
    (meshes / "box.stl").write_bytes(stl())
    file = with_mesh(tmp_path / "robot", reference.format(folder=tmp_path))
    choices = SourceChoices(package_paths=(tmp_path / opened,))
    (mesh,) = read_assembly(file, choices=choices).part("a").meshes
    np.testing.assert_allclose(sorted(np.ptp(mesh.vertices, axis=0)), [1, 2, 3], atol=1e-6)
    with pytest.raises(InputError, match="--package-path") as caught:
        read_assembly(file)
    assert caught.value.exit_status == 2
    left_out = read_assembly(file, choices=SourceChoices(allow_missing=True))
    assert left_out.part("a").meshes == ()


@pytest.mark.parametrize("own", [True, False])
def test_a_package_is_known_by_its_package_xml_too(tmp_path: Path, own: bool) -> None:
    """A clone may have any name; its package.xml has the one that references mean."""
    clone = tmp_path / "arm-main"
    (clone / "meshes").mkdir(parents=True)
    (clone / "meshes" / "box.stl").write_bytes(stl())
    (clone / "package.xml").write_text("<?xml version='1.0'?><package><name> arm </name></package>")
    file = with_mesh(clone / "urdf" if own else tmp_path / "robot", "package://arm/meshes/box.stl")
    choices = SourceChoices(package_paths=() if own else (clone,))
    assert len(read_assembly(file, choices=choices).part("a").meshes) == 1
    (clone / "package.xml").write_text("<package><name>hand</name></package>")
    with pytest.raises(InputError, match="names the package 'arm'"):
        read_assembly(with_mesh(clone / "urdf", "package://arm/other/box.stl"))


@pytest.mark.parametrize("reference", ["../../secret.stl", "package://arm/../../secret.stl", "meshes/link.stl"])
def test_opened_folder_opens_nothing_else(tmp_path: Path, reference: str) -> None:
    opened = tmp_path / "arm"
    (opened / "meshes").mkdir(parents=True)
    (tmp_path / "secret.stl").write_bytes(stl())
    (opened / "meshes" / "link.stl").symlink_to(tmp_path / "secret.stl")
    file = with_mesh(tmp_path / "a" / "b", reference)
    with pytest.raises(InputError, match=r"leaves|symbolic"):
        read_assembly(file, choices=SourceChoices(package_paths=(opened,)))


def test_missing_package_is_one_problem_and_names_the_option(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also where no link has a mass, which is what other readers complain about first."""
    mesh = '<visual><geometry><mesh filename="package://irb/m{}.stl"/></geometry></visual>'
    file = write(
        tmp_path, link("a", None, mesh.format(1)), link("b", None, mesh.format(2)), joint("j", "fixed", "a", "b")
    )
    assert main(["generate", str(file), "--output", str(tmp_path / "out")]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "names the package 'irb', which does not exist" in said
    assert "(2 meshes)" in said
    assert "--package-path FOLDER" in said
    assert "--allow-missing" in said
    assert said.count("does not exist") == 1
    assert not (tmp_path / "out").exists()


def test_unbound_prefix_is_read_with_a_note(tmp_path: Path) -> None:
    file = write(tmp_path, "<drake:joint/>", link("a"), '<gazebo gz:reference="a"/>')
    assembly = read_assembly(file)
    assert [part.name for part in assembly.parts] == ["a"]
    noted = [note for note in assembly.notes if "bound to no namespace" in note]
    assert ["drake" in noted[0], "gz" in noted[1]] == [True, True]


def test_unbound_prefixes_are_those_of_this_file_alone(tmp_path: Path) -> None:
    read_assembly(write(tmp_path / "first", "<another:joint/>", link("a")))
    assembly = read_assembly(write(tmp_path / "second", "<drake:joint/>", link("a")))
    (noted,) = [note for note in assembly.notes if "bound to no namespace" in note]
    assert "'drake'" in noted


def test_unbound_prefix_does_not_hide_what_is_wrong_beside_it(tmp_path: Path) -> None:
    file = write(tmp_path, "<drake:joint/>", "<link>", "</robot>")
    with pytest.raises(InputError, match="well-formed"):
        read_assembly(file)


# ----- links that are fixed to each other -----


def test_links_fixed_to_each_other_are_one_body(tmp_path: Path) -> None:
    """Mass, centre and inertia against sums over random points that stand for each body."""
    poses = {"b": ((0.1, 0.2, -0.3), (0.3, -0.2, 0.5)), "c": ((-0.4, 0.1, 0.2), (1.0, 0.4, -0.7))}
    origins = {
        name: f'<origin xyz="{" ".join(map(str, xyz))}" rpy="{" ".join(map(str, rpy))}"/>'
        for name, (xyz, rpy) in poses.items()
    }
    file = write(
        tmp_path,
        link("a", 2.0, origin='<origin xyz="0.01 0.02 0.03"/>'),
        link("b", 0.5),
        link("c", 0.25),
        joint("ab", "fixed", "a", "b", origins["b"]),
        joint("bc", "fixed", "b", "c", origins["c"]),
    )
    assembly = read_assembly(file)
    (part,) = assembly.parts
    assert part.name == "a"
    assert assembly.joints == ()
    assert assembly.aliases == {"b": "a", "c": "a"}
    assert "fixed to 'a' and one body with it: 'b', 'c'" in assembly.notes

    inertia = np.array([[0.1, 0.01, 0], [0.01, 0.2, 0], [0, 0, 0.25]])
    turn_b = Rotation.from_euler("xyz", poses["b"][1])
    turn_c = turn_b * Rotation.from_euler("xyz", poses["c"][1])
    place_b = np.array(poses["b"][0])
    place_c = place_b + turn_b.apply(poses["c"][0])
    bodies = [(2.0, np.array([0.01, 0.02, 0.03]), np.eye(3)), (0.5, place_b, turn_b.as_matrix())]
    bodies.append((0.25, place_c, turn_c.as_matrix()))
    second = np.zeros((3, 3))  # integral of x x^T about the origin
    for mass, center, turn in bodies:
        own = turn @ (np.trace(inertia) / 2 * np.eye(3) - inertia) @ turn.T
        second += own + mass * np.outer(center, center)
    total = sum(mass for mass, _, _ in bodies)
    center = sum(mass * place for mass, place, _ in bodies) / total
    about = second - total * np.outer(center, center)
    found = part.mass_properties
    assert found.mass == pytest.approx(total)
    np.testing.assert_allclose(found.center_of_mass, center, atol=1e-14)
    np.testing.assert_allclose(found.inertia, np.trace(about) * np.eye(3) - about, atol=1e-14)


def test_links_fixed_to_the_world_stand_there(tmp_path: Path) -> None:
    box = "<collision><geometry><box size='1 1 1'/></geometry></collision>"
    file = write(
        tmp_path,
        link("world", None),
        link("base", 3.0, box),
        link("arm", 1.0, box),
        joint("w", "fixed", "world", "base"),
        joint("j", "revolute", "base", "arm"),
    )
    assembly = read_assembly(file)
    assert [(part.name, part.grounded) for part in assembly.parts] == [("base", True), ("arm", False)]
    assert assembly.joints[0].parent == "base"
    assert assembly.aliases == {"world": "base"}


@pytest.mark.parametrize("kind", ["fixed", "revolute"])
@pytest.mark.parametrize("declared", [(), (link("world", None),), (link("world", 2.0),)])
def test_a_parent_named_world_is_the_fixed_surroundings(tmp_path: Path, declared: tuple[str, ...], kind: str) -> None:
    """With or without a link of that name, and whatever its mass: Drake's files declare none."""
    file = write(
        tmp_path,
        *declared,
        link("base", 3.0),
        link("arm"),
        joint("w", kind, "world", "base", '<origin xyz="0 0 2"/>'),
        joint("j", "revolute", "base", "arm"),
    )
    assembly = read_assembly(file)
    assert [part.name for part in assembly.parts] == (["arm"] if kind == "fixed" else ["base", "arm"])
    assert assembly.joints[0].parent == GROUND
    np.testing.assert_allclose(assembly.joints[0].origin, [0, 0, 2])
    assert not any("moves freely" in note for note in assembly.notes)
    assert any("'world'" in note and "mass" in note for note in assembly.notes) == ('mass value="2' in str(declared))


def test_a_world_that_hangs_on_a_link_is_told(tmp_path: Path) -> None:
    file = write(tmp_path, link("base"), link("arm"), joint("w", "fixed", "base", "world"))
    with pytest.raises(InputError, match="child 'world' is no link"):
        read_assembly(file)


def test_inertia_of_no_body_is_told_though_the_link_is_fixed_to_another(tmp_path: Path) -> None:
    """The sum of both would be a body's; a point mass is one."""
    wrong = '<inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial>'
    point = '<inertial><mass value="1"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial>'
    file = write(
        tmp_path,
        link("arm"),
        link("tool", None, wrong),
        link("weight", None, point),
        joint("f", "fixed", "arm", "tool"),
        joint("g", "fixed", "arm", "weight"),
    )
    found = [note for note in read_assembly(file).notes if "principal moments" in note]
    assert found == [
        "link 'tool', fixed to others: no body has these principal moments of inertia: "
        "0.01, 0.01, 0.05 kg.m2 (one exceeds the sum of the others)"
    ]


def test_ground_takes_an_empty_root(tmp_path: Path) -> None:
    file = write(tmp_path, link("base_link", None), link("arm"), joint("j", "revolute", "base_link", "arm"))
    assert read_assembly(file).aliases == {"base_link": GROUND}
    package = generate(file, tmp_path / "out", GenerateOptions(ground=("base_link",)))
    assert "'base_link' stands in the world without --ground too" in package.notes


def test_ground_takes_a_link_that_is_fixed_to_another(tmp_path: Path) -> None:
    file = write(tmp_path, link("trunk"), link("foot", None), joint("f", "fixed", "trunk", "foot"))
    package = generate(file, tmp_path / "out", GenerateOptions(ground=("foot",)))
    assert "connect(world.frame_b, trunk.frame_a)" in (package.root / "Mechanics.mo").read_text()
    assert not any("moves freely" in note for note in package.notes)
    with pytest.raises(InputError, match="no part 'hand' to ground"):
        generate(file, tmp_path / "other", GenerateOptions(ground=("hand",)))


# ----- masses -----


def massless(tmp_path: Path) -> Path:
    box = '<visual><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.3 0.4"/></geometry></visual>'
    return write(
        tmp_path,
        link("base", None, box),
        link("arm", None, box),
        link("tip", None, box),
        joint("j", "revolute", "base", "arm"),
        joint("f", "fixed", "arm", "tip", '<origin xyz="0.2 0 0"/>'),
    )


def test_no_mass_at_all_is_refused_with_advice(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none of its 1 joints would move") as caught:
        generate(massless(tmp_path), tmp_path / "out")
    assert "--density 2700" in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_density_makes_masses_from_the_geometry(tmp_path: Path) -> None:
    assembly: Assembly = read_assembly(massless(tmp_path), choices=SourceChoices(density=1000.0))
    base, arm = assembly.parts
    assert base.grounded
    assert base.mass_properties.mass == 0.0
    found = arm.mass_properties  # two boxes side by side are one of 0.4 x 0.3 x 0.4
    assert found.mass == pytest.approx(48.0)
    np.testing.assert_allclose(found.center_of_mass, [0.2, 0, 0], atol=1e-12)
    expected = 48.0 / 12 * np.array([0.3**2 + 0.4**2, 2 * 0.4**2, 0.4**2 + 0.3**2])
    np.testing.assert_allclose(found.inertia, np.diag(expected), atol=1e-12)


@pytest.mark.parametrize("density", [0.0, -1.0, float("nan"), float("inf")])
def test_density_must_be_positive(tmp_path: Path, density: float) -> None:
    with pytest.raises(InputError, match="density"):
        generate(massless(tmp_path), tmp_path / "out", GenerateOptions(source=SourceChoices(density=density)))


# ----- overlaps at the start -----


def overlapping(tmp_path: Path) -> Path:
    """Two fingers at one hand, 10 mm deep in each other."""
    box = '<collision><geometry><box size="0.05 0.05 0.05"/></geometry></collision>'
    return write(
        tmp_path,
        link("hand"),
        link("left", 0.1, box),
        link("right", 0.1, box),
        joint("l", "prismatic", "hand", "left"),
        joint("r", "prismatic", "hand", "right", '<origin xyz="0 0.04 0"/>'),
    )


def test_pairs_that_overlap_at_the_start_are_left_out(tmp_path: Path) -> None:
    package = generate(overlapping(tmp_path), tmp_path / "out")
    assert "contacts.frame" not in (package.root / "Mechanics.mo").read_text()
    (note,) = [note for note in package.notes if "overlap at the start" in note]
    assert "'left' and 'right' overlap at the start by 10 mm and were left out" in note
    assert "--include left,right" in note


def test_included_pair_collides_though_it_overlaps(tmp_path: Path) -> None:
    package = generate(overlapping(tmp_path), tmp_path / "out", GenerateOptions(include=(("left", "right"),)))
    assert "contacts.frame" in (package.root / "Mechanics.mo").read_text()
    assert any("contact throws them apart" in note for note in package.notes)


def grooved(tmp_path: Path, depth: float) -> Path:
    """A finger 0.5 mm below the rim of a groove (m deep) in a hand, to which a knuckle without shape joins it."""
    width, height, groove = 0.03, 0.02, 0.02
    profile = [(-width, 0), (width, 0), (width, height), (groove, height), (groove, height - depth)]
    profile += [(-groove, height - depth), (-groove, height), (-width, height)]
    front = [f"v {x} {y} {z}" for x in (-0.03, 0.03) for y, z in profile]
    caps = [(1, 2, 5), (1, 5, 6), (2, 3, 5), (3, 4, 5), (1, 6, 8), (6, 7, 8)]
    faces = [f"f {a} {c} {b}" for a, b, c in caps] + [f"f {a + 8} {b + 8} {c + 8}" for a, b, c in caps]
    for a in range(1, 9):
        b = a % 8 + 1
        faces += [f"f {a} {b} {b + 8}", f"f {a} {b + 8} {a + 8}"]
    (tmp_path / "hand.obj").write_text("\n".join(front + faces))
    box = '<collision><origin xyz="0 0 0.0345"/><geometry><box size="0.03 0.03 0.03"/></geometry></collision>'
    return write(
        tmp_path,
        link("hand", 0.1, '<collision><geometry><mesh filename="hand.obj"/></geometry></collision>'),
        link("knuckle", 0.1),
        link("finger", 0.1, box),
        joint("l", "revolute", "hand", "knuckle"),
        joint("r", "revolute", "knuckle", "finger"),
    )


def test_shapes_that_fill_what_is_hollow_do_not_touch_where_they_overlap_at_the_start(tmp_path: Path) -> None:
    package = generate(grooved(tmp_path, 0.001), tmp_path / "out")
    assert "contacts.frame" not in (package.root / "Mechanics.mo").read_text()
    (note,) = [note for note in package.notes if "overlap at the start" in note]
    assert (
        "'hand' and 'finger' overlap at the start by 0.5 mm, one of them as a shape that fills what is hollow" in note
    )
    assert "--include hand,finger" in note
    included = GenerateOptions(include=(("hand", "finger"),))
    kept = generate(grooved(tmp_path, 0.001), tmp_path / "kept", included)
    assert "contacts.frame" in (kept.root / "Mechanics.mo").read_text()


def test_shapes_that_are_the_bodies_touch_though_they_overlap_a_little_at_the_start(tmp_path: Path) -> None:
    package = generate(grooved(tmp_path, 1e-6), tmp_path / "out")
    assert "contacts.frame" in (package.root / "Mechanics.mo").read_text()
    assert any("overlap at the start by 0.5 mm" in note and "left out" not in note for note in package.notes)


def test_excluded_pair_does_not_collide(tmp_path: Path) -> None:
    file = overlapping(tmp_path)
    file.write_text(file.read_text().replace("0.04", "0.07"))
    assert "contacts.frame" in (generate(file, tmp_path / "with").root / "Mechanics.mo").read_text()
    without = generate(file, tmp_path / "without", GenerateOptions(exclude=(("right", "left"),)))
    assert "contacts.frame" not in (without.root / "Mechanics.mo").read_text()
    with pytest.raises(InputError, match="no part 'thumb'"):
        generate(file, tmp_path / "wrong", GenerateOptions(exclude=(("left", "thumb"),)))


def test_pair_that_is_none_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["generate", str(overlapping(tmp_path)), "--output", str(tmp_path / "out"), "--exclude", "left"])
    assert caught.value.code == 2
    assert "is no pair" in capsys.readouterr().err
