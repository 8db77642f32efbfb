"""The front end sees the Standard Library with a few places written differently; nothing else changes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from modelica2fmu.library.library_repairs import REPAIRS, repaired_library
from modelica2fmu.library.source_map import SourceMap, Span, source_number
from modelica2fmu.library.standard_library import find_standard_library
from modelica2fmu.translation import translate

VECTORS = """within Modelica.Math;
package BooleanVectors
  function firstTrueIndex
    input Boolean b[:];
    output Integer index;
  algorithm
    index :=0;
    for i in 1:size(b,1) loop
      if b[i] then
         index :=i;
         return;
      end if;
    end for;
  end firstTrueIndex;
end BooleanVectors;
"""


@pytest.fixture
def library(tmp_path):
    folder = tmp_path / "library"
    (folder / "Modelica" / "Math").mkdir(parents=True)
    (folder / "Modelica" / "package.mo").write_text("package Modelica\nend Modelica;\n")
    (folder / "Modelica" / "Math" / "package.mo").write_text("within Modelica;\npackage Math\nend Math;\n")
    (folder / "Modelica" / "Math" / "BooleanVectors.mo").write_text(VECTORS)
    return folder


def seen(library, tmp_path, source_map=None):
    return repaired_library(library, source_map or SourceMap([]), {"XDG_CACHE_HOME": str(tmp_path / "cache")})


def test_a_place_is_replaced_and_the_rest_is_linked(library, tmp_path):
    folder = seen(library, tmp_path)
    text = (folder / "Modelica" / "Math" / "BooleanVectors.mo").read_text()
    assert "if b[i] and index == 0 then" in text
    assert "return" not in text
    assert len(text.splitlines()) == len(VECTORS.splitlines())
    linked = folder / "Modelica" / "Math" / "package.mo"
    assert linked.is_symlink()
    assert linked.samefile(library / "Modelica" / "Math" / "package.mo")
    assert "return" in (library / "Modelica" / "Math" / "BooleanVectors.mo").read_text()  # the user's own stays


def test_a_loop_in_a_when_equation_sets_elements_at_any_time(library, tmp_path):
    text = """within Modelica.Blocks;
package Routing
  block Picks
    Real k[3];
  equation

    when {initial(),change(index)} then

      for i in 1:3 loop
        k[i] = if index == i then 1 else 0;
      end for;

    end when;
  end Picks;
end Routing;
"""
    (library / "Modelica" / "Blocks").mkdir()
    (library / "Modelica" / "Blocks" / "Routing.mo").write_text(text)
    written = (seen(library, tmp_path) / "Modelica" / "Blocks" / "Routing.mo").read_text()
    assert "when" not in written
    assert "for i in 1:3 loop" in written
    assert len(written.splitlines()) == len(text.splitlines())


def test_the_view_is_kept_until_the_library_changes(library, tmp_path):
    first = seen(library, tmp_path)
    assert seen(library, tmp_path) == first
    (library / "Modelica" / "Math" / "Special.mo").write_text("within Modelica.Math;\npackage Special\nend Special;\n")
    second = seen(library, tmp_path)
    assert second != first
    assert (second / "Modelica" / "Math" / "Special.mo").is_file()
    assert sorted(path.name for path in first.parent.iterdir()) == sorted([first.name, second.name])  # nothing half


def test_a_library_without_such_places_is_seen_as_it_is(library, tmp_path):
    (library / "Modelica" / "Math" / "BooleanVectors.mo").write_text("within Modelica.Math;\n")
    assert seen(library, tmp_path) == library
    assert not (tmp_path / "cache").exists()


def test_places_are_those_of_the_library_itself(library, tmp_path):
    source_map = SourceMap([])
    folder = seen(library, tmp_path, source_map)
    given = folder / "Modelica" / "Math" / "BooleanVectors.mo"
    place = source_map.place(Span(source_number(str(given)), given.read_text().index("if b[i]"), 0))
    assert (place.file, place.line) == (library / "Modelica" / "Math" / "BooleanVectors.mo", 9)


def test_every_repair_finds_its_place_in_the_standard_library():
    found = find_standard_library()
    if found.origin == "core subset":
        pytest.skip("needs the complete Modelica Standard Library (MODELICAPATH names none)")
    for repair in REPAIRS:
        for name in repair.files:
            text = (Path(found.folder) / name).read_text(encoding="utf-8")
            changed, count = repair.pattern.subn(repair.replacement, text)
            assert count > 0, name
            assert len(re.findall("\n", changed)) == len(re.findall("\n", text)), name


def test_diameters_of_bodies_may_follow_from_parameters(tmp_path):
    library = find_standard_library()
    if library.origin == "core subset":
        pytest.skip("needs the Standard Library (MODELICAPATH)")
    (tmp_path / "Ball.mo").write_text(
        "model Ball\n  parameter Modelica.Units.SI.Radius radius=0.02;\n"
        "  inner Modelica.Mechanics.MultiBody.World world;\n"
        "  Modelica.Mechanics.MultiBody.Parts.Body ball(\n"
        "    m=1, r_CM={0,0,0}, sphereDiameter=2*radius, r_0(each fixed=true), v_0(each fixed=true));\nend Ball;\n"
    )
    assert translate("Ball", [tmp_path / "Ball.mo"], library).systems.reduction.states
