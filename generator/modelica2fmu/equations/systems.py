"""The two systems that a generated model solves: while simulating, and at initialization."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from contact_foundation.errors import Place

from modelica2fmu.equations.alias import ReducedModel, substituted_call
from modelica2fmu.equations.blocks import Assignment, Block, Entry, Residual
from modelica2fmu.equations.continuous_system import ReducedSystem
from modelica2fmu.equations.dependent_equations import DependentEquationsError, Statement, with_combination
from modelica2fmu.equations.discrete_assignments import partitioned
from modelica2fmu.equations.index_reduction import reduce_index
from modelica2fmu.equations.initialization import Initialization
from modelica2fmu.equations.sorting import solve_order
from modelica2fmu.equations.unit_states import with_unit_states
from modelica2fmu.equations.unit_vectors import unit_vectors
from modelica2fmu.expand.scalar_model import (
    INITIAL,
    ExternalCall,
    Kind,
    ScalarAssert,
    ScalarModel,
    derivative_name,
)
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

PlaceOf = Callable[[Span | None], Place]


@dataclass
class Systems:
    """Everything that code generation needs.

    Attributes:
        model: variables, relations and actions.
        reduction: equations of index one and states.
        simulation: blocks while simulating, discrete ones included.
        initialization: blocks at initialization.
        checks: what must hold at the end of initialization.
        warnings: remarks for the build log (start values assumed, initial equations only checked).
        integrated: the state that stands for each element of a vector of length one.
    """

    model: ScalarModel
    reduction: ReducedSystem
    simulation: list[Block]
    initialization: list[Block]
    checks: list[ScalarAssert] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    integrated: dict[str, str] = field(default_factory=dict)


def build_systems(reduced: ReducedModel, place: PlaceOf) -> Systems:
    """Partitions, reduces the index, and sorts both systems.

    Raises:
        InputError: a system is structurally singular.
        UnsupportedModelError: the structure is one that is not translated.
    """
    return _Builder(reduced, place).run()


class _Builder:
    def __init__(self, reduced: ReducedModel, place: PlaceOf) -> None:
        self._reduced = reduced
        self._model = reduced.model
        self._place = place
        removed = {*reduced.replacements, *(name for name, _ in reduced.invariants)}
        self._live = {name: variable for name, variable in self._model.variables.items() if name not in removed}
        self._note_calls()

    def _note_calls(self) -> None:
        self._calls = [call for call in self._model.calls if not self._is_known(call)]
        self._outputs = {name for call in self._calls for name in call.outputs}

    def _is_known(self, call: ExternalCall) -> bool:
        """A call that depends on parameters alone."""
        return all(self._model.variables[name].kind is Kind.PARAMETER for name in call.outputs) and bool(call.outputs)

    def run(self) -> Systems:
        discrete = [
            name
            for name, variable in self._live.items()
            if variable.kind is Kind.DISCRETE and name not in self._outputs
        ]
        assignments, residuals = partitioned(self._reduced.equations, self._model.variables, discrete, self._place)
        unknowns = [
            name
            for name, variable in self._live.items()
            if variable.kind is Kind.CONTINUOUS and name not in self._outputs
        ]
        others: list[float | Node] = [item for call in self._calls for item in call.inputs()]
        others += [assignment.value for assignment in assignments]
        others += [item.indicator for item in self._model.relations]
        others += [item.value for item in self._model.reinitializations]
        statements = [(ex.subtract(equation.left, equation.right), equation.span) for equation in residuals]
        reduction, simulation = self._reduced_to_blocks(statements, unknowns, others, assignments)
        start = Initialization(
            self._live, self._reduced.initial_equations, self._calls, assignments, reduction, self._place
        )
        initialization = start.blocks()
        drifting = [
            names for names in unit_vectors(reduction.states, simulation) if names not in reduction.unit_vectors
        ]
        unit = with_unit_states(self._model, reduction.states, [*reduction.unit_vectors, *drifting])
        return Systems(
            model=self._model,
            reduction=replace(reduction, states=list(unit.states)),
            simulation=[*unit.vectors, *simulation, *unit.rates],
            initialization=[*initialization, *unit.initialization],
            checks=start.checks,
            warnings=[*self._model.warnings, *start.warnings],
            integrated=unit.integrated,
        )

    def _reduced_to_blocks(
        self,
        residuals: Sequence[Statement],
        unknowns: Sequence[str],
        others: Sequence[float | Node],
        assignments: Sequence[Assignment],
    ) -> tuple[ReducedSystem, list[Block]]:
        """The system of index one and its blocks; equations that prove dependent give way to what they say together."""
        left = len(residuals)
        while True:
            reduction = reduce_index(self._model, residuals, unknowns, others, self._resolve, self._place)
            self._note_calls()  # derivatives of tables are calls, too
            try:
                return reduction, self._simulation(assignments, reduction)
            except DependentEquationsError as found:
                if left == 0:
                    raise
                left -= 1
                residuals = with_combination(residuals, reduction.equations, found)

    def _resolve(self, name: str) -> float | Node:
        replacement = self._reduced.replacements.get(name)
        return ex.symbol(name) if replacement is None else replacement

    def _simulation(self, assignments: Sequence[Assignment], reduction: ReducedSystem) -> list[Block]:
        running = ex.Substitution({INITIAL: 0})
        entries: list[Entry] = []
        for equation in reduction.equations:
            if equation.number in reduction.stabilized:
                entries.append(Residual(reduction.stabilized[equation.number], equation.span))
            elif not equation.is_invariant:
                entries.append(Residual(running(equation.residual), equation.span, equation.number))
        entries.extend(
            Assignment(item.target, running(item.value), is_discrete=True, span=item.span) for item in assignments
        )
        entries.extend(substituted_call(call, running) for call in self._calls)
        states = set(reduction.states)
        unknowns = [name for name in reduction.unknowns if name not in states]
        unknowns += [item.target for item in assignments]
        unknowns += [name for call in self._calls for name in call.outputs]
        preferred = [derivative_name(name) for name in reduction.states]
        return solve_order(entries, unknowns, preferred, self._place)
