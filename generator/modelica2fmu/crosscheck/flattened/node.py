"""Components of a model on the way to its variables."""

from __future__ import annotations

from dataclasses import dataclass

from modelica2fmu.crosscheck.class_instances import ClassInstance, Component


@dataclass(frozen=True)
class Node:
    """A component, or the model itself.

    Attributes:
        instance: its class.
        component: ``None`` for the model itself.
        is_certain: = true, if its modifiers are, and those of all components around it.
        has_value: = true, if a record around it has a value, which gives its own.
    """

    instance: ClassInstance
    component: Component | None
    is_certain: bool = True
    has_value: bool = False
