"""Finds components of a model and of local variables by name and subscripts."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from modelica2fmu.frontend import ir
from modelica2fmu.interpreter.arrays import Record, Value
from modelica2fmu.interpreter.interpreter_host import Host, Scope
from modelica2fmu.interpreter.translation_values import TranslationValues
from modelica2fmu.interpreter.value_functions import dynamic_element
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class References:
    """Looks components up, first among local variables.

    Args:
        model: the model whose enumeration literals are known.
        host: see :class:`Host`.
        known: asks for what is needed at translation.
        value: evaluates subscripts.
    """

    def __init__(
        self,
        model: ir.FlatModel,
        host: Host,
        known: TranslationValues,
        value: Callable[[ir.Expression, Scope], Value],
    ) -> None:
        self._model = model
        self._host = host
        self._known = known
        self._value = value

    def reference(self, reference: ir.Reference, scope: Scope) -> Value:
        """The value of a component, with its subscripts.

        Raises:
            InputError: there is none of this name, or a subscript is outside of the array.
        """
        value = self._look_up(reference, scope)
        return self.indexed(value, reference.subscripts, scope, reference.span) if reference.subscripts else value

    def _look_up(self, reference: ir.Reference, scope: Scope) -> Value:
        name = reference.name
        value = scope.find(name)
        if value is None:
            value = self._host.variable(name)
        if value is None:
            ordinal = self._model.enumeration_literals.get(name)
            if ordinal is not None:
                return ordinal
            if name == "time":
                return ex.symbol("time")
            value = self._walk(reference, scope)
        if value is None:
            raise self._known.wrong(f"there is no variable {name}", reference.span)
        return value

    def _walk(self, reference: ir.Reference, scope: Scope) -> Value | None:
        """Finds a component part by part: fields of local records, subscripts that are not literal."""
        path = ""
        value: Value | None = None
        parts = reference.parts
        if len(parts) == 1 and "." in parts[0][0]:
            parts = tuple((piece, ()) for piece in parts[0][0].split("."))
        for identifier, subscripts in parts:
            if isinstance(value, Record):
                value = value.fields.get(identifier)
                if value is not None and subscripts:
                    value = self.indexed(value, subscripts, scope, reference.span)
                continue
            path = f"{path}.{identifier}" if path else identifier
            value = scope.find(path)
            if value is None:
                value = self._host.variable(path)
            if value is not None:
                if subscripts:
                    value = self.indexed(value, subscripts, scope, reference.span)
            elif subscripts:
                numbers = [
                    str(self._known.integer(self.subscript_value(item, scope), reference.span)) for item in subscripts
                ]
                path += f"[{','.join(numbers)}]"
                value = self._host.variable(path)
        return value

    def subscript_value(self, subscript: ir.Subscript, scope: Scope) -> Value:
        """The value of a subscript that is no colon."""
        if isinstance(subscript, ir.Colon):
            raise self._known.unsupported("a slice of an array of components", None)
        return self._value(subscript, scope)

    def indexed(self, value: Value, subscripts: tuple[ir.Subscript, ...], scope: Scope, span: Span | None) -> Value:
        """Elements of an array, by subscripts of its first dimensions.

        Raises:
            InputError: what is no array has subscripts, there are too many, or one is outside of the array.
        """
        if not isinstance(value, np.ndarray):
            raise self._known.wrong("a scalar has subscripts", span)
        if len(subscripts) > value.ndim:
            raise self._known.wrong("there are more subscripts than dimensions", span)
        result: Value = value
        dimension = 0
        for position, subscript in enumerate(subscripts):
            assert isinstance(result, np.ndarray)
            if isinstance(subscript, ir.Colon):
                dimension += 1
                continue
            inner = Scope(scope)
            inner.values["end"] = value.shape[position]
            index = self._value(subscript, inner)
            if isinstance(index, np.ndarray):
                numbers = [
                    self._known.checked(self._known.integer(item, span), value.shape[position], span) for item in index
                ]
                result = np.take(result, numbers, axis=dimension)
                dimension += 1
                continue
            if isinstance(index, Node) and not self._known.is_known(index, span, "an index"):
                result = dynamic_element(result, index, dimension)
                continue
            number = self._known.checked(self._known.integer(index, span), value.shape[position], span)
            result = result[(slice(None),) * dimension + (number,)]
        return result
