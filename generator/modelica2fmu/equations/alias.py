"""Removes trivial equations: variables that are constant, equal to or the negative of another, or parameters.

About four of five scalar equations of a multibody model are connections and copies. They are found repeatedly,
because each substitution makes further equations trivial, and replaced everywhere.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Final

from contact_foundation.errors import InputError

from modelica2fmu.expand.bounds_check import beyond_integers
from modelica2fmu.expand.scalar_model import (
    CallArgument,
    ExternalCall,
    Kind,
    Relation,
    ScalarEquation,
    ScalarModel,
    ScalarVariable,
    derivative_name,
    previous_name,
)
from modelica2fmu.frontend import ir
from modelica2fmu.library.source_map import SourceMap
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_PARAMETERS: Final = frozenset({Kind.CONSTANT, Kind.PARAMETER})
_TOLERANCE: Final = 1e-9


@dataclass
class ReducedModel:
    """A scalar model without trivial equations.

    Attributes:
        model: variables, relations, calls, actions; all expressions in terms of what is left.
        equations: the equations that are left.
        initial_equations: initial equations in terms of what is left.
        replacements: what each removed variable is: a number, a symbol or its negative.
        invariants: variables that depend on parameters alone, with their values, in order of evaluation; they are
            parameters of ``model``.
    """

    model: ScalarModel
    equations: list[ScalarEquation]
    initial_equations: list[ScalarEquation]
    replacements: dict[str, float | Node]
    invariants: list[tuple[str, float | Node]] = field(default_factory=list)


def eliminate_aliases(model: ScalarModel, source_map: SourceMap) -> ReducedModel:
    """The model without trivial equations; raises InputError if equations contradict each other."""
    return _Eliminator(model, source_map).run()


def signed_terms(node: float | Node) -> tuple[float, dict[str, int]] | None:
    """Constant and signs of the symbols of a sum of symbols, if each occurs once; ``None`` for anything else."""
    constant = 0.0
    signs: dict[str, int] = {}
    stack: list[tuple[float | Node, int]] = [(node, 1)]
    while stack:
        item, sign = stack.pop()
        if not isinstance(item, Node):
            constant += sign * item
        elif item.op == "constant":
            constant += sign * item.value
        elif item.op == "symbol":
            if item.name in signs or len(signs) >= 2:
                return None
            signs[item.name] = sign
        elif item.op == "neg":
            stack.append((item.args[0], -sign))
        elif item.op == "add":
            stack.extend((arg, sign) for arg in item.args)
        elif item.op == "sub":
            stack.extend(((item.args[0], sign), (item.args[1], -sign)))
        else:
            return None
    return constant, signs


class _Eliminator:
    def __init__(self, model: ScalarModel, source_map: SourceMap) -> None:
        self._model = model
        self._source_map = source_map
        self._variables = {name: replace(variable) for name, variable in model.variables.items()}
        self._replacements: dict[str, float | Node] = {}
        self._invariants: dict[str, float | Node] = {}
        self._fresh: dict[str, float | Node] = {}
        self._removed_starts: list[ScalarEquation] = []
        # A variable that an assignment of a when-clause or algorithm computes stays, and so does one that
        # reinit() sets, so that the assignment keeps its target.
        self._kept = {equation.target for equation in model.equations if equation.target is not None}
        self._kept |= {item.state for item in model.reinitializations}
        self._kept |= {output for call in model.calls for output in call.outputs}

    def run(self) -> ReducedModel:
        equations = list(self._model.equations)
        while True:
            self._fresh = {}
            remaining = [equation for equation in equations if not self._consume(equation)]
            if not self._fresh and len(remaining) == len(equations):
                break
            substitution = self._substitution()
            equations = [self._substituted(equation, substitution) for equation in remaining]
        return self._result(equations)

    # --- one equation ---

    def _consume(self, equation: ScalarEquation) -> bool:
        """Takes a trivial equation in; false if the equation stays."""
        if equation.target is not None:
            return False
        residual = ex.subtract(equation.left, equation.right)
        if not isinstance(residual, Node):
            self._check(residual, equation)
            return True
        terms = signed_terms(residual)
        if terms is not None:
            constant, signs = terms
            if not signs:
                self._check(constant, equation)
                return True
            if len(signs) == 1:
                ((name, sign),) = signs.items()
                if self._removable(name):
                    self._require_integer(name, -constant * sign, equation)
                    self._remove(name, -constant * sign)
                    return True
            elif constant == 0 and self._merge(signs):
                return True
        return self._take_invariant(equation)

    def _check(self, residual: float, equation: ScalarEquation) -> None:
        if not abs(residual) <= _TOLERANCE:
            raise InputError(
                f"equations contradict each other: {equation.left} = {equation.right}",
                place=self._source_map.place(equation.span),
            )

    def _require_integer(self, name: str, value: float, equation: ScalarEquation) -> None:
        wrong = beyond_integers(self._variables[name], value)
        if wrong:
            place = self._source_map.place(equation.span)
            raise InputError(f"{name} is {wrong}", place=place, remedy="declare it as Real")

    def _is_parameter(self, name: str) -> bool:
        variable = self._model.variables.get(name)
        return variable is not None and variable.kind in _PARAMETERS

    def _is_unknown(self, name: str) -> bool:
        variable = self._variables.get(name)
        return variable is not None and variable.kind in (Kind.CONTINUOUS, Kind.DISCRETE)

    def _removable(self, name: str) -> bool:
        return (
            self._is_unknown(name)
            and name not in self._kept
            and name not in self._fresh
            and name not in self._replacements
            and name not in self._invariants
        )

    def _remove(self, name: str, by: float | Node) -> None:
        if isinstance(by, float):
            by = 0.0 if by == 0 else by
            self._keep_start(self._variables[name], by, by)
            if self._variables[name].type != "Real" and by.is_integer():
                by = bool(by) if self._variables[name].type == "Boolean" else int(by)
        self._fresh[name] = by

    def _merge(self, signs: dict[str, int]) -> bool:
        (first, first_sign), (second, second_sign) = signs.items()
        for name in (first, second):
            if name in self._fresh or name not in self._variables:
                return False
        a, b = self._variables[first], self._variables[second]
        if not (self._is_real(a) == self._is_real(b) and (self._is_real(a) or a.type == b.type)):
            return False
        sign = -first_sign * second_sign
        if sign < 0 and a.type == "Boolean":
            return False
        if self._rank(a) > self._rank(b):
            kept, removed = a, b
        else:
            kept, removed = b, a
        if not self._removable(removed.name):
            kept, removed = removed, kept
            if not self._removable(removed.name):
                return False
        if kept.kind is Kind.CONTINUOUS and removed.kind is Kind.DISCRETE:
            return False
        node = ex.symbol(kept.name)
        by = node if sign > 0 else ex.negate(node)
        if not self._is_unknown(kept.name):
            self._keep_start(removed, by, by)
        else:
            if kept.fixed:
                self._keep_start(removed, by, _signed(kept.start, sign))
            self._inherit(kept, removed, sign)
        self._remove(removed.name, by)
        # What was replaced by a variable in this pass must not be replaced itself before the next.
        self._fresh.setdefault(kept.name, node) if self._is_unknown(kept.name) else None
        return True

    @staticmethod
    def _is_real(variable: ScalarVariable) -> bool:
        return variable.type == "Real"

    def _rank(self, variable: ScalarVariable) -> tuple[int, bool, bool, bool, int]:
        order = {
            Kind.CONSTANT: 5,
            Kind.PARAMETER: 4,
            Kind.FREE_PARAMETER: 4,
            Kind.INPUT: 3,
            Kind.DISCRETE: 2,
            Kind.CONTINUOUS: 1,
        }
        return (
            order[variable.kind],
            variable.name in self._kept,
            variable.declaration is not None,
            variable.fixed,
            -variable.name.count("."),
        )

    @staticmethod
    def _inherit(kept: ScalarVariable, removed: ScalarVariable, sign: int) -> None:
        start = _signed(removed.start, sign)
        if removed.fixed and not kept.fixed:
            kept.fixed, kept.start = True, start
        elif kept.start in (None, 0, 0.0) and start is not None and not kept.fixed:
            kept.start = start
        if removed.state_select.value != ir.StateSelect.DEFAULT.value:
            selects = [kept.state_select.value, removed.state_select.value]
            if kept.state_select is ir.StateSelect.DEFAULT:
                selects = selects[1:]
            kept.state_select = ir.StateSelect(max(selects))
        if kept.nominal is None:
            kept.nominal = removed.nominal
        if kept.orientation is None and sign > 0:
            kept.orientation = removed.orientation

    def _keep_start(self, removed: ScalarVariable, by: float | Node, other: float | str | Node | None) -> None:
        """A fixed start value of a variable that is ``by`` must be that which holds there.

        Args:
            other: what holds there: a number, or an expression of parameters or variables.
        """
        if not removed.fixed or removed.kind is not Kind.CONTINUOUS:
            return
        start, there = (value if isinstance(value, float | int | Node) else 0.0 for value in (removed.start, other))
        if isinstance(start, Node) or isinstance(there, Node):
            self._removed_starts.append(ScalarEquation(by, start, removed.span))
        elif not abs(start - there) <= _TOLERANCE * (abs(start) + 1):
            raise InputError(
                f"{removed.name} has the fixed start value {start:g}, but is {by}, which is {there:g} there",
                place=self._source_map.place(removed.span),
                remedy="fix one of the start values, or make them equal",
            )

    def _take_invariant(self, equation: ScalarEquation) -> bool:
        for side, other in ((equation.left, equation.right), (equation.right, equation.left)):
            if not (isinstance(side, Node) and side.op == "symbol" and self._removable(side.name)):
                continue
            names = ex.symbols(other)
            if names and all(self._is_known(name) for name in names):
                self._keep_start(self._variables[side.name], side, other)
                self._invariants[side.name] = other
                return True
        return False

    def _is_known(self, name: str) -> bool:
        return name in self._invariants or self._is_parameter(name)

    # --- substitution ---

    def _substitution(self) -> ex.Substitution:
        for name, by in list(self._fresh.items()):
            if isinstance(by, Node) and by.op == "symbol" and by.name == name:
                del self._fresh[name]
        step = ex.Substitution(self._wrapped(self._fresh))
        self._replacements = {name: step(by) for name, by in self._replacements.items()}
        self._replacements.update(self._fresh)
        self._invariants = {name: step(value) for name, value in self._invariants.items()}
        return step

    def _wrapped(self, replacements: Mapping[str, float | Node]) -> dict[str, float | Node]:
        """Replacements of variables with those of their derivatives and previous values."""
        mapping = dict(replacements)
        for name, by in replacements.items():
            inner = by.args[0] if isinstance(by, Node) and by.op == "neg" else by
            negative = inner is not by
            if isinstance(inner, Node) and not self._is_parameter(inner.name):
                rate: float | Node = ex.symbol(derivative_name(inner.name))
                before: float | Node = ex.symbol(previous_name(inner.name))
                if self._variables[inner.name].kind is Kind.DISCRETE:
                    rate = 0
            else:
                rate, before = 0, inner
            mapping[derivative_name(name)] = ex.negate(rate) if negative else rate
            mapping[previous_name(name)] = ex.negate(before) if negative else before
        for name in self._invariants:
            mapping[derivative_name(name)] = 0
            mapping[previous_name(name)] = ex.symbol(name)
        return mapping

    @staticmethod
    def _substituted(equation: ScalarEquation, substitution: ex.Substitution) -> ScalarEquation:
        left, right = substitution(equation.left), substitution(equation.right)
        if left is equation.left and right is equation.right:
            return equation
        return replace(equation, left=left, right=right)

    # --- result ---

    def _result(self, equations: list[ScalarEquation]) -> ReducedModel:
        apply = ex.Substitution(self._wrapped(self._replacements))
        equations = [self._substituted(equation, apply) for equation in equations]
        starts = [*self._model.initial_equations, *self._removed_starts]
        initial = [self._substituted(equation, apply) for equation in starts]
        model = self._model
        reduced = ScalarModel(
            name=model.name,
            description=model.description,
            variables=self._variables,
            equations=equations,
            initial_equations=initial,
            calls=[substituted_call(call, apply) for call in model.calls],
            relations=[_relation(item, apply) for item in model.relations],
            reinitializations=[
                replace(item, trigger=apply(item.trigger), value=apply(item.value)) for item in model.reinitializations
            ],
            asserts=[
                replace(
                    item,
                    condition=apply(item.condition),
                    trigger=None if item.trigger is None else apply(item.trigger),
                    message=replace(
                        item.message,
                        parts=tuple(
                            ex.node_of(apply(part)) if isinstance(part, Node) else part for part in item.message.parts
                        ),
                    ),
                )
                for item in model.asserts
            ],
            terminations=[replace(item, trigger=apply(item.trigger)) for item in model.terminations],
            samples=model.samples,
            time_thresholds=[apply(item) for item in model.time_thresholds],
            enumerations=model.enumerations,
            external_annotations=model.external_annotations,
            warnings=model.warnings,
        )
        for variable in self._variables.values():
            if isinstance(variable.start, Node):
                variable.start = apply(variable.start)
        invariants = self._sorted_invariants()
        for name, value in invariants:
            self._variables[name].kind = Kind.PARAMETER
            self._variables[name].value = value
        return ReducedModel(
            model=reduced,
            equations=equations,
            initial_equations=initial,
            replacements=dict(self._replacements),
            invariants=invariants,
        )

    def _sorted_invariants(self) -> list[tuple[str, float | Node]]:
        order: dict[str, float | Node] = {}

        def visit(name: str) -> None:
            if name in order or name not in self._invariants:
                return
            for inner in ex.symbols(self._invariants[name]):
                visit(inner)
            order[name] = self._invariants[name]

        for name in self._invariants:
            visit(name)
        return list(order.items())


def _signed(value: float | str | Node | None, sign: int) -> float | str | Node | None:
    return ex.negate(value) if sign < 0 and isinstance(value, float | int | Node) else value


def substituted_call(call: ExternalCall, apply: ex.Substitution) -> ExternalCall:
    """The call with its inputs replaced."""
    args: list[CallArgument] = []
    for argument in call.args:
        if argument.is_output:
            args.append(argument)
            continue
        values = tuple(apply(value) if isinstance(value, Node) else value for value in argument.values)
        args.append(replace(argument, values=values))
    return replace(call, args=tuple(args))


def _relation(item: Relation, apply: ex.Substitution) -> Relation:
    return replace(item, indicator=ex.node_of(apply(item.indicator)))
