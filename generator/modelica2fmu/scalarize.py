"""Expands a flat model to scalars: arrays, functions, loops, when-clauses and algorithms."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from cmb_base.errors import InputError, UnsupportedModelError

from modelica2fmu import arrays, ir
from modelica2fmu import expression as ex
from modelica2fmu.arrays import Record, Scalar, Text, Value
from modelica2fmu.call_expansion import CallExpansion
from modelica2fmu.expression import Node
from modelica2fmu.interpreter import Interpreter
from modelica2fmu.scalar_model import (
    INITIAL,
    TERMINAL,
    TIME,
    CallArgument,
    Kind,
    Relation,
    SampleCounter,
    ScalarAssert,
    ScalarEquation,
    ScalarModel,
    ScalarVariable,
    derivative_name,
    previous_name,
    unwrapped,
)
from modelica2fmu.scalar_values import (
    BASE_TYPES,
    KNOWN_KINDS,
    as_number,
    element_names,
    only_parameters,
    text_of,
)
from modelica2fmu.source_map import SourceMap
from modelica2fmu.tables import is_table_function
from modelica2fmu.value_functions import relation
from modelica2fmu.when_expansion import WhenExpansion


def scalarize(model: ir.FlatModel, source_map: SourceMap, files: Callable[[str], Path] = Path) -> ScalarModel:
    """The scalar form of ``model``.

    Args:
        model: what to expand.
        source_map: for the places in error messages.
        files: the file that a name in the model means.

    Raises:
        UnsupportedModelError: a construct that is not translated.
        InputError: the model is wrong (a parameter without value, operands that do not fit).
    """
    return _Scalarizer(model, source_map, files).run()


class _Scalarizer:
    """Host of the interpreter and builder of the scalar model."""

    def __init__(self, model: ir.FlatModel, source_map: SourceMap, files: Callable[[str], Path]) -> None:
        self._model = model
        self._source_map = source_map
        self._interpreter = Interpreter(model, self, source_map)
        self._result = ScalarModel(model.name, model.description)
        self._values: dict[str, Value] = {}
        self._in_progress: set[str] = set()
        self._relations: dict[Node, Relation] = {}
        self._samples: dict[tuple[Any, Any], str] = {}
        self._time_relations: dict[Node, str] = {}
        self._steps: dict[tuple[str, Node], str] = {}
        self._delays: dict[tuple[float | Node, ...], int] = {}
        self._assigned_in_when = self._targets_of_whens()
        self._enumeration_names = {literal.rsplit(".", 1)[0] for literal in model.enumeration_literals}
        self._structural: set[str] = set()
        self._external_calls = CallExpansion(
            self._result,
            self._interpreter,
            source_map,
            files,
            self.constant,
            lambda name: bool(self._enumeration_candidates(name)),
        )
        self._whens = WhenExpansion(model, self._result, self._interpreter, source_map)

    # --- run ---

    def run(self) -> ScalarModel:
        model, result = self._model, self._result
        variables = [variable for variable in model.variables.values() if not self._is_table(variable)]
        for variable in variables:
            self._declare(variable)
        for variable in variables:
            self._attributes(variable)
        for variable in variables:
            if variable.binding is not None and variable.variability not in ("parameter", "constant"):
                if variable.causality == "input" and variable.is_top_level and "." not in variable.name:
                    continue  # a default value of a top-level input
                self._equation_of_binding(variable)
        for equation in model.equations:
            result.equations.extend(self._equation(equation))
        for algorithm in model.algorithms:
            self._whens.algorithm(algorithm)
        for position, when in enumerate(model.whens):
            self._whens.when([(branch.condition, branch.body) for branch in when.branches], f"$when[{position + 1}]")
        for equation in model.initial_equations:
            result.initial_equations.extend(self._equation(equation, events=False))
        for algorithm in model.initial_algorithms:
            self._whens.initial_algorithm(algorithm)
        for item in (*model.asserts, *model.initial_asserts):
            self._assert(item)
        for name in self._structural:
            variable_ = result.variables[name]
            if variable_.kind is Kind.PARAMETER:
                variable_.kind = Kind.CONSTANT
                variable_.value = self._parameter_number(name, None)
        result.enumerations = self._enumerations()
        return result

    # --- variables ---

    def _is_table(self, variable: ir.Variable) -> bool:
        """A table of the Standard Library, which is no variable of the equations."""
        made = variable.binding
        function = self._model.functions.get(made.name) if isinstance(made, ir.Call) else None
        return function is not None and function.external is not None and is_table_function(function.external.name)

    def _targets_of_whens(self) -> set[str]:
        """Names (without subscripts) of the variables that when-clauses assign."""
        names: set[str] = set()

        def visit(statements: tuple[ir.Statement, ...], inside: bool) -> None:
            for statement in statements:
                match statement:
                    case ir.Assignment(target=target) if inside:
                        names.add(target.name)
                    case ir.CallAssignment(targets=targets) if inside:
                        names.update(target.name for target in targets if target is not None)
                    case ir.IfStatement(branches=branches, otherwise=otherwise):
                        for _, body in branches:
                            visit(body, inside)
                        visit(otherwise, inside)
                    case ir.For(body=body):
                        visit(body, inside)
                    case ir.WhenStatement(branches=branches):
                        for _, body in branches:
                            visit(body, True)

        for when in self._model.whens:
            for branch in when.branches:
                visit(branch.body, True)
        for algorithm in self._model.algorithms:
            visit(algorithm.statements, False)
        return names

    def _kind(self, variable: ir.Variable) -> Kind:
        if variable.variability == "constant":
            return Kind.CONSTANT
        if variable.variability == "parameter":
            if variable.fixed is not None and not all(variable.fixed):
                return Kind.FREE_PARAMETER
            return Kind.PARAMETER
        if variable.causality == "input" and variable.is_top_level and "." not in variable.name:
            return Kind.INPUT
        is_discrete = (
            variable.type != "Real"
            or variable.variability == "discrete"
            or variable.name in self._assigned_in_when
            or any(name in self._assigned_in_when for name in element_names(variable.name, variable.shape))
        )
        return Kind.DISCRETE if is_discrete else Kind.CONTINUOUS

    def _declare(self, variable: ir.Variable) -> None:
        kind = self._kind(variable)
        names = element_names(variable.name, variable.shape)
        fixed = variable.fixed or (False,)
        for position, name in enumerate(names):
            orientation = None
            if variable.orientation is not None and variable.shape == (3, 3):
                orientation = (variable.orientation, position // 3, position % 3)
            self._result.variables[name] = ScalarVariable(
                name=name,
                type=variable.type if variable.type in BASE_TYPES else self._enumeration(variable.type),
                kind=kind,
                fixed=fixed[position] if len(fixed) == len(names) else fixed[0],
                state_select=variable.state_select,
                orientation=orientation,
                declaration=variable,
                is_output=variable.causality == "output" and variable.is_top_level,
                span=variable.span,
            )

    def _enumeration_candidates(self, name: str) -> list[str]:
        return [full for full in self._enumeration_names if full == name or full.endswith("." + name)]

    def _enumeration(self, name: str) -> str:
        """The full name of an enumeration type that is known by ``name`` in its scope."""
        candidates = self._enumeration_candidates(name)
        # Of a type whose literals nobody mentions, only the ordinal is known.
        return max(candidates, key=lambda full: (len(full), full)) if candidates else "Integer"

    def enumeration_type(self, name: str) -> str | None:
        """See :class:`interpreter_host.Host`."""
        variable = self._model.variables.get(name)
        if variable is None or variable.type in BASE_TYPES:
            return None
        return self._enumeration(variable.type)

    def _enumerations(self) -> dict[str, tuple[str, ...]]:
        used = {variable.type for variable in self._result.variables.values()} - BASE_TYPES
        result: dict[str, tuple[str, ...]] = {}
        for name in sorted(used):
            literals = {
                ordinal: literal.rsplit(".", 1)[-1]
                for literal, ordinal in self._model.enumeration_literals.items()
                if literal.rsplit(".", 1)[0] == name and not literal.endswith("'")
            }
            result[name] = tuple(literals[ordinal] for ordinal in sorted(literals))
        return result

    def _attributes(self, variable: ir.Variable) -> None:
        names = element_names(variable.name, variable.shape)
        if not names:
            return
        if variable.variability in ("parameter", "constant"):
            self.variable(variable.name)
        elif variable.start is not None:
            for name, start in zip(names, self._broadcast(variable.start, names), strict=True):
                self._result.variables[name].start = self._plain(start)
        if self._result.variables[names[0]].kind is Kind.FREE_PARAMETER and variable.start is not None:
            for name, start in zip(names, self._broadcast(variable.start, names), strict=True):
                self._result.variables[name].start = self._plain(start)
        for attribute in ("minimum", "maximum", "nominal"):
            expression = getattr(variable, attribute)
            if expression is None:
                continue
            for name, value in zip(names, self._broadcast(expression, names), strict=True):
                if isinstance(value, float | int):
                    setattr(self._result.variables[name], attribute, float(value))

    def _broadcast(self, expression: ir.Expression, names: list[str]) -> list[Scalar]:
        value = self._interpreter.evaluate(expression, events=False)
        items = arrays.scalars(value)
        declared = self._model.variables.get(names[0].split("[")[0]) if names else None
        fits = not isinstance(value, np.ndarray) or declared is None or value.shape in ((1,), declared.shape)
        if len(items) == 1 and len(names) != 1:
            items = items * len(names)
        if len(items) != len(names) or not fits:
            raise InputError(
                f"an attribute of {names[0]} has {len(items)} elements instead of {len(names)}",
                place=self._source_map.place(expression.span),
            )
        return items

    @staticmethod
    def _plain(value: Scalar) -> float | str | Node | None:
        return None if isinstance(value, Text) else value

    # --- Host ---

    def variable(self, name: str) -> Value | None:
        """See :class:`interpreter_host.Host`."""
        value = self._values.get(name)
        if value is not None:
            return value
        declared = self._model.variables.get(name)
        if declared is None:
            record = self._model.records.get(name)
            if record is not None:
                fields = {item: self.variable(f"{name}.{item}") for item in record.fields}
                return Record({item: field for item, field in fields.items() if field is not None})
            scalar = self._result.variables.get(name)
            return ex.symbol(name) if scalar is not None else None
        if name in self._in_progress:
            raise InputError(f"the binding of {name} depends on itself", place=self._source_map.place(declared.span))
        self._in_progress.add(name)
        try:
            if self._is_table(declared):
                assert declared.binding is not None
                value = self._interpreter.evaluate(declared.binding, events=False)
                self._values[name] = value
                return value
            value = self._parameter(declared) if declared.variability in ("parameter", "constant") else None
        finally:
            self._in_progress.discard(name)
        if value is None:
            value = self._symbols(declared)
        self._values[name] = value
        return value

    @staticmethod
    def _symbols(variable: ir.Variable) -> Value:
        if not variable.shape:
            return ex.symbol(variable.name)
        result: arrays.Array = np.empty(variable.shape, dtype=object)
        flat = result.reshape(-1)
        for position, name in enumerate(element_names(variable.name, variable.shape)):
            flat[position] = ex.symbol(name)
        return result

    def _parameter(self, variable: ir.Variable) -> Value | None:
        """Evaluates a parameter; its constants as they are, what can change as symbols."""
        names = element_names(variable.name, variable.shape)
        scalars = [self._result.variables[name] for name in names]
        if scalars and scalars[0].kind is Kind.FREE_PARAMETER:
            return None
        expression = variable.binding if variable.binding is not None else variable.start
        if variable.binding is None and variable.start is not None and names:
            self._result.warnings.append(f"the parameter {variable.name} has no value, its start value is used")
        if expression is None:
            if not names:
                return arrays.filled(variable.shape, 0)
            if variable.type == "String":
                items: list[Scalar] = [""] * len(names)
            else:
                raise InputError(
                    f"the parameter {variable.name} has no value",
                    place=self._source_map.place(variable.span, variable.name),
                    remedy="give it a value in the model",
                )
        else:
            items = self._broadcast(expression, names)
        values: list[Scalar] = []
        for scalar, item in zip(scalars, items, strict=True):
            if isinstance(item, Text):
                raise UnsupportedModelError(
                    f"the String parameter {scalar.name} depends on variables",
                    place=self._source_map.place(variable.span),
                )
            if scalar.type == "Integer" and isinstance(item, float) and item.is_integer():
                item = int(item)
            scalar.value = item
            is_constant = not isinstance(item, Node) and (
                variable.variability == "constant"
                or variable.evaluate
                or variable.is_protected  # nobody outside can change it
                or isinstance(item, str)
            )
            if is_constant:
                scalar.kind = Kind.CONSTANT
                values.append(item)
            else:
                values.append(ex.symbol(scalar.name))
        if not variable.shape:
            return values[0]
        result: arrays.Array = np.empty(variable.shape, dtype=object)
        flat = result.reshape(-1)
        for position, value in enumerate(values):
            flat[position] = value
        return result

    def derivative(self, value: float | Node, span: ir.Span | None) -> float | Node:
        """See :class:`interpreter_host.Host`."""

        def rate(name: str) -> float | Node:
            if name == TIME:
                return 1
            variable = self._result.variables.get(name)
            if variable is None or variable.kind is Kind.CONTINUOUS:
                return ex.symbol(derivative_name(name))
            if variable.kind is Kind.INPUT:
                raise UnsupportedModelError(
                    f"the derivative of the input {name} is not translated", place=self._source_map.place(span)
                )
            return 0

        return ex.Differentiation(rate)(value)

    def previous(self, value: float | Node, span: ir.Span | None) -> float | Node:
        """See :class:`interpreter_host.Host`."""
        del span
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

    def sample(self, start: float | Node, interval: float | Node, span: ir.Span | None) -> bool | Node:
        """See :class:`interpreter_host.Host`; true in the event iteration in which the count of samples rises."""
        for value in (start, interval):
            if isinstance(value, Node) and not self._is_fixed_while_simulating(value):
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

    def delay(
        self, value: float | Node, delay: float | Node, longest: float | Node, span: ir.Span | None
    ) -> float | Node:
        """See :class:`interpreter_host.Host`; a call of the runtime, which keeps the history."""
        if not isinstance(value, Node) or only_parameters(self._result, value):
            return value
        if isinstance(longest, Node) and not self._is_fixed_while_simulating(longest):
            raise UnsupportedModelError(
                "delay() with a delay that changes and no longest one is not translated",
                place=self._source_map.place(span),
                remedy="give the longest delay as third argument",
            )
        key = (value, delay, longest)
        number = self._delays.setdefault(key, len(self._delays))
        reals = (CallArgument("Real", (item,), is_array=False, is_output=False) for item in key)
        position = CallArgument("Integer", (number,), is_array=False, is_output=False)
        instance = CallArgument("Instance", (), is_array=False, is_output=False)
        return self._external_calls.lookup("delay", "cmb_delay", (instance, position, *reals), span)

    def _is_fixed_while_simulating(self, node: Node) -> bool:
        """Parameters, also those that the initialization finds."""
        return all(
            (variable := self._result.variables.get(name)) is not None
            and variable.kind in (*KNOWN_KINDS, Kind.FREE_PARAMETER)
            for name in ex.symbols(node)
        )

    def constant(self, value: Node, span: ir.Span | None, purpose: str) -> float:
        """See :class:`interpreter_host.Host`; the parameters it depends on can no longer be changed."""
        numbers: dict[str, float | Node] = {}
        for name in ex.symbols(value):
            variable = self._result.variables.get(name)
            if variable is None or variable.kind not in KNOWN_KINDS:
                raise UnsupportedModelError(
                    f"{purpose or 'a value'} that depends on the variable {name} is not translated",
                    place=self._source_map.place(span),
                )
        for name in ex.symbols(value):
            numbers[name] = self._parameter_number(name, span)
        if purpose:
            self._make_structural(numbers)
        result = ex.Substitution(numbers)(value)
        if isinstance(result, Node):
            raise InputError(f"no finite value: {result}", place=self._source_map.place(span))
        return result

    def _make_structural(self, numbers: Mapping[str, float | Node]) -> None:
        """Parameters that can no longer be changed; what is evaluated from now on has their numbers."""
        for name, number in numbers.items():
            if name in self._structural:
                continue
            self._structural.add(name)
            declared = self._result.variables[name].declaration
            value = self._values.get(declared.name) if declared is not None else None
            if isinstance(value, Node):
                self._values[name] = number
            elif isinstance(value, np.ndarray) and declared is not None:
                indices = name[len(declared.name) + 1 : -1].split(",")
                value[tuple(int(index) - 1 for index in indices)] = number

    def _parameter_number(self, name: str, span: ir.Span | None) -> float:
        value = self._result.variables[name].value
        if value is None:
            declared = self._result.variables[name].declaration
            if declared is not None:
                self.variable(declared.name)
            value = self._result.variables[name].value
        if isinstance(value, Node):
            return self.constant(value, span, f"the parameter {name}")
        if isinstance(value, float | int):
            return value
        raise UnsupportedModelError(f"the parameter {name} has no value at translation")

    def function_assert(self, condition: Scalar, message: Scalar, is_warning: bool) -> None:
        """See :class:`interpreter_host.Host`."""
        if isinstance(condition, str | Text) or not isinstance(message, str | Text):
            return
        if isinstance(condition, Node):
            # Checked when it depends on parameters alone; an assertion of an inlined function on variables may
            # stand in a branch that is not taken, so it cannot be lifted out of it.
            if only_parameters(self._result, condition):
                self._result.asserts.append(ScalarAssert(condition, text_of(message), is_warning))
        elif not condition and not is_warning:
            raise InputError(
                f"an assertion of the model fails: {message if isinstance(message, str) else message.parts}"
            )

    def external(self, function: ir.Function, args: Mapping[str, Value], span: ir.Span | None) -> tuple[Value, ...]:
        """See :class:`interpreter_host.Host`."""
        return self._external_calls.external(function, args, span)

    # --- equations ---

    def _equation_of_binding(self, variable: ir.Variable) -> None:
        assert variable.binding is not None
        names = element_names(variable.name, variable.shape)
        if variable.type == "String":
            items = self._broadcast(variable.binding, names)
            for name, item in zip(names, items, strict=True):
                if not isinstance(item, str):
                    raise UnsupportedModelError(
                        f"the String variable {name} changes, which is not translated",
                        place=self._source_map.place(variable.span),
                    )
                self._result.variables[name].kind = Kind.CONSTANT
                self._result.variables[name].value = item
            return
        for name, item in zip(names, self._broadcast_events(variable.binding, names), strict=True):
            self._result.equations.append(ScalarEquation(ex.symbol(name), as_number(item), variable.span))

    def _broadcast_events(self, expression: ir.Expression, names: list[str]) -> list[Scalar]:
        items = arrays.scalars(self._interpreter.evaluate(expression))
        return items * len(names) if len(items) == 1 else items

    def _equation(self, equation: ir.Equation, events: bool = True) -> list[ScalarEquation]:
        residual = equation.residual
        if isinstance(residual, ir.Binary) and isinstance(residual.left, ir.TupleExpression):
            left, right = self._outputs(residual.left, residual.right, events, equation.span)
        elif isinstance(residual, ir.Binary) and residual.op in ("Sub", "SubElem"):
            left = self._sides(residual.left, events)
            right = self._sides(residual.right, events)
            if len(left) == 1 and len(right) > 1 and isinstance(residual.left, ir.Literal):
                left = left * len(right)
            if len(right) == 1 and len(left) > 1:
                right = right * len(left)
        else:
            left = self._sides(residual, events)
            right = [0] * len(left)
        if len(left) != len(right):
            raise InputError(
                f"the sides of an equation have {len(left)} and {len(right)} elements",
                place=self._source_map.place(equation.span),
            )
        result = []
        for a, b in zip(left, right, strict=True):
            if isinstance(a, str | Text) or isinstance(b, str | Text):
                if a == b:
                    continue
                raise UnsupportedModelError(
                    "an equation between Strings is not translated", place=self._source_map.place(equation.span)
                )
            result.append(ScalarEquation(as_number(a), as_number(b), equation.span))
        return result

    def _outputs(
        self, targets: ir.TupleExpression, call: ir.Expression, events: bool, span: ir.Span | None
    ) -> tuple[list[Any], list[Any]]:
        """Scalars of the outputs of a call and of what they are equal to; outputs may be left out."""
        outputs = self._interpreter.evaluate(call, events=events)
        values = outputs if isinstance(outputs, tuple) else (outputs,)
        if len(targets.elements) > len(values):
            raise InputError(
                f"a call with {len(values)} outputs is given {len(targets.elements)} targets",
                place=self._source_map.place(span),
            )
        left: list[Any] = []
        right: list[Any] = []
        for target, value in zip(targets.elements, values, strict=False):
            if target is not None:
                left.extend(arrays.scalars(self._interpreter.evaluate(target, events=events)))
                right.extend(arrays.scalars(value))
        return left, right

    def _sides(self, expression: ir.Expression, events: bool) -> list[Any]:
        """Scalars of one side of an equation."""
        return list(arrays.scalars(self._interpreter.evaluate(expression, events=events)))

    def _assert(self, item: ir.Assert) -> None:
        condition = as_number(self._interpreter.evaluate(item.condition, events=False))
        message = text_of(self._interpreter.evaluate(item.message, events=False))
        if isinstance(condition, Node):
            self._result.asserts.append(ScalarAssert(condition, message, item.is_warning))
        elif not condition and not item.is_warning:
            raise InputError(
                "an assertion of the model fails: " + "".join(str(part) for part in message.parts),
                place=self._source_map.place(item.span),
            )
