"""Descriptions of the hand-written models in ``fixtures``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from modelica2fmu.codegen.generated_source import GeneratedSource
from modelica2fmu.description.model_description import (
    Causality,
    DataType,
    EnumerationItem,
    EnumerationType,
    Initial,
    ModelDescription,
    Variability,
    Variable,
)
from modelica2fmu.library.experiment import DefaultExperiment

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

BALL = model(
    "Ball",
    [
        state("h", 0, 1.0, Causality.OUTPUT, unit="m"),
        state("v", 1, 0.0, Causality.OUTPUT, unit="m/s", reinit=True),
        local("der(h)", 2, unit="m/s", derivative_of="h"),
        local("der(v)", 3, unit="m/s2", derivative_of="v"),
        parameter("e", 4, 0.7, minimum=0.0, maximum=1.0),
        parameter("g", 5, 9.81, unit="m/s2"),
        parameter("restSpeed", 6, 1e-3, unit="m/s"),
        discrete("impactSpeed", 7, DataType.REAL, Causality.OUTPUT, unit="m/s"),
        discrete("bounces", 0, DataType.INTEGER, Causality.OUTPUT),
        discrete("impact", 0, DataType.BOOLEAN),
        Variable("flying", DataType.BOOLEAN, 1, Causality.LOCAL, Variability.DISCRETE, Initial.EXACT, True),
    ],
    ["h", "v"],
    indicators=1,
    stop=3.0,
)

MODE = EnumerationType(
    "Schedule.Mode", (EnumerationItem("up", 1, "Level rises"), EnumerationItem("down", 2, "Level falls"))
)

SCHEDULE = model(
    "Schedule",
    [
        Variable("x", DataType.REAL, 0, Causality.OUTPUT, Variability.CONTINUOUS, Initial.CALCULATED),
        local("der(x)", 1, derivative_of="x", unit="1/s"),
        parameter("base", 2, 1.5),
        calculated("twice", 3),
        parameter("lag", 4, 0.5, unit="s", tunable=True),
        parameter("first", 5, 0.1, unit="s"),
        parameter("period", 6, 0.25, unit="s", display_unit="ms"),
        discrete("level", 7, DataType.REAL, Causality.OUTPUT),
        discrete("nextTick", 8, DataType.REAL, unit="s"),
        discrete("ticks", 0, DataType.INTEGER, Causality.OUTPUT),
        parameter("mode", 1, 1, DataType.ENUMERATION, enumeration="Schedule.Mode"),
        Variable("step", DataType.INTEGER, 2, Causality.INPUT, Variability.DISCRETE, None, 1),
        parameter("enabled", 0, True, DataType.BOOLEAN),
        discrete("late", 1, DataType.BOOLEAN, Causality.OUTPUT),
        parameter("title", 0, "schedule", DataType.STRING),
        discrete("remark", 1, DataType.STRING, Causality.OUTPUT),
    ],
    ["x"],
    stop=2.0,
    enumerations=(MODE,),
)

GUARDED = model(
    "Guarded",
    [
        state("x", 0, 1.0, Causality.OUTPUT),
        local("der(x)", 1, derivative_of="x"),
        parameter("limit", 2, 0.0),
        parameter("gain", 3, 1.0),
        parameter("drift", 4, 0.0),
        parameter("fail", 0, 1, DataType.INTEGER),
        discrete("label", 0, DataType.STRING),
    ],
    ["x"],
)

SWITCHING = model(
    "Switching",
    [
        state("x", 0, 0.25, Causality.OUTPUT),
        local("der(x)", 1, derivative_of="x"),
        discrete("crossingTime", 2, DataType.REAL, unit="s"),
        local("tie", 3),
        local("sum", 4),
        local("root", 5),
        parameter("kind", 0, 3, DataType.INTEGER),
        discrete("crossings", 1, DataType.INTEGER),
        discrete("above", 0, DataType.BOOLEAN),
        discrete("restless", 1, DataType.BOOLEAN),
    ],
    ["x"],
    indicators=1,
)


def by_file_name(name: str) -> ModelDescription:
    """The description of the model in ``name.c``."""
    return {
        "oscillator": OSCILLATOR, "ball": BALL, "schedule": SCHEDULE, "guarded": GUARDED, "switching": SWITCHING
    }[name]  # fmt: skip
