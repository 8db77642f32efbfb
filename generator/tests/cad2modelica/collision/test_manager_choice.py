"""Many pairs get the contact manager whose variables grow with the bodies; it pushes as the other does."""

from __future__ import annotations

import json
import re
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import GenerateOptions, ManagerChoice, generate
from cad2modelica.collision.manager_choice import MANY_PAIRS, MOST_PAIRS
from contact_data import core_subset
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from mechanics_simulation import ROOT
from modelica2fmu.build import BuildOptions, build_fmu
from synthetic_assembly import write_chains

COMPILED = GenerateOptions(manager=ManagerChoice.COMPILED)
PAIRS = GenerateOptions(manager=ManagerChoice.PAIRS)
BOX = """<assembly xmlns="urn:contactmultibody:assembly:1" name="Box"><units length="m" mass="kg" angle="deg"/>
<gravity>0 0 -9.81</gravity><ground><plane name="floor"/></ground><parts>
<part name="pillar" grounded="true"><pose><position>0.5 0 0.2</position></pose>
<massProperties><mass>2</mass><centerOfMass>0 0 0</centerOfMass>{inertia}</massProperties>
<geometry file="box.wrl" node="box" coordinates="node" length="m"/></part>
<part name="box"><pose><position>0 0 0.1005</position></pose>
<massProperties><mass>2</mass><centerOfMass>0 0 0</centerOfMass>{inertia}</massProperties>
<geometry file="box.wrl" node="box" coordinates="node" length="m"/></part>
</parts><joints><joint name="free" type="free" parent="ground" child="box"/></joints>
<contacts stiffness="1e5"/></assembly>"""
INERTIA = (
    '<inertia about="centerOfMass" axes="part" products="tensor" xx="0.02" yy="0.02" zz="0.02" xy="0" xz="0" yz="0"/>'
)


def box_on_floor(folder: Path, contacts: str = '<contacts stiffness="1e5"/>') -> Path:
    (folder / "box.wrl").write_text(
        "#VRML V2.0 utf8\nDEF box Transform { children [ Shape { geometry Box { size 0.2 0.2 0.2 } } ] }\n"
    )
    file = folder / "box.xml"
    file.write_text(BOX.format(inertia=INERTIA).replace('<contacts stiffness="1e5"/>', contacts))
    return file


def manager(package: Path) -> str:
    found = re.search(
        r"ContactMultiBody\.\w*ContactManager contacts\(.*?\) \"Contacts\"", mechanics(package), re.DOTALL
    )
    assert found is not None
    return found[0]


def mechanics(package: Path) -> str:
    return (package / "Mechanics.mo").read_text()


def listed(text: str, name: str) -> set[tuple[int, ...]]:
    found = re.search(rf"{name}=\{{(.*?)\}}\}}", text)
    assert found is not None
    return {tuple(sorted(map(int, pair.split(",")))) for pair in re.findall(r"(\d+,\d+)", found[1])}


def test_many_pairs_take_the_compiled_manager_and_a_note_says_so(tmp_path: Path) -> None:
    file = write_chains(tmp_path, 24, 24)
    package = generate(file, tmp_path / "out")
    text = manager(package.root)
    assert text.startswith("ContactMultiBody.CompiledContactManager")
    (note,) = (note for note in package.notes if "CompiledContactManager" in note)
    assert f"more than {MOST_PAIRS}" in note
    assert "--contact-manager pairs" in note
    scene = json.loads(package.scene.read_text())["contacts"]
    assert "pairs" not in scene
    # What the one is told to leave out is what the other is not told to watch.
    other = generate(file, tmp_path / "pairs", PAIRS)
    assert not any("CompiledContactManager" in note for note in other.notes)
    pairs = listed(manager(other.root), "pairs")
    assert len(pairs) > MOST_PAIRS
    every = set(combinations(range(1, len(scene["bodies"]) + 1), 2))
    assert listed(text, "excluded") == every - pairs


def test_few_pairs_keep_variables_of_their_own(tmp_path: Path) -> None:
    package = generate(write_chains(tmp_path, 6, 6), tmp_path / "out")
    assert manager(package.root).startswith("ContactMultiBody.ContactManager")
    assert not any("--contact-manager" in note for note in package.notes)


def test_pairs_that_take_most_of_the_time_are_told(tmp_path: Path) -> None:
    file = write_chains(tmp_path, 14, 14)
    package = generate(file, tmp_path / "out")
    assert manager(package.root).startswith("ContactMultiBody.ContactManager")
    (note,) = (note for note in package.notes if "--contact-manager compiled" in note)
    assert MANY_PAIRS <= int(note.split()[0]) == len(listed(manager(package.root), "pairs")) <= MOST_PAIRS
    anchored = file.with_name("anchored.xml")
    anchored.write_text(file.read_text().replace("</assembly>", '<contacts friction="anchored"/></assembly>'))
    assert not any("--contact-manager" in note for note in generate(anchored, tmp_path / "anchored").notes)


def test_another_manager_needs_consent(tmp_path: Path) -> None:
    """Models that extend the mechanics may speak of contacts.normalForce."""
    file = write_chains(tmp_path, 6, 6)
    before = mechanics(generate(file, tmp_path / "out").root)
    with pytest.raises(InputError, match="contacts is a CompiledContactManager now"):
        generate(file, tmp_path / "out", COMPILED)
    assert mechanics(tmp_path / "out" / "Chains") == before
    consent = GenerateOptions(manager=ManagerChoice.COMPILED, accept_structure=True)
    generate(file, tmp_path / "out", consent)
    generate(file, tmp_path / "out", COMPILED)
    assert mechanics(tmp_path / "out" / "Chains") != before


@pytest.mark.parametrize(
    ("contacts", "clearances", "named"),
    [('<contacts friction="anchored"/>', False, "anchored friction"), ("<contacts/>", True, "exact clearances")],
)
def test_what_the_compiled_manager_lacks_is_refused(
    tmp_path: Path, contacts: str, clearances: bool, named: str
) -> None:
    file = box_on_floor(tmp_path, contacts)
    with pytest.raises(InputError, match=named):
        generate(file, tmp_path / "out", GenerateOptions(manager=ManagerChoice.COMPILED, clearances=clearances))
    assert not (tmp_path / "out").exists()


@pytest.mark.full
def test_both_managers_push_alike(tmp_path: Path, fmu_cache: Path) -> None:
    """A box that rests sinks in by m g / K, whoever computes it."""
    file = box_on_floor(tmp_path)
    for name, options in (("pairs", PAIRS), ("compiled", COMPILED)):
        package = generate(file, tmp_path / name, options)
        report = build_fmu(
            package.mechanics,
            [package.root, ROOT / "ContactMultiBody"],
            tmp_path / f"{name}.fmu",
            BuildOptions(msl=core_subset(), cache=fmu_cache),
        )
        result = simulate_fmu(
            str(report.fmu),
            fmi_type="CoSimulation",
            stop_time=3,
            relative_tolerance=1e-8,
            output=["box.frame_a.r_0[3]"],
        )
        depth = 0.1 - result["box.frame_a.r_0[3]"][-1]
        assert depth == pytest.approx(2 * 9.81 / 1e5, rel=1e-3)
        assert np.isfinite(depth)


def test_a_part_that_is_held_is_immovable(tmp_path: Path) -> None:
    text = manager(generate(box_on_floor(tmp_path), tmp_path / "out", COMPILED).root)
    assert "inertia={ContactMultiBody.Parts.Inertia(),box.inertia,floorPlane.inertia}" in text
