"""Errors of syntax are told with the file, the line and words that a modeller understands."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError
from modelica2fmu.build import translate
from modelica2fmu.crosscheck.class_tokens import tokens_of
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.phases import PhaseClock

LIBRARY = StandardLibrary(core_subset(), "", "core subset")
SPRING = """model Spring "A mass on a spring"
  parameter Real c = 100 "Stiffness";
  Real x(start = 1, fixed = true);
  Real v(start = 0, fixed = true);
  Real f[2];
equation
  der(x) = v;
  der(v) = -f[1];
  for i in 1:2 loop
    f[i] = i * c * x;
  end for;
  assert(x < 2, "too far");
end Spring;
"""


def refusal(model: str, file: Path) -> InputError:
    with pytest.raises(InputError) as caught:
        translate(model, [file], LIBRARY, PhaseClock(lambda *_: None))
    return caught.value


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("fixed = true);\n  Real v", "fixed = true)\n  Real v", 4, "unexpected `Real`"),
        ("der(x) = v", "der(x) == v", 7, "this is no equation"),
        ("start = 1, fixed = true)", "start = 1, fixed = true", 3, "unexpected `;`"),
        ("end Spring", "end Sprung", 13, "Sprung"),
        ("Real v(start", "Real block(start", 4, "block is a keyword of Modelica"),
        ("parameter Real c", "parameter Real input", 2, "input is a keyword of Modelica"),
        ("end for;", "", 12, "unexpected"),
        ("model Spring", "model", 1, "unexpected `model`"),
    ],
)
def test_a_syntax_error_is_told_with_its_line(tmp_path, old, new, line, said):
    file = tmp_path / "Spring.mo"
    assert old in SPRING
    file.write_text(SPRING.replace(old, new))
    error = refusal("Spring", file)
    assert error.place is not None
    assert error.place.file == file
    assert error.message.startswith("syntax error: ")
    assert said in error.message
    assert error.place.line is not None
    assert abs(error.place.line - line) <= (1 if old == "end for;" else 0)  # a parser sees it where the next word is


@pytest.mark.parametrize(
    "text", ["model B\n  Real x(start = 1)\nequation\n", "model B\n  Real x;\n  Real when;\nequation\n"]
)
def test_the_file_of_a_package_that_cannot_be_read_is_named(tmp_path, text):
    package = tmp_path / "P"
    package.mkdir()
    (package / "package.mo").write_text("package P\nend P;\n")
    (package / "package.order").write_text("A\nB\n")
    (package / "A.mo").write_text("within P;\nmodel A\n  B b;\nend A;\n")
    (package / "B.mo").write_text(f"within P;\n{text}  der(x) = -x;\nend B;\n")
    error = refusal("P.A", package)
    assert error.place is not None
    assert error.place.file == package / "B.mo"
    assert error.place.line == 4
    assert error.message.startswith("syntax error: ")


DRAWS = [pytest.param(seed, marks=[pytest.mark.full] if seed >= 6 else []) for seed in range(60)]


@pytest.mark.parametrize("seed", DRAWS)
def test_a_word_too_few_or_too_many_is_told_plainly(tmp_path, seed):
    """Sampled: one word of a model is left out, doubled or put elsewhere."""
    draw = random.Random(seed)
    tokens = list(tokens_of(SPRING))
    token, other = draw.choice(tokens), draw.choice(tokens)
    text = draw.choice(("", f"{token.text} {token.text}", other.text))
    file = tmp_path / "Spring.mo"
    file.write_text(SPRING[: token.start] + text + SPRING[token.end :])
    try:
        translate("Spring", [file], LIBRARY, PhaseClock(lambda *_: None))
    except InputError as caught:
        error = caught
    else:
        return  # it is a model still
    assert error.place is not None
    assert error.place.file == file
    said = str(error)
    assert "resolve/parse" not in said
    assert " { " not in said, "no dump of a parser"
    assert "Related failures" not in said
    assert error.place.line is not None or not error.message.startswith("syntax error: ")
