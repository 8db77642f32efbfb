"""Legal, unique, readable Modelica names from the names of a CAD system."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable

from contact_foundation.modelica_keywords import KEYWORDS

_BUILT_IN_TEXT = """
time Real Integer Boolean String Clock ExternalObject StateSelect AssertionLevel Connections Modelica
ContactMultiBody abs sign sqrt div mod rem ceil floor integer sin cos tan asin acos atan atan2 sinh cosh tanh
exp log log10 min max sum product size ndims fill zeros ones identity diagonal linspace transpose cross skew
outerProduct symmetric vector matrix scalar cat delay pre edge change reinit noEvent smooth sample initial
terminal terminate assert homotopy semiLinear inStream actualStream getInstanceName spatialDistribution
cardinality previous hold backSample subSample superSample shiftSample noClock interval firstTick clock
"""
_BUILT_IN = frozenset(_BUILT_IN_TEXT.split())
_SPELLED = {
    "ß": "ss",
    "æ": "ae",
    "Æ": "Ae",
    "œ": "oe",
    "Œ": "Oe",
    "ø": "oe",
    "Ø": "Oe",
    "đ": "d",
    "Đ": "D",
    "ł": "l",
    "Ł": "L",
}
MAXIMUM_LENGTH = 60


class NamePool:
    """Hands out names that are legal, not yet taken, and no keywords.

    Args:
        taken: names that are in use already.
    """

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self._taken = {name.lower() for name in taken}

    def instance(self, text: str, kind: str = "part") -> str:
        """A lowerCamelCase name for a component; ``kind`` completes what is empty, a keyword or begins with a digit."""
        words = _words(text)
        name = "".join([_lower_first(words[0]), *(_upper_first(word) for word in words[1:])]) if words else kind
        if not name[0].isalpha():
            name = kind + name
        if name in KEYWORDS or name in _BUILT_IN:
            name += _upper_first(kind)
        return self._unique(name)

    def class_name(self, text: str, fallback: str = "Assembly") -> str:
        """An UpperCamelCase name for a class."""
        words = _words(text)
        name = "".join(_upper_first(word) for word in words) if words else fallback
        return self._unique(name if name[0].isalpha() else fallback + name)

    def _unique(self, name: str) -> str:
        name = name[:MAXIMUM_LENGTH]
        candidate, number = name, 1
        # Compared without case: files of classes must differ on every file system, and readers are no better.
        while candidate.lower() in self._taken or candidate in KEYWORDS or candidate in _BUILT_IN:
            number += 1
            candidate = f"{name}{'_' if name[-1].isdigit() else ''}{number}"
        self._taken.add(candidate.lower())
        return candidate


def _words(text: str) -> list[str]:
    spelled = "".join(_SPELLED.get(character, character) for character in text)
    plain = unicodedata.normalize("NFKD", spelled).encode("ascii", "ignore").decode("ascii")
    return [word for word in re.split(r"[^A-Za-z0-9]+", plain) if word]


def _lower_first(word: str) -> str:
    return word.lower() if word.isupper() else word[0].lower() + word[1:]


def _upper_first(word: str) -> str:
    return word[0].upper() + word[1:]
