"""The mechanism as Modelica components and connections, without any text layout."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import combinations

from cad2modelica.geometry.spatial import Array


@dataclass(frozen=True)
class Component:
    """One component declaration.

    Attributes:
        row: line of the diagram, counted downwards from 0.
        column: place in the line, counted from 0; the world stands at -1.
        level: 0 in the line, from 1 on beside each other over it, -1 under it.
    """

    class_name: str
    name: str
    modifiers: tuple[str, ...]
    description: str
    column: int
    row: int
    level: int = 0


@dataclass(frozen=True)
class Connection:
    """``connect(first, second)``; both are ``component.connector``."""

    first: str
    second: str


@dataclass(frozen=True)
class ContactView:
    """What the contact manager is given: bodies in their order, and pairs as 1-based indices.

    ``exact_within`` is the manager's parameter, m; None: distances are exact everywhere. ``compiled``: the manager
    is one that tells the forces of bodies, and is given the pairs that never touch. ``held``: those of the bodies that
    never move.
    """

    bodies: tuple[str, ...]
    pairs: tuple[tuple[int, int], ...]
    stiffness: float | None
    friction: str | None
    friction_rule: str | None
    exact_within: float | None
    compiled: bool = False
    held: frozenset[str] = frozenset()

    @property
    def class_name(self) -> str:
        """The manager's class."""
        return f"ContactMultiBody.{'Compiled' if self.compiled else ''}ContactManager"

    @property
    def apart(self) -> tuple[tuple[int, int], ...]:
        """Pairs of its bodies that never touch, as 1-based indices."""
        touching = {tuple(sorted(pair)) for pair in self.pairs}
        return tuple(pair for pair in combinations(range(1, len(self.bodies) + 1), 2) if pair not in touching)


@dataclass
class MechanismView:
    """The mechanical model.

    Attributes:
        part_names, joint_names, plane_names, material_names: Modelica name by name in the source.
    """

    gravity: float
    gravity_direction: Array
    components: list[Component] = field(default_factory=list)
    connections: list[Connection] = field(default_factory=list)
    part_names: dict[str, str] = field(default_factory=dict)
    joint_names: dict[str, str] = field(default_factory=dict)
    plane_names: dict[str, str] = field(default_factory=dict)
    material_names: dict[str, str] = field(default_factory=dict)
    contacts: ContactView | None = None
