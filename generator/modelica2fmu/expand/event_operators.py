"""Relations, steps, samples and values before events: what makes an FMU stop at events."""

from __future__ import annotations

from typing import Any

from contact_foundation.errors import UnsupportedModelError

from modelica2fmu.expand.scalar_model import (
    INITIAL,
    TERMINAL,
    TIME,
    Kind,
    Relation,
    SampleCounter,
    ScalarEquation,
    ScalarModel,
    ScalarVariable,
    previous_name,
    unwrapped,
)
from modelica2fmu.expand.scalar_values import KNOWN_KINDS, is_fixed_while_simulating
from modelica2fmu.interpreter.value_functions import relation
from modelica2fmu.library.source_map import SourceMap, Span
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node


class EventOperators:
    """Adds what generates events to a scalar model, equal ones once.

    Args:
        result: the model that is made; its variables are declared.
        source_map: for the places in error messages.
    """

    def __init__(self, result: ScalarModel, source_map: SourceMap) -> None:
        self._result = result
        self._source_map = source_map
        self._relations: dict[Node, Relation] = {}
        self._samples: dict[tuple[Any, Any], str] = {}
        self._time_relations: dict[Node, str] = {}
        self._steps: dict[tuple[str, Node], str] = {}

    def previous(self, value: float | Node) -> float | Node:
        """See :class:`interpreter_host.Host`."""
        mapping: dict[str, float | Node] = {}
        for name in ex.symbols(value):
            variable = self._result.variables.get(name)
            if variable is not None and variable.kind not in KNOWN_KINDS:
                mapping[name] = ex.symbol(previous_name(name))
        return ex.Substitution(mapping)(value)

    def relation(self, op: str, left: float | Node, right: float | Node) -> bool | Node:
        """See :class:`interpreter_host.Host`."""
        plain = relation(op, left, right)
        if not isinstance(plain, Node) or self._is_discrete(plain):
            return plain
        greater, smaller = (left, right) if op in ("gt", "le") else (right, left)
        indicator = ex.subtract(greater, smaller)
        if not isinstance(indicator, Node):
            return plain
        threshold = self._time_threshold(indicator)
        if threshold is not None:
            return self._time_relation(plain, indicator, threshold)
        node = self._held(indicator)
        return ex.logical_not(node) if op in ("le", "ge") else node

    def _held(self, indicator: float | Node) -> Node:
        """The relation ``indicator > 0``, held between events."""
        key = ex.node_of(indicator)
        held = self._relations.get(key)
        if held is None:
            held = Relation(len(self._result.relations) + 1, key)
            self._relations[key] = held
            self._result.relations.append(held)
        return ex.symbol(held.name)

    def _time_relation(self, plain: Node, indicator: Node, threshold: float | Node) -> bool | Node:
        """A relation between the time and something discrete: a Boolean that changes at a known time.

        At that time itself it has its later value, whether it is strict or not, since no event would follow.
        """
        rises = ex.Differentiation(lambda name: 1 if name == TIME else 0)(indicator) == 1
        passed = ex.less_equal(threshold, ex.symbol(TIME))
        after: float | Node = passed if rises else ex.logical_not(passed)
        if plain.op == "le":  # the indicator is that of the negation
            after = ex.logical_not(after)
        name = self._time_relations.get(ex.node_of(after))
        if name is None:
            name = f"$time[{len(self._time_relations) + 1}]"
            self._time_relations[ex.node_of(after)] = name
            self._result.variables[name] = ScalarVariable(name, "Boolean", Kind.DISCRETE, start=False)
            value = ex.select(ex.symbol(INITIAL), plain, after)
            self._result.equations.append(ScalarEquation(ex.symbol(name), value, target=name))
            self._result.time_thresholds.append(threshold)
        return ex.symbol(name)

    def _time_threshold(self, indicator: Node) -> float | Node | None:
        """The time at which an indicator that is linear in time alone vanishes."""
        rate = ex.Differentiation(lambda name: 1 if name == TIME else 0)(indicator)
        if rate not in (1, -1):
            return None
        rest = ex.Substitution({TIME: 0})(indicator)
        if isinstance(rest, Node) and not self._is_discrete(rest):
            return None
        return ex.negate(rest) if rate == 1 else rest

    def _is_discrete(self, node: Node) -> bool:
        for name in ex.symbols(node):
            wrapper, inner = unwrapped(name)
            if wrapper == "pre" or name in (INITIAL, TERMINAL) or name.startswith("relation["):
                continue
            variable = self._result.variables.get(inner)
            if wrapper == "der" or name == TIME or variable is None:
                return False
            if variable.kind in (Kind.CONTINUOUS, Kind.INPUT) and variable.type == "Real":
                return False
        return True

    def step(self, op: str, value: float | Node) -> float | Node:
        """See :class:`interpreter_host.Host`; a discrete variable with an event where it has to change."""
        if not isinstance(value, Node) or self._is_discrete(value):
            return ex.unary("floor", value) if op == "floor" else ex.binary("quotient", value, 1)
        name = self._steps.get((op, value))
        if name is None:
            name = f"$step[{len(self._steps) + 1}]"
            self._steps[op, value] = name
            self._result.variables[name] = ScalarVariable(name, "Real", Kind.DISCRETE, start=0)
            rounded = ex.unary("floor", value) if op == "floor" else ex.binary("quotient", value, 1)
            self._result.equations.append(ScalarEquation(ex.symbol(name), rounded, target=name))
            before: float | Node = ex.symbol(previous_name(name))
            below, above = before, ex.add(before, 1)
            if op == "quotient":  # towards zero: 0 belongs to the values between -1 and 1
                below = ex.select(ex.less_equal(before, 0), ex.subtract(before, 1), before)
                above = ex.select(ex.less_equal(0, before), above, before)
            # Events by these indicators, also where time alone makes the value grow: an event at a time computed
            # in advance may come a rounding too early for the new value.
            self._held(ex.subtract(value, above))
            self._held(ex.subtract(below, value))
        return ex.symbol(name)

    def sample(self, start: float | Node, interval: float | Node, span: Span | None) -> bool | Node:
        """See :class:`interpreter_host.Host`; true in the event iteration in which the count of samples rises."""
        for value in (start, interval):
            if isinstance(value, Node) and not is_fixed_while_simulating(self._result, value):
                raise UnsupportedModelError(
                    "sample() with a start or interval that changes is not translated",
                    place=self._source_map.place(span),
                )
        key = (start, interval)
        name = self._samples.get(key)
        if name is None:
            name = f"$sample[{len(self._samples) + 1}]"
            self._samples[key] = name
            self._result.variables[name] = ScalarVariable(name, "Integer", Kind.DISCRETE, start=0)
            self._result.samples.append(SampleCounter(name, start, interval))
            since = ex.subtract(ex.symbol(TIME), start)
            # Half a billionth of an interval covers the rounding of event times.
            reached = ex.add(ex.unary("floor", ex.add(ex.divide(since, interval), 5e-10)), 1)
            before = ex.unary("ceil", ex.subtract(ex.divide(since, interval), 5e-10))
            count = ex.select(ex.symbol(INITIAL), ex.binary("max", before, 0), ex.binary("max", reached, 0))
            self._result.equations.append(ScalarEquation(ex.symbol(name), count, span, target=name))
        node = ex.symbol(name)
        changed = ex.not_equal(node, ex.symbol(previous_name(name)))
        return ex.logical_and(ex.logical_not(ex.symbol(INITIAL)), changed)
