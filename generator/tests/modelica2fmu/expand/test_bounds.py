"""Values that cannot be are refused at the user's line: bounds, numbers beyond every Real; inertias are told of."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from contact_data import core_subset, modelica_library
from contact_foundation.errors import InputError
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.translation import Translation, translate

LIBRARY = StandardLibrary(core_subset(), "", "core subset")
MODEL = """model Bounds
  type Share = Real(min = 0, max = 2);
  parameter Real k = 3;
  parameter Share given = 2*k - 5;
  Real x(min = 2, max = 3, start = 2.5, fixed = true);
  Share y(start = 0.5);
  Share z[2](start = {0.5, 1}, each fixed = true);
initial equation
  y = 1;
equation
  der(x) = 0;
  der(y) = 0;
  der(z) = {0, 0};
  assert(k < 5, "k is " + String(k));
end Bounds;
"""
BODY = """model Tumbling
  inner Modelica.Mechanics.MultiBody.World world;
  ContactMultiBody.Parts.Body body(
    m = 1, r_CM = {0, 0, 0},
    I_11 = 0.01, I_22 = 0.01, I_33 = 0.01,
    geometry = ContactMultiBody.Shapes.sphere(0.1));
end Tumbling;
"""


def translated(folder: Path, text: str) -> Translation:
    model = text.split(None, 2)[1]
    (folder / f"{model}.mo").write_text(text)
    return translate(model, [folder / f"{model}.mo", modelica_library()], LIBRARY)


def refused(folder: Path, text: str, old: str, new: str) -> tuple[int | None, str | None, str]:
    """Line, component and message of the refusal of a changed model."""
    assert old in text
    with pytest.raises(InputError) as caught:
        translated(folder, text.replace(old, new))
    assert caught.value.place is not None
    assert caught.value.place.file is not None
    assert caught.value.place.file.parent == folder
    return caught.value.place.line, caught.value.place.component, caught.value.message


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("max = 3", "max = 1", 5, "x has a min of 2, more than its max of 1"),
        ("min = 0", "min = 5", 4, "given has a min of 5, more than its max of 2"),
        ("start = 2.5", "start = 4", 5, "the start value of x is 4, more than its max of 3"),
        ("{0.5, 1}", "{0.5, -k}", 7, "the start value of z[2] is -3, less than its min of 0"),
        ("2*k - 5", "-k", 4, "given is -3, less than its min of 0"),
        ("k = 3", "k = 1e400", 3, "the number 1e400 is larger than any Real"),
        ("der(x) = 0", "der(x) = -2E999", 11, "the number 2E999 is larger than any Real"),
        ("k = 3", "k = sqrt(-1)", 3, "k is no number: what it is computed from has no finite result"),
        ("k = 3", "k = 10^400", 3, "k is no number: what it is computed from has no finite result"),
        ("Real k = 3", "Integer k = 10000000000", 3, "k is 10000000000, beyond the largest Integer, 2147483647"),
        ("k < 5", "k < 2.5", 14, "an assertion of the model fails: k is 3"),
    ],
)
def test_value_that_cannot_be(tmp_path: Path, old: str, new: str, line: int, said: str) -> None:
    where, _, message = refused(tmp_path, MODEL, old, new)
    assert (where, message) == (line, said)


def test_guess_outside_the_bounds_is_a_warning(tmp_path: Path) -> None:
    warnings = translated(tmp_path, MODEL.replace("start = 0.5", "start = 5")).systems.warnings
    assert "the start value of y is 5, more than its max of 2" in warnings
    assert not translated(tmp_path, MODEL).systems.warnings


def test_what_is_not_computed_may_have_no_value(tmp_path: Path) -> None:
    translated(tmp_path, MODEL.replace("k = 3", "k = 3; parameter Real unused = if k > 4 then 1/(k - 3) else 1"))


def with_part(part: str, old: str, new: str) -> str:
    assert old in BODY
    shape = "r = {1, 0, 0}, I_11" if "Shape" in part else "I_11"
    return BODY.replace("Parts.Body", f"Parts.{part}").replace(old, new).replace("I_11", shape)


PARTS = ["FreeBody", *(pytest.param(part, marks=pytest.mark.full) for part in ("Body", "BodyShape"))]


@pytest.mark.parametrize("part", PARTS)
def test_negative_moment(tmp_path: Path, part: str) -> None:
    text = with_part(part, "I_33 = 0.01", "I_33 = 0.01, I_21 = 0.1")
    line, component, message = refused(tmp_path, text, "I_33 = 0.01", "I_33 = 0.01")
    assert line == 5
    assert component in ("body", "body.inertia")
    assert "has a negative principal moment" in message


@pytest.mark.parametrize("part", PARTS)
def test_inertia_of_no_body_is_told(tmp_path: Path, part: str) -> None:
    """Told, not refused: of what turns about one axis people give one moment, and leave the others as they are."""
    text = with_part(part, "I_11 = 0.01", "I_11 = 0.03")
    declared = text[text.index("  ContactMultiBody") : text.index("end Tumbling")]
    quiet = declared.replace(" body(", " unchecked(").replace("m = 1", "m = 1, checkInertia = false")
    quiet += declared.replace(" body(", " right(").replace("0.03", "0.01")
    said = translated(tmp_path, text.replace("end Tumbling", f"{quiet}end Tumbling")).systems.warnings
    (warning,) = (w for w in said if "inertia" in w)
    assert "tensor of inertia" in warning
    assert "Tumbling.mo:5: body" in warning


def test_what_parameters_decide_is_not_asked_at_each_step(tmp_path: Path) -> None:
    generated = translated(tmp_path, with_part("FreeBody", "I_11 = 0.01", "I_11 = 0.03")).generated
    assert not generated.needs_completed_steps
    (text,) = (source.text for source in generated.sources if "No body has this tensor of inertia" in source.text)
    before = text[: text.index("No body has this tensor of inertia")]
    assert before.rpartition("int fmurt_part_")[2].startswith("initialize")


def test_shape_that_cannot_be_names_the_parameter(tmp_path: Path) -> None:
    line, component, message = refused(tmp_path, BODY, "sphere(0.1)", "sphere(-0.1)")
    assert (line, component) == (6, "body.geometry")
    assert "radius must be positive" in message


def test_principal_values_that_are_negative(tmp_path: Path) -> None:
    draw = np.random.default_rng(23)
    tensors, semidefinite = [], []
    for _ in range(60):
        values = draw.exponential(size=3) * draw.choice([1.0, 1.0, 1.0, -0.5], size=3) * 10.0 ** draw.uniform(-9, 9)
        axes, _ = np.linalg.qr(draw.normal(size=(3, 3)))
        if abs(values.min()) > 1e-4 * abs(values).sum():  # elsewhere the error of the elements decides
            tensors.append(axes @ np.diag(values) @ axes.T)
            semidefinite.append(values.min() > 0)
    tensors += [np.zeros((3, 3)), np.diag([0.0, 1.0, 1.0]), np.diag([1.0, -1.0, 1.0]), np.diag([1.0, -1.0, 0.0])]
    semidefinite += [True, True, False, False]
    assert len(set(semidefinite[:-4])) == 2
    rows = [", ".join("{" + ", ".join(f"{float(x)!r}" for x in row) + "}" for row in tensor) for tensor in tensors]
    lines = [
        f"  constant Boolean c{n} = ContactMultiBody.Internal.isSemidefinite({{{row}}});\n"
        for n, row in enumerate(rows)
    ]
    scalar = translated(tmp_path, f"model Tensors\n{''.join(lines)}  Real x = time;\nend Tensors;\n").scalar
    assert [bool(scalar.variables[f"c{n}"].value) for n in range(len(rows))] == semidefinite
