"""Expands equations and assertions of a flat model to scalar ones."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from contact_foundation.errors import InputError, Place, UnsupportedModelError

from modelica2fmu.expand.scalar_model import Kind, ScalarAssert, ScalarEquation, ScalarModel
from modelica2fmu.expand.scalar_values import as_number, element_names, only_parameters, text_of
from modelica2fmu.expand.variable_values import VariableValues
from modelica2fmu.frontend import ir
from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Scalar, Text
from modelica2fmu.interpreter.interpreter import Interpreter
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class EquationExpansion:
    """Makes scalar equations and assertions of those of a flat model.

    Args:
        result: the model that is made; its variables are declared.
        interpreter: evaluates expressions.
        values: of the variables.
        source_map: for the places in error messages.
    """

    def __init__(
        self, result: ScalarModel, interpreter: Interpreter, values: VariableValues, source_map: SourceMap
    ) -> None:
        self._result = result
        self._interpreter = interpreter
        self._values = values
        self._source_map = source_map
        self._is_lasting = False  # = true, while what holds at all times is expanded

    @contextmanager
    def lasting(self) -> Iterator[None]:
        """What is expanded within holds at all times, and so do the assertions of its functions."""
        self._is_lasting = True
        try:
            yield
        finally:
            self._is_lasting = False

    def binding(self, variable: ir.Variable) -> None:
        """The binding of a variable becomes equations of its elements."""
        assert variable.binding is not None
        names = element_names(variable.name, variable.shape)
        if variable.type == "String":
            items = self._values.broadcast(variable.binding, names)
            for name, item in zip(names, items, strict=True):
                if not isinstance(item, str):
                    raise UnsupportedModelError(
                        f"the String variable {name} changes, which is not translated",
                        place=self._source_map.place(variable.span),
                    )
                self._result.variables[name].kind = Kind.CONSTANT
                self._result.variables[name].value = item
            return
        for name, item in zip(names, self._broadcast_events(variable.binding, names), strict=True):
            self._result.equations.append(ScalarEquation(ex.symbol(name), as_number(item), variable.span))

    def _broadcast_events(self, expression: ir.Expression, names: list[str]) -> list[Scalar]:
        items = arrays.scalars(self._interpreter.evaluate(expression))
        return items * len(names) if len(items) == 1 else items

    def equation(self, equation: ir.Equation, events: bool = True) -> list[ScalarEquation]:
        """The scalar equations of an equation; with ``events`` false, its relations generate none."""
        residual = equation.residual
        if isinstance(residual, ir.Binary) and isinstance(residual.left, ir.TupleExpression):
            left, right = self._outputs(residual.left, residual.right, events, equation.span)
        elif isinstance(residual, ir.Binary) and residual.op in ("Sub", "SubElem"):
            left = self._sides(residual.left, events)
            right = self._sides(residual.right, events)
            if len(left) == 1 and len(right) > 1 and isinstance(residual.left, ir.Literal):
                left = left * len(right)
            if len(right) == 1 and len(left) > 1:
                right = right * len(left)
        else:
            left = self._sides(residual, events)
            right = [0] * len(left)
        if len(left) != len(right):
            raise InputError(
                f"the sides of an equation have {len(left)} and {len(right)} elements",
                place=self._source_map.place(equation.span),
            )
        result = []
        for a, b in zip(left, right, strict=True):
            if isinstance(a, str | Text) or isinstance(b, str | Text):
                if a == b:
                    continue
                raise UnsupportedModelError(
                    "an equation between Strings is not translated", place=self._source_map.place(equation.span)
                )
            result.append(ScalarEquation(as_number(a), as_number(b), equation.span))
        return result

    def _outputs(
        self, targets: ir.TupleExpression, call: ir.Expression, events: bool, span: Span | None
    ) -> tuple[list[Any], list[Any]]:
        """Scalars of the outputs of a call and of what they are equal to; outputs may be left out."""
        values = self._interpreter.outputs(call, events=events)
        if len(targets.elements) > len(values):
            raise InputError(
                f"a call with {len(values)} outputs is given {len(targets.elements)} targets",
                place=self._source_map.place(span),
            )
        left: list[Any] = []
        right: list[Any] = []
        for target, value in zip(targets.elements, values, strict=False):
            if target is not None:
                left.extend(arrays.scalars(self._interpreter.evaluate(target, events=events)))
                right.extend(arrays.scalars(value))
        return left, right

    def _sides(self, expression: ir.Expression, events: bool) -> list[Any]:
        """Scalars of one side of an equation."""
        return list(arrays.scalars(self._interpreter.evaluate(expression, events=events)))

    def assertion(self, item: ir.Assert) -> None:
        """An assertion of the model; raises InputError if it fails with the values that its parameters have now."""
        condition = as_number(self._interpreter.evaluate(item.condition, events=False))
        message = text_of(self._interpreter.evaluate(item.message, events=False))
        self._require(condition, message, item.is_warning, self._source_map.place(item.span))
        if isinstance(condition, Node):
            self._result.asserts.append(ScalarAssert(condition, message, item.is_warning))

    def function_assert(self, condition: Scalar, message: Scalar, is_warning: bool) -> None:
        """See :class:`interpreter_host.Host`."""
        if isinstance(condition, str | Text) or not isinstance(message, str | Text):
            return
        self._require(condition, text_of(message), is_warning, Place())
        # Initial equations and when-clauses call functions at events alone: what these say of variables holds there.
        if isinstance(condition, Node) and (self._is_lasting or only_parameters(self._result, condition)):
            self._result.asserts.append(ScalarAssert(condition, text_of(message), is_warning))

    def _require(self, condition: float | Node, message: Text, is_warning: bool, place: Place) -> None:
        """Refuses, or warns of, what fails with the values that parameters have now.

        What depends on variables is not known yet.
        """
        if self._values.number_now(condition) != 0.0:
            return
        shown = [part if isinstance(part, str) else f"{self._values.number_now(part):g}" for part in message.parts]
        names = ex.symbols(condition) if isinstance(condition, Node) else []
        found = self._values.modified(names) or place
        owner = min((name.rpartition(".")[0] for name in names), key=len, default="")
        error = InputError(
            ("" if is_warning else "an assertion of the model fails: ") + "".join(shown),
            place=Place(found.file, found.line, owner or None) if found.file is not None else None,
        )
        if not is_warning:
            raise error
        self._result.warnings.append(str(error))
