"""The report on a generation: overlaps at the start with their depth, loops in the drawing, nothing from outside."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from cad2modelica import generate, read_assembly
from cad2modelica.collision.collision_shapes import collision_geometry
from cad2modelica.collision.start_overlaps import start_overlaps
from contact_data import contact_engine
from lxml import html

FIXTURES = Path(__file__).parents[1] / "fixtures"


def text_of(report: Path) -> str:
    return re.sub(r"\s+", " ", html.parse(str(report)).getroot().text_content())


def boxes(folder: Path, second: str, plane: str = "") -> Path:
    """Two cubes of 100 mm; the second one placed by ``second``; both free."""
    cube = "0 1 3 2 -1 4 6 7 5 -1 0 4 5 1 -1 2 3 7 6 -1 0 2 6 4 -1 1 5 7 3 -1"
    points = ", ".join(f"{x} {y} {z}" for x in (-50, 50) for y in (-50, 50) for z in (-50, 50))
    mesh = f"IndexedFaceSet {{ coord Coordinate {{ point [ {points} ] }} coordIndex [ {cube} ] }}"
    node = f"DEF cube Transform {{ children [ Shape {{ geometry {mesh} }} ] }}"
    (folder / "cube.wrl").write_text(f"#VRML V2.0 utf8\n{node}\n")
    parts = ""
    for name, pose in (("first", "<position>0 0 1000</position>"), ("second", second)):
        parts += (
            f'<part name="{name}"><pose>{pose}</pose><massProperties><mass>1</mass><centerOfMass>0 0 0</centerOfMass>'
            '<inertia about="centerOfMass" axes="part" products="tensor" xx="1700" yy="1700" zz="1700" xy="0" xz="0" '
            'yz="0"/></massProperties><geometry file="cube.wrl" node="cube" coordinates="node" length="mm"/></part>'
        )
    file = folder / "boxes.xml"
    file.write_text(
        '<assembly xmlns="urn:contactmultibody:assembly:1" name="Boxes"><units length="mm" mass="kg" angle="deg"/>'
        f"{plane}<parts>{parts}</parts></assembly>"
    )
    return file


needs_engine = pytest.mark.skipif(not contact_engine().is_file(), reason="the contact engine is not installed")


@needs_engine
def test_overlapping_boxes_are_reported_with_their_depth(tmp_path: Path) -> None:
    package = generate(boxes(tmp_path, "<position>90 20 1000</position>"), tmp_path / "out")
    # Cubes of 100 mm: their balls have a diameter of 173 mm.
    note = "'first' and 'second' overlap at the start by 10 mm, 6 % of the smaller one: contact throws them apart"
    assert note in package.notes
    text = text_of(package.report)
    assert "1 of 1 pairs overlap" in text
    assert "first and second" in text
    assert "10 mm" in text
    assert "overlap" not in (package.root / "Mechanics.mo").read_text()


@needs_engine
@pytest.mark.parametrize("position", ["100 0 1000", "100.001 0 1000", "0 0 700"])
def test_touching_and_separate_boxes_are_not(tmp_path: Path, position: str) -> None:
    package = generate(boxes(tmp_path, f"<position>{position}</position>"), tmp_path / "out")
    assert not any("overlap" in note for note in package.notes)
    assert "None of the 1 pairs that may touch overlap" in text_of(package.report)


@needs_engine
def test_overlap_with_a_tilted_plane(tmp_path: Path) -> None:
    """A cube turned by 45 degrees about y: its edge is 50 sqrt(2) mm under the centre, seen along any normal."""
    turned = '<position>0 0 300</position><axisAngle axis="0 1 0" angle="45"/>'
    wall = '<ground><plane name="wall" normal="1 0 0" position="-60 0 0"/></ground>'
    package = generate(boxes(tmp_path, turned, wall), tmp_path / "out")
    depth = 50 * 2**0.5 - 60
    assert f"'second' and 'wall' overlap at the start by {depth:.4g} mm, 6 % of the smaller one" in package.notes[0]


@needs_engine
def test_bodies_that_rest_on_each_other_are_told_from_those_that_are_thrown_apart(tmp_path: Path) -> None:
    """0.1 mm of 173 mm: noted, but not called a mistake."""
    package = generate(boxes(tmp_path, "<position>99.9 20 1000</position>"), tmp_path / "out")
    assert "'first' and 'second' overlap at the start by 0.1 mm" in package.notes
    assert "as bodies do that rest on each other" in text_of(package.report)
    assert '<tr class="bad">' not in package.report.read_text()


def test_without_the_engine_the_report_says_so(tmp_path: Path) -> None:
    assembly = read_assembly(boxes(tmp_path, "<position>90 20 1000</position>"))
    geometries = {part.name: collision_geometry(part) for part in assembly.parts}
    check = start_overlaps(assembly, geometries, [("first", "second")], tmp_path / "missing.so")
    assert check.overlaps == ()
    assert check.reason == "the contact engine is not installed"


def test_loops_are_marked_in_the_drawing(tmp_path: Path) -> None:
    package = generate(FIXTURES / "two_loops.xml", tmp_path / "out")
    page = package.report.read_text()
    assert page.count('class="cut" d=') == 2
    drawn = dict(re.findall(r'<text class="joint closing"[^>]*>([^<]*?) \[([\d,]+)\]', page))
    assert list(drawn.values()) == ["1", "2"]
    assert re.search(r">crank pin<title>.*?</text>\n<text [^>]*>revolute \[1,2\]<", page)
    text = text_of(package.report)
    assert "closes a planar loop" in text
    assert "follows from the loops" in text
    assert re.findall(r'(?:src|href)="(?!data:)', page) == []


def test_names_of_the_source_are_escaped(tmp_path: Path) -> None:
    file = boxes(tmp_path, "<position>0 0 700</position>")
    file.write_text(file.read_text().replace('name="second"', 'name="&lt;script&gt;x"'))
    page = generate(file, tmp_path / "out").report.read_text()
    assert "<script>" not in page
    assert "&lt;script&gt;x" in page
