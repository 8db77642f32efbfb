"""What a generated FMU says about its model: the contract between code generation and packaging.

Everything that ``modelDescription.xml`` and the FMU's ``resources`` need is here; the numbers of the
model itself are in the generated C (``runtime/model/fmurt_model.h``). Value references are the slots of the
four value arrays of that header, one numbering for each of Real, Integer (with enumerations), Boolean
and String. Variables that are equal share a slot, so a value reference may occur more than once.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path

from modelica2fmu.library.experiment import DefaultExperiment
from modelica2fmu.library.external_code import ExternalCode


class DataType(StrEnum):
    """Base type of a variable."""

    REAL = "real"
    INTEGER = "integer"
    BOOLEAN = "boolean"
    STRING = "string"
    ENUMERATION = "enumeration"  # its slot lies in the Integer array


class Causality(StrEnum):
    """FMI 2.0 causality (the spelling is that of the XML)."""

    PARAMETER = "parameter"
    CALCULATED_PARAMETER = "calculatedParameter"
    INPUT = "input"
    OUTPUT = "output"
    LOCAL = "local"
    INDEPENDENT = "independent"


class Variability(StrEnum):
    """FMI 2.0 variability (the spelling is that of the XML)."""

    CONSTANT = "constant"
    FIXED = "fixed"
    TUNABLE = "tunable"
    DISCRETE = "discrete"
    CONTINUOUS = "continuous"


class Initial(StrEnum):
    """FMI 2.0 attribute ``initial`` (the spelling is that of the XML)."""

    EXACT = "exact"
    APPROX = "approx"
    CALCULATED = "calculated"


@dataclass(frozen=True)
class EnumerationItem:
    """One literal of an enumeration type; its value is 1-based."""

    name: str
    value: int
    description: str = ""


@dataclass(frozen=True)
class EnumerationType:
    """An enumeration type, by its full Modelica name."""

    name: str
    items: tuple[EnumerationItem, ...]


@dataclass(frozen=True)
class Variable:
    """One scalar variable of the FMU.

    Attributes:
        name: Modelica name in FMI's structured convention, ``body.frame_a.R.T[1,2]``; derivatives
            ``der(body.v_0[1])``.
        type: base type.
        value_reference: slot in the array of its type; aliases share it.
        causality: FMI causality.
        variability: FMI variability.
        initial: FMI ``initial``; ``None`` where the standard forbids it (inputs, independent).
        start: start value; ``None`` where ``initial`` is ``calculated``. Enumerations: the 1-based value.
        description: Modelica's description text.
        unit: unit attribute, empty if none.
        display_unit: displayUnit attribute, empty if none.
        quantity: quantity attribute, empty if none.
        minimum: min attribute.
        maximum: max attribute.
        nominal: nominal attribute.
        enumeration: full name of the enumeration type, key into ``ModelDescription.enumerations``.
        derivative_of: name of the variable of which this is the time derivative (state derivatives).
        reinit: = true, if a state may be set by ``reinit`` at events.
    """

    name: str
    type: DataType
    value_reference: int
    causality: Causality
    variability: Variability
    initial: Initial | None = None
    start: float | int | bool | str | None = None
    description: str = ""
    unit: str = ""
    display_unit: str = ""
    quantity: str = ""
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    enumeration: str | None = None
    derivative_of: str | None = None
    reinit: bool = False


@dataclass(frozen=True)
class Resource:
    """A file that goes into the FMU's ``resources`` folder under the relative name ``target``."""

    source: Path
    target: str


@dataclass(frozen=True)
class ModelDescription:
    """Everything packaging needs to know of a translated model.

    Attributes:
        name: full Modelica name of the model.
        identifier: C identifier and file name of the binaries (FMI ``modelIdentifier``).
        guid: the same text as in the generated C; a hash of the generated code.
        description: Modelica's description text of the model.
        variables: in the order of modelDescription.xml; a state comes before its derivative.
        states: names of the continuous states in the order of ``fmurt_model.state``.
        derivatives: names of their derivatives, same order.
        outputs: names of the variables of causality output, in order.
        indicator_count: number of event indicators.
        enumerations: types that the variables use.
        experiment: the default experiment.
        external: external code.
        resources: files for the ``resources`` folder.
        internal_parameters: Real slots that no variable shows and that parameters decide; the runtime keeps them
            over the initialization.
        needs_completed_steps: whether importers have to tell of each step that they accept in model exchange.
        icon: the model's icon, a PNG; ``None`` if it has none.
    """

    name: str
    identifier: str
    guid: str
    variables: tuple[Variable, ...]
    states: tuple[str, ...]
    derivatives: tuple[str, ...]
    outputs: tuple[str, ...] = ()
    indicator_count: int = 0
    description: str = ""
    enumerations: tuple[EnumerationType, ...] = ()
    experiment: DefaultExperiment = field(default_factory=DefaultExperiment)
    external: ExternalCode = field(default_factory=ExternalCode)
    resources: tuple[Resource, ...] = ()
    internal_parameters: tuple[int, ...] = ()
    needs_completed_steps: bool = False
    icon: bytes | None = None
