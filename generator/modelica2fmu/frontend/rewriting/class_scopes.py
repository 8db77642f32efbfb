"""The classes of Modelica texts by their ranges: what is declared around a place, and which of them a model uses."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final

from modelica2fmu.library.brackets import end_of_bracket, parts_between_commas

_BOUND: Final = re.compile(
    r"\b(?:model|block|class|package|record|connector|function|operator)\s+(?:extends\s+)?(?P<begin>\w+)\b(?!\s*[=(])"
    r"|\bend\s+(?!(?:if|for|when|while)\b)(?P<end>\w+)\s*;"
)
_EXTENDS: Final = re.compile(r"\bextends\s+\.?((?:\w+\s*\.\s*)*)(\w+)")
_BRACKET: Final = re.compile(r"\s*\(")
_MODIFIER: Final = re.compile(r"\s*(?:final\s+)?(\w+)\s*=(?!=)(.*)", re.DOTALL)
_WORD: Final = re.compile(r"\b[^\W\d]\w*")


@dataclass
class ClassScope:
    """A class of a text.

    Attributes:
        name: without that of the class around it.
        code: what it says itself: without the classes in it.
        around: the class that it lies in.
    """

    name: str
    start: int
    end: int
    code: str
    around: ClassScope | None

    def and_around(self) -> Iterator[ClassScope]:
        """It, and the classes around it, from the inside."""
        scope: ClassScope | None = self
        while scope is not None:
            yield scope
            scope = scope.around


def class_scopes(code: str) -> list[ClassScope]:
    """The classes of a text.

    Args:
        code: without what comments and Strings say.
    """
    scopes: list[ClassScope] = []
    open_scopes: list[ClassScope] = []
    said = 0
    for bound in _BOUND.finditer(code):
        if bound["begin"]:
            if open_scopes:
                open_scopes[-1].code += code[said : bound.start()]
            scope = ClassScope(bound["begin"], bound.start(), len(code), "", open_scopes[-1] if open_scopes else None)
            scopes.append(scope)
            open_scopes.append(scope)
            said = bound.end()
        elif open_scopes and open_scopes[-1].name == bound["end"]:
            scope = open_scopes.pop()
            scope.code += code[said : bound.start()]
            scope.end = said = bound.end()
    return scopes


def scope_at(scopes: Iterable[ClassScope], position: int) -> ClassScope | None:
    """The innermost class around a place."""
    around = [scope for scope in scopes if scope.start <= position < scope.end]
    return max(around, key=lambda scope: scope.start, default=None)


def used_classes(model: str, scopes: Iterable[ClassScope]) -> list[ClassScope]:
    """The classes that a model may use, by their names alone: more than it uses, but none less.

    Args:
        model: full name.
        scopes: of all texts that it may come from.
    """
    known: dict[str, list[ClassScope]] = {}
    for scope in scopes:
        known.setdefault(scope.name, []).append(scope)
    names, waiting = set[str](), set(model.split("."))
    while waiting:
        name = waiting.pop()
        names.add(name)
        words = {word for scope in known.get(name, ()) for word in _WORD.findall(scope.code)}
        waiting |= (words & known.keys()) - names
    return [scope for name in names for scope in known.get(name, ())]


def own_classes(model: str, used: Iterable[ClassScope]) -> list[str]:
    """Names of the model and of the bases whose members are its own, each before its bases.

    They are the classes that are extended, and nothing else.
    """
    used = list(used)
    own = [model.rpartition(".")[2]]
    for name in own:
        bases = [found[2] for scope in used if scope.name == name for found in _EXTENDS.finditer(scope.code)]
        own += [base for base in dict.fromkeys(bases) if base not in own and _is_only_extended(base, used)]
    return own


def extends_modifiers(scope: ClassScope) -> dict[str, str]:
    """What a class makes of its bases' members: ``{"n": "2*k"}`` of ``extends Base(n=2*k)``."""
    modifiers: dict[str, str] = {}
    for found in _EXTENDS.finditer(scope.code):
        bracket = _BRACKET.match(scope.code, found.end())
        if bracket is None:
            continue
        end = end_of_bracket(scope.code, bracket.end() - 1) - 1
        for part in parts_between_commas(scope.code, bracket.end(), end):
            if modifier := _MODIFIER.fullmatch(scope.code, *part):
                modifiers.setdefault(modifier[1], modifier[2].strip())
    return modifiers


def _is_only_extended(name: str, used: Iterable[ClassScope]) -> bool:
    others = (_EXTENDS.sub(lambda found: "" if found[2] == name else found[0], scope.code) for scope in used)
    return not any(re.search(rf"\b{name}\b", code) for code in others)
