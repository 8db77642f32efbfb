"""What the interpreter asks of the model around it, and where its local variables are."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from modelica2fmu.frontend import ir
from modelica2fmu.interpreter.arrays import Scalar, Value
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class Host(Protocol):
    """What the interpreter asks of the model around it."""

    def variable(self, name: str) -> Value | None:
        """The value of a variable, record, or ``None`` if there is none of this name."""
        ...

    def enumeration_type(self, name: str) -> str | None:
        """Name of the enumeration type of a variable, or ``None``."""
        ...

    def derivative(self, value: float | Node, span: Span | None) -> float | Node:
        """``der(value)``."""
        ...

    def previous(self, value: float | Node, span: Span | None) -> float | Node:
        """``pre(value)``."""
        ...

    def relation(self, op: str, left: float | Node, right: float | Node) -> bool | Node:
        """A relation that may generate events."""
        ...

    def step(self, op: str, value: float | Node) -> float | Node:
        """``floor`` of a value or, for ``quotient``, the value rounded towards zero, with events where it changes."""
        ...

    def sample(self, start: float | Node, interval: float | Node, span: Span | None) -> bool | Node:
        """``sample(start, interval)``."""
        ...

    def external(self, function: ir.Function, args: Mapping[str, Value], span: Span | None) -> tuple[Value, ...]:
        """The outputs of an external function."""
        ...

    def delay(self, value: float | Node, delay: float | Node, longest: float | Node, span: Span | None) -> float | Node:
        """``delay(value, delay, longest)``."""
        ...

    def constant(self, value: Node, span: Span | None, purpose: str) -> float:
        """The number that ``value`` has at translation; raises UnsupportedModelError if it can change."""
        ...

    def function_assert(self, condition: Scalar, message: Scalar, is_warning: bool) -> None:
        """An assertion met while a function was inlined."""
        ...


class Scope:
    """Local variables of a function call or of loops; looks outwards to the model if it is not a function."""

    def __init__(self, parent: Scope | None = None) -> None:
        self.values: dict[str, Value | None] = {}
        self.parent = parent
        # A return- or break-statement was executed, or, if a node, may have been: then assignments keep old values.
        self.returned: bool | Node = False
        self.broken: bool | Node = False

    def branch(self) -> Scope:
        """A copy for one branch of an if-statement."""
        result = Scope(self.parent)
        result.values = dict(self.values)
        result.returned, result.broken = self.returned, self.broken
        return result

    @property
    def left(self) -> bool | Node:
        """What follows is not executed."""
        return ex.logical_or(self.returned, self.broken)

    def find(self, name: str) -> Value | None:
        """The value of a local variable, looked for outwards."""
        scope: Scope | None = self
        while scope is not None:
            if name in scope.values:
                return scope.values[name]
            scope = scope.parent
        return None
