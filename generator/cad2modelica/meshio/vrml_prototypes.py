"""Instances of VRML97 prototypes: copies of their bodies in which ``IS`` is replaced by the instance's values."""

from __future__ import annotations

from typing import Any

from contact_foundation.errors import InputError, Place

from cad2modelica.meshio.vrml_syntax import Node, Numbers, Prototype, Reference


def instance_of(prototype: Prototype, node: Node) -> Node | None:
    """What stands for a node whose type is a prototype; None for one without a body.

    Raises:
        InputError: the prototype contains itself.
    """
    if prototype in node.inside:
        raise InputError(
            f"the prototype {prototype.name} contains itself",
            place=Place(file=node.document.file, line=node.line),
            remedy="Remove the circle of PROTO nodes.",
        )
    if not prototype.body:
        return None
    copier = _Copier({**prototype.defaults, **node.fields}, (*node.inside, prototype))
    instance = copier.copy(prototype.body[0])
    instance.name = node.name or instance.name
    return instance


class _Copier:
    """Copies nodes once each, so that what ``USE`` shares stays shared.

    Args:
        values: what ``IS`` stands for.
        inside: prototypes whose bodies the copies belong to.
    """

    def __init__(self, values: dict[str, Any], inside: tuple[Prototype, ...]) -> None:
        self._values = values
        self._inside = inside
        self._copies: dict[int, Node] = {}
        self._waiting: list[Node] = []  # a stack instead of recursion: bodies may be nested deeply

    def copy(self, root: Node) -> Node:
        """A copy of a node and of all below it."""
        copied = self._copy_of(root)
        while self._waiting:
            node = self._waiting.pop()
            fields = {name: self._value(item) for name, item in node.fields.items()}
            self._copy_of(node).fields.update((name, item) for name, item in fields.items() if item is not None)
        return copied

    def _copy_of(self, node: Node) -> Node:
        if id(node) not in self._copies:
            self._copies[id(node)] = Node(node.type, {}, node.line, node.document, node.name, self._inside)
            self._waiting.append(node)
        return self._copies[id(node)]

    def _value(self, value: Any) -> Any:
        if isinstance(value, Reference):
            return self._values.get(value.name)
        if isinstance(value, Node):
            return self._copy_of(value)
        if isinstance(value, list):  # of nodes or texts: lists hold no lists
            return [self._copy_of(item) if isinstance(item, Node) else item for item in value]
        return value if isinstance(value, Numbers | str | bool) else None
