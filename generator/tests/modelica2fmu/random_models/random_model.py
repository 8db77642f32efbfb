"""Random Modelica models of expressions of arrays, each with what numpy makes of it.

Modelica Language Specification 3.6, chapters 3, 10 and 12.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Shape = tuple[int, ...]
Values = dict[str, Any]
# Modelica text, and its value from those of the variables before it.
Expression = tuple[str, Callable[[Values], Any]]

FUNCTIONS = """
  function squares
    input Real v[:];
    output Real y = 0;
  algorithm
    for x in v loop
      y := y + x^2;
    end for;
  end squares;
  function polynomial
    input Real c[:];
    input Real x;
    output Real y;
  protected
    Integer n = size(c, 1);
  algorithm
    y := c[n];
    for i in n - 1:-1:1 loop
      y := y*x + c[i];
    end for;
  end polynomial;
  function cumulated
    input Real v[:];
    output Real y[size(v, 1)];
  algorithm
    y[1] := v[1];
    for i in 2:size(v, 1) loop
      y[i] := y[i - 1] + v[i];
    end for;
  end cumulated;
  function reversed
    input Real v[:];
    output Real y[size(v, 1)];
  algorithm
    y := v[end:-1:1];
  end reversed;
  function sorted
    input Real v[:];
    output Real y[size(v, 1)] = v;
  protected
    Real h;
  algorithm
    for i in 1:size(v, 1) loop
      for j in 1:size(v, 1) - i loop
        if y[j] > y[j + 1] then
          h := y[j];
          y[j] := y[j + 1];
          y[j + 1] := h;
        end if;
      end for;
    end for;
  end sorted;
"""


@dataclass(frozen=True)
class Variable:
    """A variable of the model.

    Attributes:
        kind: what stands before its type: ``constant``, ``parameter`` or nothing.
    """

    name: str
    shape: Shape
    kind: str


@dataclass
class RandomModel:
    """A model named M with an order of variables, each determined by those before it.

    Attributes:
        text: of the model.
        variables: those to be compared.
        steps: names and values of all variables in their order.
    """

    choose: random.Random
    text: str = ""
    variables: list[Variable] = field(default_factory=list)
    steps: list[tuple[str, Callable[[Values], Any]]] = field(default_factory=list)
    _iterators: list[tuple[str, int]] = field(default_factory=list)
    _known: list[Variable] = field(default_factory=list)

    def values(self, time: float) -> Values:
        """What the variables are at a time."""
        values: Values = {"time": time}
        for name, value in self.steps:
            values[name] = value(values)
        return values

    def fill(self, count: int, depth: int) -> None:
        """Writes the model with ``count`` variables."""
        declared, equations = [], []
        for number, rate in enumerate((0.5, -0.75)):
            declared.append(f"Real s{number} = {rate}*time + {number + 1};")
            self._add(Variable(f"s{number}", (), ""), lambda values, r=rate, n=number: r * values["time"] + n + 1)
        for number in range(count):
            kind = self.choose.choice(["", "", "parameter ", "constant "])
            shape = self._shape(self.choose.choice([0, 1, 1, 2, 2]))
            all_known = self._known
            self._known = [known for known in all_known if kind in ("", known.kind, "parameter " if known.kind else "")]
            text, value = self._real(shape, depth)
            self._known = all_known
            variable = Variable(f"x{number}", shape, kind)
            sizes = f"[{', '.join(map(str, shape))}]" if shape else ""
            is_equation = not kind and self.choose.random() < 0.5
            declared.append(f"{kind}Real {variable.name}{sizes}{'' if is_equation else f' = {text}'};")
            if is_equation:
                equations.append(f"{variable.name} = {text};")
            self._add(variable, value)
            self.variables.append(variable)
        lines = "\n  ".join(declared), "\n  ".join(equations)
        self.text = f"model M{FUNCTIONS}  {lines[0]}\nequation\n  {lines[1]}\nend M;\n"

    def _add(self, variable: Variable, value: Callable[[Values], Any]) -> None:
        self._known.append(variable)
        self.steps.append((variable.name, value))

    def _shape(self, dimensions: int) -> Shape:
        return tuple(self.choose.randint(1, 3) for _ in range(dimensions))

    def _real(self, shape: Shape, depth: int) -> Expression:
        if depth <= 0 or self.choose.random() < 0.1:
            return self._leaf(shape)
        by_dimensions = {
            0: (self._index, self._reduction, self._reduced, self._product_of_vectors, self._call),
            1: (self._slice, self._row_or_column, self._iterated, self._matrix_by_vector, self._call_of_vector),
            2: (self._transposed, self._matrix_product, self._joined, self._matrix_of_vector, self._iterated),
        }
        of_any = (self._sum, self._scaled, self._if, self._elementwise, self._function)
        makers: Sequence[Callable[[Shape, int], Expression | None]] = (*of_any, *by_dimensions[len(shape)])
        return self.choose.choice(makers)(shape, depth - 1) or self._leaf(shape)

    def _leaf(self, shape: Shape) -> Expression:
        names = [known.name for known in self._known if known.shape == shape]
        if names and self.choose.random() < 0.8:
            name = self.choose.choice(names)
            return name, lambda values: values[name]
        if shape:
            parts = [self._leaf(shape[1:]) for _ in range(shape[0])]
            return _list(parts)
        if self._iterators and self.choose.random() < 0.5:
            iterator = self.choose.choice(self._iterators)[0]
            return iterator, lambda values: float(values[iterator])
        number = self.choose.choice([0.5, 1.5, 2.0, -1.0, 3.25, -0.75, 2, 1, 4])
        return (str(number) if number >= 0 else f"({number})"), lambda _: float(number)

    def _sum(self, shape: Shape, depth: int) -> Expression:
        sign = self.choose.choice(["+", "-", ".+", ".-"])
        left, right = self._real(shape, depth), self._real(shape, depth)
        factor = 1 if "+" in sign else -1
        return f"({left[0]} {sign} {right[0]})", lambda values: left[1](values) + factor * right[1](values)

    def _scaled(self, shape: Shape, depth: int) -> Expression:
        array, scalar = self._real(shape, depth), self._real((), depth)
        if self.choose.random() < 0.5:
            return f"({scalar[0]}*{array[0]})", lambda values: scalar[1](values) * array[1](values)
        return f"({array[0]}/(1 + {scalar[0]}^2))", lambda values: array[1](values) / (1 + scalar[1](values) ** 2)

    def _if(self, shape: Shape, depth: int) -> Expression:
        left, right = self._real((), 0), self._real((), 0)
        yes, no = self._real(shape, depth), self._real(shape, depth)
        text = f"(if {left[0]} < {right[0]} + 0.0137 then {yes[0]} else {no[0]})"
        return text, lambda values: (yes if left[1](values) < right[1](values) + 0.0137 else no)[1](values)

    def _elementwise(self, shape: Shape, depth: int) -> Expression:
        left, right = self._real(shape, depth), self._real(shape, depth)
        if self.choose.random() < 0.5:
            return f"({left[0]} .* {right[0]})", lambda values: left[1](values) * right[1](values)
        return (
            f"({left[0]} ./ (1.5 .+ {right[0]} .* {right[0]}))",
            lambda values: left[1](values) / (1.5 + right[1](values) ** 2),
        )

    def _function(self, shape: Shape, depth: int) -> Expression:
        name, function = self.choose.choice([("sin", np.sin), ("tanh", np.tanh), ("atan", np.arctan), ("cos", np.cos)])
        argument = self._real((), depth) if shape == () else self._real(shape, 0)
        if shape and not any(
            known.kind == "" for known in self._known
        ):  # of arrays the front end evaluates no constants
            return argument
        return f"{name}({argument[0]})", lambda values: function(argument[1](values))

    def _index(self, _shape: Shape, _depth: int) -> Expression | None:
        array = self._array(self.choose.choice([1, 2]))
        if array is None:
            return None
        subscripts = [self._subscript(size) for size in array.shape]
        text = f"{array.name}[{', '.join(text for text, _ in subscripts)}]"
        return text, lambda values: values[array.name][tuple(place(values) for _, place in subscripts)]

    def _array(self, dimensions: int) -> Variable | None:
        arrays = [known for known in self._known if len(known.shape) == dimensions]
        return self.choose.choice(arrays) if arrays else None

    def _subscript(self, size: int) -> Expression:
        """One subscript, and the place from zero that it means."""
        fitting = [name for name, last in self._iterators if last <= size]
        number = self.choose.randint(1, size)
        if fitting and self.choose.random() < 0.6:
            name = self.choose.choice(fitting)
            return name, lambda values: values[name] - 1
        if number == size and self.choose.random() < 0.5:
            return "end", lambda _: size - 1
        return str(number), lambda _: number - 1

    def _range(self, size: int, count: int) -> tuple[str, list[int]]:
        """Subscripts of ``count`` elements of ``size``, and their places from zero."""
        listed = [self.choose.randint(1, size) for _ in range(count)]
        ranges = [(f"{{{', '.join(map(str, listed))}}}", [number - 1 for number in listed])]
        if count == size:
            ranges += [(":", list(range(size))), ("end:-1:1", list(range(size))[::-1])]
        if count <= size:
            first = self.choose.randint(1, size - count + 1)
            ranges += [(f"{first}:{first + count - 1}", list(range(first - 1, first + count - 1)))]
            ranges += [(f"{size - count + 1}:end", list(range(size - count, size)))]
        return self.choose.choice(ranges)

    def _slice(self, shape: Shape, _depth: int) -> Expression | None:
        array = self._array(1)
        if array is None:
            return None
        text, places = self._range(array.shape[0], shape[0])
        return f"{array.name}[{text}]", lambda values: values[array.name][places]

    def _row_or_column(self, shape: Shape, _depth: int) -> Expression | None:
        array = self._array(2)
        if array is None:
            return None
        axis = self.choose.choice([0, 1])
        text, places = self._range(array.shape[axis], shape[0])
        one, place = self._subscript(array.shape[1 - axis])
        name = array.name
        if axis == 0:
            return f"{name}[{text}, {one}]", lambda values: values[name][places, place(values)]
        return f"{name}[{one}, {text}]", lambda values: values[name][place(values), places]

    def _iterated(self, shape: Shape, depth: int) -> Expression:
        iterator = f"i{len(self._iterators) + 1}"
        self._iterators.append((iterator, shape[0]))
        body = self._real(shape[1:], depth)
        self._iterators.pop()
        numbers = list(range(1, shape[0] + 1))
        limits = f"1:{shape[0]}"
        if self.choose.random() < 0.3:
            self.choose.shuffle(numbers)
            limits = f"{{{', '.join(map(str, numbers))}}}"
        return f"{{{body[0]} for {iterator} in {limits}}}", lambda values: np.array(
            [body[1]({**values, iterator: number}) for number in numbers]
        )

    def _reduced(self, _shape: Shape, depth: int) -> Expression:
        shape = self._shape(1)
        text, value = self._iterated(shape, depth)
        name, function = self.choose.choice(REDUCTIONS)
        return f"{name}({text[1:-1]})", lambda values: function(value(values))

    def _reduction(self, _shape: Shape, depth: int) -> Expression:
        is_constant = not any(known.kind == "" for known in self._known)  # matrices have no sums there
        array = self._real(self._shape(1 if is_constant else self.choose.choice([1, 2])), depth)
        name, function = self.choose.choice(REDUCTIONS)
        return f"{name}({array[0]})", lambda values: function(array[1](values))

    def _product_of_vectors(self, _shape: Shape, depth: int) -> Expression:
        shape = self._shape(1)
        return _product(self._real(shape, depth), self._real(shape, depth))

    def _matrix_by_vector(self, shape: Shape, depth: int) -> Expression:
        inner = self._shape(1)
        if self.choose.random() < 0.5:
            return _product(self._real((*shape, *inner), depth), self._real(inner, depth))
        return _product(self._real(inner, depth), self._real((*inner, *shape), depth))

    def _matrix_product(self, shape: Shape, depth: int) -> Expression:
        inner = self.choose.randint(1, 3)
        return _product(self._real((shape[0], inner), depth), self._real((inner, shape[1]), depth))

    def _transposed(self, shape: Shape, depth: int) -> Expression:
        matrix = self._real((shape[1], shape[0]), depth)
        return f"transpose({matrix[0]})", lambda values: matrix[1](values).T

    def _joined(self, shape: Shape, depth: int) -> Expression | None:
        axis = self.choose.choice([0, 1])
        if shape[axis] < 2:
            return None
        sizes = [list(shape), list(shape)]
        sizes[0][axis], sizes[1][axis] = 1, shape[axis] - 1
        parts = [self._real(tuple(size), depth) for size in sizes]
        text = f"cat({axis + 1}, {parts[0][0]}, {parts[1][0]})"
        if self.choose.random() < 0.5:
            text = f"[{parts[0][0]}{'; ' if axis == 0 else ', '}{parts[1][0]}]"
        return text, lambda values: np.concatenate([part[1](values) for part in parts], axis)

    def _matrix_of_vector(self, shape: Shape, depth: int) -> Expression | None:
        if shape == (3, 3):
            vector = self._real((3,), depth)
            return f"skew({vector[0]}*1.0)", lambda values: np.cross(np.eye(3), vector[1](values)).T * -1.0
        if shape[0] == shape[1]:
            vector = self._real(shape[:1], depth)
            return f"diagonal({vector[0]})", lambda values: np.diag(vector[1](values))
        rows, columns = self._real(shape[:1], depth), self._real(shape[1:], depth)
        return f"outerProduct({rows[0]}, {columns[0]})", lambda values: np.outer(rows[1](values), columns[1](values))

    def _call(self, _shape: Shape, depth: int) -> Expression:
        vector = self._leaf(self._shape(1))
        if self.choose.random() < 0.5:
            return f"squares({vector[0]})", lambda values: np.sum(vector[1](values) ** 2)
        at = self._real((), depth)
        text = self.choose.choice([f"polynomial({vector[0]}, {at[0]})", f"polynomial(x={at[0]}, c={vector[0]})"])
        return text, lambda values: np.polynomial.polynomial.polyval(at[1](values), vector[1](values))

    def _call_of_vector(self, shape: Shape, _depth: int) -> Expression:
        vector = self._leaf(shape)
        name, function = self.choose.choice(OF_VECTORS)
        return f"{name}({vector[0]})", lambda values: function(vector[1](values))


REDUCTIONS = (("sum", np.sum), ("product", np.prod), ("max", np.max), ("min", np.min))
OF_VECTORS: Sequence[tuple[str, Callable[[NDArray[np.float64]], Any]]] = (
    ("cumulated", np.cumsum),
    ("reversed", lambda vector: vector[::-1]),
    ("sorted", np.sort),
)


def random_model(seed: int, count: int = 14, depth: int = 3) -> RandomModel:
    """The model of a seed, with ``count`` variables of expressions ``depth`` deep."""
    model = RandomModel(random.Random(seed))
    model.fill(count, depth)
    return model


def _list(parts: Sequence[Expression]) -> Expression:
    text = f"{{{', '.join(part[0] for part in parts)}}}"
    return text, lambda values: np.array([part[1](values) for part in parts])


def _product(left: Expression, right: Expression) -> Expression:
    return f"({left[0]}*{right[0]})", lambda values: left[1](values) @ right[1](values)
