"""A mechanical model while it is built: what stands already, the names taken and the line of the diagram."""

from __future__ import annotations

from cad2modelica.modelica.names import NamePool
from cad2modelica.modelica.view import Component, Connection, MechanismView

RESERVED = ("world", "contacts", "Mechanics", "Mechatronics", "Geometry")


class MechanismDraft:
    """Takes components and connections in their order.

    Attributes:
        view: what has been built so far.
        names: for components; those of the package are taken.
        row: line of the diagram in which components are placed.
    """

    def __init__(self, view: MechanismView) -> None:
        self.view = view
        self.names = NamePool(RESERVED)
        self.row = 0

    def place(
        self,
        class_name: str,
        name: str,
        modifiers: tuple[str, ...],
        description: str,
        column: int,
        level: int = 0,
    ) -> None:
        """Adds a component in the present row; see :class:`Component`."""
        self.view.components.append(Component(class_name, name, modifiers, description, column, self.row, level))

    def connect(self, first: str, second: str) -> None:
        """Adds a connection of two connectors, each ``component.connector``."""
        self.view.connections.append(Connection(first, second))
