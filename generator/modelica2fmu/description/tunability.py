"""Which parameters have an effect when they are set while an FMU runs."""

from __future__ import annotations

from collections.abc import Iterator

from modelica2fmu.equations.alias import ReducedModel
from modelica2fmu.expand.scalar_model import Kind
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class Tunability:
    """Answers for the variables of one model; start values and initial equations do not count as use.

    Args:
        reduced: the model.
    """

    def __init__(self, reduced: ReducedModel) -> None:
        self._variables = reduced.model.variables
        self._replacements = reduced.replacements
        self._calls = {output: call for call in reduced.model.calls for output in call.outputs}
        self._used = self._closure(ex.symbols(*_roots(reduced)))
        self._memo: dict[str, bool] = {}

    def is_tunable(self, name: str) -> bool:
        """True for a Real parameter that is used after initialization, and for what is computed from one."""
        if name not in self._memo:
            self._memo[name] = False  # of itself a value does not depend on anything
            self._memo[name] = self._decide(name)
        return self._memo[name]

    def _decide(self, name: str) -> bool:
        variable = self._variables.get(name)
        if variable is None or variable.type != "Real":
            return False
        by = self._replacements.get(name)
        if isinstance(by, Node):
            return any(self.is_tunable(inner) for inner in ex.symbols(by))
        inputs = self._inputs(name)
        if inputs:
            return any(self.is_tunable(inner) for inner in inputs)
        return variable.kind is Kind.PARAMETER and name in self._used

    def _inputs(self, name: str) -> list[str]:
        """Symbols from which the value of a parameter is computed."""
        call = self._calls.get(name)
        if call is not None:
            return ex.symbols(*call.inputs())
        variable = self._variables.get(name)
        value = variable.value if variable is not None else None
        return ex.symbols(value) if isinstance(value, Node) else []

    def _closure(self, names: list[str]) -> set[str]:
        used: set[str] = set()
        followed: set[int] = set()  # calls: one may have thousands of outputs, which all need the same inputs
        stack = list(names)
        while stack:
            name = stack.pop()
            if name in used:
                continue
            used.add(name)
            call = self._calls.get(name)
            if call is not None and call.number in followed:
                continue
            if call is not None:
                followed.add(call.number)
            stack.extend(self._inputs(name))
        return used


def _roots(reduced: ReducedModel) -> Iterator[float | Node]:
    """All expressions that are computed after initialization."""
    model = reduced.model
    for equation in reduced.equations:
        yield from (equation.left, equation.right)
    for relation in model.relations:
        yield relation.indicator
    for item in model.reinitializations:
        yield from (item.trigger, item.value)
    for check in model.asserts:
        yield from (check.condition, check.trigger if check.trigger is not None else 0.0)
    for termination in model.terminations:
        yield termination.trigger
    for sample in model.samples:
        yield from (sample.start, sample.interval)
    yield from model.time_thresholds
