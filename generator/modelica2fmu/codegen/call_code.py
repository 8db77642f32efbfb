"""C statements that call external functions."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Final

from modelica2fmu.codegen.c_expressions import c_text
from modelica2fmu.codegen.rolled_code import rolled
from modelica2fmu.codegen.statements import Statement, Write
from modelica2fmu.expand.scalar_model import CallArgument, ExternalCall
from modelica2fmu.symbolic.expression import Node

_LONGEST_INITIALIZER: Final = 64
_STORED: Final = re.compile(r"(r|output)\[(\d+)\] = value;")


def call_statement(call: ExternalCall, store: Callable[[str, str], str]) -> Statement:
    """The statement that makes a call and stores its outputs.

    Args:
        call: the call.
        store: C statement that stores a C expression in a symbol.
    """
    roots = tuple(
        value for argument in call.args if not argument.is_output for value in argument.values
        if not isinstance(value, str)
    )  # fmt: skip

    def lines(write: Write) -> list[str]:
        result = ["{"]
        passed = []
        copies: list[str] = []
        if not call.has_prototype:
            result.append(f"  {_prototype(call)}")
        for position, argument in enumerate(call.args):
            passed.append(_argument(f"a{position}", argument, write, store, result, copies))
        text = f"{call.symbol}({', '.join(passed)})"
        if call.result is not None:
            text = f"const {_c_type(call.result[1])} result = {text}"
            copies.append(store(call.result[0], "result"))
        result.append(f"  {text};")
        result.extend(f"  {copy}" for copy in rolled(copies))
        result.append("}")
        return result

    return Statement(roots, lines)


def _argument(
    name: str,
    argument: CallArgument,
    write: Write,
    store: Callable[[str, str], str],
    declarations: list[str],
    copies: list[str],
) -> str:
    """C text of an argument; arrays are declared before the call, outputs copied after it."""
    if argument.type == "Instance":
        return "v"
    c_type = _c_type(argument.type)
    if argument.is_output:
        count = max(len(argument.values), 1)
        place = _consecutive_places(argument, store)
        if place is not None:
            declarations.append(f"  memset({place}, 0, {count} * sizeof(double));")
            return place
        declarations.append(f"  {c_type} {name}[{count}] = {{0}};")
        for k, value in enumerate(argument.values):
            assert isinstance(value, Node)
            copies.append(store(value.name, f"{name}[{k}]"))
        return name
    texts = [_value(argument.type, value, write) for value in argument.values]
    if not argument.is_array:
        return f"({c_type}){texts[0]}" if argument.type != "String" else texts[0]
    if argument.is_constant:
        declarations.append(f"  static const {c_type} {name}[{len(texts)}] = {{{', '.join(texts)}}};")
        return name
    if len(texts) > _LONGEST_INITIALIZER and argument.type != "String":
        declarations.append(f"  {c_type} {name}[{len(texts)}];")
        declarations.extend(f"  {line}" for line in rolled([f"{name}[{k}] = {text};" for k, text in enumerate(texts)]))
        return name
    initial = ", ".join(texts) if texts else "0"
    declarations.append(f"  {c_type} {name}[{max(len(texts), 1)}] = {{{initial}}};")
    return name


def _consecutive_places(argument: CallArgument, store: Callable[[str, str], str]) -> str | None:
    """C text of the first place where an output is stored, if all others follow it: it need not be copied then."""
    if argument.type != "Real" or not argument.values:
        return None
    first: tuple[str, int] | None = None
    for position, value in enumerate(argument.values):
        assert isinstance(value, Node)
        match = _STORED.fullmatch(store(value.name, "value"))
        if match is None:
            return None
        array, index = match[1], int(match[2])
        first = first or (array, index)
        if (array, index - position) != first:
            return None
    assert first is not None
    return f"{first[0]} + {first[1]}"


def _value(type_name: str, value: float | str | Node, write: Write) -> str:
    if isinstance(value, str):
        return c_text(value)
    text = write(value)
    if type_name in ("Integer", "Boolean", "size"):
        return str(int(value)) if not isinstance(value, Node) else f"(int)({text})"
    return text


def _prototype(call: ExternalCall) -> str:
    types = []
    for argument in call.args:
        c_type = _c_type(argument.type)
        pointer = "*" if argument.is_array or argument.is_output else ""
        constant = "const " if pointer and not argument.is_output and argument.type != "String" else ""
        types.append(f"{constant}{c_type} {pointer}".strip())
    returned = _c_type(call.result[1]) if call.result is not None else "void"
    return f"extern {returned} {call.symbol}({', '.join(types) or 'void'});"


def _c_type(type_name: str) -> str:
    return {"Real": "double", "String": "const char *", "size": "size_t"}.get(type_name, "int")
