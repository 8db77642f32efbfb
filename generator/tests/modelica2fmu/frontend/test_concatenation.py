"""Arrays that the front end takes only when they are written out."""

from __future__ import annotations

import random
import re
from pathlib import Path

import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError
from modelica2fmu.frontend.rewriting.concatenation import with_arrays_written_out
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.symbolic.expression import Node
from modelica2fmu.translation import Translation, translate

MODEL = """model M
  record Material
    Real mu = 0.1;
  end Material;
  model Body
    parameter String shape;
    parameter Material material;
  end Body;
  model Manager
    parameter Integer n;
    parameter String shape[n];
    parameter Material material[n];
    Real mu = sum(material.mu)*time;
    Real first = material[1].mu*time;
  end Manager;
  constant Integer N = {count};
  Body ball[N](each shape = "ball", material(mu = {{0.1*i for i in 1:N}}));
  Body floor(shape = "floor", material(mu = 0.7));
  Manager contacts(n = N + 1, shape = {shape}, material = {material});
end M;
"""


def translated(folder: Path, text: str, name: str = "M") -> Translation:
    file = folder / f"{name.partition('.')[0]}.mo"
    file.write_text(text)
    return translate(name, [file], StandardLibrary(core_subset(), "", "core subset"))


def written_out(text: str) -> str:
    """The same in a model."""
    head, tail = "model M\n", "\nend M;"
    (written,) = with_arrays_written_out("M", [head + text + tail], Path).texts
    return written.removeprefix(head).removesuffix(tail)


def value(translation: Translation, name: str) -> object:
    """The value of a parameter; of one that is another, that one's."""
    found = translation.scalar.variables[name].value
    return value(translation, found.name) if isinstance(found, Node) and found.op == "symbol" else found


@pytest.mark.parametrize("count", [1, 3])
@pytest.mark.parametrize(
    "text",
    [
        "cat(1, {ball[i].X for i in 1:N}, {floor.X})",
        "cat( 1 ,{ ball[k].X for k in 1 : N },\n    {floor.X} )",
        "cat(1, ball.X, {floor.X})",
        "cat(1, cat(1, ball.X), {floor.X}) /* {ball[i].X for i in 1:2} */",
    ],
)
def test_bodies_of_an_array_and_others(tmp_path, text, count):
    model = MODEL.format(count=count, shape=text.replace("X", "shape"), material=text.replace("X", "material"))
    translation = translated(tmp_path, model)
    shapes = [value(translation, f"contacts.shape[{number}]") for number in range(1, count + 2)]
    assert shapes == [*["ball"] * count, "floor"]
    friction = [value(translation, f"contacts.material[{number}].mu") for number in range(1, count + 2)]
    assert friction == pytest.approx([*(0.1 * number for number in range(1, count + 1)), 0.7])


def in_package(folder: Path, **classes: str) -> Path:
    """A package P with each class in a file of its own; it names no library that its classes use."""
    package = folder / "P"
    package.mkdir()
    (package / "package.mo").write_text("package P\nend P;\n")
    (package / "package.order").write_text("".join(f"{name}\n" for name in classes))
    for name, text in classes.items():
        (package / f"{name}.mo").write_text(f"within P;\n{text}")
    return package


def test_bodies_of_an_array_in_a_file_of_a_package(tmp_path):
    text = "cat(1, ball.X, {floor.X})"
    model = MODEL.format(count=2, shape=text.replace("X", "shape"), material=text.replace("X", "material"))
    package = in_package(tmp_path, M=model)
    translation = translate("P.M", [package], StandardLibrary(core_subset(), "", "core subset"))
    shapes = [value(translation, f"contacts.shape[{number}]") for number in (1, 2, 3)]
    assert shapes == ["ball", "ball", "floor"]


def test_places_in_a_file_of_a_package_stay_right(tmp_path):
    text = "cat(1, ball.X,\n   {floor.X})"
    model = MODEL.format(count=2, shape=text.replace("X", "shape"), material=text.replace("X", "material"))
    model = model.replace("end M;", "  Real x, y;\nequation\n  x + y = 1;\n  2*x + 2*y = 2;\nend M;")
    package = in_package(tmp_path, M=model)
    with pytest.raises(InputError, match="linearly dependent") as caught:
        translate("P.M", [package], StandardLibrary(core_subset(), "", "core subset"))
    line = f"within P;\n{model}"[: model.index("  x + y") + len("within P;\n")].count("\n") + 1
    assert caught.value.place is not None
    assert caught.value.place.file == package / "M.mo"
    assert caught.value.place.line in (line, line + 1)


def two_of_a_package() -> tuple[str, str]:
    """Models M and Other, whose numbers of bodies differ."""
    text = "cat(1, {ball[i].X for i in 1:N}, ball.X, {floor.X})"
    model, other = (
        MODEL.format(count=count, shape=text.replace("X", "shape"), material=text.replace("X", "material")).replace(
            "n = N + 1", "n = 2*N + 1"
        )
        for count in (2, 3)
    )
    return model, other.replace("model M\n", "model Other\n").replace("end M;", "end Other;")


def test_each_file_of_a_package_has_its_own_numbers(tmp_path):
    model, other = two_of_a_package()
    package = in_package(tmp_path, M=model, Other=other)
    for name, count in (("M", 2), ("Other", 3)):
        translation = translate(f"P.{name}", [package], StandardLibrary(core_subset(), "", "core subset"))
        shapes = [value(translation, f"contacts.shape[{number}]") for number in range(1, 2 * count + 2)]
        assert shapes == [*["ball"] * 2 * count, "floor"]


def test_each_model_of_a_file_has_its_own_numbers(tmp_path):
    models = "".join(two_of_a_package())
    (tmp_path / "P.mo").write_text(f"package P\n{models}end P;\n")
    for name, count in (("M", 2), ("Other", 3)):
        translation = translate(f"P.{name}", [tmp_path / "P.mo"], StandardLibrary(core_subset(), "", "core subset"))
        assert value(translation, f"contacts.shape[{2 * count + 1}]") == "floor"


def test_numbers_that_two_models_in_use_give_differently_are_not_taken(tmp_path):
    model, other = two_of_a_package()
    package = in_package(tmp_path, M=model.replace("  Body ball", "  Other other;\n  Body ball"), Other=other)
    with pytest.raises(InputError):
        translate("P.M", [package], StandardLibrary(core_subset(), "", "core subset"))


@pytest.mark.parametrize(
    "declared",
    [
        "parameter Integer N = 2 annotation(Evaluate = true)",
        'parameter Integer N(min = 1) = 2 "Number of balls"',
        "parameter Integer K = 1, N = 2",
        "constant Integer N = 2 /* balls */",
    ],
)
def test_numbers_are_found_however_they_are_declared(tmp_path, declared):
    text = "cat(1, ball.X, {floor.X})"
    model = MODEL.format(count=2, shape=text.replace("X", "shape"), material=text.replace("X", "material"))
    translation = translated(tmp_path, model.replace("constant Integer N = 2", declared))
    assert value(translation, "contacts.shape[3]") == "floor"


@pytest.mark.parametrize("name", ["n", "mu"])
def test_the_same_name_elsewhere_does_no_harm(tmp_path, name):
    """The manager has a size n of another value, the materials a Real mu."""
    text = "cat(1, ball.X, {floor.X})"
    model = MODEL.format(count=2, shape=text.replace("X", "shape"), material=text.replace("X", "material"))
    translation = translated(tmp_path, re.sub(r"\bN\b", name, model))
    assert value(translation, "contacts.shape[3]") == "floor"


@pytest.mark.parametrize(
    ("classes", "count"),
    [
        ("model M\n  extends Base;\n", 2),
        ("model M\n  extends Base(N = 3);\n", 3),
        ('model M\n  parameter Integer K = 2;\n  extends Base (floor(shape = "floor"), final N = 2*K - 1);\n', 3),
        ("model Near\n  extends Base(N = 3);\nend Near;\nmodel M\n  extends Near;\n", 3),
        ("model Near\n  extends Base(N = 3);\nend Near;\nmodel M\n  extends Near(N = 1);\n", 1),
        (
            "model Near\n  parameter Integer K = 3;\n  extends Base(N = K);\nend Near;\n"
            "model M\n  extends Near(K = 1);\n",
            1,
        ),
        ("model Other\n  extends Base(N = 5);\nend Other;\nmodel M\n  extends Base(N = 3);\n", 3),
    ],
)
@pytest.mark.parametrize("manager_in", ["Base", "M"])
def test_bodies_of_a_base(tmp_path, classes, count, manager_in):
    """The text of the base says 2; modifiers of extends say otherwise, the outermost last."""
    text = "cat(1, ball.X, {floor.X})"
    model = MODEL.format(count=2, shape=text.replace("X", "shape"), material=text.replace("X", "material"))
    bodies, manager = model.replace("constant Integer N", "parameter Integer N").split("  Manager contacts")
    manager = f"  Manager contacts{manager}".removesuffix("end M;\n")
    base = bodies.replace("model M\n", "model Base\n") + (manager if manager_in == "Base" else "") + "end Base;\n"
    models = f"{base}{classes}{manager if manager_in == 'M' else ''}end M;\n"
    translation = translated(tmp_path, f"package P\n{models}end P;\n", "P.M")
    shapes = [value(translation, f"contacts.shape[{number}]") for number in range(1, count + 2)]
    assert shapes == [*["ball"] * count, "floor"]


def test_a_package_needs_not_name_the_libraries_its_files_use(tmp_path):
    model = "model M\n  Modelica.Blocks.Continuous.Integrator integrator(u = 2*time, y_start = 1);\nend M;\n"
    package = in_package(tmp_path, M=model)
    translation = translate("P.M", [package], StandardLibrary(core_subset(), "", "core subset"))
    assert "integrator.y" in translation.scalar.variables


def test_a_mistake_in_such_a_package_is_placed_in_its_file(tmp_path):
    model = "model M\n  Modelica.Blocks.Continuous.Integrator integrator(u = 2*time);\n  Missing missing;\nend M;\n"
    package = in_package(tmp_path, M=model)
    with pytest.raises(InputError, match="Missing") as caught:
        translate("P.M", [package], StandardLibrary(core_subset(), "", "core subset"))
    assert "cmb-package-" not in str(caught.value)


def test_places_in_messages_stay_right(tmp_path):
    text = "cat(1, {ball[i].X for i in 1:N},\n   {floor.X})"
    model = MODEL.format(count=2, shape=text.replace("X", "shape"), material=text.replace("X", "material"))
    model = model.replace("end M;", "  Real x, y;\nequation\n  x + y = 1;\n  2*x + 2*y = 2;\nend M;")
    with pytest.raises(InputError, match="linearly dependent") as caught:
        translated(tmp_path, model)
    line = model[: model.index("  x + y")].count("\n") + 1
    assert caught.value.place is not None
    assert caught.value.place.line in (line, line + 1)


def test_a_number_that_a_modifier_changes_is_not_taken(tmp_path):
    """In the text it is 2, in the model 3."""
    text = "cat(1, {ball[i].X for i in 1:N}, {floor.X})"
    model = MODEL.format(count=2, shape=text.replace("X", "shape"), material=text.replace("X", "material"))
    inner = model.replace("model M\n", "model Inner\n").replace("end M;", "end Inner;")
    inner = inner.replace("constant Integer N", "parameter Integer N")
    with pytest.raises(InputError):
        translated(tmp_path, f"model M\n{inner}  Inner inner(N = 3);\nend M;\n")


@pytest.mark.parametrize(
    "text",
    [
        "x = cat(2, [1], [2]);",
        "x = cat(1, a, {b});",
        "x = cat(1, {a[i].b for i in 1:M}, {c}); Integer M = f(3);",
        "algorithm for i in 1:n loop y := y + b[i]; end for;",  # n is declared nowhere
        "algorithm for i in 1:size(b, 1) loop y := y + b[i]; end for;",
        "equation for i in 1:2 loop y[i] = b[i]; end for;",
        "algorithm for x in v loop v[1] := x; end for;",
        "algorithm for x in v loop (v, k) := f(v, x); end for;",
        "algorithm for x in r.v loop if x > 0 then r := g(r); end if; end for;",
        "algorithm for x in {a, b} loop a := 2*x; end for;",
        "algorithm for x in {1, 2} loop if x > n then break; end if; end for;",
        "equation for i in 1:2, j in {1, 2} loop y[i, j] = 1; end for;",
        "y = cross({0.0, 0, 1}, {a, 0, 0}); z = g.cross({0, 0, 1}, v);",
        "x = {a[i].b for i in 1:2, j in 1:2};",
        "x = {2*i for i in 1:3};",
        "// cat(1, {a[i].b for i in 1:2})",
        'y = "cat(1, {a[i].b for i in 1:2})";',
        "x = {a[i].b for i in 1:100000};",
    ],
)
def test_what_is_not_plain_stays_as_it_is(text):
    assert written_out(text) == text


def test_iterators_are_replaced_by_their_numbers_alone():
    written = written_out("x = {a[i].i + f(i = i, n = i*pi) for i in 2:3};")
    assert written == "x = {a[2].i + f(i = 2, n = 2*pi), a[3].i + f(i = 3, n = 3*pi)};"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x = {a[i].b for i in r};", "x = {a[r[i]].b for i in 1:size(r, 1)};"),
        ("x = sum(f(q, p.q, q = 1) for q in p.v);", "x = sum(f(p.v[q], p.q, q = 1) for q in 1:size(p.v, 1));"),
        (
            "x = {{i*j for j in 1:2} for i in {2, 1}}; y = max(sum(i for j in 1:2) for i in {3});",
            "x = {{2*j for j in 1:2}, {1*j for j in 1:2}}; y = max({sum(3 for j in 1:2)});",
        ),
        ("x = {u[i] for i in {k + 1, 2}};", "x = {u[(k + 1)], u[2]};"),
        ("for i in {2, 1} loop y[i] = u[i]; end for;", "y[2] = u[2]; y[1] = u[1];"),
        ('for i in {1, 2} loop\n  y[i] = f(i, "i"); // i\nend for;', 'y[1] = f(1, "i"); y[2] = f(2, "i");\n\n'),
        ("for x in v loop y := y + x; end for;", "for x in 1:size(v, 1) loop y := y + v[x]; end for;"),
        (
            "Real v[2]; algorithm for i in size(v, 1):-1:1 loop y := y + v[i]; end for;",
            "Real v[2]; algorithm y := y + v[2]; y := y + v[1];",
        ),
        (
            "Real v[1]; algorithm for i in 1:size(v, 1) loop if v[i] > 0 then y := y + v[i]; end if; end for;",
            "Real v[1]; algorithm if v[1] > 0 then y := y + v[1]; end if;",
        ),
        (
            "equation algorithm for i in 1:2 loop for j in {i, 3} loop y := y + i*j; end for; end for;",
            "equation algorithm y := y + 1*1; y := y + 1*3; y := y + 2*2; y := y + 2*3;",
        ),
        ("y = cross({0, -1, 0}, -{1, 0, 0});", "y = cross({0.0, -1, 0}, -{1.0, 0, 0});"),
        ("parameter Integer n[3]; y = skew(n);", "parameter Integer n[3]; y = skew((1.0*n));"),
    ],
)
def test_loops_and_arguments_are_written_otherwise(text, expected):
    assert written_out(text) == expected


def test_enumerations_of_other_texts_are_not_taken_for_those_of_the_text():
    written = written_out("type E = enumeration(a, b); equation for e in Other.E loop y[e] = 1; end for;")
    assert "Other.E.a" not in written
    written = written_out("package P type E = enumeration(a); end P; equation for e in P.E loop y[e] = 1; end for;")
    assert "y[P.E.a] = 1" in written


def test_sizes_of_what_a_base_declares_are_not_taken_from_other_classes():
    text = "model M extends Base; algorithm for i in 1:size(v, 1) loop y := y + v[i]; end for; end M;\n"
    text += "model Other Real v[2]; end Other; model N extends M; Other other; end N;"
    assert with_arrays_written_out("N", [text], Path).texts == [text]


def test_lines_and_elements_of_random_concatenations():
    choose = random.Random(23)
    for _ in range(200):
        parts, expected = [], []
        for _ in range(choose.randint(1, 4)):
            blank = choose.choice(["", " ", "\n", " // {\n"])
            if choose.random() < 0.5:
                first, last = choose.randint(-2, 2), choose.randint(0, 4)
                parts.append(f"{{{blank}b[i].m for i in {first}:{last}}}{blank}")
                expected += [f"b[{number}].m" for number in range(first, last + 1)]
            else:
                names = [choose.choice("xyz") for _ in range(choose.randint(1, 3))]
                parts.append(f"{{{', '.join(names)}}}{blank}")
                expected += names
        text = f"a = cat(1, {', '.join(parts)}) + c;"
        written = written_out(text)
        assert written.count("\n") == text.count("\n")
        if expected:
            code = written.replace("\n", "")
            assert code == f"a = {{{', '.join(expected)}}} + c;"
        else:
            assert written == text
