"""Small questions about scalar values and names, asked while a model is expanded."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from modelica2fmu.expand.scalar_model import Kind, ScalarModel
from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Text, Value
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

BASE_TYPES: Final = frozenset({"Real", "Integer", "Boolean", "String"})
KNOWN_KINDS: Final = frozenset({Kind.CONSTANT, Kind.PARAMETER})


def element_names(name: str, shape: tuple[int, ...]) -> list[str]:
    """Names of the elements of a variable, row-major."""
    if not shape:
        return [name]
    return [f"{name}[{','.join(str(number + 1) for number in index)}]" for index in np.ndindex(*shape)]


def only_parameters(model: ScalarModel, node: Node) -> bool:
    """True for an expression that is known before the equations are solved."""
    return all(
        (variable := model.variables.get(name)) is not None and variable.kind in KNOWN_KINDS
        for name in ex.symbols(node)
    )


def is_fixed_while_simulating(model: ScalarModel, node: Node) -> bool:
    """True for an expression of parameters, also of those that the initialization finds."""
    return all(
        (variable := model.variables.get(name)) is not None and variable.kind in (*KNOWN_KINDS, Kind.FREE_PARAMETER)
        for name in ex.symbols(node)
    )


def as_number(value: Any) -> float | Node:
    """A number or node; raises ShapeError for anything else, but for arrays of one element."""
    if isinstance(value, float | int | Node):
        return value
    if isinstance(value, np.ndarray) and value.size == 1:
        return as_number(value.reshape(-1)[0])
    raise arrays.ShapeError(f"a scalar number is needed here, not {type(value).__name__}")


def as_float(value: Value) -> float:
    """A number that is known."""
    number = as_number(value)
    assert not isinstance(number, Node)
    return number


def text_of(value: Value) -> Text:
    """A String with its parts."""
    if isinstance(value, Text):
        return value
    return Text((str(value),))
