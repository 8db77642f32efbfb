"""Arrays whose sizes do not fit are refused at the user's line: in equations, bindings, modifiers, calls and loops.

``CMB_SIZES=N`` draws N random models.
"""

from __future__ import annotations

import os
import random
from pathlib import Path

import pytest
from contact_data import checkout, core_subset
from contact_foundation.errors import InputError
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.translation import translate

COUNT = int(os.environ.get("CMB_SIZES", "2"))
LIBRARY = StandardLibrary(core_subset(), "", "core subset")
MODEL = """model Sizes
  model Part
    parameter Real u[2] = {1, 2};
    Real v[2] = u*time;
  end Part;
  function twice
    input Real u[3];
    output Real y[3];
  algorithm
    y := 2*u;
  end twice;
  Part part(u = {3, 4});
  Real a[2] = {time, 2};
  Real b[3] = {time, 2, 1};
  Real product = a*{1, 2};
  Real y[3];
  Real z[2];
equation
  y = twice(b) + (if time > 1 then b else {1, 2, 3});
  for i in 1:2 loop
    z[i] = a*{i, 2};
  end for;
end Sizes;
"""


def refusal(text: str, folder: Path) -> InputError:
    name = text.split(None, 2)[1]
    (folder / f"{name}.mo").write_text(text)
    with pytest.raises(InputError) as caught:
        translate(name, [folder / f"{name}.mo"], LIBRARY)
    return caught.value


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("time > 1 then b", "time > 1 then a", 19, "sizes of arrays do not fit each other in: y = twice(b)"),
        pytest.param(
            "twice(b)", "twice(a)", 19, "an argument has the wrong size in: y = twice(a)", marks=pytest.mark.full
        ),
        ("twice(b)", "twice(time)", 19, "an argument has the wrong number of dimensions in: y = twice(time)"),
        ("{1, 2};\n  Real y", "{1, 2, 3};\n  Real y", 15, "sizes of arrays do not fit each other in: a*{1, 2, 3}"),
        pytest.param(
            "u = {3, 4}",
            "u = {3, 4, 5}",
            12,
            "u has 2 elements, and what it is given has 3 elements: u = {3, 4, 5}",
            marks=pytest.mark.full,
        ),
        ("y := 2*u", "y := u + {1, 2}", 10, "sizes of arrays do not fit each other in: y := u + {1, 2}"),
        ("y := 2*u", "y := u[1:2]", 10, "y has 3 elements, and what it is given has 2 elements"),
        pytest.param(
            "y := 2*u", "y := 2*u; y[1] := u*{1, 2}", 10, "other in: y[1] := u*{1, 2}", marks=pytest.mark.full
        ),
        ("{i, 2}", "{i, 2, 3}", 20, "sizes of arrays do not fit each other in: for i in 1:2 loop"),
        pytest.param(
            "u*time", "u + time", 4, "sizes of arrays do not fit each other in: u + time", marks=pytest.mark.full
        ),
    ],
)
def test_the_line_is_named(tmp_path: Path, old: str, new: str, line: int, said: str) -> None:
    assert MODEL.count(old) == 1
    error = refusal(MODEL.replace(old, new), tmp_path)
    assert error.place is not None
    assert (error.place.file, error.place.line) == (tmp_path / "Sizes.mo", line)
    assert said in error.message
    assert error.remedy


BALLS = """model Balls
  inner Modelica.Mechanics.MultiBody.World world;
  ContactMultiBody.Parts.FreeBody ball[3](
    each m=1, each r_CM={0,0,0}, each geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.ContactManager contacts(
    n = 3,
    collider = {ball[1].collider, ball[2].collider, ball[3].collider},
    stiffnessChoice = ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness = {1e5, 1e5, 1e5});
equation
  connect(ball.frame_a, contacts.frame);
end Balls;
"""


@pytest.mark.full
@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("{1e5, 1e5, 1e5}", "{1e5}", 9, "stiffness has 3 elements, and what it is given has one element"),
        ("{1e5, 1e5, 1e5}", "fill(1e5, 2)", 9, "stiffness has 3 elements, and what it is given has another size"),
        (", ball[3].collider", "", 7, "collider has 3 elements, and what it is given has 2 elements"),
    ],
)
def test_the_size_that_a_contact_manager_wants_is_told(
    tmp_path: Path, old: str, new: str, line: int, said: str
) -> None:
    (tmp_path / "Balls.mo").write_text(BALLS.replace(old, new))
    with pytest.raises(InputError) as caught:
        translate("Balls", [tmp_path / "Balls.mo", checkout() / "ContactMultiBody"], LIBRARY)
    assert caught.value.place is not None
    assert caught.value.place.line == line
    assert said in caught.value.message


def test_the_model_itself_is_right(tmp_path: Path) -> None:
    (tmp_path / "Sizes.mo").write_text(MODEL)
    translate("Sizes", [tmp_path / "Sizes.mo"], LIBRARY)


@pytest.mark.parametrize("seed", range(COUNT))
def test_one_wrong_size_of_many(tmp_path: Path, seed: int) -> None:
    draw = random.Random(seed)
    count = draw.randrange(3, 12)
    sizes = [draw.randrange(1, 5) for _ in range(count)]
    wrong = draw.randrange(count)
    bound, free = [], []
    for k, size in enumerate(sizes):
        operator = draw.choice(("+", "-"))
        other = size + draw.randrange(1, 3) if k == wrong else size
        value = f"fill(time, {size}) {operator} {draw.choice(('', '2*'))}fill({k}, {other})"
        is_bound = draw.random() < 0.5
        bound.append(f"  Real x{k}[{size}]{f' = {value}' if is_bound else ''};")
        if not is_bound:
            free.append(f"  x{k} = {value};")
    lines = ["model Drawn", *bound, "equation", *free, "end Drawn;"]
    (place,) = (number for number, line in enumerate(lines, start=1) if f"x{wrong}" in line and "fill" in line)
    error = refusal("\n".join(lines) + "\n", tmp_path)
    assert error.place is not None
    assert error.place.line == place


def test_in_a_package_of_several_files(tmp_path: Path) -> None:
    folder = tmp_path / "Library"
    folder.mkdir()
    (folder / "package.mo").write_text("package Library\n  constant Real k[2] = {1, 2};\nend Library;\n")
    (folder / "package.order").write_text("Short\nLong\n")
    (folder / "Short.mo").write_text("within Library;\nmodel Short\n  Real x = k*{time, 1};\nend Short;\n")
    (folder / "Long.mo").write_text(
        "within Library;\nmodel Long\n  extends Short;\n  Real y;\nequation\n\n  y = k*{time, 1, 2};\nend Long;\n"
    )
    with pytest.raises(InputError) as caught:
        translate("Library.Long", [folder], LIBRARY)
    assert caught.value.place is not None
    assert (caught.value.place.file, caught.value.place.line) == (folder / "Long.mo", 7)
