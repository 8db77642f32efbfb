"""Which variables an operator sets while the machine moves: inputs, and parameters that may change."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from contact_foundation.errors import InputError, Place
from fmu_regression.fmi.description import ModelDescription, Variable
from fmu_regression.results.result import close_names_remedy

MOST_PARAMETERS = 12
_SETTABLE_KINDS = ("Real", "Integer", "Boolean", "Enumeration")


@dataclass(frozen=True)
class Control:
    """A variable that the operator sets.

    Attributes:
        name: of the FMU's variable.
        kind: "Real", "Integer", "Boolean" or "Enumeration".
        is_input: an input, or a tunable parameter.
        low, high: ends of its slider, low < high; bounds of the variable where it has them.
        start: value at the start.
        unit: unit symbol or "".
    """

    name: str
    kind: str
    is_input: bool
    low: float
    high: float
    start: float
    unit: str

    def admitted(self, value: float) -> float:
        """The value within the slider's ends, rounded where the variable is no real number.

        Raises:
            InputError: the value is not a finite number.
        """
        if not math.isfinite(value):
            raise InputError(f"{value} is not a number", place=Place(component=self.name), remedy="Give a number.")
        within = min(self.high, max(self.low, value))
        return within if self.kind == "Real" else float(round(within))


def choose_controls(description: ModelDescription, parameters: Sequence[str] = ()) -> tuple[Control, ...]:
    """The inputs of an FMU and the tunable parameters to show.

    Args:
        description: of the FMU.
        parameters: names of tunable parameters; if there are none, those of the model itself, at most 12, without
            those of its components.

    Raises:
        InputError: a name is unknown or not of a tunable parameter.
    """
    variables = [variable for variable in description.variables.values() if variable.kind in _SETTABLE_KINDS]
    inputs = [variable for variable in variables if variable.causality == "input"]
    tunable = {v.name: v for v in variables if v.causality == "parameter" and v.variability == "tunable" and v.settable}
    if parameters:
        chosen = [_named(description, tunable, name) for name in dict.fromkeys(parameters)]
    else:
        own = [v for v in tunable.values() if "." not in v.name and "[" not in v.name]
        chosen = own[:MOST_PARAMETERS]
    return tuple(_control(variable) for variable in (*inputs, *chosen))


def _named(description: ModelDescription, tunable: dict[str, Variable], name: str) -> Variable:
    if name in tunable:
        return tunable[name]
    known = name in description.variables
    raise InputError(
        "is no parameter that may change while the FMU runs" if known else "the FMU has no such parameter",
        place=Place(component=f"{description.name}.{name}"),
        remedy=close_names_remedy(name, list(tunable)) if tunable else "No parameter of this FMU is tunable.",
    )


def _control(variable: Variable) -> Control:
    start = _start(variable)
    low, high = variable.least, variable.largest
    if variable.kind == "Boolean":
        low, high = 0.0, 1.0
    reach = abs(start) if start else 1.0
    # Without bounds, from nothing to twice a parameter's value; an input to both sides.
    least = min(0.0, start - reach) if variable.causality != "input" or start else -reach
    low = least if low is None or not math.isfinite(low) else low
    high = max(start + reach, low + reach) if high is None or not math.isfinite(high) else high
    if not low < high:
        high = low + 1.0
    return Control(
        variable.name,
        variable.kind,
        variable.causality == "input",
        low,
        high,
        min(high, max(low, start)),
        variable.unit,
    )


def _start(variable: Variable) -> float:
    text = variable.start or "0"
    if text in ("true", "false"):
        return float(text == "true")
    try:
        value = float(text)
    except ValueError:
        return 0.0
    return value if math.isfinite(value) else 0.0
