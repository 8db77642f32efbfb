"""Which variables of a scene are outputs of its FMU, so that any tool records them."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import replace
from enum import Enum
from typing import Final

from contact_foundation.errors import InputError, Place

from modelica2fmu.description.model_description import Causality, ModelDescription, Variability
from modelica2fmu.scene.energies import KINETIC, POTENTIAL
from modelica2fmu.scene.mechanism import Mechanism, find_mechanism


class OutputGroup(Enum):
    """What can be asked for."""

    POSES = "poses"
    SPEEDS = "speeds"
    FORCES = "forces"
    ENERGIES = "energies"


_INDEX: Final = r"(\[[^\]]*\])?"
_OF_BODIES: Final = {
    OutputGroup.POSES: r"frame_a\.(r_0|R\.T)",
    OutputGroup.SPEEDS: r"(v_0|w_a)",
}
_OF_FREE_BODIES: Final = {
    OutputGroup.POSES: r"(r|Q)",
    OutputGroup.SPEEDS: r"(v|w)",
    OutputGroup.ENERGIES: r"(kineticEnergy|energy|bodyPotentialEnergy)",
}
_OF_MANAGERS: Final = {
    OutputGroup.FORCES: r"(normalForce|force|distance|approachSpeed|impactSpeed|touches|contactCount|largestDepth)",
    OutputGroup.ENERGIES: r"elasticEnergy",
}
_LACKING: Final = {
    OutputGroup.POSES: "moving body",
    OutputGroup.SPEEDS: "moving body",
    OutputGroup.FORCES: "contact manager",
    OutputGroup.ENERGIES: "moving body and no contact manager",
}


def output_groups(text: str) -> tuple[OutputGroup, ...]:
    """The groups that a text names, separated by commas, in a fixed order; ``all`` means all.

    Raises:
        InputError: a name is unknown.
    """
    names = {name.strip() for name in text.split(",") if name.strip()}
    known = [group.value for group in OutputGroup]
    unknown = sorted(names - {*known, "all"})
    if unknown or not names:
        raise InputError(
            f"{(unknown or [text])[0]!r} is no group of outputs", remedy=f"Known are {', '.join(known)} and all."
        )
    return tuple(group for group in OutputGroup if group.value in names or "all" in names)


def with_outputs(description: ModelDescription, groups: Collection[OutputGroup]) -> ModelDescription:
    """The description with what the groups name as outputs, as far as it changes during a simulation.

    Raises:
        InputError: a group finds nothing in the model.
    """
    if not groups:
        return description
    mechanism = find_mechanism({variable.name: None for variable in description.variables})
    changing = {
        variable.name
        for variable in description.variables
        if variable.variability in (Variability.CONTINUOUS, Variability.DISCRETE)
        and variable.causality in (Causality.LOCAL, Causality.OUTPUT)
    }
    chosen: set[str] = set()
    for group in groups:
        found = _names(group, mechanism, changing)
        if not found:
            raise InputError(
                f"the model has no {_LACKING[group]}, so there are no {group.value} to be outputs",
                place=Place(component=description.name),
            )
        chosen |= found
    variables = tuple(
        replace(variable, causality=Causality.OUTPUT) if variable.name in chosen else variable
        for variable in description.variables
    )
    outputs = tuple(variable.name for variable in variables if variable.causality is Causality.OUTPUT)
    return replace(description, variables=variables, outputs=outputs)


def _names(group: OutputGroup, mechanism: Mechanism, changing: Collection[str]) -> set[str]:
    found = _matching(mechanism.bodies, _OF_BODIES, group, changing)
    found |= _matching(mechanism.free_bodies, _OF_FREE_BODIES, group, changing)
    found |= _matching(mechanism.managers, _OF_MANAGERS, group, changing)
    if group is OutputGroup.ENERGIES:
        found |= {KINETIC, POTENTIAL} & set(changing)
    return found


def _matching(
    components: Collection[str],
    patterns: Mapping[OutputGroup, str],
    group: OutputGroup,
    changing: Collection[str],
) -> set[str]:
    if group not in patterns or not components:
        return set()
    either = "|".join(re.escape(component) for component in components)
    pattern = re.compile(rf"(?:{either})\.{patterns[group]}{_INDEX}")
    return {name for name in changing if pattern.fullmatch(name)}
