"""Where every symbol of the equations lives in the arrays of ``fmurt_values``."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum

from modelica2fmu.equations.alias import ReducedModel
from modelica2fmu.expand.scalar_model import Kind, unwrapped
from modelica2fmu.symbolic.expression import Node


class Store(StrEnum):
    """The arrays of ``fmurt_values``."""

    REAL = "real"
    INTEGER = "integer"
    BOOLEAN = "boolean"
    STRING = "string"


@dataclass(frozen=True)
class Slot:
    """An element of one of the arrays; its index is the FMI value reference."""

    store: Store
    index: int


def store_of(type_name: str) -> Store:
    """The array for variables of a type (enumerations are Integers)."""
    return {"Real": Store.REAL, "Boolean": Store.BOOLEAN, "String": Store.STRING}.get(type_name, Store.INTEGER)


@dataclass
class Slots:
    """Slots of all variables and derivatives.

    Attributes:
        of: slot by symbol; removed variables are not among them unless they have one of their own.
        counts: number of slots of each array.
        negated: removed variables with a slot of their own, and what they are.
    """

    of: dict[str, Slot] = field(default_factory=dict)
    counts: dict[Store, int] = field(default_factory=lambda: dict.fromkeys(Store, 0))
    negated: list[tuple[str, Node]] = field(default_factory=list)

    def add(self, name: str, store: Store) -> Slot:
        """A new slot for ``name``."""
        slot = Slot(store, self.counts[store])
        self.counts[store] += 1
        self.of[name] = slot
        return slot


def assign_slots(reduced: ReducedModel, derivatives: list[str]) -> Slots:
    """Slots for all variables of the model and the ``derivatives`` that the equations use.

    Variables that are equal share one; a negated or constant variable has its own.
    """
    slots = Slots()
    model = reduced.model
    for name, variable in model.variables.items():
        if name not in reduced.replacements:
            slots.add(name, store_of(variable.type))
    for name in derivatives:
        if name not in slots.of and unwrapped(name)[0]:
            slots.add(name, Store.REAL)
    for name, by in reduced.replacements.items():
        store = store_of(model.variables[name].type)
        if isinstance(by, Node) and by.op == "symbol" and by.name in slots.of and slots.of[by.name].store is store:
            slots.of[name] = slots.of[by.name]
            continue
        slots.add(name, store)
        if isinstance(by, Node):
            slots.negated.append((name, by))
        else:
            model.variables[name].kind = Kind.CONSTANT
            model.variables[name].value = by
    return slots
