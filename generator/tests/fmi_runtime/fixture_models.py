"""Descriptions of the hand-written models in ``fixtures``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from modelica2fmu.description import (
    Causality,
    DataType,
    DefaultExperiment,
    Initial,
    ModelDescription,
    Variability,
    Variable,
)
from modelica2fmu.packaging import GeneratedSource

FIXTURES = Path(__file__).resolve().parent / "fixtures"

Slot = int


def parameter(
    name: str, slot: Slot, start: Any, type: DataType = DataType.REAL, *, tunable: bool = False, **more: Any
) -> Variable:
    variability = Variability.TUNABLE if tunable else Variability.FIXED
    return Variable(name, type, slot, Causality.PARAMETER, variability, Initial.EXACT, start, **more)


def calculated(name: str, slot: Slot, **more: Any) -> Variable:
    return Variable(
        name, DataType.REAL, slot, Causality.CALCULATED_PARAMETER, Variability.FIXED, Initial.CALCULATED, **more
    )


def state(name: str, slot: Slot, start: float, causality: Causality = Causality.LOCAL, **more: Any) -> Variable:
    return Variable(name, DataType.REAL, slot, causality, Variability.CONTINUOUS, Initial.EXACT, start, **more)


def local(name: str, slot: Slot, causality: Causality = Causality.LOCAL, **more: Any) -> Variable:
    return Variable(name, DataType.REAL, slot, causality, Variability.CONTINUOUS, Initial.CALCULATED, **more)


def discrete(name: str, slot: Slot, type: DataType, causality: Causality = Causality.LOCAL, **more: Any) -> Variable:
    return Variable(name, type, slot, causality, Variability.DISCRETE, Initial.CALCULATED, **more)


def real_input(name: str, slot: Slot, start: float = 0.0, **more: Any) -> Variable:
    return Variable(name, DataType.REAL, slot, Causality.INPUT, Variability.CONTINUOUS, None, start, **more)


def independent(slot: Slot) -> Variable:
    return Variable("time", DataType.REAL, slot, Causality.INDEPENDENT, Variability.CONTINUOUS, unit="s")


def model(
    name: str, variables: list[Variable], states: list[str], *, indicators: int = 0, stop: float = 1.0, **more: Any
) -> ModelDescription:
    """A description; the derivative of each state is called ``der(state)``."""
    return ModelDescription(
        name=name,
        identifier=name,
        guid="{" + name.lower() + "}",
        variables=tuple(variables),
        states=tuple(states),
        derivatives=tuple(f"der({state})" for state in states),
        outputs=tuple(v.name for v in variables if v.causality is Causality.OUTPUT),
        indicator_count=indicators,
        experiment=DefaultExperiment(0.0, stop, 1e-8, stop / 100.0),
        **more,
    )


def source(name: str) -> list[GeneratedSource]:
    return [GeneratedSource("model.c", (FIXTURES / f"{name}.c").read_text(encoding="utf-8"))]


OSCILLATOR = model(
    "Oscillator",
    [
        state("s", 0, 1.0, Causality.OUTPUT, unit="m", description='Position "s" <&>'),
        state("v", 1, 0.0, unit="m/s"),
        local("der(s)", 2, unit="m/s", derivative_of="s"),
        local("der(v)", 3, unit="m/s2", derivative_of="v"),
        parameter("mass", 4, 1.0, unit="kg"),
        parameter("stiffness", 5, 4.0, unit="N/m"),
        parameter("damping", 6, 0.0, unit="N.s/m", tunable=True),
        real_input("force", 7, unit="N"),
        local("energy", 8, Causality.OUTPUT, unit="J"),
        calculated("frequency", 9, unit="rad/s", display_unit="rpm"),
        independent(10),
    ],
    ["s", "v"],
    stop=10.0,
)
