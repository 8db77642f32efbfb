"""References that the front end evaluates though they stand for parameters that can be set.

With ``B b(k=k)`` in a class A, rumoca binds ``a.b.k`` of ``A a(k=5)`` to 5 and not to ``a.k``; with ``Outer
outer(inner=inner)`` and ``Inner inner(x=x)``, records, it binds ``outer.inner.x`` to the value that ``x`` has at
translation. Who sets ``a.k`` or ``x`` on the FMU would then set one of two. The sources tell: both bindings have one
place there, or a name stands where the number was read.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Final

from modelica2fmu.frontend import ir
from modelica2fmu.library.source_map import SourceMap, Span

_PREDEFINED: Final = ("Real", "Integer", "Boolean", "String")
_NAME: Final = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*")
_PART: Final = re.compile(r"(\w+)(?:\[([\d,]+)\])?")
_SKIPPED: Final = re.compile(r'"(?:[^"\\]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
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
    for span, names in of_span.items():
        if len(names) == 1:
            continue
        names.sort(key=lambda name: name.count("."))
        pairs = {name: owner for name in names if (owner := _owner(name, names)) is not None}
        if pairs and _modifies_a_component(source_map, span):
            found.update((name, owner) for name, owner in pairs.items() if _are_alike(variables, name, owner))
    return found


def _owner(name: str, names: list[str]) -> str | None:
    """The outermost of the names that belongs to a component which the name lies deeper in."""
    for other in names:
        scope = other.rpartition(".")[0]
        if scope and other.count(".") < name.count(".") and name.startswith(f"{scope}."):
            return other
    return None


def _are_alike(variables: Mapping[str, ir.Variable], name: str, owner: str) -> bool:
    return variables[name].shape == variables[owner].shape and variables[name].type == variables[owner].type


def _modifies_a_component(source_map: SourceMap, span: Span) -> bool:
    """Whether a value stands in a modifier of a component: not in a declaration of its own, a base or a short class."""
    text = source_map.before(span)
    statement = _SKIPPED.sub(" ", text).rpartition(";")[2]
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
