"""What generated functions are made of: statements, groups of them, and places in the work arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum, auto

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


class Stored(Enum):
    """How a statement stores what it computes.

    Attributes:
        NUMBER: the value as it is.
        TRUTH: whether it is other than zero.
        OTHERWISE: with more lines, or not at all.
    """

    NUMBER = auto()
    TRUTH = auto()
    OTHERWISE = auto()


@dataclass(frozen=True)
class Put:
    """All that a statement does: it stores the value of its root, so that it can stand wherever that is known.

    Attributes:
        place: C lvalue; empty if nothing is stored.
        symbol: that the place belongs to, if other statements can read it.
        stored: how.
    """

    place: str
    symbol: str | None = None
    stored: Stored = Stored.NUMBER


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
        put: what it does if that is no more than to store a value; else it stays where it is.
        executed: number of lines that a loop executes; 0 for a statement that is none.
        keeps: nodes that a loop stores in the work array.
        on_request: = true, if it is executed only where somebody looks at the variables; such statements come last.
    """

    roots: tuple[float | Node, ...]
    lines: Lines
    is_discrete: bool = False
    group: Group | None = None
    calls_model: bool = False
    put: Put | None = None
    executed: int = 0
    keeps: tuple[Node, ...] = ()
    on_request: bool = False


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
