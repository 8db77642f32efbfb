"""Random mistakes in examples of the library are told in plain words at a line of the user's file, or taken."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from contact_data import core_subset, modelica_library
from contact_foundation.errors import CmbError
from modelica2fmu.library.class_text import without_comments_and_strings
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.translation import translate

EXAMPLES = ("BallOnFloor", "BallAgainstThinWall", "HeavyOnLight", "NewtonCradle", "SlidingBlock", "TumblingShapes")
DRAWS = 60
RELATIVE = re.compile(r"(?<![\w.])(Parts|Shapes|Materials|Types|ContactManager|Friction|NormalForce)\b(?=[.\s(])")
NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*(?=[\s,;(){}\[\]=*/+-])")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d*)?(?:[eE][+-]?\d+)?")
KEYWORDS = re.findall(
    r"\w+", "model end extends inner parameter final each equation connect for in loop annotation Real Integer"
)
# Words of the front end about itself.
INTERNAL = re.compile(r"failed in|Flat|canonical|DefId|DAE|shape proof")


def example(name: str) -> str:
    text = (modelica_library() / "Examples" / f"{name}.mo").read_text()
    text = re.sub(r"^within [^;]*;\n", "", text)
    text = re.sub(r"\n  annotation \(\n    experiment.*(?=\nend )", "", text, flags=re.DOTALL)
    return RELATIVE.sub(r"ContactMultiBody.\1", text)


def mutated(text: str, draw: random.Random) -> str:
    code = without_comments_and_strings(text)
    names = [found for found in NAME.finditer(code) if found[0] not in KEYWORDS]
    numbers = list(NUMBER.finditer(code))

    def misspelt(word: str) -> str:
        place = draw.randrange(len(word))
        return word[:place] + draw.choice("aexz_") + word[place + 1 :]

    changes: list[tuple[list[re.Match[str]], Callable[[str], str]]] = [
        (names, misspelt),
        (names, lambda _word: draw.choice(names)[0]),
        (names, lambda word: word.rpartition(".")[2] + "q"),
        (numbers, lambda word: draw.choice([f"-{word}", "1/0", "{1,2}", "true", '"a"', "time", f"2*{word}"])),
        (numbers, lambda word: draw.choice(["{%s}", "sqrt(-%s)", "noFunction(%s)", "%s*unknown"]) % word),
    ]
    found, change = draw.choice(changes)
    chosen = draw.choice(found)
    return text[: chosen.start()] + change(chosen[0]) + text[chosen.end() :]


def refused(name: str, file: Path) -> CmbError | None:
    try:
        translate(name, [file, modelica_library()], StandardLibrary(core_subset(), "", "core subset"))
    except CmbError as error:
        return error
    return None


@pytest.mark.full
@pytest.mark.parametrize("seed", range(DRAWS))
def test_a_mistake_is_told_at_a_line_of_the_file(tmp_path: Path, seed: int) -> None:
    draw = random.Random(seed)
    name = draw.choice(EXAMPLES)
    file = tmp_path / f"{name}.mo"
    file.write_text(mutated(example(name), draw))
    error = refused(name, file)
    if error is not None:
        assert error.place is not None
        assert error.place.line is not None
        assert error.place.file == file
        assert not INTERNAL.search(error.message)
