"""Calls of functions with arrays where they take scalars (Modelica 3.6, 12.4.6): one call an element."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from modelica2fmu.frontend import ir
from modelica2fmu.interpreter.arrays import ShapeError, Value


def vectorized_shape(function: ir.Function, args: Sequence[Value]) -> tuple[int, ...]:
    """How many calls a call means, by dimension; nothing where it is one.

    Raises:
        ShapeError: the arrays have different sizes.
    """
    if function.is_constructor:
        return ()
    shapes = {shape for shape in _shapes_beyond(function, args) if shape}
    if len(shapes) > 1:
        raise ShapeError(f"arguments of {function.name} with sizes {' and '.join(map(str, sorted(shapes)))}")
    return shapes.pop() if shapes else ()


def arguments_of_element(
    function: ir.Function, args: Sequence[Value], shape: tuple[int, ...], index: tuple[int, ...]
) -> list[Value]:
    """The arguments of one of the calls."""
    beyond = _shapes_beyond(function, args)
    return [_element(arg, index) if own == shape else arg for arg, own in zip(args, beyond, strict=True)]


def _element(arg: Value, index: tuple[int, ...]) -> Value:
    assert isinstance(arg, np.ndarray)
    element: Value = arg[index]
    return element


def results_as_arrays(results: Sequence[tuple[Value, ...]], shape: tuple[int, ...]) -> tuple[Value, ...]:
    """The outputs of all calls, one array an output."""
    return tuple(_as_array(values, shape) for values in zip(*results, strict=True))


def _as_array(values: Sequence[Value], shape: tuple[int, ...]) -> Value:
    first = values[0]
    inner = first.shape if isinstance(first, np.ndarray) else ()
    result = np.empty((*shape, *inner), dtype=object)
    for index, value in zip(np.ndindex(*shape), values, strict=True):
        result[index] = value
    return result


def _shapes_beyond(function: ir.Function, args: Sequence[Value]) -> Iterator[tuple[int, ...]]:
    """The dimensions that arguments have more than the inputs that they are for."""
    for variable, arg in zip(function.inputs, args, strict=False):
        excess = arg.ndim - variable.rank if isinstance(arg, np.ndarray) else 0
        yield arg.shape[:excess] if excess > 0 and isinstance(arg, np.ndarray) else ()
