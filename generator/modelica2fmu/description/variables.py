"""The variables of an FMU from those of the scalar model."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from modelica2fmu.codegen.slots import Slots, Store
from modelica2fmu.description.model_description import (
    Causality,
    DataType,
    EnumerationItem,
    EnumerationType,
    Initial,
    Variability,
    Variable,
)
from modelica2fmu.description.tunability import Tunability
from modelica2fmu.description.units import rate_unit
from modelica2fmu.equations.alias import ReducedModel
from modelica2fmu.expand.scalar_model import Kind, ScalarVariable, derivative_name, unwrapped
from modelica2fmu.symbolic.expression import Node

_TYPES = {
    "Real": DataType.REAL,
    "Integer": DataType.INTEGER,
    "Boolean": DataType.BOOLEAN,
    "String": DataType.STRING,
}


def describe_variables(
    reduced: ReducedModel, slots: Slots, states: Sequence[str], guessed: Collection[str]
) -> tuple[Variable, ...]:
    """Variables of the model in its order, then the derivatives of the states.

    Args:
        reduced: the model.
        slots: where the variables are.
        states: names of the states.
        guessed: names of other variables whose start value the initialization may begin from.
    """
    return _Describer(reduced, slots, states, guessed).run()


def internal_parameters(reduced: ReducedModel, slots: Slots) -> tuple[int, ...]:
    """Real slots of parameters that the translation introduced, which no variable of the FMU shows."""
    return tuple(
        sorted(
            slots.of[name].index
            for name, variable in reduced.model.variables.items()
            if variable.declaration is None and variable.kind is Kind.PARAMETER and variable.type == "Real"
        )
    )


def describe_enumerations(reduced: ReducedModel) -> tuple[EnumerationType, ...]:
    """Enumeration types that variables of the model have."""
    return tuple(
        EnumerationType(name, tuple(EnumerationItem(item, value) for value, item in enumerate(items, start=1)))
        for name, items in reduced.model.enumerations.items()
    )


class _Describer:
    def __init__(self, reduced: ReducedModel, slots: Slots, states: Sequence[str], guessed: Collection[str]) -> None:
        self._reduced = reduced
        self._variables = reduced.model.variables
        self._slots = slots
        self._states = list(states)
        self._guessed = {*states, *guessed}
        self._tunability = Tunability(reduced)
        self._invariants = {name for name, _ in reduced.invariants}
        self._reinitialized = {item.state for item in reduced.model.reinitializations}

    def run(self) -> tuple[Variable, ...]:
        described: list[Variable] = []
        for name, variable in self._variables.items():
            if variable.declaration is not None:
                described.append(self._describe(name, variable))
        names = {variable.name for variable in described} | {derivative_name(state) for state in self._states}
        for state in self._states:
            if state not in names:
                described.append(self._derived_state(state))
        for state in self._states:
            described.append(self._derivative(state))
        return tuple(described)

    def _describe(self, name: str, variable: ScalarVariable) -> Variable:
        declaration = variable.declaration
        assert declaration is not None
        data_type = _TYPES.get(variable.type, DataType.ENUMERATION)
        causality, variability, initial, start = self._role(name, variable)
        if initial not in (Initial.EXACT, Initial.APPROX) and causality is not Causality.INPUT:
            start = None
        return Variable(
            name=name,
            type=data_type,
            value_reference=self._slots.of[name].index,
            causality=causality,
            variability=variability,
            initial=initial,
            start=_typed(start, data_type),
            description=declaration.description,
            unit=declaration.unit if data_type is DataType.REAL else "",
            display_unit=declaration.display_unit if data_type is DataType.REAL else "",
            quantity=declaration.quantity if data_type is DataType.REAL else "",
            minimum=variable.minimum,
            maximum=variable.maximum,
            nominal=variable.nominal if data_type is DataType.REAL else None,
            enumeration=variable.type if data_type is DataType.ENUMERATION else None,
            reinit=name in self._reinitialized,
        )

    def _role(
        self, name: str, variable: ScalarVariable
    ) -> tuple[Causality, Variability, Initial | None, float | str | None]:
        kind = variable.kind
        causality = Causality.OUTPUT if variable.is_output else Causality.LOCAL
        start = variable.start if isinstance(variable.start, float | int | str) else None
        by = self._reduced.replacements.get(name)
        if kind is not Kind.CONSTANT and (name in self._invariants or (by is not None and self._is_fixed(by))):
            # An alias of a parameter, or computed from parameters once.
            variability = self._parameter_variability(name)
            if causality is Causality.OUTPUT:  # no output is a parameter (FMI 2.0.5, section 2.2.7)
                variability = Variability.CONTINUOUS if variable.type == "Real" else Variability.DISCRETE
            return causality, variability, Initial.CALCULATED, None
        if kind is Kind.CONSTANT:
            return causality, Variability.CONSTANT, Initial.EXACT, self._constant(variable)
        if kind is Kind.PARAMETER:
            variability = self._parameter_variability(name)
            if isinstance(variable.value, Node):
                return Causality.CALCULATED_PARAMETER, variability, Initial.CALCULATED, None
            return Causality.PARAMETER, variability, Initial.EXACT, variable.value
        if kind is Kind.FREE_PARAMETER:
            return Causality.CALCULATED_PARAMETER, Variability.FIXED, Initial.CALCULATED, None
        is_real = variable.type == "Real"
        if kind is Kind.INPUT:
            changing = Variability.CONTINUOUS if is_real else Variability.DISCRETE
            return Causality.INPUT, changing, None, start if start is not None else _zero(variable.type)
        changing = Variability.CONTINUOUS if kind is Kind.CONTINUOUS and is_real else Variability.DISCRETE
        if by is not None:
            inner = self._variables.get(by.name) if isinstance(by, Node) and by.op == "symbol" else None
            if inner is not None and inner.kind is Kind.DISCRETE:
                changing = Variability.DISCRETE
            return causality, changing, Initial.CALCULATED, None
        if isinstance(variable.start, Node):
            return causality, changing, Initial.CALCULATED, None
        if variable.fixed:
            return causality, changing, Initial.EXACT, start if start is not None else _zero(variable.type)
        if name in self._guessed:
            return causality, changing, Initial.APPROX, start if start is not None else _zero(variable.type)
        return causality, changing, Initial.CALCULATED, None

    def _parameter_variability(self, name: str) -> Variability:
        return Variability.TUNABLE if self._tunability.is_tunable(name) else Variability.FIXED

    def _constant(self, variable: ScalarVariable) -> float | str:
        value = variable.value
        return value if isinstance(value, float | int | str) else _zero(variable.type)

    def _is_fixed(self, by: float | Node) -> bool:
        """True if what a variable was replaced by depends on parameters alone."""
        if not isinstance(by, Node):
            return True
        inner = by.args[0] if by.op == "neg" else by
        variable = self._variables.get(inner.name)
        return inner.name in self._invariants or (
            variable is not None and variable.kind in (Kind.PARAMETER, Kind.CONSTANT, Kind.FREE_PARAMETER)
        )

    def _derived_state(self, name: str) -> Variable:
        """A state that is itself a derivative, of which the model has no variable."""
        return Variable(
            name=name,
            type=DataType.REAL,
            value_reference=self._slots.of[name].index,
            causality=Causality.LOCAL,
            variability=Variability.CONTINUOUS,
            initial=Initial.CALCULATED,
            description=f"Derivative of {unwrapped(name)[1]} by time",
        )

    def _derivative(self, state: str) -> Variable:
        name = derivative_name(state)
        assert self._slots.of[name].store is Store.REAL
        declaration = self._variables[state].declaration if state in self._variables else None
        unit = declaration.unit if declaration is not None else ""
        return Variable(
            name=name,
            type=DataType.REAL,
            value_reference=self._slots.of[name].index,
            causality=Causality.LOCAL,
            variability=Variability.CONTINUOUS,
            initial=Initial.CALCULATED,
            description=f"Derivative of {state} by time",
            unit=rate_unit(unit),
            derivative_of=state,
        )


def _zero(type_name: str) -> float | str:
    if type_name == "String":
        return ""
    if type_name == "Real":
        return 0.0
    if type_name == "Boolean":
        return False
    return 0 if type_name == "Integer" else 1


def _typed(value: float | str | None, data_type: DataType) -> float | int | bool | str | None:
    if value is None:
        return None
    if data_type is DataType.REAL:
        return float(value)
    if data_type is DataType.BOOLEAN:
        return bool(value)
    if data_type is DataType.STRING:
        return str(value)
    return int(value)
