"""What an FMU logged before it failed is told once, in lines a user can read; start values stay in their bounds."""

from __future__ import annotations

import math

import pytest
from contact_foundation.errors import InputError
from fmu_regression.fmi.description import ModelDescription, Variable, check_start_values
from fmu_regression.fmi.fmu import Instance


def description(*variables: Variable) -> ModelDescription:
    return ModelDescription(
        fmi="2.0",
        name="Model",
        guid="",
        identifiers={},
        variables={variable.name: variable for variable in variables},
        states=(),
        state_count=0,
        indicator_count=0,
        needs_completed_step=False,
        start=0.0,
        stop=None,
        tolerance=None,
        interval=None,
        generation_tool="",
    )


def test_repeated_lines_are_one_and_name_no_folder_of_the_builder() -> None:
    lines = [f"[error] solver: at t = {0.1 * k:g} the step is {10.0**-k:g}" for k in range(22)]
    lines.append("[error] assert: /home/builder/src/Model.mo:12: mass must be positive")
    instance = Instance(None, description(), lines)  # type: ignore[arg-type]  # no function is called
    said = str(instance.failure("the simulation stopped")).splitlines()
    assert len(said) == 3
    assert said[1].strip() == "[error] solver: at t = 2.1 the step is 1e-21 (and 21 more of this kind)"
    assert said[2].strip() == "[error] assert: Model.mo:12: mass must be positive"


@pytest.mark.parametrize(
    ("value", "fits"), [(-1.0, False), (0.0, True), ("2", True), ("11", False), (math.nextafter(0, -1), False)]
)
def test_start_values_stay_within_min_and_max(value: float | str, fits: bool) -> None:
    mass = Variable("m", 1, "Real", "Real", "parameter", "fixed", "kg", True, "1", least=0.0, largest=10.0)
    if fits:
        assert check_start_values(description(mass), {"m": value})["m"] == float(value)
    else:
        with pytest.raises(InputError, match=r"Model\.m: .* is (less|more) than"):
            check_start_values(description(mass), {"m": value})
