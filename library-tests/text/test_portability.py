"""The library's text holds the rules that other Modelica tools need, and what breaks them is found."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import pytest
from library_compiler import REPOSITORY
from library_files import class_files
from modelica_syntax import ModelicaClass, read_class
from portability_rules import findings

VECTORS = (
    "function vectors input Real u[:, 3]; output Real y[size(u, 1), 3]; algorithm y := u;"
    " annotation (Inline=false); end vectors;"
)
SEVERAL = (
    'function several input Real u[:, 3]; output Real a[size(u, 1)]; output Real b; external "C" f(u, a, b)'
    ' annotation (Library={"ContactMultiBody"}); end several;'
)


def classes_below(*folders: Path) -> dict[str, ModelicaClass]:
    """Classes of packages of one class a file, by full name."""
    classes = {}
    for folder in folders:
        for path in sorted(folder.rglob("*.mo")):
            parts = path.relative_to(folder.parent).with_suffix("").parts
            name = ".".join(parts[:-1] if parts[-1] == "package" else parts)
            classes[name] = read_class(path.read_text("utf-8"))
    return classes


def rules_broken(*texts: str) -> set[str]:
    """What classes of these texts, which lie in no package, break."""
    classes: Mapping[str, ModelicaClass] = {read_class(text).name: read_class(text) for text in texts}
    return {finding.rule for finding in findings(classes)}


def test_the_library_holds_the_rules() -> None:
    classes = classes_below(*(REPOSITORY / package for package in ("ContactMultiBody", "ContactMultiBodyTest")))
    assert len(classes) == len(class_files())
    assert [str(finding) for finding in findings(classes)] == []


MERGED = "an argument or result of a function is equated with another variable"
INLINED = "a function of arrays does not say Inline=false"
PUBLIC = "one of several results is not protected"
USED = "one of several results is used otherwise than as an argument"
CHANGES = [
    (
        "sums over points, of which there may be one",
        "Interfaces.PartialContacts",
        "force = Internal.Resultants.pairForces(pointForce);",
        "for i in 1:m loop force[i, :] = {sum(pointForce[i, :, 1]),sum(pointForce[i, :, 2]),sum(pointForce[i, :, 3])};"
        " end for;",
        MERGED,
    ),
    (
        "a result shown by a plain equation",
        "Interfaces.PartialPairs",
        "distance = Internal.Unaliased.vector(pairDistance);",
        "distance = pairDistance;",
        MERGED,
    ),
    (
        "one of several results shown by a plain equation",
        "Interfaces.PartialCompiledContacts",
        "elasticEnergy = Internal.Unaliased.scalar(responseEnergy);",
        "elasticEnergy = responseEnergy;",
        MERGED,
    ),
    (
        "a result that is a frame's negated force",
        "CompiledContactManager",
        "force = Internal.Unaliased.vectors(responseForce);",
        "for i in 1:n loop frame[i].f = -responseForce[i, :]; end for;",
        MERGED,
    ),
    (
        "a slice copied in a loop",
        "CompiledContactManager",
        "r_0 = Internal.Unaliased.vectors({frame[i].r_0 for i in 1:n});",
        "for i in 1:n loop r_0[i, :] = frame[i].r_0; end for;",
        MERGED,
    ),
    (
        "pre() of arrays as arguments",
        "Interfaces.PartialRestitution",
        "strikeSpeeds(depth, pointSpeed)",
        "strikeSpeeds(depth, pre(pointSpeed))",
        "pre() of a whole array",
    ),
    (
        "one of several results computed with",
        "Interfaces.PartialCompiledContacts",
        "largestDepth = Internal.Unaliased.scalar(responseDepth);",
        "largestDepth = 2*responseDepth;",
        USED,
    ),
    (
        "one of several results public",
        "Interfaces.PartialPairs",
        "protected\n  SI.Length pairDistance",
        "  SI.Length pairDistance",
        PUBLIC,
    ),
    ("a function that may be inlined", "Internal.Resultants.pairForces", "Inline=false, ", "", INLINED),
    ("a function of poses that may be inlined", "Internal.Kinematics.pointVelocities", "Inline=false, ", "", INLINED),
    (
        "a library that is no file",
        "Internal.Engine.query",
        'Library={"ContactMultiBody"}',
        'Library={"ContactMultiBody","stdc++"}',
        "an entry of Library is no file of the package",
    ),
]


@pytest.mark.parametrize(("name", "old", "new", "rule"), [c[1:] for c in CHANGES], ids=[c[0] for c in CHANGES])
def test_a_change_of_the_library_that_breaks_a_rule_is_found(name: str, old: str, new: str, rule: str) -> None:
    """Every rule, broken in the library's own classes where tools were found to fail."""
    library = REPOSITORY / "ContactMultiBody"
    text = library.joinpath(*name.split(".")).with_suffix(".mo").read_text("utf-8")
    assert text.count(old) == 1
    classes = {**library_classes(), f"ContactMultiBody.{name}": read_class(text.replace(old, new))}
    assert rule in {finding.rule for finding in findings(classes)}


@cache
def library_classes() -> Mapping[str, ModelicaClass]:
    """The library's classes, read once."""
    return classes_below(REPOSITORY / "ContactMultiBody")


def test_generated_models_hold_the_rules(tmp_path: Path) -> None:
    cad = REPOSITORY / "Resources" / "cad"
    program = Path(sys.executable).with_name("cmb")
    subprocess.run([program, "generate", cad / "hammer" / "hammer.xml", "--output", tmp_path], check=True)
    folders = (REPOSITORY / "ContactMultiBody", tmp_path / "Hammer", cad / "anton" / "AntonWalk")
    classes = classes_below(*folders)
    assert {"Hammer.Mechanics", "Hammer.Mechatronics"} <= classes.keys()
    assert [str(finding) for finding in findings(classes)] == []


def test_records_that_managers_give_are_replaced_as_a_whole() -> None:
    """OpenModelica drops modifiers of elements of a manager's materials and inertias, which its colliders give."""
    managers = r"\b(?:Volume|Compiled)?ContactManager \w+\(((?:[^()]|\((?:[^()]|\([^()]*\))*\))*)\)"
    declared = [(file.full_name, found[1]) for file in class_files() for found in re.finditer(managers, file.text)]
    assert len(declared) > 50
    assert [name for name, changes in declared if re.search(r"\b(?:material|inertia|collider)\(", changes)] == []


def test_the_reader_sees_what_the_rules_are_about() -> None:
    """Counts against plain searches of the text: nothing is passed over."""
    classes = classes_below(REPOSITORY / "ContactMultiBody")
    several = [
        equation
        for definition in classes.values()
        for equation in definition.equations
        if equation.left.kind == "tuple"
    ]
    text = re.sub(
        r'"(?:[^"\\]|\\.)*"',
        '""',
        "\n".join(file.text for file in class_files() if file.full_name.startswith("ContactMultiBody.")),
    )
    assert len(several) == len(re.findall(r"\n +\(\w+(?:,\w+)+\) = ", text)) > 10
    external = [name for name, definition in classes.items() if definition.external]
    assert len(external) == text.count('\nexternal ""')


WRONG = [
    (
        "an element of an argument is another variable",
        "Real r[n, 3]; Real s[n, 3]; equation r[1, :] = x; s = vectors(r);",
        MERGED,
    ),
    (
        "a slice of an argument in a loop",
        "Real r[n, 3]; Real s[n, 3]; equation for i in 1:n loop r[i, :] = x; end for; s = vectors(r);",
        MERGED,
    ),
    ("a negated element", "Real r[n, 3]; Real s[n, 3]; equation y = -r[1, 2]; s = vectors(r);", MERGED),
    (
        "a negated element by a constant that may be 1",
        "final parameter Real k=1; Real r[n, 3]; Real s[n, 3]; equation y = -r[1, 2]/k; s = vectors(r);",
        MERGED,
    ),
    ("a sum over one element", "Real r[n, 3]; Real s[n, 3]; equation y = sum(r[:, 2]); s = vectors(r);", MERGED),
    (
        "sums in an array",
        "Real r[n, 3]; Real s[n, 3]; equation x = {sum(r[:, 1]),sum(r[:, 2]),0}; s = vectors(r);",
        MERGED,
    ),
    ("an element of a result", "Real r[n, 3]; Real s[n, 3]; equation s = vectors(r); y = s[1, 1];", MERGED),
    ("a result in a declaration", "Real r[n, 3]; Real s[n, 3]=vectors(r); Real t[n, 3]=s;", MERGED),
    ("a row that is constant", "Real r[n, 3]; Real s[n, 3]; equation r[n, :] = zeros(3); s = vectors(r);", MERGED),
    (
        "an argument in an array",
        "Real r[n, 3]; Real s[2*n, 3]; equation s = vectors({r[i, :] for i in 1:n}); x = r[1, :];",
        MERGED,
    ),
    (
        "under a structural condition",
        "Real r[n, 3]; Real s[n, 3]; equation if c then s = vectors(r); y = s[1, 1]; end if;",
        MERGED,
    ),
    (
        "pre of an array",
        "Boolean b[n]; Real s[n, 3]; Real t[n, 3]; equation when b then s = vectors(g(pre(b), t)); end when;",
        "pre() of a whole array",
    ),
    ("pre of a slice", "Real b[n, 3]; equation x = h(pre(b[1, :]));", "pre() of a whole array"),
    (
        "several results, one read",
        "protected Real r[n, 3]; Real a[n]; Real b; equation (a,b) = several(r); y = 2*b;",
        USED,
    ),
    (
        "several results, one public",
        "Real a[n]; protected Real r[n, 3]; Real b; equation (a,b) = several(r);",
        PUBLIC,
    ),
]


@pytest.mark.parametrize(("body", "rule"), [case[1:] for case in WRONG], ids=[case[0] for case in WRONG])
def test_what_breaks_a_rule_is_found(body: str, rule: str) -> None:
    model = f"model M parameter Integer n=1; Real x[3]; Real y; {body} end M;"
    assert rules_broken(model, VECTORS, SEVERAL) == {rule}


def test_what_breaks_a_rule_in_two_classes_is_found() -> None:
    base = "partial model Base Real r[2, 3]; Real s[2, 3]; equation s = vectors(r); end Base;"
    heir = "model Heir extends Base; Real x[3]; equation x = s[1, :]; end Heir;"
    holder = "model Holder Base part; Real y; equation y = part.s[1, 2]; end Holder;"
    assert rules_broken(base, heir, VECTORS) == {MERGED}
    assert rules_broken(base, holder, VECTORS) == {MERGED}


def test_functions_that_may_be_inlined_and_files_that_are_not_there_are_found() -> None:
    model = "model M Real r[2, 3]; Real s[2, 3]; equation s = vectors(r); end M;"
    assert rules_broken(model, VECTORS.replace("annotation (Inline=false);", "")) == {INLINED}
    assert rules_broken(SEVERAL.replace('{"', '{"stdc++","')) == {"an entry of Library is no file of the package"}


RIGHT = [
    "Real r[n, 3]; Real s[n, 3]; equation der(r) = vectors(s); s = vectors(r);",
    "Real r[n, 3]; Real s[n, 3]; equation r[1, :] = 2*x; r[2, :] = f(x); s = vectors(r);",
    "Boolean b[n]; equation for i in 1:n loop y = if pre(b[i]) then 1 else 0; end for;",
    "Real b[n]; initial equation pre(b) = {0};",
    "parameter Real r[n, 3]; Real s[n, 3]; equation s = vectors(r); x = r[1, :];",
    "Real r[n, 3]; Real s[n, 3]; Real t[n, 3]; equation t = r + vectors(s); y = t[1, 1];",
    "protected Real r[n, 3]; Real a[n]; Real b; Real c[n, 3]; equation (a,b) = several(r); c = vectors({a,a,a});",
    "Frame_a frame[n]; Real s[n, 3]; equation s = vectors({frame[i].r_0 for i in 1:n}); frame[1].f = -g(s[1, :]);",
]


@pytest.mark.parametrize("body", RIGHT)
def test_what_holds_the_rules_is_let_pass(body: str) -> None:
    model = f"model M parameter Integer n=1; Real x[3]; Real y; {body} end M;"
    assert rules_broken(model, VECTORS, SEVERAL) == set()
