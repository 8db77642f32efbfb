"""Holds the lists of a contact manager against the connections of its frames.

A manager of ContactMultiBody takes geometries, materials and inertias of bodies in the order of its frames. Modelica
passes no parameter through a connection, so that the library cannot assert that order for bodies that move; the
flattened model shows both.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Final

_FRAME: Final = re.compile(r"(.+)\.frame\[(\d+)\]\.r_0")
_LISTS: Final = "collider|geometry|material|inertia"
_ROW: Final = re.compile(rf"({_LISTS})\[(\d+)\](?:\.\w+)*")
_OWNED: Final = re.compile(rf"(.+?)\.({_LISTS})(?:\.\w+)*")


@dataclass(frozen=True)
class MisplacedRow:
    """A row of a manager's lists that belongs to the body at another frame.

    Attributes:
        manager: the component.
        taken: what it takes, as ``ball.collider``.
        number: the row, and the frame that it is taken for.
        frame: the one that the body is connected to.
    """

    manager: str
    taken: str
    number: int
    frame: int

    @property
    def message(self) -> str:
        """What is wrong."""
        owner = self.taken.rpartition(".")[0]
        return (
            f"{self.manager} takes {self.taken} for {self.manager}.frame[{self.number}], but {owner} is connected to "
            f"{self.manager}.frame[{self.frame}]"
        )


@dataclass
class _Manager:
    """A component with an array of frames.

    Attributes:
        connected: names of the positions that are connected to each frame, by its number.
        rows: of each list, what is taken from which component, by number.
        with_colliders: frames whose body has a collider of its own.
    """

    connected: dict[int, set[str]] = field(default_factory=dict)
    rows: dict[str, dict[int, tuple[str, str]]] = field(default_factory=dict)
    with_colliders: set[int] = field(default_factory=set)

    def note(self, kind: str, number: int, value: Any) -> None:
        """Notes where a row is taken from, if it is a member of a component."""
        reference = value.get("VarRef") if isinstance(value, dict) else None
        found = _OWNED.fullmatch(reference["name"]["name"]) if reference and not reference["subscripts"] else None
        if found:
            self.rows.setdefault(kind, {}).setdefault(number, (found[1], f"{found[1]}.{found[2]}"))

    def misplaced(self, component: str) -> MisplacedRow | None:
        """The first row whose body is at another frame, where another body's row stands or this frame's has its own."""
        for kind, rows in self.rows.items():
            for number, (owner, taken) in rows.items():
                if number not in self.connected or self._is_at(owner, number):
                    continue
                # A body may lend geometry, material or inertia, if its own row stands at its own frame. A collider is
                # lent only to what has none.
                passed_over = kind == "collider" and number in self.with_colliders
                for frame in self.connected:
                    if self._is_at(owner, frame) and (passed_over or rows.get(frame, (owner, taken))[0] != owner):
                        return MisplacedRow(component, taken, number, frame)
        return None

    def _is_at(self, owner: str, frame: int) -> bool:
        return any(name.startswith(f"{owner}.") for name in self.connected[frame])


def misplaced_row(flat: Mapping[str, Any]) -> MisplacedRow | None:
    """A row of a manager's lists that belongs to the body at another frame.

    Args:
        flat: the flattened model.
    """
    managers = _managers(flat["equations"])
    owners = {name.partition(".collider.")[0] for name in flat["variables"] if ".collider." in name}
    for manager in managers.values():
        for number, names in manager.connected.items():
            if any(name[: dot.start()] in owners for name in names for dot in re.finditer(r"\.", name)):
                manager.with_colliders.add(number)
    for name, variable in flat["variables"].items():
        for component, manager in managers.items():
            if name.startswith(f"{component}."):
                _note_rows(manager, name[len(component) + 1 :], variable.get("binding"))
    found = (manager.misplaced(component) for component, manager in managers.items())
    return next((row for row in found if row is not None), None)


def _managers(equations: Iterable[Mapping[str, Any]]) -> dict[str, _Manager]:
    """Components with connected frames of an array."""
    sets: dict[str, set[str]] = {}
    for equation in equations:
        origin = equation.get("origin")
        connection = origin.get("Connection") if isinstance(origin, dict) else None
        if connection is None or not connection["lhs"].endswith(".r_0"):
            continue
        ends = (connection["lhs"], connection["rhs"])
        together = set(ends).union(*(sets.get(end, ()) for end in ends))
        for name in together:
            sets[name] = together
    managers: dict[str, _Manager] = {}
    for name, together in sets.items():
        found = _FRAME.fullmatch(name)
        if found:
            managers.setdefault(found[1], _Manager()).connected[int(found[2])] = together
    return managers


def _note_rows(manager: _Manager, name: str, binding: Any) -> None:
    row = _ROW.fullmatch(name)
    if row:
        manager.note(row[1], int(row[2]), binding)
    elif re.fullmatch(_LISTS, name) and isinstance(binding, dict) and "Array" in binding:
        for number, element in enumerate(binding["Array"]["elements"], start=1):
            manager.note(name, number, element)
