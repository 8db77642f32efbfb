"""What functions with algorithms mean: an own reading of small Modelica functions, beside the builder's.

Modelica Language Specification 3.6, chapters 11 (statements) and 12 (functions): loops over ranges, arrays and nothing,
``while``, ``break`` and ``return``, assignments to elements, slices and members, several outputs, defaults, named
arguments, sizes that callers decide, records, functions that call functions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Values = dict[str, Any]
Expression = tuple[str, Callable[[Values], Any]]
Statement = tuple[list[str], Callable[[Values], None]]


class Break(Exception):
    """Leaves the innermost loop."""


class Return(Exception):
    """Leaves the function."""


@dataclass(frozen=True)
class Kind:
    """``Real``, ``Integer``, ``Boolean``, ``Data`` or ``vector`` (of Reals), as long as a number or an input says."""

    name: str
    size: int | str = 0

    def declaration(self, name: str, is_input: bool = False) -> str:
        if self.name != "vector":
            return f"{self.name} {name}"
        return f"Real {name}[{':' if is_input and self.size == name else self.size_text}]"

    @property
    def size_text(self) -> str:
        return str(self.size) if isinstance(self.size, int) else f"size({self.size}, 1)"


REAL, INTEGER, BOOLEAN, DATA = Kind("Real"), Kind("Integer"), Kind("Boolean"), Kind("Data")


@dataclass
class Function:
    """A function: its text, and its values from those of its inputs."""

    name: str
    inputs: list[tuple[str, Kind, Expression | None]] = field(default_factory=list)
    outputs: list[tuple[str, Kind, Expression | None]] = field(default_factory=list)
    protected: list[tuple[str, Kind, Expression | None]] = field(default_factory=list)
    body: list[Statement] = field(default_factory=list)

    @property
    def text(self) -> str:
        lines = [f"  function {self.name}"]
        for prefix, declared in (("input ", self.inputs), ("output ", self.outputs)):
            lines += [f"    {prefix}{_declared(each, prefix == 'input ')};" for each in declared]
        if self.protected:
            lines += ["  protected", *(f"    {_declared(each)};" for each in self.protected)]
        lines += ["  algorithm", *(f"    {line}" for each in self.body for line in each[0]), f"  end {self.name};"]
        return "\n".join(lines)

    def call(self, given: Values) -> list[Any]:
        """The outputs. Inputs that are not given have their defaults."""
        values: Values = {}
        for name, _, default in self.inputs:
            values[name] = copied(given[name]) if name in given else copied(default[1](values))  # type: ignore[index]
        for name, kind, start in (*self.outputs, *self.protected):
            values[name] = copied(start[1](values)) if start else _unset(kind, values)
        try:
            for _, run in self.body:
                run(values)
        except Return:
            pass
        return [copied(values[name]) for name, _, _ in self.outputs]


def copied(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: copied(each) for name, each in value.items()}
    return np.array(value, dtype=float) if isinstance(value, np.ndarray) else value


def _declared(each: tuple[str, Kind, Expression | None], is_input: bool = False) -> str:
    name, kind, start = each
    return kind.declaration(name, is_input) + (f" = {start[0]}" if start else "")


def _unset(kind: Kind, values: Values) -> Any:
    """What must be assigned before it is read; arrays have their size."""
    if kind.name == "vector":
        return np.full(kind.size if isinstance(kind.size, int) else len(values[kind.size]), np.nan)
    if kind.name == "Data":
        return {"a": 1.25, "v": np.array([0.5, -2.25]), "n": 3}
    return None
