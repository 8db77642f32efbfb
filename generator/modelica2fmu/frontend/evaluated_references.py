"""References that the front end evaluates though they stand for parameters that can be set.

With ``B b(k=k)`` in a class A, rumoca binds ``a.b.k`` of ``A a(k=5)`` to 5 and not to ``a.k``; with ``Outer
outer(inner=inner)`` and ``Inner inner(x=x)``, records, it binds ``outer.inner.x`` to the value that ``x`` has at
translation. Who sets ``a.k`` or ``x`` on the FMU would then set one of two. The sources tell: both bindings have one
place there, or a name stands where the number was read.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Final

from modelica2fmu.frontend import ir
from modelica2fmu.library.source_map import SourceMap, Span

_PREDEFINED: Final = ("Real", "Integer", "Boolean", "String")
_NAME: Final = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*")
_PART: Final = re.compile(r"(\w+)(?:\[([\d,]+)\])?")
_SKIPPED: Final = re.compile(rb'"(?:[^"\\]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
_WORDS: Final = r"\s*(?:(?:public|protected|final|inner|outer|redeclare|replaceable|partial|encapsulated|pure)\s+)*"
_KINDS: Final = "model|class|block|record|type|connector|package|function|operator"
_HEAD_OF_CLASS: Final = re.compile(rf"{_WORDS}(?:{_KINDS})\s+\w+(?!\s*=)(?=\s)")
_NO_COMPONENT: Final = re.compile(rf"{_WORDS}(?:extends|{_KINDS})\b")


def with_references(flat: ir.FlatModel, source_map: SourceMap) -> ir.FlatModel:
    """The model with these references in place of their values."""
    found = {}
    owners = _owners(flat.variables, source_map)
    for name, variable in flat.variables.items():
        owner = owners.get(name) or _named(name, variable, flat, source_map)
        if owner is not None:
            span = _span(variable)
            found[name] = replace(variable, binding=ir.Reference(owner, _parts(owner), (), span))
    return replace(flat, variables={**flat.variables, **found}) if found else flat


def _span(variable: ir.Variable) -> Span | None:
    """Where the value of a parameter that can be set stands in the sources.

    Final parameters of other types than Real may be what the structure of a model goes by.
    """
    binding = variable.binding
    if variable.variability != "parameter" or (variable.evaluate and variable.type != "Real"):
        return None
    if isinstance(binding, ir.Reference) and variable.type in _PREDEFINED:  # of others it is a literal
        return None
    return getattr(binding, "span", None)


# --- one modifier, several parameters ---


def _owners(variables: Mapping[str, ir.Variable], source_map: SourceMap) -> dict[str, str]:
    """Of parameters that have their value from the modifier of another one: that one."""
    of_span: dict[Span, list[str]] = {}
    for name, variable in variables.items():
        span = _span(variable)
        if span is not None:
            of_span.setdefault(span, []).append(name)
    found: dict[str, str] = {}
    statements = _Statements(source_map)
    for span, names in of_span.items():
        if len(names) == 1:
            continue
        pairs = _pairs(names)
        if pairs and _modifies_a_component(statements.before(span)):
            found.update((name, owner) for name, owner in pairs.items() if _are_alike(variables, name, owner))
    return found


def _pairs(names: Sequence[str]) -> dict[str, str]:
    """With names, the outermost of them that belongs to a component which the name lies deeper in."""
    of_scope: dict[str, str] = {}
    for name in names:
        of_scope.setdefault(name.rpartition(".")[0], name)
    found = {}
    for name in names:
        own = name.rpartition(".")[0]
        scopes = itertools.accumulate(own.split("."), "{}.{}".format)
        outermost = next((scope for scope in scopes if scope in of_scope), own)
        if outermost != own:
            found[name] = of_scope[outermost]
    return found


def _are_alike(variables: Mapping[str, ir.Variable], name: str, owner: str) -> bool:
    return variables[name].shape == variables[owner].shape and variables[name].type == variables[owner].type


class _Statements:
    """Finds what stands before a value in its statement, without comments and strings."""

    def __init__(self, source_map: SourceMap) -> None:
        self._source_map = source_map
        self._texts: dict[int, bytes] = {}

    def before(self, span: Span) -> str:
        if span.source not in self._texts:
            text = self._source_map.source_text(span)
            self._texts[span.source] = _SKIPPED.sub(lambda match: b" " * len(match[0]), text)
        text = self._texts[span.source]
        return text[text.rfind(b";", 0, span.start) + 1 : span.start].decode(errors="replace")


def _modifies_a_component(statement: str) -> bool:
    """Whether a value stands in a modifier of a component: not in a declaration of its own, a base or a short class.

    Args:
        statement: what stands before the value.
    """
    while (head := _HEAD_OF_CLASS.match(statement)) is not None:
        statement = statement[head.end() :]
    if _NO_COMPONENT.match(statement):
        return False
    return statement.count("(") > statement.count(")")


# --- a name where a number was read ---


def _named(name: str, variable: ir.Variable, flat: ir.FlatModel, source_map: SourceMap) -> str | None:
    """The parameter whose name stands in the source where the front end read a number, in a record of a record."""
    literal = variable.binding
    span = _span(variable)
    if span is None or variable.type != "Real" or variable.shape or not _is_of_nested_record(name, flat):
        return None
    if not isinstance(literal, ir.Literal):
        return None
    text = source_map.excerpt(span)
    if not _NAME.fullmatch(text):
        return None
    for candidate in _scopes(name, text):
        other = flat.variables.get(candidate)
        if (
            candidate == name
            or other is None
            or other.type != "Real"
            or other.variability != "parameter"
            or other.shape
        ):
            continue
        value = _value(candidate, flat.variables, 0)
        if value is None or value == literal.value:
            return candidate
    return None


def _is_of_nested_record(name: str, flat: ir.FlatModel) -> bool:
    record = name.rpartition(".")[0]
    return record in flat.records and record.rpartition(".")[0] in flat.records


def _scopes(name: str, text: str) -> Iterator[str]:
    """What a name may mean in the modifier of a component, from the innermost scope outwards."""
    parts = name.split(".")
    for depth in range(len(parts) - 2, -1, -1):
        yield ".".join([*parts[:depth], text])


def _value(name: str, variables: Mapping[str, ir.Variable], depth: int) -> float | None:
    """The value of a parameter that is a number or another parameter; None if it takes computing to tell."""
    variable = variables.get(name)
    binding = None if variable is None else variable.binding
    if isinstance(binding, ir.Reference) and not binding.subscripts and depth < len(variables):
        return _value(binding.name, variables, depth + 1)
    if isinstance(binding, ir.Literal) and isinstance(binding.value, int | float):
        return float(binding.value)
    return None


def _parts(name: str) -> tuple[tuple[str, tuple[ir.Subscript, ...]], ...]:
    found = []
    for part in name.split("."):
        match = _PART.fullmatch(part)
        assert match is not None
        subscripts = match[2].split(",") if match[2] else []
        found.append((match[1], tuple(ir.Literal(int(subscript)) for subscript in subscripts)))
    return tuple(found)
