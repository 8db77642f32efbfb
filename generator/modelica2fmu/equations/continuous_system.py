"""The continuous equations with their derivatives, and what index reduction makes of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from modelica2fmu.expand.scalar_model import Kind, ScalarModel, is_call_output, unwrapped
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


@dataclass
class ContinuousEquation:
    """``residual = 0`` with the equation it is the derivative of.

    Attributes:
        number: position among all equations.
        residual: expression that vanishes.
        span: where the model states it.
        derivative_of: number of the equation whose derivative this is.
        derivative: number of its own derivative.
        is_invariant: = true, if the simulation need not solve it, since its stabilized derivative keeps it.
    """

    number: int
    residual: float | Node
    span: Span | None = None
    derivative_of: int | None = None
    derivative: int | None = None
    is_invariant: bool = False


@dataclass
class ReducedSystem:
    """The continuous system with index one.

    Attributes:
        equations: original and differentiated ones.
        unknowns: all continuous symbols, derivatives included.
        states: chosen states, in order.
        dummies: derivatives that are algebraic unknowns.
        stabilized: residuals that replace those of some differentiated equations while simulating.
        rejected_states: variables with StateSelect.always that cannot be states.
        unit_vectors: vectors of states whose norm is an invariant.
    """

    equations: list[ContinuousEquation]
    unknowns: list[str]
    states: list[str]
    dummies: list[str]
    stabilized: dict[int, float | Node] = field(default_factory=dict)
    rejected_states: list[str] = field(default_factory=list)
    unit_vectors: list[tuple[str, ...]] = field(default_factory=list)

    @property
    def differentiations(self) -> int:
        """How many differentiations were made."""
        return sum(equation.derivative_of is not None for equation in self.equations)


def continuous_symbols(model: ScalarModel, roots: Sequence[float | Node]) -> list[str]:
    """Symbols of continuous unknowns below ``roots``, derivatives included."""
    found = []
    for name in ex.symbols(*roots):
        _, inner = order_and_variable(name)
        variable = model.variables.get(inner)
        if variable is None or variable.kind is not Kind.CONTINUOUS or unwrapped(name)[0] == "pre":
            continue
        if not is_call_output(inner):
            found.append(name)
    return found


def order_and_variable(name: str) -> tuple[int, str]:
    """Order of differentiation and name of the variable."""
    order = 0
    while True:
        wrapper, inner = unwrapped(name)
        if wrapper == "":
            return order, name
        if wrapper == "der":
            order += 1
        name = inner
