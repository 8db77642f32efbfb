"""State selection: which variables are states once the equations have been differentiated.

Which derivatives become algebraic unknowns: Mattsson and Soederlind 1993, "Index reduction in differential-algebraic
equations using dummy derivatives". The choice is greedy by stateSelect, which is optimal because the sets of unknowns
that can be matched form a matroid (Edmonds and Fulkerson 1965).

The norm of a quaternion, ``Q * Q = 1``, is an invariant: no three of the four components are states for all
orientations. All four become states, and the differentiated equation is stabilized (Baumgarte 1972, "Stabilization of
constraints and integrals of motion in dynamical systems"): ``der(g) + k g = 0``.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Final

from contact_foundation.errors import InputError, Place, UnsupportedModelError

from modelica2fmu.equations.continuous_system import ContinuousEquation, ReducedSystem, order_and_variable
from modelica2fmu.equations.matching import Matching
from modelica2fmu.expand.scalar_model import ScalarModel, derivative_name, unwrapped
from modelica2fmu.frontend import ir
from modelica2fmu.library.source_map import Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

STABILIZATION_RATE: Final = 10.0


class StateSelection:
    """Selects the states of a differentiated system.

    Args:
        model: for the attributes of variables.
        equations: original and differentiated ones; those that are invariants are marked.
        incidence: continuous symbols of each equation.
        names: all continuous symbols, derivatives included.
        angular_velocities: symbols that are components of some frame's angular velocity.
        place: place of a span.
    """

    def __init__(
        self,
        model: ScalarModel,
        equations: list[ContinuousEquation],
        incidence: Mapping[int, Sequence[str]],
        names: Mapping[str, None],
        angular_velocities: Collection[str],
        place: Callable[[Span | None], Place],
    ) -> None:
        self._model = model
        self._equations = equations
        self._incidence = incidence
        self._names = names
        self._angular_velocities = angular_velocities
        self._place = place
        self._owners: set[str] = set()  # components whose quaternions are states

    def run(self) -> ReducedSystem:
        """The system with its states.

        Raises:
            InputError: an unknown is determined by no equation once the states are given.
            UnsupportedModelError: no states can be chosen for a constraint.
        """
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
        variable = self._model.variables.get(order_and_variable(name)[1])
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


def _only(name: str) -> Callable[[str], float | Node]:
    """Rates for the partial derivative by one symbol."""
    return lambda other: 1 if other == name else 0


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
