"""Each kind of wrong input gives one clear message with file and line, exit status 2, and writes nothing."""

from __future__ import annotations

from pathlib import Path

import pytest
from cad2modelica import generate, read_assembly
from contact_foundation.errors import EXIT_INPUT, InputError, ProblemList

DEEP = "".join("<a>" for _ in range(100)) + "".join("</a>" for _ in range(100))
INSTANCE = '<instances><instance name="i" of="{}"/></instances>'

# (identifier, text to find, replacement, words of the message, text whose line the message names)
WRONG_XML = [
    ("not-well-formed", "</parts>", "</part>", "not well-formed", "</part>\n  <joints>"),
    ("unknown-element", "<ground>", "<grund>", None, None),
    ("schema-attribute", 'mass="kg"', 'mass="stone"', "stone", "stone"),
    ("schema-missing-mass", "<mass>0.5</mass>", "", "Expected is ( mass )", None),
    ("schema-not-a-number", "<mass>0.5</mass>", "<mass>heavy</mass>", "heavy", "heavy"),
    ("schema-infinite", "<mass>0.5</mass>", "<mass>INF</mass>", "INF", "INF"),
    ("wrong-root", "assembly", "mechanism", "not an assembly", "<mechanism"),
    (
        "missing-geometry-file",
        'file="pendulum.wrl" node="rod"',
        'file="gone.wrl" node="rod"',
        "does not exist",
        "gone.wrl",
    ),
    ("missing-node", 'node="rod"', 'node="bar"', "'bar'", "bar"),
    ("unknown-joint-part", 'child="rod"', 'child="bar"', "'bar', which does not exist", "bar"),
    ("child-ground", 'child="rod"', 'child="ground"', "'ground' cannot be a child", '<joint name="hinge"'),
    ("joint-with-itself", 'parent="block"', 'parent="rod"', "with itself", '<joint name="hinge"'),
    ("unknown-material", 'name="rod" material="steel"', 'name="rod" material="stell"', "'stell'", "stell"),
    ("schema-huge", "<mass>0.5</mass>", "<mass>1e400</mass>", "greater than the maximum value", "1e400"),
    ("schema-huge-vector", "<axis>0 1 0</axis>", "<axis>0 1e31 0</axis>", "greater than the maximum value", "1e31"),
    ("schema-tolerance", "<ground>", '<simulation stopTime="1" tolerance="1"/><ground>', None, None),
    ("tiny-mass", "<mass>0.5</mass>", "<mass>1e-320</mass>", "at least 1e-30 kg", None),
    (
        "long-file-name",
        'file="pendulum.wrl" node="rod"',
        f'file="{"x" * 5000}" node="rod"',
        "does not exist",
        "x" * 5000,
    ),
    ("zero-mass", "<mass>0.5</mass>", "<mass>0</mass>", "must be positive", None),
    ("negative-mass", "<mass>0.5</mass>", "<mass>-1</mass>", "must be positive", None),
    ("negative-inertia", 'xx="80"', 'xx="-80"', "not positive definite", None),
    ("inertia-products", 'yy="1700" zz="1700" xy="0"', 'yy="1700" zz="1700" xy="500"', "not positive definite", None),
    ("triangle-inequality", 'xx="80"', 'xx="8000"', "no body has these", None),
    (
        "same-name",
        'part name="rod"',
        'part name="block"',
        "another part of",
        'part name="block" material="steel">',
    ),
    ("reserved-name", 'part name="rod"', 'part name="ground"', "cannot be named", 'part name="ground"'),
    (
        "plane-named-ground",
        'plane name="floor"',
        'plane name="ground"',
        "a plane cannot be named",
        'plane name="ground"',
    ),
    ("leaves-folder", 'file="pendulum.wrl" node="rod"', 'file="../pendulum.wrl" node="rod"', "leaves the", "../"),
    (
        "absolute-path",
        'file="pendulum.wrl" node="rod"',
        'file="/etc/passwd" node="rod"',
        "not a relative path",
        "passwd",
    ),
    (
        "url",
        'file="pendulum.wrl" node="rod"',
        'file="http://example.org/a.wrl" node="rod"',
        "not a relative",
        "example",
    ),
    ("backslash", 'file="pendulum.wrl" node="rod"', 'file="a\\b.wrl" node="rod"', "not a file name", "a\\b"),
    ("wrong-length-unit", 'units length="mm"', 'units length="m"', "m outside the geometry", None),
    (
        "wrong-geometry-unit",
        'node="rod" coordinates="node" length="mm"',
        'node="rod" coordinates="node" length="m"',
        "radius of gyration",
        None,
    ),
    ("wrong-mass-unit", 'mass="kg"', 'mass="t"', "which no solid has", None),
    ("mirrored", "0 0 1 0 1 0 -1 0 0", "0 0 1 0 1 0 1 0 0", "mirrors", "0 0 1 0 1 0 1"),
    ("scaled-rotation", "0 0 1 0 1 0 -1 0 0", "0 0 2 0 2 0 -2 0 0", "not a rotation", "0 0 2"),
    ("zero-axis", "<axis>0 1 0</axis>", "<axis>0 0 0</axis>", "zero vector", "<axis>"),
    ("no-axis", "<axis>0 1 0</axis>", "", "needs an axis", '<joint name="hinge"'),
    ("no-origin", "<origin>0 0 300</origin>", "", "needs an origin", '<joint name="hinge"'),
    ("axis-of-fixed", 'type="revolute"', 'type="fixed"', "has no axis", "<axis>"),
    ("start-of-spherical", '<start position="90"', '<start velocity="0 0 0"', "has no velocity", "<start"),
    ("zero-normal", 'plane name="floor"', 'plane name="floor" normal="0 0 0"', "zero vector", "normal="),
    (
        "self-pair",
        "</joints>",
        '</joints><contacts><exclude first="rod" second="rod"/></contacts>',
        "itself",
        "exclude",
    ),
    ("unknown-pair", "</joints>", '</joints><contacts><exclude first="rod" second="x"/></contacts>', "'x'", "exclude"),
    ("unknown-definition", "</parts>", "</parts>" + INSTANCE.format("leg"), "'leg'", "instance"),
    ("too-deep", "<units", DEEP + "<units", "nested deeper", None),
    ("empty", None, "", "not well-formed", None),
]


def change(file: Path, old: str | None, new: str) -> str:
    text = file.read_text()
    if old is None:
        text = new
    else:
        assert old in text
        text = text.replace(old, new)
    file.write_text(text)
    return text


def line_of(text: str, part: str) -> int:
    return text[: text.index(part)].count("\n") + 1


def refused(file: Path, tmp_path: Path) -> InputError:
    """Generates, expecting an error of the input family and no trace of output."""
    output = tmp_path / "out" / "package"
    with pytest.raises(InputError) as caught:
        generate(file, output)
    assert caught.value.exit_status == EXIT_INPUT
    assert not output.exists()
    assert not output.parent.exists() or not list(output.parent.iterdir())
    return caught.value


@pytest.mark.parametrize(("old", "new", "words", "at"), [case[1:] for case in WRONG_XML], ids=[c[0] for c in WRONG_XML])
def test_wrong_xml(
    pendulum: Path, tmp_path: Path, old: str | None, new: str, words: str | None, at: str | None
) -> None:
    text = change(pendulum, old, new)
    error = refused(pendulum, tmp_path)
    assert str(pendulum) in str(error)
    if words is not None:
        assert words in str(error)
    if at is not None:
        assert f"{pendulum}:{line_of(text, at)}" in str(error)
    assert len(str(error).splitlines()) <= 8


def test_sound_file_is_accepted(pendulum: Path) -> None:
    """The file all wrong ones are made from is right: each refusal above has the reason it claims."""
    assembly = read_assembly(pendulum)
    assert [part.name for part in assembly.parts] == ["block", "rod"]


def test_cyclic_assembly_names_the_circle(pendulum: Path, tmp_path: Path) -> None:
    instance = '<instances><instance name="i" of="{}"/></instances>'
    text = change(
        pendulum,
        "  <ground>",
        f'<definitions><definition name="a">{instance.format("b")}</definition>'
        f'<definition name="b">{instance.format("a")}</definition></definitions>\n<ground>',
    )
    error = refused(pendulum, tmp_path)
    assert "contains itself" in error.message
    assert error.place is not None
    assert error.place.line == line_of(text, "<definitions>")


def test_instances_that_multiply_are_stopped(pendulum: Path, tmp_path: Path) -> None:
    """Fifty levels of two empty instances each would be 2^50."""
    two = '<instances><instance name="i" of="{0}"/><instance name="j" of="{0}"/></instances>'
    levels = "".join(f'<definition name="d{n}">{two.format(f"d{n + 1}")}</definition>' for n in range(50))
    change(pendulum, "  <ground>", f'<definitions>{levels}<definition name="d50"/></definitions>\n<ground>')
    change(pendulum, "  <joints>", two.format("d0") + "<joints>")
    assert "unfolds to more than" in str(refused(pendulum, tmp_path))


def test_what_a_value_must_look_like_is_said_in_words(pendulum: Path, tmp_path: Path) -> None:
    change(pendulum, "<mass>0.5</mass>", "<mass>NaN</mass>")
    change(pendulum, 'part name="rod"', 'part name="rod/2"')
    said = str(refused(pendulum, tmp_path))
    assert "A number from -1e30 to 1e30" in said
    assert 'Any text without "/"' in said
    assert "pattern" not in said


def test_geometry_that_overflows_is_refused(pendulum: Path, tmp_path: Path) -> None:
    change(pendulum.parent / "pendulum.wrl", "translation 100 0 0", "scale 1e20 1e20 1e20")
    file = pendulum.parent / "pendulum.wrl"
    file.write_text(file.read_text().replace("size 200", "size 2e20"))
    change(pendulum, 'node="rod" coordinates="node"', 'node="rod" coordinates="file"')
    assert "reaches farther than 1e+30 m" in str(refused(pendulum, tmp_path))


def test_geometry_in_one_point_is_refused(pendulum: Path, tmp_path: Path) -> None:
    point = "IndexedFaceSet { coord Coordinate { point [ 1 2 3, 1 2 3, 1 2 3 ] } coordIndex [ 0 1 2 -1 ] }"
    change(pendulum.parent / "pendulum.wrl", "Box { size 200 40 20 }", point)
    assert "all points of the geometry coincide" in str(refused(pendulum, tmp_path))


def test_blanks_around_true_make_no_difference(pendulum: Path) -> None:
    """Blanks around a Boolean are part of XML Schema's notation."""
    change(pendulum, 'grounded="true"', 'grounded=" true "')
    assert read_assembly(pendulum).part("block").grounded


def test_all_problems_are_reported_together(pendulum: Path, tmp_path: Path) -> None:
    change(pendulum, "<mass>0.5</mass>", "<mass>0</mass>")
    change(pendulum, "<axis>0 1 0</axis>", "<axis>0 0 0</axis>")
    error = refused(pendulum, tmp_path)
    assert isinstance(error, ProblemList)
    assert len(error.problems) == 2


def test_missing_file(tmp_path: Path) -> None:
    error = refused(tmp_path / "nothing.xml", tmp_path)
    assert "No such file" in error.message


def test_entity_bomb_is_not_unfolded(pendulum: Path, tmp_path: Path) -> None:
    entities = '<!ENTITY a0 "boom">' + "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 12))
    change(pendulum, "<assembly", f"<!DOCTYPE assembly [{entities}]>\n<assembly")
    change(pendulum, 'name="Pendulum"', 'name="&a11;"')
    error = refused(pendulum, tmp_path)
    assert "DOCTYPE" in error.message
    assert error.place is not None
    assert error.place.line == 2


def test_external_entity_is_not_read(pendulum: Path, tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("classified")
    change(pendulum, "<assembly", f'<!DOCTYPE assembly [<!ENTITY s SYSTEM "{secret}">]>\n<assembly')
    change(pendulum, "  <units", "  <description>&s;</description><units")
    error = refused(pendulum, tmp_path)
    assert "DOCTYPE" in error.message
    assert "classified" not in str(error)


def test_document_type_in_another_encoding(pendulum: Path, tmp_path: Path) -> None:
    text = pendulum.read_text().replace(
        'encoding="UTF-8"?>', 'encoding="UTF-16"?>\n<!DOCTYPE assembly [<!ENTITY a "b">]>'
    )
    pendulum.write_bytes(text.encode("utf-16"))
    assert "DOCTYPE" in refused(pendulum, tmp_path).message


def test_symbolic_link_out_of_the_folder(pendulum: Path, tmp_path: Path) -> None:
    outside = tmp_path / "outside.wrl"
    outside.write_text((pendulum.parent / "pendulum.wrl").read_text())
    (pendulum.parent / "link.wrl").symlink_to(outside)
    text = change(pendulum, 'file="pendulum.wrl" node="rod"', 'file="link.wrl" node="rod"')
    error = refused(pendulum, tmp_path)
    assert "symbolic link" in error.message
    assert error.place is not None
    assert error.place.line == line_of(text, "link.wrl")


def test_symbolic_link_inside_the_folder_is_fine(pendulum: Path) -> None:
    (pendulum.parent / "link.wrl").symlink_to("pendulum.wrl")
    change(pendulum, 'file="pendulum.wrl" node="rod"', 'file="link.wrl" node="rod"')
    assert read_assembly(pendulum).part("rod").meshes


def test_foreign_output_folder_is_kept(pendulum: Path, tmp_path: Path) -> None:
    output = tmp_path / "precious"
    output.mkdir()
    (output / "thesis.txt").write_text("years of work")
    with pytest.raises(InputError):
        generate(pendulum, output)
    assert [file.name for file in output.iterdir()] == ["thesis.txt"]


WRONG_VRML = [
    ("truncated-node", None, "the file ends in the middle of"),
    ("vrml-1", "#VRML V2.0 utf8", "not a VRML 2.0 file"),
    ("stray-bracket", "size 60 60 60 }", "not valid VRML"),
    ("wrong-count", "translation 100 0 0", "3 finite numbers"),
    ("negative-box", "size 200 40 20", "must be positive"),
    ("use-before-def", "Shape { geometry", "no node of that name"),
    ("inline-outside", "Shape { geometry Box { size 200 40 20 } }", "leaves the assembly's folder"),
    ("inline-itself", "Shape { geometry Box { size 200 40 20 } }", "inlines itself"),
    ("zero-scale", "translation 100 0 0", "scale is zero in one direction"),
]
REPLACEMENTS = {
    "vrml-1": "#VRML V1.0 ascii",
    "stray-bracket": "size 60 60 60 ] }",
    "wrong-count": "translation 100 0",
    "negative-box": "size 200 -40 20",
    "use-before-def": "USE later Shape { geometry",
    "inline-outside": 'Inline { url "../secret.wrl" }',
    "inline-itself": 'Inline { url "pendulum.wrl" }',
    "zero-scale": "scale 1 0 1",
}


@pytest.mark.parametrize(("case", "old", "words"), WRONG_VRML, ids=[case[0] for case in WRONG_VRML])
def test_wrong_vrml(pendulum: Path, tmp_path: Path, case: str, old: str | None, words: str) -> None:
    file = pendulum.parent / "pendulum.wrl"
    text = file.read_text()
    if old is None:
        text = text[: text.index("Shape { geometry") + 12]
    else:
        assert old in text
        text = text.replace(old, REPLACEMENTS[case])
    file.write_text(text)
    error = refused(pendulum, tmp_path)
    assert words in str(error)
    assert f"{file}:" in str(error)


@pytest.mark.parametrize("share", [0.1, 0.25, 0.5, 0.77, 0.9, 0.999])
def test_truncated_sample_is_refused(hammer: Path, tmp_path: Path, share: float) -> None:
    folder = tmp_path / "cut"
    folder.mkdir()
    (folder / "hammer.xml").write_bytes(hammer.read_bytes())
    whole = (hammer.parent / "hammer.wrl").read_bytes()
    cut = whole[: int(share * len(whole))]
    (folder / "hammer.wrl").write_bytes(cut)
    error = refused(folder / "hammer.xml", tmp_path)
    assert "ends in the middle of" in error.message
    assert error.place is not None
    assert error.place.line == cut.count(b"\n") + 1


def test_vrml_bomb_is_stopped(pendulum: Path, tmp_path: Path) -> None:
    """Ten groups that each use the one before ten times would be 10^10 boxes."""
    groups = ["DEF g0 Shape { geometry Box {} }"]
    groups += [f"DEF g{n} Group {{ children [ {f'USE g{n - 1} ' * 10} ] }}" for n in range(1, 11)]
    (pendulum.parent / "pendulum.wrl").write_text("#VRML V2.0 utf8\n" + "\n".join(groups))
    error = refused(pendulum, tmp_path)
    assert "more than" in error.message or "too many" in error.message


@pytest.mark.full
def test_deep_vrml_is_stopped(pendulum: Path, tmp_path: Path) -> None:
    depth = 50_000
    text = "#VRML V2.0 utf8\n" + "Group { children [ " * depth + "Shape { geometry Box {} }" + " ] }" * depth
    (pendulum.parent / "pendulum.wrl").write_text(text)
    assert "nested deeper" in refused(pendulum, tmp_path).message


def test_damaged_gzip_is_refused(pendulum: Path, tmp_path: Path) -> None:
    import gzip

    file = pendulum.parent / "pendulum.wrl"
    file.write_bytes(gzip.compress(file.read_bytes())[:-20])
    assert "compressed" in refused(pendulum, tmp_path).message
