"""Naming, documentation and experiments follow the conventions of the Modelica Standard Library."""

from __future__ import annotations

import re
from pathlib import Path

import pymoca.parser  # type: ignore[import-untyped]
import pytest
from library_compiler import PACKAGES, REPOSITORY
from library_files import ClassFile, case_models, class_files
from lxml import etree

FILES = class_files()
by_name = pytest.mark.parametrize("file", FILES, ids=lambda file: file.full_name)


def test_finds_the_library() -> None:
    assert len(FILES) > 100
    assert {file.full_name for file in FILES} >= {"ContactMultiBody", "ContactMultiBody.ContactManager"}


@pytest.mark.full
def test_an_independent_parser_accepts_every_file() -> None:
    for file in FILES:
        pymoca.parser.parse(file.text)


def test_the_independent_parser_accepts_the_models_of_the_cases() -> None:
    models = sorted((REPOSITORY / "regression" / "cases").rglob("*.mo"))
    assert models
    for path in models:
        pymoca.parser.parse(path.read_text("utf-8"))


def test_the_independent_parser_rejects_what_is_wrong() -> None:
    with pytest.raises(pymoca.parser.ModelicaSyntaxError):
        pymoca.parser.parse("model A Real x; equation x = ; end A;")


@by_name
def test_file_place_and_class_agree(file: ClassFile) -> None:
    expected = file.path.parent.name if file.path.name == "package.mo" else file.path.stem
    assert file.name == expected
    within = re.match(r"within\s*([\w.]*)\s*;", file.text)
    assert within is not None
    assert within[1] == ".".join(file.full_name.split(".")[:-1])
    assert file.text.rstrip().endswith(f"end {file.name};") or file.kind == "type"
    assert "\t" not in file.text


@by_name
def test_names(file: ClassFile) -> None:
    functions_are_lower = file.kind == "function" and "partial" not in file.prefix
    assert file.name[0].islower() == functions_are_lower


@by_name
def test_documentation(file: ClassFile) -> None:
    assert file.description
    assert not file.description.endswith(".")
    assert file.html.strip(), "no documentation"
    text = file.html.replace("<br>", "<br/>")
    entities = {name: etree.HTML(f"<p>&{name};</p>").findtext(".//p") for name in re.findall(r"&([a-z]+);", text)}
    for name, character in entities.items():
        if name not in {"amp", "lt", "gt", "quot"}:
            text = text.replace(f"&{name};", character or "")
    etree.fromstring(f"<html>{text}</html>")


@by_name
def test_links_lead_to_classes(file: ClassFile) -> None:
    names = {other.full_name for other in FILES}
    for target in re.findall(r"modelica://([\w.]+)\\?\"", file.text):
        assert target in names, f"{file.path}: no class {target}"


@by_name
def test_boolean_descriptions(file: ClassFile) -> None:
    for statement in re.findall(r"^\s*(?:parameter |input |output |final )*Boolean [^;]*;", file.text, re.MULTILINE):
        assert '"= true, if ' in statement, statement


@by_name
def test_boolean_parameters_are_check_boxes(file: ClassFile) -> None:
    for statement in re.findall(r'^  parameter Boolean \w+=[^"]*"[^"]*"[^;]*;', file.text, re.MULTILINE):
        assert "choices(checkBox=true)" in statement, statement


@by_name
def test_files_of_geometry_are_found_by_every_tool(file: ClassFile) -> None:
    """Only the project's own FMU builder takes a bare modelica:// name where a file is wanted."""
    code = re.sub(r"annotation \(.*", "", file.text, flags=re.DOTALL)
    for place in re.finditer(r'"modelica://', code):
        assert code[: place.start()].endswith("loadResource("), code[place.start() : place.end() + 60]


@by_name
def test_declarations_are_described(file: ClassFile) -> None:
    declarations = re.findall(
        r"^  (?:final )?(?:parameter|input|output|constant) (?:[\w.]+)(?:\[[^\]]*\])? [^;]*;", file.text, re.MULTILINE
    )
    for declaration in declarations:
        assert '"' in declaration, f"{file.full_name}: {declaration}"


CONDITIONAL = re.compile(
    r"^  (?!annotation)[\w.]+ (\w+)(?:\[[^\]]*\])?(?:\((?:[^()]|\([^()]*\))*\))? if [^;]*;", re.MULTILINE
)


def reads_conditional_components(text: str) -> set[str]:
    """Conditional components that are used outside a connect; Modelica 3.6, section 4.4.5, forbids it."""
    outside = re.sub(r"connect\([^;]*;", "", re.sub(r'"(?:[^"\\]|\\.)*"', '""', text))
    return {name for name in CONDITIONAL.findall(text) if re.search(rf"\b{name}\.\w", outside)}


@by_name
def test_conditional_components_are_connected_only(file: ClassFile) -> None:
    assert reads_conditional_components(file.text) == set()


def test_the_rule_of_conditional_components_finds_what_breaks_it() -> None:
    wrong = "model A\n  B b(m=f(1)) if c;\nequation\n  x = b.y;\nend A;\n"
    right = "model A\n  B b if c;\nequation\n  connect(b.y, x);\nend A;\n"
    assert reads_conditional_components(wrong) == {"b"}
    assert reads_conditional_components(right) == set()


BUILT_IN = (
    "size",
    "sum",
    "min",
    "max",
    "edge",
    "floor",
    "ceil",
    "product",
    "ones",
    "zeros",
    "fill",
    "cross",
    "abs",
    "sign",
)


DECLARED = re.compile(r"([A-Z][\w.]*(?:\[[^\]]*\])? )([a-z]\w*)\b\(?")


def hides_what_it_calls(text: str) -> set[str]:
    """Built-in functions that a class calls and has a component of the same name; lookup would find that."""
    code = re.sub(r'"(?:[^"\\]|\\.)*"', '""', text)
    declared = {name for _, name in DECLARED.findall(code)}
    calls = DECLARED.sub(r"\1\2 ", code)
    return {name for name in declared & set(BUILT_IN) if re.search(rf"(?<![\w.]){name}\(", calls)}


@by_name
def test_components_do_not_hide_functions_that_the_class_calls(file: ClassFile) -> None:
    assert hides_what_it_calls(file.text) == set()


def test_the_rule_of_hidden_functions_finds_what_breaks_it() -> None:
    wrong = "function f\n  input Real size[2];\n  input Real h[:];\nalgorithm\n  n := size(h, 1);\nend f;\n"
    right = "model A\n  Ground floor(r=1);\n  Real h[3];\nequation\n  x = size(h, 1);\nend A;\n"
    assert hides_what_it_calls(wrong) == {"size"}
    assert hides_what_it_calls(right) == set()


def test_examples_have_one_experiment() -> None:
    for file in FILES:
        runs = file.is_model and "extends Modelica.Icons.Example" in file.text
        runs = runs or (".Examples." in file.full_name and file.is_model)
        assert len(file.experiments) == (1 if runs else 0), file.full_name
        for experiment in file.experiments:
            assert "StopTime=" in experiment, file.full_name
            assert "Tolerance=" in experiment, file.full_name


def test_examples_hold_a_body_by_joints_or_take_a_free_one() -> None:
    """FMUs that OpenModelica exports of a free Body fail at initialization (ToolNotes)."""
    examples = [file for file in FILES if ".Examples." in file.full_name]
    held = [file for file in examples if re.search(r"^ +Parts\.Body\w* ", file.text, re.MULTILINE)]
    assert held
    assert [file.full_name for file in held if ".Joints." not in file.text] == []


def test_every_example_is_run_by_a_regression_case() -> None:
    run = case_models()
    extended = {base for file in FILES if file.full_name in run for base in re.findall(r"extends ([\w.]+)", file.text)}
    examples = {file.full_name for file in FILES if ".Examples." in file.full_name and file.is_model}
    assert len(examples) > 20
    assert sorted(examples - run - extended) == []


@pytest.mark.parametrize("folder", sorted({file.path.parent for file in FILES}), ids=lambda f: f.name)
def test_package_order_is_complete(folder: Path) -> None:
    listed = (folder / "package.order").read_text("utf-8").split()
    classes = {path.stem for path in folder.glob("*.mo")} - {"package"}
    classes |= {path.parent.name for path in folder.glob("*/package.mo")}
    assert sorted(listed) == sorted(classes)


def test_versions_agree() -> None:
    for package in PACKAGES:
        text = (REPOSITORY / package / "package.mo").read_text("utf-8")
        assert 'version="0.1.0"' in text
        # The oldest that it works with: 4.1.0 says of itself that it takes the place of 4.0.0 without conversion.
        assert 'Modelica(version="4.0.0")' in text
