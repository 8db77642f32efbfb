"""The operator ``String``: numbers, Booleans and enumeration literals as text."""

from __future__ import annotations

from modelica2fmu.frontend import ir
from modelica2fmu.interpreter.arrays import Text, Value
from modelica2fmu.interpreter.interpreter_host import Host
from modelica2fmu.interpreter.translation_values import TranslationValues
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic.expression import Node


class StringOperator:
    """Writes values of one flat model as Strings.

    Args:
        model: the model whose enumerations are known.
        host: see :class:`Host`.
        known: asks for what is needed at translation.
    """

    def __init__(self, model: ir.FlatModel, host: Host, known: TranslationValues) -> None:
        self._model = model
        self._host = host
        self._known = known

    def convert(
        self, value: Value, source: ir.Expression, digits: int, width: int, left: bool, span: Span | None
    ) -> str | Text:
        """``String(value, significantDigits=digits, minimumLength=width, leftJustified=left)``.

        Args:
            value: what to write.
            source: the expression whose value it is; its type decides.
            digits: significant digits.
            width: the least number of characters.
            left: = true, if blanks that fill it up stand on the right.
            span: for the place in error messages.
        """
        if isinstance(value, Node):
            if not self._known.is_known(value, None, ""):
                return Text((value,))
            value = self._host.constant(value, span, "a String")
            if float(value).is_integer() and self._is_whole(source):
                value = int(value)
        text = self._formatted(value, digits, source)
        return text.ljust(width) if left else text.rjust(width)

    def _is_whole(self, expression: ir.Expression) -> bool:
        variable = self._model.variables.get(expression.name) if isinstance(expression, ir.Reference) else None
        return variable is not None and variable.type == "Integer"

    def _formatted(self, value: Value, digits: int, source: ir.Expression) -> str:
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(source, ir.Reference):
            literal = self._literal_name(source.name, value)
            if literal is not None:
                return literal
        if isinstance(value, int):
            return str(value)
        return f"{value:.{digits}g}"

    def _literal_name(self, name: str, value: Value) -> str | None:
        if name in self._model.enumeration_literals:
            return name.rsplit(".", 1)[-1]
        enumeration = self._host.enumeration_type(name)
        if enumeration is None:
            return None
        for literal, ordinal in self._model.enumeration_literals.items():
            if literal.rsplit(".", 1)[0] == enumeration and ordinal == value and not literal.endswith("'"):
                return literal.rsplit(".", 1)[-1]
        return None
