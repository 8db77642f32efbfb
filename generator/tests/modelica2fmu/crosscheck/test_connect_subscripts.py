"""Connections of elements of arrays connect these, or the model is refused at their line.

``CMB_CONNECTS=N`` draws N random models. Masses that are connected move as one: with masses that are powers of two how
far they get tells which these are.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.translation import translate

COUNT = int(os.environ.get("CMB_CONNECTS", "3"))
LIBRARY = StandardLibrary(core_subset(), "", "core subset")
MODEL = """model Connected
  model Masses
    parameter Real mass[2] = {1, 1};
    Modelica.Mechanics.Translational.Components.Mass first(m = mass[1]);
    Modelica.Mechanics.Translational.Components.Mass second(m = mass[2]);
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange[2];
  equation
    connect(first.flange_b, flange[1]);
    connect(second.flange_b, flange[2]);
  end Masses;
  package Constants
    constant Integer two = 2;
  end Constants;
  function other
    input Integer i;
    output Integer j;
  algorithm
    j := 3 - i;
  end other;
  record Numbers
    parameter Integer two = 2;
  end Numbers;
  parameter Integer n = 2, one = n - 1, list[2] = {2, 1}, second = list[1];
  parameter Numbers numbers;
  Masses part1;
  Modelica.Mechanics.Translational.Components.Mass mass[2, 2](m = {{64, 128}, {256, 512}});
  Masses part[2](mass = {{1024, 2048}, {4096, 8192}});
  Modelica.Mechanics.Translational.Components.Mass moved[2](m = {1, 2});
  Modelica.Mechanics.Translational.Sources.ConstantForce force[2](each f_constant = 1e4);
equation
  connect(force.flange, moved.flange_a);
CONNECTIONS
end Connected;
"""
Element = tuple[str, ...]
MASSES: dict[Element, int] = {
    ("moved", "1"): 1,
    ("moved", "2"): 2,
    **{("mass", str(i), str(j)): 2 ** (4 + 2 * i + j - 1) for i in (1, 2) for j in (1, 2)},
    **{("part", str(i), str(j)): 2 ** (8 + 2 * i + j - 1) for i in (1, 2) for j in (1, 2)},
}
# Subscripts as they are written, with the numbers that they stand for.
SINGLE = {
    "1": 1,
    "2": 2,
    "n": 2,
    "one": 1,
    "n - 1": 1,
    "2*one": 2,
    "(1)": 1,
    "end": 2,
    "numbers.two": 2,
    "Constants.two": 2,
    "list[2]": 1,
    "second": 2,
    "other(1)": 2,
    "mod(3, 2)": 1,
    "div(5, 2)": 2,
    "if n > 1 then 1 else 2": 1,
    "size(list, 1)": 2,
    "3": 3,
    "n + 1": 3,
    "0": 0,
}
SEVERAL = {
    "1:2": (1, 2),
    "one:n": (1, 2),
    "2:-1:1": (2, 1),
    ":": (1, 2),
    "{2, 1}": (2, 1),
    "list": (2, 1),
    "1:end": (1, 2),
    "2:3": (2, 3),
    "": (1, 2),
}
LOOPED = {
    "i": (1, 2),
    "3 - i": (2, 1),
    "n + 1 - i": (2, 1),
    "mod(i, 2) + 1": (2, 1),
    "list[i]": (2, 1),
    "i + 1": (2, 3),
}


def test_what_is_refused_is_named(tmp_path: Path) -> None:
    for ends, said in (
        ("mass[{2, 1}, 1].flange_b, moved.flange_b", "{2, 1} is a vector of subscripts"),
        ("mass[list, 1].flange_b, moved.flange_b", "list is a vector of subscripts"),
        ("mass[:, 1].flange_b, moved.flange_b", "mass[:, 1] names all elements by a colon"),
        ("part.flange[1], moved.flange_b", "part is an array without subscripts before others"),
        ("mass[1].flange_b, moved.flange_b", "mass has 2 dimensions"),
        ("mass[end, 1].flange_b, moved[1].flange_b", "the subscript end counts from the end"),
        ("mass[list[1], 1].flange_b, moved[1].flange_b", "the subscript list[1] is no sum"),
        ("mass[Constants.two, 1].flange_b, moved[1].flange_b", "the subscript Constants.two is no sum"),
        ("mass[3, 1].flange_b, moved[1].flange_b", "names mass[3], and mass has 2 elements"),
        ("part1.flange[n + 1], moved[1].flange_b", "names flange[3], and flange has 2 elements"),
    ):
        (tmp_path / "Connected.mo").write_text(MODEL.replace("CONNECTIONS", f"  connect({ends});"))
        with pytest.raises(InputError) as caught:
            translate("Connected", [tmp_path / "Connected.mo"], LIBRARY)
        assert said in caught.value.message
        assert caught.value.place is not None
        assert caught.value.place.line == MODEL.count("\n", 0, MODEL.index("CONNECTIONS")) + 1


def test_an_element_beyond_a_loop_is_named(tmp_path: Path) -> None:
    loop = "  for i in 1:n loop\n    connect(mass[1, i + 1].flange_b, moved[i].flange_b);\n  end for;"
    (tmp_path / "Connected.mo").write_text(MODEL.replace("CONNECTIONS", loop))
    with pytest.raises(InputError, match=r"names mass\[3\] at i = 2, and mass has 2 elements"):
        translate("Connected", [tmp_path / "Connected.mo"], LIBRARY)


def test_iterators_hide_variables(tmp_path: Path) -> None:
    loop = "  for list in 1:n loop\n    connect(mass[1, list].flange_b, moved[list].flange_b);\n  end for;"
    (tmp_path / "Connected.mo").write_text(MODEL.replace("CONNECTIONS", loop))
    translate("Connected", [tmp_path / "Connected.mo"], LIBRARY)


@pytest.mark.parametrize("seed", range(COUNT))
def test_random_connections_are_right_or_refused(simulate: Callable[..., Any], seed: int) -> None:
    draw = random.Random(seed)
    text, pairs = _drawn(draw)
    try:
        result = simulate(MODEL.replace("CONNECTIONS", text), ["moved[1].s", "moved[2].s"])
    except InputError:
        return
    groups = {element: {element} for element in MASSES}
    for first, second in pairs:
        assert first in groups, text
        both = groups[first] | groups[second]
        for element in both:
            groups[element] = both
    for number in ("1", "2"):
        together = groups["moved", number]
        pushed = sum(element[0] == "moved" for element in together)
        expected = 0.5 * 1e4 * pushed / sum(MASSES[each] for each in together)
        assert result[f"moved[{number}].s"][-1] == pytest.approx(expected, rel=1e-6), text


def _drawn(draw: random.Random) -> tuple[str, list[tuple[Element, Element]]]:
    """A connection, and the elements that it connects; half of them are in loops."""
    kind = draw.choice(("mass", "part"))
    form = draw.choice(("single", "several", "loop"))
    fixed = draw.choice(list(SINGLE))
    if form == "single":
        subscripts, numbers = draw.choice(list(SINGLE.items()))
        values, moved, head = [numbers], "[1]", "connect({});"
    elif form == "several":
        subscripts, several = draw.choice(list(SEVERAL.items()))
        values, moved, head = list(several), "", "connect({});"
    else:
        subscripts, several = draw.choice(list(LOOPED.items()))
        values, moved, head = list(several), "[i]", "for i in 1:2 loop connect({}); end for;"
    is_first = draw.random() < 0.5
    if kind == "mass":
        both = (subscripts or ":", fixed) if is_first else (fixed, subscripts or ":")
        end = f"mass[{', '.join(both)}].flange_b"
    else:
        both = (subscripts, fixed) if is_first else (fixed, subscripts)
        end = "part{}.flange{}".format(*(f"[{each}]" if each else "" for each in both))
    ends = [end, f"moved{moved}.flange_b"]
    draw.shuffle(ends)
    other = str(SINGLE[fixed])
    pairs = [
        ((kind, *((str(value), other) if is_first else (other, str(value)))), ("moved", str(number)))
        for number, value in enumerate(values, 1)
    ]
    return "  " + head.format(", ".join(ends)), pairs
