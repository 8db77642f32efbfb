"""The system that is solved at initialization: what its conditions are, and which of them are only checked."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from contact_foundation.errors import Place

from modelica2fmu.equations.blocks import Assignment, Block, Entry, Residual
from modelica2fmu.equations.continuous_system import ReducedSystem
from modelica2fmu.equations.initial_checks import initial_check
from modelica2fmu.equations.matching import Matching
from modelica2fmu.equations.sorting import solve_order
from modelica2fmu.expand.scalar_model import (
    INITIAL,
    ExternalCall,
    Kind,
    ScalarAssert,
    ScalarEquation,
    ScalarVariable,
    derivative_name,
    previous_name,
    start_name,
    unwrapped,
)
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class Initialization:
    """The initialization problem of a model.

    Args:
        live: variables that are left.
        equations: initial ones.
        calls: of external functions that do not depend on parameters alone.
        assignments: of discrete variables.
        reduction: of the continuous equations.
        place: place of a span.

    Attributes:
        checks: conditions that others determine already; they must hold at the end.
        warnings: start values that are assumed, conditions that are only checked.
    """

    def __init__(
        self,
        live: Mapping[str, ScalarVariable],
        equations: Sequence[ScalarEquation],
        calls: Sequence[ExternalCall],
        assignments: Sequence[Assignment],
        reduction: ReducedSystem,
        place: Callable[[Span | None], Place],
    ) -> None:
        self._live = live
        self._equations = equations
        self._calls = calls
        self._assignments = assignments
        self._reduction = reduction
        self._place = place
        self.checks: list[ScalarAssert] = []
        self.warnings: list[str] = []

    def blocks(self) -> list[Block]:
        """The blocks, sorted."""
        assignments, reduction = self._assignments, self._reduction
        mapping: dict[str, float | Node] = {INITIAL: 1}
        for name in reduction.unknowns:
            mapping[previous_name(name)] = ex.symbol(name)
        starting = ex.Substitution(mapping)
        entries: list[Entry] = [Residual(starting(item.residual), item.span) for item in reduction.equations]
        before: dict[str, float | Node] = {}
        initial_residuals: list[Residual] = []
        for equation in self._equations:
            discrete, value = self._discrete_initial(equation)
            if discrete is not None:
                before[discrete] = starting(value)
                continue
            initial_residuals.append(Residual(starting(ex.subtract(equation.left, equation.right)), equation.span))
        unknowns: dict[str, None] = dict.fromkeys(reduction.unknowns)
        for item in assignments:
            entries.append(Assignment(item.target, starting(item.value), is_discrete=True, span=item.span))
            unknowns[item.target] = None
        for name, value in before.items():
            entries.append(Assignment(previous_name(name), value, is_discrete=True))
            unknowns[previous_name(name)] = None
        entries.extend(self._calls)
        outputs = {name for call in self._calls for name in call.outputs}
        unknowns.update(dict.fromkeys(outputs))
        free = [name for name, variable in self._live.items() if variable.kind is Kind.FREE_PARAMETER]
        unknowns.update(dict.fromkeys(free))
        given = {item.target for item in entries if isinstance(item, Assignment)} | outputs
        entries.extend(self._initial_conditions(entries, initial_residuals, unknowns, given, reduction, free))
        preferred = [derivative_name(name) for name in reduction.states]
        return solve_order(entries, list(unknowns), preferred, self._place)

    def _discrete_initial(self, equation: ScalarEquation) -> tuple[str | None, float | Node]:
        """The discrete variable whose first pre() value an initial equation gives."""
        for side, other in ((equation.left, equation.right), (equation.right, equation.left)):
            if isinstance(side, Node) and side.op == "symbol":
                wrapper, inner = unwrapped(side.name)
                variable = self._live.get(inner)
                if variable is not None and variable.kind is Kind.DISCRETE and wrapper in ("", "pre"):
                    return inner, other
        return None, 0

    def _initial_conditions(
        self,
        entries: Sequence[Entry],
        initial_residuals: Sequence[Residual],
        unknowns: dict[str, None],
        given: set[str],
        reduction: ReducedSystem,
        free: Sequence[str],
    ) -> list[Residual]:
        """The start values and initial equations that complete the initialization problem."""
        matching = Matching()
        open_unknowns = {name for name in unknowns if name not in given}

        def attempt(residual: float | Node) -> bool:
            number = len(matching.incidence)
            matching.incidence[number] = [name for name in ex.symbols(residual) if name in open_unknowns]
            if matching.augment(number):
                return True
            matching.incidence[number] = []
            return False

        for entry in entries:
            if isinstance(entry, Residual):
                attempt(entry.residual)
        chosen: list[Residual] = []
        fixed = [name for name in reduction.unknowns if (item := self._live.get(name)) is not None and item.fixed]
        conditions = [(self._start_condition(name), f"the start value of {name}") for name in fixed]
        conditions += [(item, f"the initial equation 0 = {item.residual}") for item in initial_residuals]
        for condition, text in conditions:
            if attempt(condition.residual):
                chosen.append(condition)
            else:
                self.warnings.append(f"too many initial conditions: {text} is not used, only checked")
                self.checks.append(initial_check(condition.residual, text, self._place(condition.span)))
        states = sorted(
            (name for name in reduction.states if name not in fixed),
            key=lambda name: -self._preference(name),
        )
        others = [name for name in unknowns if name not in states and name not in given]
        for name in [*free, *states, *others]:
            if len(matching.row_of) == len(open_unknowns):
                break
            condition = self._start_condition(name)
            if attempt(condition.residual):
                chosen.append(condition)
                self.warnings.append(f"start value of {name} used as initial condition")
        return chosen

    def _preference(self, name: str) -> int:
        variable = self._live.get(name)
        return variable.state_select.value if variable is not None else 0

    def _start_condition(self, name: str) -> Residual:
        variable = self._live.get(name)
        return Residual(
            ex.subtract(ex.symbol(name), ex.symbol(start_name(name))), variable.span if variable is not None else None
        )
