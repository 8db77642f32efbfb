"""Options and counters of the co-simulation integrator as variables of the FMU.

The names, their order and the first value reference are those of ``runtime/model/fmurt_interface.h``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from contact_foundation.errors import InputError, Place

from modelica2fmu.description.model_description import (
    Causality,
    DataType,
    Initial,
    ModelDescription,
    Variability,
    Variable,
)

FIRST_REFERENCE = 0x40000000
PREFIX = "cmbSolver"

DEFAULT_TOLERANCE = 1e-6
_LARGEST_INTEGER = 2**31 - 1


@dataclass(frozen=True)
class SolverOptions:
    """Defaults of the integrator inside a co-simulation FMU; an importer can change them.

    Attributes:
        relative_tolerance: ``None`` for that of the experiment annotation, else 1e-6.
        absolute_tolerance: divided by each state's nominal value; 0 for 1e-3 times the relative tolerance,
            1e-9 at least where that is not more than the relative one.
        maximum_step: s; 0 for the communication step.
        maximum_steps: of the integrator in one communication step; more discard it.

    Raises:
        InputError: an option is out of range.
    """

    relative_tolerance: float | None = None
    absolute_tolerance: float = 0.0
    maximum_step: float = 0.0
    maximum_steps: int = 100_000

    def __post_init__(self) -> None:
        if self.relative_tolerance is not None:
            _check_tolerance(self.relative_tolerance)
        for name, value in (("absolute tolerance", self.absolute_tolerance), ("longest step", self.maximum_step)):
            if not 0.0 <= value < math.inf:
                raise InputError(f"the integrator's {name} cannot be {value:g}")
        if not 1 <= self.maximum_steps <= _LARGEST_INTEGER:
            raise InputError(f"the integrator cannot be allowed {self.maximum_steps} steps")


def _check_tolerance(tolerance: float, place: Place | None = None) -> None:
    if not 0.0 < tolerance < 1.0:
        raise InputError(f"the integrator's tolerance must lie between 0 and 1, {tolerance:g} does not", place=place)


def effective_tolerance(description: ModelDescription, options: SolverOptions) -> float:
    """The relative tolerance that an FMU uses where its importer gives none."""
    if options.relative_tolerance is not None:
        return options.relative_tolerance
    return description.experiment.tolerance or DEFAULT_TOLERANCE


def with_solver_variables(description: ModelDescription, options: SolverOptions) -> ModelDescription:
    """The description with the integrator's variables appended.

    Raises:
        InputError: a variable of the model has one of their names, or the tolerance of its experiment is out of range.
    """
    place = Place(component=description.name)
    tolerance = effective_tolerance(description, options)
    _check_tolerance(tolerance, place)
    reals = (
        ("relativeTolerance", tolerance, "", "Relative tolerance where the importer gives none"),
        ("absoluteTolerance", options.absolute_tolerance, "",
         "Absolute tolerance divided by each state's nominal value; 0: 1e-3 times the relative one, 1e-9 at least"),
        ("maximumStep", options.maximum_step, "s", "Longest step of the integrator; 0: the communication step"),
    )  # fmt: skip
    integers = (
        ("steps", "Steps of the integrator"),
        ("evaluations", "Evaluations of the right-hand side, those for Jacobians included"),
        ("jacobians", "Jacobians computed"),
        ("errorTestFailures", "Steps rejected by the error test"),
        ("convergenceFailures", "Steps rejected because Newton's iteration did not converge"),
        ("stateEvents", "State events"),
        ("timeEvents", "Time events"),
    )
    variables = [
        Variable(
            name=f"{PREFIX}.{name}",
            type=DataType.REAL,
            value_reference=FIRST_REFERENCE + index,
            causality=Causality.PARAMETER,
            variability=Variability.FIXED,
            initial=Initial.EXACT,
            start=start,
            unit=unit,
            description=f"Co-simulation: {text}",
            minimum=0.0,
        )
        for index, (name, start, unit, text) in enumerate(reals)
    ]
    variables += [
        Variable(
            name=f"{PREFIX}.{name}",
            type=DataType.INTEGER,
            value_reference=FIRST_REFERENCE + index,
            causality=Causality.LOCAL,
            variability=Variability.DISCRETE,
            initial=Initial.CALCULATED,
            description=f"Co-simulation: {text}",
        )
        for index, (name, text) in enumerate(integers)
    ]
    variables.append(
        Variable(
            name=f"{PREFIX}.maximumSteps",
            type=DataType.INTEGER,
            value_reference=FIRST_REFERENCE + len(integers),
            causality=Causality.PARAMETER,
            variability=Variability.FIXED,
            initial=Initial.EXACT,
            start=options.maximum_steps,
            description="Co-simulation: Most steps of the integrator in one communication step, which fails beyond",
            minimum=1.0,
        )
    )
    taken = {variable.name for variable in description.variables} & {variable.name for variable in variables}
    if taken:
        raise InputError(
            f"the name {min(taken)} belongs to the FMU's integrator",
            place=place,
            remedy=f"Rename the component {PREFIX} of the model.",
        )
    return replace(description, variables=(*description.variables, *variables))
