"""Built-in functions and operators on values that may be symbolic."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Final

import numpy as np

from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Scalar, ShapeError, Text, Value
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


def relation(op: str, a: float | Node, b: float | Node) -> bool | Node:
    """The relation ``a op b`` as it is; ``op`` is one of lt, le, gt, ge, eq, ne."""
    if op == "lt":
        return ex.less(a, b)
    if op == "le":
        return ex.less_equal(a, b)
    if op == "gt":
        return ex.less(b, a)
    if op == "ge":
        return ex.less_equal(b, a)
    return ex.equal(a, b) if op == "eq" else ex.not_equal(a, b)


def scalar_number(value: Value) -> float | Node:
    """A number or node; raises ShapeError for anything else, but for arrays of one element."""
    if isinstance(value, float | int | Node):
        return value
    if isinstance(value, np.ndarray) and value.size == 1:
        return scalar_number(value.reshape(-1)[0])
    raise ShapeError("a scalar number is needed here")


def whole_value(value: float | Node) -> float | Node:
    """A whole number as one of Python, nodes as they are."""
    return value if isinstance(value, Node) else int(value)


def concatenated(left: Value, right: Value) -> Value:
    """Two Strings, or what can be written as one, after each other."""
    parts: list[str | Node] = []
    for value in (left, right):
        if isinstance(value, Text):
            parts.extend(value.parts)
        elif isinstance(value, str | Node):
            parts.append(value)
        else:
            parts.append(str(value))
    if all(isinstance(part, str) for part in parts):
        return "".join(part for part in parts if isinstance(part, str))
    return Text(tuple(parts))


def dynamic_element(value: arrays.Array, index: Node, dimension: int) -> Value:
    """An element whose index changes at run time; no number where the index is out of bounds."""
    size = value.shape[dimension]
    if size == 0:
        raise ShapeError("an element of an empty array")
    result: Value = arrays.elementwise(lambda _: math.nan, np.take(value, 0, axis=dimension))
    for number in range(size, 0, -1):
        item = np.take(value, number - 1, axis=dimension)
        result = arrays.elementwise(partial(ex.select, ex.equal(index, number)), item, result)
    return result


def with_elements(array: arrays.Array, index: Sequence[Any], value: Value) -> arrays.Array:
    """The array with other elements; no numbers where an index that changes at run time is out of bounds.

    Args:
        array: which stays as it is.
        index: of each dimension that has one a number from 0, several, a slice, or what changes, counted from 1.
        value: of the elements.
    """
    changing = next((position for position, item in enumerate(index) if isinstance(item, Node)), None)
    if changing is None:
        result = array.copy()
        result[tuple(index)] = value
        return result
    item = index[changing]
    chosen: arrays.Array = np.full(array.shape, math.nan, dtype=object)
    for number in range(array.shape[changing], 0, -1):
        written = with_elements(array, [*index[:changing], number - 1, *index[changing + 1 :]], value)
        chosen = array_value(arrays.elementwise(partial(ex.select, ex.equal(item, number)), written, chosen))
    return chosen


def selected_shape(array: arrays.Array, index: Sequence[Any]) -> tuple[int, ...]:
    """The sizes of what :func:`with_elements` replaces."""
    selected = array[tuple(0 if isinstance(item, Node) else item for item in index)]
    return selected.shape if isinstance(selected, np.ndarray) else ()


RELATIONS: Final = {"Lt": "lt", "Le": "le", "Gt": "gt", "Ge": "ge", "Eq": "eq", "Neq": "ne", "Ne": "ne"}
STEPPING: Final = frozenset({"floor", "ceil", "integer", "div", "mod", "rem"})
ELEMENTWISE: Final[dict[str, Callable[..., Scalar]]] = {
    "Add": ex.add, "Sub": ex.subtract, "Div": ex.divide, "AddElem": ex.add, "SubElem": ex.subtract,
    "MulElem": ex.multiply, "DivElem": ex.divide, "ExpElem": ex.power, "And": ex.logical_and, "Or": ex.logical_or,
}  # fmt: skip


def array_value(value: Value) -> arrays.Array:
    """An array; raises ShapeError for anything else."""
    if isinstance(value, np.ndarray):
        return value
    raise ShapeError("an array is needed here")


VALUE_FUNCTIONS: Final[dict[str, Callable[[list[Value]], Value]]] = {
    "sum": lambda args: arrays.total(args[0]),
    "product": lambda args: arrays.product(args[0]),
    "ndims": lambda args: args[0].ndim if isinstance(args[0], np.ndarray) else 0,
    "scalar": lambda args: scalar_number(args[0]),
    "vector": lambda args: arrays.stack(arrays.scalars(args[0])),
    "matrix": lambda args: arrays.promoted(args[0], 2),
    "diagonal": lambda args: arrays.diagonal(array_value(args[0])),
    "transpose": lambda args: array_value(args[0]).swapaxes(0, 1),
    "outerProduct": lambda args: arrays.outer_product(array_value(args[0]), array_value(args[1])),
    "symmetric": lambda args: arrays.symmetric(array_value(args[0])),
    "cross": lambda args: arrays.cross(array_value(args[0]), array_value(args[1])),
    "skew": lambda args: arrays.skew(array_value(args[0])),
}
