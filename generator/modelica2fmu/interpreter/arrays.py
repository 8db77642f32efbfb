"""Array values of the interpreter: numpy arrays of objects whose elements are scalars, and Modelica's operations.

A value is a scalar (number, Boolean, string, :class:`Text` or expression node), an object array of scalars, a
:class:`Record`, or a tuple of values (the outputs of a function).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Text:
    """A string with numbers in it that are only known at run time, in order."""

    parts: tuple[str | Node, ...]


@dataclass
class Record:
    """A record value: its fields by name, in the order of the type."""

    fields: dict[str, Any]


Scalar = float | int | bool | str | Text | Node
Value = Scalar | Array | Record | tuple[Any, ...]


class ShapeError(Exception):
    """Operands do not fit together; the interpreter adds the place."""


def stack(values: Sequence[Value]) -> Array:
    """``{values...}``: one more dimension in front."""
    first = np.shape(values[0]) if values and isinstance(values[0], np.ndarray) else ()
    result: Array = np.empty((len(values), *first), dtype=object)
    for position, value in enumerate(values):
        shape = value.shape if isinstance(value, np.ndarray) else ()
        if shape != first:
            raise ShapeError(f"array elements of shapes {list(first)} and {list(shape)}")
        result[position] = value
    return result


def filled(shape: Sequence[int], value: Scalar) -> Array:
    """An array of equal elements."""
    result: Array = np.empty(tuple(shape), dtype=object)
    result.fill(value)
    return result


def from_function(shape: Sequence[int], function: Callable[..., Scalar]) -> Array:
    """An array whose elements are ``function(i, j, ...)`` with 0-based indices."""
    result: Array = np.empty(tuple(shape), dtype=object)
    for index in np.ndindex(*shape):
        result[index] = function(*index)
    return result


def scalars(value: Value) -> list[Scalar]:
    """The elements of a value, row-major; fields of a record in order."""
    if isinstance(value, np.ndarray):
        return list(value.flat)
    if isinstance(value, Record):
        return [scalar for item in value.fields.values() for scalar in scalars(item)]
    if isinstance(value, tuple):
        return [scalar for item in value for scalar in scalars(item)]
    return [value]


def elementwise(function: Callable[..., Scalar], *values: Value) -> Value:
    """Applies a scalar function to scalars and arrays of equal shape (scalars are repeated)."""
    shapes = {value.shape for value in values if isinstance(value, np.ndarray)}
    if not shapes:
        return function(*values)
    if len(shapes) > 1:
        raise ShapeError("operands of shapes " + " and ".join(str(list(shape)) for shape in sorted(shapes)))
    (shape,) = shapes
    flat = [list(value.flat) if isinstance(value, np.ndarray) else None for value in values]
    result: Array = np.empty(shape, dtype=object)
    target = result.reshape(-1)
    for position in range(target.shape[0]):
        target[position] = function(
            *(items[position] if items is not None else value for items, value in zip(flat, values, strict=True))
        )
    return result


def _sum(items: Iterable[float | Node]) -> float | Node:
    total: float | Node = 0
    for item in items:
        total = ex.add(total, item)
    return total


def multiply(a: Value, b: Value) -> Value:
    """Modelica's ``*``: scalar, scalar product, matrix and vector products."""
    if not isinstance(a, np.ndarray) or not isinstance(b, np.ndarray):
        return elementwise(ex.multiply, a, b)
    left = a if a.ndim == 2 else a.reshape(1, -1)
    right = b if b.ndim == 2 else b.reshape(-1, 1)
    if a.ndim > 2 or b.ndim > 2 or left.shape[1] != right.shape[0]:
        raise ShapeError(f"a product of shapes {list(a.shape)} and {list(b.shape)}")
    rows, inner, columns = left.shape[0], left.shape[1], right.shape[1]
    product = from_function(
        (rows, columns),
        lambda i, j: _sum(ex.multiply(left[i, k], right[k, j]) for k in range(inner)),
    )
    if a.ndim == 1 and b.ndim == 1:
        scalar: Scalar = product[0, 0]
        return scalar
    if a.ndim == 1:
        return product[0, :]
    if b.ndim == 1:
        return product[:, 0]
    return product


def matrix_power(a: Array, exponent: int) -> Array:
    """A square matrix to a whole power >= 0."""
    result: Value = identity(a.shape[0])
    for _ in range(exponent):
        result = multiply(result, a)
    assert isinstance(result, np.ndarray)
    return result


def identity(size: int) -> Array:
    """The identity matrix."""
    return from_function((size, size), lambda i, j: 1 if i == j else 0)


def diagonal(vector: Array) -> Array:
    """The diagonal matrix of a vector."""
    items: list[Any] = list(vector)
    return from_function((len(items), len(items)), lambda i, j: items[i] if i == j else 0)


def cross(a: Array, b: Array) -> Array:
    """The cross product of two vectors of three."""
    if a.shape != (3,) or b.shape != (3,):
        raise ShapeError(f"cross() of shapes {list(a.shape)} and {list(b.shape)}")

    def component(i: int) -> Scalar:
        j, k = (i + 1) % 3, (i + 2) % 3
        return ex.subtract(ex.multiply(a[j], b[k]), ex.multiply(a[k], b[j]))

    return from_function((3,), component)


def skew(a: Array) -> Array:
    """The matrix with ``skew(a) * b = cross(a, b)``."""
    rows = ((0, ex.negate(a[2]), a[1]), (a[2], 0, ex.negate(a[0])), (ex.negate(a[1]), a[0], 0))
    return from_function((3, 3), lambda i, j: rows[i][j])


def outer_product(a: Array, b: Array) -> Array:
    """The outer product of two vectors."""
    rows: list[Any] = list(a)
    columns: list[Any] = list(b)
    return from_function((len(rows), len(columns)), lambda i, j: ex.multiply(rows[i], columns[j]))


def symmetric(a: Array) -> Array:
    """The upper triangle mirrored into the lower."""
    result = a.copy()
    for i, j in np.ndindex(*a.shape):
        if i > j:
            result[i, j] = a[j, i]
    return result


def concatenate(dimension: int, values: Sequence[Array]) -> Array:
    """``cat(dimension, ...)``, 1-based."""
    try:
        return np.concatenate(values, axis=dimension - 1)
    except ValueError as error:
        raise ShapeError(str(error)) from error


def promoted(value: Value, dimensions: int) -> Array:
    """The value with dimensions of size one behind, as ``[...]`` needs it."""
    array = value if isinstance(value, np.ndarray) else stack([value])[0:1].reshape(())
    shape = array.shape + (1,) * (dimensions - array.ndim)
    return array.reshape(shape)


def total(value: Value) -> Scalar:
    """``sum(value)``."""
    return _sum(_numbers(value))


def product(value: Value) -> Scalar:
    """``product(value)``."""
    result: float | Node = 1
    for item in _numbers(value):
        result = ex.multiply(result, item)
    return result


def _numbers(value: Value) -> list[float | Node]:
    return [item for item in scalars(value) if not isinstance(item, str | Text)]
