"""The two systems that a generated model solves: while simulating, and at initialization."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.equations.alias import ReducedModel, substituted_call
from modelica2fmu.equations.blocks import Assignment, Block, Entry, Residual
from modelica2fmu.equations.continuous_system import ReducedSystem
from modelica2fmu.equations.dependent_equations import DependentEquationsError, Statement, with_combination
from modelica2fmu.equations.index_reduction import reduce_index
from modelica2fmu.equations.initial_checks import initial_check
from modelica2fmu.equations.matching import Matching
from modelica2fmu.equations.sorting import solve_order
from modelica2fmu.equations.unit_states import with_unit_states
from modelica2fmu.equations.unit_vectors import unit_vectors
from modelica2fmu.expand.scalar_model import (
    INITIAL,
    ExternalCall,
    Kind,
    ScalarAssert,
    ScalarEquation,
    ScalarModel,
    derivative_name,
    previous_name,
    start_name,
    unwrapped,
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
        self._warnings: list[str] = list(self._model.warnings)
        self._checks: list[ScalarAssert] = []
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
        assignments, residuals = self._partition()
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
        initialization = self._initialization(assignments, reduction)
        drifting = [
            names for names in unit_vectors(reduction.states, simulation) if names not in reduction.unit_vectors
        ]
        unit = with_unit_states(self._model, reduction.states, [*reduction.unit_vectors, *drifting])
        return Systems(
            model=self._model,
            reduction=replace(reduction, states=list(unit.states)),
            simulation=[*unit.vectors, *simulation, *unit.rates],
            initialization=[*initialization, *unit.initialization],
            checks=self._checks,
            warnings=self._warnings,
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

    # --- discrete and continuous ---

    def _partition(self) -> tuple[list[Assignment], list[ScalarEquation]]:
        """Assignments to discrete variables, and the continuous equations."""
        assignments: dict[str, Assignment] = {}
        rest: list[ScalarEquation] = []
        for equation in self._reduced.equations:
            target = equation.target
            if target is not None and self._model.variables[target].kind is Kind.DISCRETE:
                assignments[target] = Assignment(target, equation.right, is_discrete=True, span=equation.span)
            else:
                rest.append(equation)
        discrete = [
            name
            for name, variable in self._live.items()
            if variable.kind is Kind.DISCRETE and name not in assignments and name not in self._outputs
        ]
        candidates: dict[str, dict[int, float | Node]] = {name: {} for name in discrete}
        for number, equation in enumerate(rest):
            for side, other in ((equation.left, equation.right), (equation.right, equation.left)):
                name, value = _explicit(side, other)
                if name in candidates and name not in ex.symbols(value) and not self._is_real(name, value):
                    candidates[name].setdefault(number, value)
        matching = Matching(
            {position: [str(number) for number in candidates[name]] for position, name in enumerate(discrete)}
        )
        used: set[int] = set()
        for position, name in enumerate(discrete):
            if not matching.augment(position):
                variable = self._model.variables[name]
                raise UnsupportedModelError(
                    f"no equation gives the discrete variable {name} explicitly",
                    place=self._place(variable.span),
                    remedy=f"write it as {name} = ...",
                )
        for position, name in enumerate(discrete):
            number = int(matching.column_of[position])
            used.add(number)
            assignments[name] = Assignment(name, candidates[name][number], is_discrete=True, span=rest[number].span)
        return list(assignments.values()), [item for number, item in enumerate(rest) if number not in used]

    def _is_real(self, name: str, value: float | Node) -> bool:
        """= true, if an equation of an Integer or the like gives a continuous variable: ``y = i`` is none for ``i``."""
        while isinstance(value, Node) and value.op == "neg":
            value = value.args[0]
        other = self._model.variables.get(value.name) if isinstance(value, Node) and value.op == "symbol" else None
        is_continuous = other is not None and other.kind is Kind.CONTINUOUS
        return is_continuous and self._model.variables[name].type != "Real"

    # --- simulation ---

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

    # --- initialization ---

    def _initialization(self, assignments: Sequence[Assignment], reduction: ReducedSystem) -> list[Block]:
        mapping: dict[str, float | Node] = {INITIAL: 1}
        for name in reduction.unknowns:
            mapping[previous_name(name)] = ex.symbol(name)
        starting = ex.Substitution(mapping)
        entries: list[Entry] = [Residual(starting(item.residual), item.span) for item in reduction.equations]
        before: dict[str, float | Node] = {}
        initial_residuals: list[Residual] = []
        for equation in self._reduced.initial_equations:
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
                self._warnings.append(f"too many initial conditions: {text} is not used, only checked")
                self._checks.append(initial_check(condition.residual, text, self._place(condition.span)))
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
                self._warnings.append(f"start value of {name} used as initial condition")
        return chosen

    def _preference(self, name: str) -> int:
        variable = self._live.get(name)
        return variable.state_select.value if variable is not None else 0

    def _start_condition(self, name: str) -> Residual:
        variable = self._live.get(name)
        return Residual(
            ex.subtract(ex.symbol(name), ex.symbol(start_name(name))), variable.span if variable is not None else None
        )


def _explicit(side: float | Node, other: float | Node) -> tuple[str, float | Node]:
    """Name and value if ``side`` is a symbol, its negative or its negation."""
    if not isinstance(side, Node):
        return "", 0
    if side.op == "symbol":
        return side.name, other
    if side.op == "neg" and side.args[0].op == "symbol":
        return side.args[0].name, ex.negate(other)
    if side.op == "not" and side.args[0].op == "symbol":
        return side.args[0].name, ex.logical_not(other)
    return "", 0
