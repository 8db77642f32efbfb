"""What generated functions are made of: statements, groups of them, and places in the work arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from modelica2fmu.symbolic.expression import Node

Write = Callable[["float | Node"], str]

Lines = Callable[[Write], Sequence[str]]


@dataclass(frozen=True)
class Group:
    """Statements that make up a function of its own, which a later statement calls, perhaps several times.

    Attributes:
        name: of the function.
        executions: how often it is executed in one evaluation.
    """

    name: str
    executions: int


@dataclass(frozen=True)
class Statement:
    """Some lines of C and the expressions in them.

    Attributes:
        roots: expressions that the lines contain.
        lines: the C, given a function from expression to C.
        is_discrete: = true, if it is executed at events only.
        group: the group that the statement is in; the statements of a group follow each other.
        calls_model: = true, if the lines call functions that change the model's variables: it becomes a function of
            its own, since the others take it for granted that only they do.
    """

    roots: tuple[float | Node, ...]
    lines: Lines
    is_discrete: bool = False
    group: Group | None = None
    calls_model: bool = False


@dataclass
class WorkSpace:
    """Allocation of the work arrays."""

    reals: int = 0
    integers: int = 0

    def real(self, count: int) -> int:
        """Offset of ``count`` new doubles."""
        offset = self.reals
        self.reals += count
        return offset

    def integer(self, count: int) -> int:
        """Offset of ``count`` new integers."""
        offset = self.integers
        self.integers += count
        return offset
