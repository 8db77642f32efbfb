"""Index reduction: Pantelides' algorithm and dummy derivatives with Modelica's stateSelect.

Which equations must be differentiated: Pantelides 1988, "The consistent initialization of differential-algebraic
systems". Which derivatives become algebraic unknowns afterwards: Mattsson and Soederlind 1993, "Index reduction in
differential-algebraic equations using dummy derivatives"; the choice is greedy by stateSelect, which is optimal
because the sets of unknowns that can be matched form a matroid (Edmonds and Fulkerson 1965).

Two things are particular to multibody systems:

- The rotation matrix of an Orientation record has the known derivative ``der(T) = -skew(w) T``. Using it instead
  of differentiating what defines ``T`` (as the derivative annotations of ``resolve1`` and ``resolve2`` in the Modelica
  Standard Library do) keeps the differentiated system small.
- The norm of a quaternion, ``Q * Q = 1``, is an invariant: no three of the four components are states for all
  orientations. All four become states, and the differentiated equation is stabilized (Baumgarte 1972,
  "Stabilization of constraints and integrals of motion in dynamical systems"): ``der(g) + k g = 0``. All other
  equations get ``Q / |Q|`` while simulating, so that rotation matrices are orthonormal at every trial point of an
  integrator and the result does not depend on the norm.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from cmb_base.errors import InputError, Place, UnsupportedModelError

from modelica2fmu import expression as ex
from modelica2fmu import ir
from modelica2fmu.expression import Node
from modelica2fmu.matching import Matching
from modelica2fmu.scalar_model import Kind, ScalarModel, derivative_name, is_call_output, unwrapped

STABILIZATION_RATE: Final = 10.0
_ORDER_LIMIT: Final = 6


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
    span: ir.Span | None = None
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
        _, inner = _inner(name)
        variable = model.variables.get(inner)
        if variable is None or variable.kind is not Kind.CONTINUOUS or unwrapped(name)[0] == "pre":
            continue
        if not is_call_output(inner):
            found.append(name)
    return found


def _inner(name: str) -> tuple[int, str]:
    """Order of differentiation and name of the variable."""
    order = 0
    while True:
        wrapper, inner = unwrapped(name)
        if wrapper == "":
            return order, name
        if wrapper == "der":
            order += 1
        name = inner


def reduce_index(
    model: ScalarModel,
    residuals: Sequence[tuple[float | Node, ir.Span | None]],
    unknowns: Sequence[str],
    others: Sequence[float | Node],
    resolve: Callable[[str], float | Node],
    place: Callable[[ir.Span | None], Place],
) -> ReducedSystem:
    """Reduces the index of ``residuals = 0`` and chooses states.

    Args:
        model: for the attributes of variables.
        residuals: continuous equations.
        unknowns: continuous variables, each of which some equation must determine.
        others: expressions outside of the equations that may contain derivatives.
        resolve: what a removed variable is (aliases, constants).
        place: place of a span.

    Raises:
        InputError: the equations are structurally singular.
        UnsupportedModelError: an equation that must be differentiated cannot be.
    """
    return _Reducer(model, residuals, unknowns, others, resolve, place).run()


class _Reducer:
    def __init__(
        self,
        model: ScalarModel,
        residuals: Sequence[tuple[float | Node, ir.Span | None]],
        unknowns: Sequence[str],
        others: Sequence[float | Node],
        resolve: Callable[[str], float | Node],
        place: Callable[[ir.Span | None], Place],
    ) -> None:
        self._model = model
        self._resolve = resolve
        self._place = place
        self._equations = [
            ContinuousEquation(number, residual, span) for number, (residual, span) in enumerate(residuals)
        ]
        names: dict[str, None] = dict.fromkeys(unknowns)
        for name in continuous_symbols(model, [*(residual for residual, _ in residuals), *others]):
            order, inner = _inner(name)
            current = inner
            names.setdefault(current)
            for _ in range(order):
                current = derivative_name(current)
                names.setdefault(current)
        self._names = names
        for root, span in (*residuals, *((other, None) for other in others)):
            self._require_derivatives(root, span)
        self._differentiate = ex.Differentiation(self._rate)
        self._incidence: dict[int, list[str]] = {}
        for equation in self._equations:
            self._incidence[equation.number] = continuous_symbols(model, [equation.residual])
        # Elements of rotation matrices with the equations that define them: they take no part in the search for
        # equations to differentiate, since their derivative is known from the angular velocity.
        self._defined, self._definitions = self._matrix_definitions()
        self._incidence_is_stale = False
        self._owners: set[str] = set()  # components whose quaternions are states
        self._angular_velocities = self._angular_velocity_names()

    def _require_derivatives(self, root: float | Node, span: ir.Span | None) -> None:
        """Only continuous variables of the equations have derivatives."""
        for name in ex.symbols(root):
            order, inner = _inner(name)
            if order == 0 or name in self._names or unwrapped(name)[0] == "pre":
                continue
            what = "the output of an external function" if is_call_output(inner) else f"{inner}"
            raise UnsupportedModelError(
                f"the derivative of {what} is not translated",
                place=self._place(span),
                remedy="prescribe the motion with its derivatives",
            )

    def _matrix_definitions(self) -> tuple[set[str], set[int]]:
        matrices = [
            name
            for name in self._names
            if (variable := self._model.variables.get(name)) is not None and variable.orientation is not None
        ]
        candidates: dict[str, list[str]] = {name: [] for name in matrices}
        for equation in self._equations:
            for name in explicit_variables(equation.residual):
                if name in candidates:
                    candidates[name].append(str(equation.number))
        matching = Matching({position: candidates[name] for position, name in enumerate(matrices)})
        defined = {name for position, name in enumerate(matrices) if matching.augment(position)}
        for name in matrices:
            if name not in defined or derivative_name(name) in self._names:
                self._model.variables[name].orientation = None
        defined = {name for name in defined if self._model.variables[name].orientation is not None}
        rows = {int(matching.column_of[position]) for position, name in enumerate(matrices) if name in defined}
        return defined, rows

    def _angular_velocity_names(self) -> set[str]:
        records = {item.orientation[0] for item in self._model.variables.values() if item.orientation is not None}
        names = set()
        for record in records:
            for index in range(3):
                by = self._resolve(f"{record}.w[{index + 1}]")
                names.update(ex.symbols(by))
        return names

    # --- derivatives ---

    def _rate(self, name: str) -> float | Node:
        if name == "time":
            return 1
        order, inner = _inner(name)
        variable = self._model.variables.get(inner)
        if variable is None or unwrapped(name)[0] == "pre":
            return 0
        if variable.kind is Kind.INPUT:
            raise _NotDifferentiableError(f"the input {name}")
        if variable.kind is not Kind.CONTINUOUS:
            return 0
        if is_call_output(inner):
            raise _NotDifferentiableError("the output of an external function")
        if order == 0 and variable.orientation is not None:
            return self._orientation_rate(*variable.orientation)
        if order >= _ORDER_LIMIT:
            raise _NotDifferentiableError(f"{inner} more than {_ORDER_LIMIT} times")
        derivative = derivative_name(name)
        self._names.setdefault(derivative)
        return ex.symbol(derivative)

    def _orientation_rate(self, record: str, row: int, column: int) -> float | Node:
        second, third = (row + 1) % 3, (row + 2) % 3
        w2, w3 = (self._resolve(f"{record}.w[{index + 1}]") for index in (second, third))
        t2, t3 = (self._resolve(f"{record}.T[{index + 1},{column + 1}]") for index in (second, third))
        return ex.subtract(ex.multiply(w3, t2), ex.multiply(w2, t3))

    def _add_derivative(self, equation: ContinuousEquation) -> ContinuousEquation:
        try:
            residual = self._differentiate(equation.residual)
        except _NotDifferentiableError as error:
            raise UnsupportedModelError(
                f"an equation must be differentiated for index reduction, but contains {error}",
                place=self._place(equation.span),
                remedy="break the constraint by a compliant element, or prescribe the motion with its derivatives",
            ) from error
        derivative = ContinuousEquation(len(self._equations), residual, equation.span, equation.number)
        equation.derivative = derivative.number
        self._equations.append(derivative)
        self._incidence[derivative.number] = continuous_symbols(self._model, [residual])
        return derivative

    # --- Pantelides ---

    def run(self) -> ReducedSystem:
        self._require_regular()
        matching = Matching()
        for number in range(len(self._equations)):
            if number not in self._definitions:
                self._match(matching, number)
        return self._select_states()

    def _require_regular(self) -> None:
        """A matching must exist when a variable and its derivatives count as one; else nothing helps."""
        merged = {
            number: list(dict.fromkeys(_inner(name)[1] for name in names)) for number, names in self._incidence.items()
        }
        matching = Matching(merged)
        problems = [number for number in merged if not matching.augment(number)]
        variables = dict.fromkeys(_inner(name)[1] for name in self._names)
        missing = [name for name in variables if name not in matching.row_of]
        if not problems and not missing:
            return
        texts = []
        place = None
        if problems:
            equations = [self._equations[number] for number in problems[:5]]
            place = self._place(equations[0].span)
            texts.append("equations that determine nothing: " + "; ".join(f"0 = {e.residual}" for e in equations))
        if missing:
            texts.append("variables that no equation determines: " + ", ".join(missing[:10]))
        raise InputError(
            f"the model is structurally singular ({len(self._equations)} equations, {len(variables)} unknowns): "
            + "; ".join(texts),
            place=place,
        )

    def _highest(self, number: int) -> list[str]:
        return [
            name
            for name in self._incidence[number]
            if derivative_name(name) not in self._names and name not in self._defined
        ]

    def _match(self, matching: Matching, number: int) -> None:
        while True:
            if self._incidence_is_stale:  # some names have got derivatives and are no longer the highest ones
                matching.incidence = {row: self._highest(row) for row in matching.column_of}
                self._incidence_is_stale = False
                for row, column in list(matching.column_of.items()):
                    if derivative_name(column) in self._names:
                        del matching.column_of[row], matching.row_of[column]
                        if row != number:
                            raise AssertionError("a matched variable got a derivative without its equation")
            matching.incidence[number] = self._highest(number)
            found, reached_rows, reached_columns = matching.search(number)
            if found:
                return
            self._incidence_is_stale = True
            for name in reached_columns:
                self._names.setdefault(derivative_name(name))
            created = {}
            for row in reached_rows:
                created[row] = self._add_derivative(self._equations[row]).number
            for name in reached_columns:
                row = matching.row_of.pop(name)
                matching.column_of[created[row]] = derivative_name(name)
                matching.row_of[derivative_name(name)] = created[row]
                del matching.column_of[row]
            number = created[number]

    # --- states ---

    def _select_states(self) -> ReducedSystem:
        names = list(self._names)
        stabilized, invariants = self._invariants()
        forced = {name for equation in invariants for name in self._incidence[equation]}
        candidates = [name for name in names if derivative_name(name) in self._names and name not in forced]
        unknown = self._choose_unknowns(candidates, forced)
        states = [name for name in names if name in forced or (name in candidates and name not in unknown)]
        rejected = [name for name in unknown if self._select(name) is ir.StateSelect.ALWAYS]
        return ReducedSystem(
            equations=self._equations,
            unknowns=names,
            states=states,
            dummies=[derivative_name(name) for name in unknown],
            stabilized=stabilized,
            rejected_states=rejected,
            unit_vectors=[tuple(self._incidence[equation]) for equation in invariants],
        )

    def _choose_unknowns(self, candidates: Sequence[str], forced: set[str]) -> dict[str, None]:
        """The candidates that are no states: poor states first, as long as the equations can determine them.

        The equations must determine everything that is no state. A derivative can only be a state if what it is
        the derivative of is one; that keeps the choices of all orders of differentiation nested, as the method
        of dummy derivatives demands.
        """
        rows = [equation.number for equation in self._equations if not equation.is_invariant]
        rows_of: dict[str, list[str]] = {name: [] for name in self._names}
        for row in rows:
            for name in self._incidence[row]:
                rows_of[name].append(str(row))
        numbers = {name: position for position, name in enumerate(self._names)}
        matching = Matching({numbers[name]: rows_of[name] for name in self._names})
        possible = set(candidates)
        for name in self._names:
            if name not in possible and name not in forced and not matching.augment(numbers[name]):
                raise InputError(f"no equation determines {name} once the states are given", place=self._place_of(name))
        unknown: dict[str, None] = {}
        constant = self._constant_rates(candidates)
        for name in sorted(candidates, key=lambda name: self._preference(name, name in constant)):
            if len(matching.row_of) == len(rows):
                break
            derivative = derivative_name(name)
            if derivative in possible and derivative not in unknown:
                continue
            if matching.augment(numbers[name]):
                unknown[name] = None
        if len(matching.row_of) < len(rows):
            row = next(row for row in rows if str(row) not in matching.row_of)
            raise UnsupportedModelError(
                "no states can be chosen for a constraint",
                place=self._place(self._equations[row].span),
                remedy="give the variables that shall be states stateSelect = StateSelect.always",
            )
        return unknown

    def _place_of(self, name: str) -> Place:
        variable = self._model.variables.get(_inner(name)[1])
        return self._place(variable.span if variable is not None else None)

    def _constant_rates(self, candidates: Sequence[str]) -> set[str]:
        """Candidates whose derivative some differentiated equation contains with a constant factor."""
        found: set[str] = set()
        rates = {derivative_name(name): name for name in candidates}
        for equation in self._equations:
            if equation.derivative_of is None:
                continue
            for rate in self._incidence[equation.number]:
                name = rates.get(rate)
                if name is None or name in found:
                    continue
                slope = ex.Differentiation(_only(rate))(equation.residual)
                if not isinstance(slope, Node):
                    found.add(name)
        return found

    def _invariants(self) -> tuple[dict[int, float | Node], list[int]]:
        """Norms of vectors of possible states that are all equally eligible."""
        stabilized: dict[int, float | Node] = {}
        invariants: list[int] = []
        for equation in self._equations:
            if equation.derivative is None or equation.derivative_of is not None:
                continue
            derivative = self._equations[equation.derivative]
            if derivative.derivative is not None or not _is_norm(equation.residual, self._incidence[equation.number]):
                continue
            selects = {self._model.variables[name].state_select for name in self._incidence[equation.number]}
            if len(selects) != 1:
                continue
            equation.is_invariant = True
            self._owners.update(name.rpartition(".")[0] for name in self._incidence[equation.number])
            invariants.append(equation.number)
            stabilized[derivative.number] = ex.add(
                derivative.residual, ex.multiply(STABILIZATION_RATE, equation.residual)
            )
        return stabilized, invariants

    def _select(self, name: str) -> ir.StateSelect:
        if unwrapped(name)[0] == "der":
            return ir.StateSelect.NEVER
        return self._model.variables[name].state_select

    def _preference(self, name: str, is_explicit: bool) -> tuple[int, bool, int]:
        """How well a variable serves as a state; low values are dropped first.

        Below StateSelect.prefer, what the differentiated equations give explicitly is dropped before what they
        do not: a body's orientation is a better state than the height of a point on it. Then fixed start values
        count, which need no solving at initialization, and stateSelect. Beside a body's
        quaternions its own angular velocity is the best state: the accelerations of all other bodies follow
        from its derivative in the direction in which their equations are written.

        Args:
            name: the variable.
            is_explicit: = true, if a differentiated equation has its derivative with a constant factor.
        """
        if unwrapped(name)[0] == "der":
            return (0, False, 0)
        select = self._select(name)
        is_own = name in self._angular_velocities and name.rpartition(".")[0] in self._owners
        if select in (ir.StateSelect.AVOID, ir.StateSelect.DEFAULT):
            group = 2 if is_explicit and not is_own else 3
        else:
            group = 1 if select is ir.StateSelect.NEVER else 4
        return (group, self._model.variables[name].fixed, select.value)


def explicit_variables(residual: float | Node) -> list[str]:
    """Symbols that ``residual = 0`` gives by an addition alone: one side of the difference, found nowhere else."""
    if not isinstance(residual, Node):
        return []
    sides = residual.args if residual.op in ("sub", "add") else (residual,)
    result = []
    for position, side in enumerate(sides):
        inner = side.args[0] if side.op == "neg" else side
        if inner.op == "symbol" and inner.name not in ex.symbols(*(s for i, s in enumerate(sides) if i != position)):
            result.append(inner.name)
    return result


def _only(name: str) -> Callable[[str], float | Node]:
    """Rates for the partial derivative by one symbol."""
    return lambda other: 1 if other == name else 0


class _NotDifferentiableError(Exception):
    """An expression has no derivative by time; the message says what."""


def _is_norm(residual: float | Node, names: Sequence[str]) -> bool:
    """True for a sum of squares of ``names`` less a constant."""
    if len(names) < 2:
        return False
    for name in names:
        if unwrapped(name)[0]:
            return False
        first = ex.Differentiation(_only(name))(residual)
        second = ex.Differentiation(_only(name))(first)
        if isinstance(second, Node) or second == 0 or ex.symbols(first) != [name]:
            return False
        offset: Mapping[str, float | Node] = {name: 0}
        if ex.Substitution(offset)(first) != 0:
            return False
    return True
