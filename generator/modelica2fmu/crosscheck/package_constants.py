"""Constants that packages inherit with other values, which rumoca 0.10 does not keep apart.

It knows one value of a constant: where packages that a model uses give it several, as ``extends Medium(density = 800)``
does, what is computed from it, arrays and Booleans have that of another package. In loops and if-equations it takes the
value of the declaration. A package that a modifier redeclares has its own values where the model names them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import ClassInstance, Component, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import PREDEFINED, ClassDefinition, Extent
from modelica2fmu.crosscheck.class_tokens import Token, UnreadableError
from modelica2fmu.crosscheck.own_classes import model_class
from modelica2fmu.library.class_text import COMMENTS_AND_STRINGS

_REMEDY: Final = (
    "declare the constant in each package, in place of extends with a modifier, or make it a parameter of the classes"
    " that use it"
)
_ALIAS: Final = re.compile(r"\bpackage\s+\w+\s*=\s*[\w.\s]+\(")
_EXTENDS: Final = re.compile(r"\bextends\s+[\w.\s]+\(")
_DEEPEST: Final = 40  # how many constants may be computed one from another
_CALLED: Final = frozenset({"function", "record", "operator", "type"})


@dataclass(frozen=True)
class _Name:
    """A name in a text.

    Attributes:
        parts: between its dots.
        is_shared: = true, if the front end takes one value there for all packages: in heads of loops and of ifs, and in
            records, whose constructors are the same for all.
        decides: = true, if it stands in such a head of equations.
    """

    parts: tuple[str, ...]
    extent: Extent
    is_shared: bool
    decides: bool


@dataclass(frozen=True)
class _Use:
    """A constant where it is named.

    Attributes:
        values: where the values are written from which it is computed, its own one included.
        is_modified: = true, if a modifier gives one of them.
        is_handed_over: = true, if it is named through a package that a modifier redeclares.
        is_number: = true, if it is bound to a number as such.
    """

    name: _Name
    values: frozenset[Extent]
    is_modified: bool
    is_handed_over: bool
    is_number: bool


def mixed_constants(
    model: str, library: ClassLibrary, place_of: Callable[[Extent], Place]
) -> UnsupportedModelError | None:
    """The refusal of a model that uses constants of packages whose values the front end mixes up.

    Args:
        model: full name.
        library: the sources.
        place_of: the place of a range of a file.
    """
    wrong = _mixed_up(model, library)
    if wrong is None:
        return None
    return UnsupportedModelError(
        f"packages inherit {'.'.join(wrong.name.parts)}, or what it is computed from, with other values, and the front"
        " end does not keep them apart",
        place=replace(place_of(wrong.name.extent), component=model),
        remedy=_REMEDY,
    )


def has_mixed_constants(model: str, library: ClassLibrary) -> bool:
    """= true, if there is such a refusal; arguments as of ``mixed_constants``."""
    return _mixed_up(model, library) is not None


def _mixed_up(model: str, library: ClassLibrary) -> _Use | None:
    root = model_class(model, library)
    if root is None or not any(map(_can_modify_constants, library.texts())):
        return None
    uses = _Uses(library)
    uses.walk(root, is_handed_over=False)
    return next((wrong for each in uses.found.values() if (wrong := _wrong_use(each)) is not None), None)


def _can_modify_constants(text: bytes) -> bool:
    """= false, if no package of a file extends another one with modifiers; quick, as nearly all are such."""
    if b"package" not in text:
        return False
    code = COMMENTS_AND_STRINGS.sub(" ", text.decode("latin-1"))
    return _ALIAS.search(code) is not None or ("package" in code and _EXTENDS.search(code) is not None)


def _wrong_use(uses: Sequence[_Use]) -> _Use | None:
    others = [each for each in uses if not each.is_handed_over]
    if len({each.values for each in uses}) > 1:
        # a number in an expression is held against its source by the check of expressions
        return next((each for each in others if each.name.is_shared or not each.is_number), None)
    return next((each for each in others if each.is_modified and each.name.decides), None)


class _Uses:
    """All constants of packages that a model and its components name.

    Attributes:
        found: by where they are declared.
    """

    def __init__(self, library: ClassLibrary) -> None:
        self.found: dict[Extent, list[_Use]] = {}
        self._library = library
        self._names: dict[Extent, list[_Name]] = {}
        self._seen: set[tuple[Extent, int]] = set()
        self._kept: list[ClassInstance] = []  # as their numbers are in use
        self._computing: list[Extent] = []

    def walk(self, instance: ClassInstance, is_handed_over: bool) -> None:
        """What a class, its components and the functions that it calls name; what is not found is passed over.

        Args:
            is_handed_over: = true, if it is a class of a package that a modifier redeclares.
        """
        waiting = [(instance, is_handed_over)]
        while waiting:
            each, handed_over = waiting.pop()
            if not self._is_new(each):
                continue
            try:
                for part in each.chain():
                    waiting += self._own_names(part, handed_over)
                    waiting += self._components(part, each, handed_over)
            except (UnknownError, UnreadableError, RecursionError):
                continue

    def _is_new(self, instance: ClassInstance) -> bool:
        key = (instance.definition.extent, id(instance.parent))
        if instance.has_redeclarations:
            return True
        if key in self._seen:
            return False
        self._seen.add(key)
        self._kept.append(instance)
        return True

    def _components(
        self, part: ClassInstance, whole: ClassInstance, handed_over: bool
    ) -> Iterator[tuple[ClassInstance, bool]]:
        for name, declared in part.definition.components.items():
            component = whole.component(name)
            if component is not None and component.type.definition.name not in PREDEFINED:
                yield component.type, handed_over or self._is_redeclared(part, declared.type_name[:-1])

    def _own_names(self, part: ClassInstance, handed_over: bool) -> Iterator[tuple[ClassInstance, bool]]:
        for name in self._names_of(part.definition):
            try:
                found = self._constant(part, name.parts)
                if found is not None:
                    # in loops and if-equations classes of a redeclared package have its values, elsewhere just
                    # direct names
                    direct = self._is_redeclared(part, name.parts[:-1])
                    self._note(found, name, direct or (handed_over and name.decides))
                    continue
                called = part.lookup(name.parts)
            except (UnknownError, UnreadableError, RecursionError):
                continue
            if called.definition.kind in _CALLED and called.definition is not part.definition:
                yield called, handed_over or self._is_redeclared(part, name.parts[:-1])

    def _note(self, constant: Component, name: _Name, is_handed_over: bool) -> _Use | None:
        """Keeps where a constant is named, and with it all constants from which it is computed."""
        if constant.binding is None or len(self._computing) > _DEEPEST:
            return None
        declared = constant.declarations[0]
        if declared in self._computing:
            return None
        self._computing.append(declared)
        values = {constant.binding.extent}
        is_modified = constant.binding.modifier is not None
        for each in self._names_in(constant.binding.extent):
            try:
                found = self._constant(constant.binding.scope, each.parts)
            except (UnknownError, UnreadableError, RecursionError):
                continue
            use = found and self._note(
                found, replace(each, is_shared=name.is_shared, decides=name.decides), is_handed_over
            )
            if use:
                values |= use.values
                is_modified |= use.is_modified
        self._computing.pop()
        is_number = all(
            token.kind == "number" or token.text == "-" for token in self._library.tokens(constant.binding.extent)
        )
        noted = _Use(name, frozenset(values), is_modified, is_handed_over, is_number)
        self.found.setdefault(declared, []).append(noted)
        return noted

    def _constant(self, scope: ClassInstance, name: tuple[str, ...]) -> Component | None:
        """The constant of a package that a name means; ``None`` if it means something else; raises UnknownError."""
        for each in scope.scopes():
            found = each.component(name[0])
            if found is not None:
                return found if len(name) == 1 and each.definition.kind == "package" else None
            if each.class_element(name[0]) is not None:
                break
        if len(name) == 1:
            return None
        holder = scope.lookup(name[:-1])
        return holder.component(name[-1]) if holder.definition.kind == "package" else None

    @staticmethod
    def _is_redeclared(scope: ClassInstance, name: tuple[str, ...]) -> bool:
        """= true, if a modifier redeclares one of the classes of a name with dots; none of those of full names."""
        if name[:1] == ("",):
            return False
        try:
            return any(scope.lookup(name[:length]).redeclaration is not None for length in range(1, len(name) + 1))
        except (UnknownError, UnreadableError, RecursionError):
            return False

    # --- text ---

    def _names_of(self, definition: ClassDefinition) -> Iterator[_Name]:
        declared = [component.extent for component in definition.components.values()]
        declared += [each.sizes_of_type for each in definition.components.values() if each.sizes_of_type is not None]
        declared += [base.extent for base in definition.bases]
        # what is decided in declarations and functions has the values of expressions
        evaluated = (*declared, *(definition.behaviour if definition.kind in _CALLED else ()))
        is_record = definition.kind == "record"
        for extent in evaluated:
            for each in self._names_in(extent):
                yield replace(each, is_shared=each.is_shared or is_record, decides=False)
        for section in definition.behaviour if definition.kind not in _CALLED else ():
            yield from self._names_in(section)

    def _names_in(self, extent: Extent) -> list[_Name]:
        if extent not in self._names:
            self._names[extent] = list(_names(extent, self._library.tokens(extent)))
        return self._names[extent]


def _names(extent: Extent, tokens: Sequence[Token]) -> Iterator[_Name]:
    """The names in a text, but for those of arguments and of what comes after a subscript."""
    heads = _heads(tokens)
    number = 0
    while number < len(tokens):
        first = number
        number += 1
        if tokens[first].kind != "name" or (first and tokens[first - 1].text == "."):
            continue
        while number + 1 < len(tokens) and tokens[number].text == "." and tokens[number + 1].kind == "name":
            number += 2
        is_argument = number < len(tokens) and tokens[number].text == "=" and first > 0
        if is_argument and tokens[first - 1].text in ("(", ",", "each", "final"):
            continue
        place = Extent(extent.file, extent.start + tokens[first].start, extent.start + tokens[number - 1].end)
        yield _Name(tuple(token.text for token in tokens[first:number:2]), place, first in heads, first in heads)


def _heads(tokens: Sequence[Token]) -> set[int]:
    """Numbers of the tokens in the heads of loops and of what begins with if."""
    heads: set[int] = set()
    for number, token in enumerate(tokens):
        if token.kind != "name" or token.text not in ("if", "elseif", "for", "while"):
            continue
        ends = "then" if "if" in token.text else "loop"
        end = next((at for at in range(number, len(tokens)) if tokens[at].text in (ends, ";")), len(tokens))
        if end < len(tokens) and tokens[end].text == ends:
            heads.update(range(number, end))
    return heads
