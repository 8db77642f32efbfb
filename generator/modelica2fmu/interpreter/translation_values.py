"""Values that a model must have at translation, and the errors where it has none."""

from __future__ import annotations

import numpy as np
from contact_foundation.errors import InputError, UnsupportedModelError

from modelica2fmu.interpreter.arrays import Value
from modelica2fmu.interpreter.interpreter_host import Host
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic.expression import Node


class TranslationValues:
    """Asks for values that are needed at translation; errors name their place.

    Args:
        host: see :class:`Host`.
        source_map: for the places in error messages.
    """

    def __init__(self, host: Host, source_map: SourceMap) -> None:
        self._host = host
        self._source_map = source_map

    def unsupported(self, construct: str, span: Span | None) -> UnsupportedModelError:
        """The error for a construct that is not translated."""
        return UnsupportedModelError(
            f"{construct} is not translated",
            place=self._source_map.place(span),
            remedy="see docs/fmu-builder.md for the constructs that are, and rewrite the model with those",
        )

    def wrong(self, message: str, span: Span | None, remedy: str | None = None) -> InputError:
        """The error for a model that is wrong."""
        return InputError(message, place=self._source_map.place(span), remedy=remedy)

    def integer(self, value: Value, span: Span | None) -> int:
        """A whole number that is needed at translation."""
        if isinstance(value, Node):
            value = self._host.constant(value, span, "an array size, index or loop bound")
        if isinstance(value, float | int) and float(value).is_integer():
            return int(value)
        if isinstance(value, np.ndarray):
            raise self.wrong(f"one whole number is needed here, not a vector of {value.size}, as of subscripts", span)
        raise self.wrong(f"a whole number is needed here, not {value!r}", span)

    def number(self, value: Value, span: Span | None, purpose: str) -> float:
        """A number that is needed at translation, for ``purpose``."""
        if isinstance(value, Node):
            value = self._host.constant(value, span, purpose)
        if isinstance(value, float | int):
            return value
        raise self.wrong(f"a number is needed here, not {value!r}", span)

    def is_known(self, value: Node, span: Span | None, purpose: str) -> bool:
        """True for what parameters decide; with a ``purpose`` these can no longer be changed."""
        try:
            self._host.constant(value, span, purpose)
        except UnsupportedModelError:
            return False
        return True

    def text(self, value: Value, span: Span | None) -> str:
        """A String that is needed at translation."""
        if isinstance(value, str):
            return value
        raise self.unsupported("a String that depends on variables", span)

    def checked(self, index: int, size: int, span: Span | None) -> int:
        """An index counted from 0; raises InputError outside of the array."""
        if not 1 <= index <= size:
            raise self.wrong(f"index {index} is outside of 1 to {size}", span)
        return index - 1
