"""The order in which variables of a function get the values and sizes that they are declared with."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from modelica2fmu.frontend import ir


def declaration_order(function: ir.Function) -> tuple[ir.FunctionVariable, ...]:
    """Local variables and outputs, each behind those that its value or its size names.

    Variables that name each other are left in the order of the function (Modelica 3.6, section 12.4.4, forbids them).
    """
    waiting = {variable.name: variable for variable in (*function.locals, *function.outputs)}
    ordered: list[ir.FunctionVariable] = []

    def place(name: str) -> None:
        variable = waiting.pop(name, None)
        if variable is None:
            return
        for needed in _names((variable.shape, variable.default)):
            place(needed)
        ordered.append(variable)

    for name in tuple(waiting):
        place(name)
    return tuple(ordered)


def _names(node: Any) -> Iterator[str]:
    """The first parts of all names in an expression."""
    if isinstance(node, tuple):
        for each in node:
            yield from _names(each)
    elif is_dataclass(node):
        if isinstance(node, ir.Reference):
            yield node.parts[0][0].partition(".")[0]
        for each in fields(node):
            yield from _names(getattr(node, each.name))
