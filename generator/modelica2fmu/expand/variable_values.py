"""Values of a flat model's variables: parameters are evaluated, what can change are symbols."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager

import numpy as np
from contact_foundation.errors import InputError, Place, UnsupportedModelError

from modelica2fmu.expand.bounds_check import empty_bounds, outside_bounds
from modelica2fmu.expand.scalar_model import TIME, Kind, ScalarModel
from modelica2fmu.expand.scalar_values import KNOWN_KINDS, element_names
from modelica2fmu.expand.tables import is_table_function
from modelica2fmu.frontend import ir
from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Record, Scalar, Text, Value
from modelica2fmu.interpreter.interpreter import Interpreter
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class VariableValues:
    """Evaluates variables when they are asked for, each once.

    Args:
        model: the flat model.
        result: the model that is made; its variables are declared.
        interpreter: evaluates bindings.
        source_map: for the places in error messages.
    """

    def __init__(
        self, model: ir.FlatModel, result: ScalarModel, interpreter: Interpreter, source_map: SourceMap
    ) -> None:
        self._model = model
        self._result = result
        self._interpreter = interpreter
        self._source_map = source_map
        self._values: dict[str, Value] = {}
        self._in_progress: set[str] = set()
        self._structural: set[str] = set()

    def is_table(self, variable: ir.Variable) -> bool:
        """A table of the Standard Library, which is no variable of the equations."""
        made = variable.binding
        function = self._model.functions.get(made.name) if isinstance(made, ir.Call) else None
        return function is not None and function.external is not None and is_table_function(function.external.name)

    def variable(self, name: str) -> Value | None:
        """See :class:`interpreter_host.Host`."""
        value = self._values.get(name)
        if value is not None:
            return value
        declared = self._model.variables.get(name)
        if declared is None:
            record = self._model.records.get(name)
            if record is not None:
                fields = {item: self.variable(f"{name}.{item}") for item in record.fields}
                return Record({item: field for item, field in fields.items() if field is not None})
            scalar = self._result.variables.get(name)
            return ex.symbol(name) if scalar is not None else None
        if name in self._in_progress:
            raise InputError(f"the binding of {name} depends on itself", place=self._source_map.place(declared.span))
        self._in_progress.add(name)
        try:
            if self.is_table(declared):
                assert declared.binding is not None
                with self._told_of(declared, declared.binding):
                    value = self._interpreter.evaluate(declared.binding, events=False)
                self._values[name] = value
                return value
            value = self._parameter(declared) if declared.variability in ("parameter", "constant") else None
        finally:
            self._in_progress.discard(name)
        if value is None:
            value = self._symbols(declared)
        self._values[name] = value
        return value

    @staticmethod
    def _symbols(variable: ir.Variable) -> Value:
        if not variable.shape:
            return ex.symbol(variable.name)
        result: arrays.Array = np.empty(variable.shape, dtype=object)
        flat = result.reshape(-1)
        for position, name in enumerate(element_names(variable.name, variable.shape)):
            flat[position] = ex.symbol(name)
        return result

    def _parameter(self, variable: ir.Variable) -> Value | None:
        """Evaluates a parameter; its constants as they are, what can change as symbols."""
        names = element_names(variable.name, variable.shape)
        scalars = [self._result.variables[name] for name in names]
        if scalars and scalars[0].kind is Kind.FREE_PARAMETER:
            return None
        expression = variable.binding if variable.binding is not None else variable.start
        if variable.binding is None and variable.start is not None and names:
            self._result.warnings.append(f"the parameter {variable.name} has no value, its start value is used")
        if expression is None:
            if not names:
                return arrays.filled(variable.shape, 0)
            if variable.type == "String":
                items: list[Scalar] = [""] * len(names)
            else:
                raise InputError(
                    f"the parameter {variable.name} has no value",
                    place=self._source_map.place(variable.span, variable.name),
                    remedy="give it a value in the model",
                )
        else:
            items = self._items(variable, expression, names)
            self._require_no_time(items, expression, f"the parameter {variable.name}", variable)
        values: list[Scalar] = []
        for scalar, item in zip(scalars, items, strict=True):
            if isinstance(item, Text):
                raise UnsupportedModelError(
                    f"the String parameter {scalar.name} depends on variables",
                    place=self._source_map.place(variable.span),
                )
            if scalar.type == "Integer" and isinstance(item, float) and item.is_integer():
                item = int(item)
            scalar.value = item
            is_constant = not isinstance(item, Node) and (
                variable.variability == "constant"
                or variable.evaluate
                or variable.is_protected  # nobody outside can change it
                or isinstance(item, str)
            )
            if is_constant:
                scalar.kind = Kind.CONSTANT
                values.append(item)
            else:
                values.append(ex.symbol(scalar.name))
        if not variable.shape:
            return values[0]
        result: arrays.Array = np.empty(variable.shape, dtype=object)
        flat = result.reshape(-1)
        for position, value in enumerate(values):
            flat[position] = value
        return result

    def _items(self, variable: ir.Variable, expression: ir.Expression, names: list[str]) -> list[Scalar]:
        """The values of a parameter's elements."""
        with self._told_of(variable, expression):
            return self.broadcast(expression, names)

    @contextmanager
    def _told_of(self, variable: ir.Variable, expression: ir.Expression) -> Iterator[None]:
        """Tells with a variable of what is refused in its binding, as by a function its arguments."""
        try:
            yield
        except InputError as error:
            if error.place is not None and error.place.file is not None:
                raise
            place = self._source_map.place(expression.span or variable.span, variable.name)
            raise type(error)(error.message, place=place, remedy=error.remedy) from error

    def broadcast(self, expression: ir.Expression, names: list[str]) -> list[Scalar]:
        """The value of a binding or attribute for each of the elements ``names`` of a variable.

        Raises:
            InputError: it has another number of elements.
        """
        value = self._interpreter.evaluate(expression, events=False)
        items = arrays.scalars(value)
        declared = self._model.variables.get(names[0].split("[")[0]) if names else None
        fits = not isinstance(value, np.ndarray) or declared is None or value.shape in ((1,), declared.shape)
        if len(items) == 1 and len(names) != 1:
            items = items * len(names)
        if len(items) != len(names) or not fits:
            raise InputError(
                f"an attribute of {names[0]} has {len(items)} elements instead of {len(names)}",
                place=self._source_map.place(expression.span),
            )
        return items

    def set_attributes(self, variable: ir.Variable) -> None:
        """Gives the elements of a variable their value or start, limits and nominal value."""
        names = element_names(variable.name, variable.shape)
        if not names:
            return
        if variable.variability in ("parameter", "constant"):
            self.variable(variable.name)
        elif variable.start is not None:
            self._set_start(variable, variable.start, names)
        if self._result.variables[names[0]].kind is Kind.FREE_PARAMETER and variable.start is not None:
            self._set_start(variable, variable.start, names)
        for attribute in ("minimum", "maximum", "nominal"):
            expression = getattr(variable, attribute)
            if expression is None:
                continue
            for name, value in zip(names, self.broadcast(expression, names), strict=True):
                if isinstance(value, float | int):
                    setattr(self._result.variables[name], attribute, float(value))
        self._require_within(variable, names)

    def _set_start(self, variable: ir.Variable, start: ir.Expression, names: list[str]) -> None:
        items = self.broadcast(start, names)
        self._require_no_time(items, start, f"the start value of {variable.name}", variable)
        for name, item in zip(names, items, strict=True):
            self._result.variables[name].start = self._plain(item)

    def _require_no_time(
        self, items: Iterable[Scalar], expression: ir.Expression, what: str, variable: ir.Variable
    ) -> None:
        """Refuses what is to stay as it is and changes with time (Modelica 3.6, 3.8.4)."""
        if any(isinstance(item, Node) and TIME in ex.symbols(item) for item in items):
            raise InputError(
                f"{what} depends on time, which it cannot",
                place=self._source_map.place(expression.span or variable.span, variable.name),
                remedy="Give it a value that stays, or declare a variable in its place.",
            )

    def _require_within(self, variable: ir.Variable, names: list[str]) -> None:
        """Holds bounds against each other, and against values of parameters and start values of variables.

        A start value outside the bounds that is not fixed is a guess, and gets a warning.
        """
        known = variable.variability in ("parameter", "constant")
        for name in names:
            scalar = self._result.variables[name]
            wrong = empty_bounds(scalar)
            if wrong:
                raise self._outside(wrong, variable.span)
            given = scalar.value if known else scalar.start
            wrong = outside_bounds(scalar, self.number_now(given))
            if wrong and known:
                raise self._outside(f"{name} is {wrong}", variable.binding.span if variable.binding else variable.span)
            if wrong and scalar.fixed:
                given_at = variable.start.span if variable.start is not None else None
                raise self._outside(f"the start value of {name} is {wrong}", given_at or variable.span)
            if wrong:
                self._result.warnings.append(f"the start value of {name} is {wrong}")

    def _outside(self, wrong: str, span: Span | None) -> InputError:
        return InputError(wrong, place=self._source_map.place(span), remedy="Give a value within the bounds.")

    @staticmethod
    def _plain(value: Scalar) -> float | str | Node | None:
        return None if isinstance(value, Text) else value

    def constant(self, value: Node, span: Span | None, purpose: str) -> float:
        """See :class:`interpreter_host.Host`; the parameters it depends on can no longer be changed."""
        numbers: dict[str, float | Node] = {}
        for name in ex.symbols(value):
            variable = self._result.variables.get(name)
            if variable is None or variable.kind not in KNOWN_KINDS:
                raise UnsupportedModelError(
                    f"{purpose or 'a value'} that depends on the variable {name} is not translated",
                    place=self._source_map.place(span),
                )
        for name in ex.symbols(value):
            numbers[name] = self._parameter_number(name, span)
        if purpose:
            self._make_structural(numbers)
        result = ex.Substitution(numbers)(value)
        if isinstance(result, Node):
            raise InputError(f"no finite value: {result}", place=self._source_map.place(span))
        return result

    def number_now(self, value: object) -> float | None:
        """The number of an expression of parameters that can still be changed.

        ``None`` if it depends on more, NaN if it has none: a division by zero, a logarithm of a negative number.
        """
        return self._number_now(value, {})

    def _number_now(self, value: object, known: dict[str, float | None]) -> float | None:
        """The same with the numbers that are known already; ``None`` for those that are being asked for."""
        if not isinstance(value, Node):
            return value if isinstance(value, float | int) else None
        numbers: dict[str, float | Node] = {}
        for name in ex.symbols(value):
            if name not in known:
                variable = self._result.variables.get(name)
                known[name] = None
                if variable is not None and variable.kind in KNOWN_KINDS:
                    known[name] = self._number_now(variable.value, known)
            number = known[name]
            if number is None:
                return None
            numbers[name] = number
        result = ex.Substitution(numbers)(value)
        return math.nan if isinstance(result, Node) else result

    def modified(self, names: Iterable[str]) -> Place | None:
        """Where the first of these parameters, or of those they are computed from, is given another value than its own.

        The file is another one than that of the declaration.
        """
        waiting, seen = list(names), set()
        while waiting:
            name = waiting.pop(0)
            variable = self._result.variables.get(name)
            if variable is None or variable.declaration is None or name in seen:
                continue
            seen.add(name)
            if isinstance(variable.value, Node):
                waiting += ex.symbols(variable.value)
            elif variable.declaration.binding is not None:
                place = self._source_map.place(variable.declaration.binding.span)
                if place.file not in (None, self._source_map.place(variable.declaration.span).file):
                    return place
        return None

    def _make_structural(self, numbers: Mapping[str, float | Node]) -> None:
        """Parameters that can no longer be changed; what is evaluated from now on has their numbers."""
        for name, number in numbers.items():
            if name in self._structural:
                continue
            self._structural.add(name)
            declared = self._result.variables[name].declaration
            value = self._values.get(declared.name) if declared is not None else None
            if isinstance(value, Node):
                self._values[name] = number
            elif isinstance(value, np.ndarray) and declared is not None:
                indices = name[len(declared.name) + 1 : -1].split(",")
                value[tuple(int(index) - 1 for index in indices)] = number

    def _parameter_number(self, name: str, span: Span | None) -> float:
        value = self._result.variables[name].value
        if value is None:
            declared = self._result.variables[name].declaration
            if declared is not None:
                self.variable(declared.name)
            value = self._result.variables[name].value
        if isinstance(value, Node):
            declared = self._result.variables[name].declaration
            own = declared.binding.span if declared is not None and declared.binding is not None else None
            return self.constant(value, own or span, f"the parameter {name}")
        if isinstance(value, float | int):
            return value
        raise UnsupportedModelError(f"the parameter {name} has no value at translation")

    def fix_structural(self) -> None:
        """Makes the parameters constants on whose numbers the translation depends."""
        for name in self._structural:
            variable = self._result.variables[name]
            if variable.kind is Kind.PARAMETER:
                variable.kind = Kind.CONSTANT
                variable.value = self._parameter_number(name, None)
