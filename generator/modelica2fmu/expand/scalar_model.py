"""The expanded model: scalar variables, scalar equations, external calls, relations and when-clauses.

Symbols of expressions are names of scalar variables (``body.r_0[1]``), their derivatives (``der(x)``), values
before an event (``pre(x)``), ``relation[k]``, outputs of external calls, ``time``, ``initial()`` and
``terminal()``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from enum import Enum
from typing import Final

from modelica2fmu.frontend import ir
from modelica2fmu.interpreter.arrays import Text
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic.expression import Node

TIME: Final = "time"
INITIAL: Final = "initial()"
TERMINAL: Final = "terminal()"


def derivative_name(name: str) -> str:
    """Name of the time derivative of a variable."""
    return f"der({name})"


def previous_name(name: str) -> str:
    """Name of the value of a variable before an event."""
    return f"pre({name})"


def relation_name(number: int) -> str:
    """Name of the held value of a relation."""
    return f"relation[{number}]"


def start_name(name: str) -> str:
    """Name of the start value of a variable, as it is when the initialization begins."""
    return f"start({name})"


def is_call_output(name: str) -> bool:
    """True for the outputs of external calls."""
    return name.startswith("$call[")


_WRAPPED = re.compile(r"^(der|pre)\((.*)\)$")


def unwrapped(name: str) -> tuple[str, str]:
    """``("der", "x")`` of ``der(x)``, ``("", "x")`` of ``x``."""
    match = _WRAPPED.match(name)
    return (match[1], match[2]) if match else ("", name)


class Kind(Enum):
    """What a variable is to the equations."""

    CONSTANT = "constant"  # its value is known at translation and cannot be changed
    PARAMETER = "parameter"  # known before the equations are solved
    FREE_PARAMETER = "free parameter"  # fixed=false: unknown of the initialization, then known
    INPUT = "input"
    DISCRETE = "discrete"
    CONTINUOUS = "continuous"


@dataclass
class ScalarVariable:
    """One scalar variable.

    Attributes:
        name: Modelica name, subscripts included.
        type: ``Real``, ``Integer``, ``Boolean``, ``String`` or an enumeration's name.
        kind: see :class:`Kind`.
        value: of a constant: its number or string; of a parameter: its binding, a number if independent.
        start: start attribute, ``None`` if not given.
        fixed: = true, if the start value holds at initialization.
        orientation: name of the Orientation record of which this is an element of ``T``, and its row and column.
        declaration: attributes of the array or scalar it comes from; ``None`` for variables of the translation.
    """

    name: str
    type: str
    kind: Kind
    value: float | str | Node | None = None
    start: float | str | Node | None = None
    fixed: bool = False
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    state_select: ir.StateSelect = ir.StateSelect.DEFAULT
    orientation: tuple[str, int, int] | None = None
    declaration: ir.Variable | None = None
    is_output: bool = False
    span: Span | None = None


@dataclass(frozen=True)
class ScalarEquation:
    """``left = right``; ``target`` names the variable that it assigns, where it is an assignment."""

    left: float | Node
    right: float | Node
    span: Span | None = None
    target: str | None = None


@dataclass(frozen=True)
class Relation:
    """A relation that generates events: true while ``indicator > 0``, held in ``relation[number]``."""

    number: int
    indicator: Node

    @property
    def name(self) -> str:
        """Its symbol."""
        return relation_name(self.number)


@dataclass(frozen=True)
class CallArgument:
    """An argument of a C function.

    Attributes:
        type: ``Real``, ``Integer``, ``Boolean``, ``String``, ``size``, or ``Instance``: the values of the instance.
        values: scalars of an input, row-major; symbols of an output.
        is_array: = true, if it is passed as a pointer to its elements.
        is_output: = true, if the function writes it.
        is_constant: = true, if it is an array of numbers that the function only reads.
    """

    type: str
    values: tuple[float | str | Node, ...]
    is_array: bool
    is_output: bool
    is_constant: bool = False


@dataclass(frozen=True)
class ExternalCall:
    """A call of an external C function with its outputs as symbols.

    Attributes:
        number: position in ``ScalarModel.calls``.
        function: Modelica function.
        symbol: C function.
        args: arguments in the order of the C function.
        result: symbol and type of the return value, if it is an output.
        outputs: symbols of all outputs.
        has_prototype: = true, if an Include annotation declares the function.
    """

    number: int
    function: str
    symbol: str
    args: tuple[CallArgument, ...]
    result: tuple[str, str] | None
    outputs: tuple[str, ...]
    has_prototype: bool
    span: Span | None = None

    def inputs(self) -> list[Node]:
        """Symbolic inputs."""
        return [
            value
            for argument in self.args
            if not argument.is_output
            for value in argument.values
            if isinstance(value, Node)
        ]


@dataclass(frozen=True)
class Reinitialization:
    """``reinit(state, value)`` when ``trigger`` becomes true."""

    trigger: float | Node
    state: str
    value: float | Node
    span: Span | None = None


@dataclass(frozen=True)
class ScalarAssert:
    """An assertion; ``trigger`` limits it to events (``None``: always checked)."""

    condition: float | Node
    message: Text
    is_warning: bool = False
    trigger: float | Node | None = None


@dataclass(frozen=True)
class Termination:
    """``terminate(message)`` when ``trigger`` becomes true."""

    trigger: float | Node
    message: Text


@dataclass(frozen=True)
class SampleCounter:
    """``sample(start, interval)``: an Integer variable that counts the samples up to now."""

    variable: str
    start: float | Node
    interval: float | Node


@dataclass
class ScalarModel:
    """The expanded model."""

    name: str
    description: str
    variables: dict[str, ScalarVariable] = field(default_factory=dict)
    equations: list[ScalarEquation] = field(default_factory=list)
    initial_equations: list[ScalarEquation] = field(default_factory=list)
    calls: list[ExternalCall] = field(default_factory=list)
    relations: list[Relation] = field(default_factory=list)
    reinitializations: list[Reinitialization] = field(default_factory=list)
    asserts: list[ScalarAssert] = field(default_factory=list)
    terminations: list[Termination] = field(default_factory=list)
    samples: list[SampleCounter] = field(default_factory=list)
    time_thresholds: list[float | Node] = field(default_factory=list)  # times at which discrete expressions change
    enumerations: dict[str, tuple[str, ...]] = field(default_factory=dict)
    external_annotations: list[tuple[str, tuple[str, ...]]] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
