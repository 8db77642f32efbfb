"""Instances of VRML97 prototypes: copies of their bodies in which ``IS`` is replaced by the instance's values."""

from __future__ import annotations

from typing import Any

from cmb_base.errors import InputError, Place

from cad2modelica.vrml_syntax import Node, Numbers, Prototype, Reference

MAXIMUM_DEPTH = 200


def instance_of(prototype: Prototype, node: Node) -> Node | None:
    """What stands for a node whose type is a prototype; None for one without a body.

    Raises:
        InputError: the prototype contains itself, or its body is nested too deep.
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
    instance = copier.node(prototype.body[0], 0)
    instance.name = node.name or instance.name
    return instance


def too_deep(node: Node) -> InputError:
    """The error for nodes that are nested too deep."""
    return InputError(
        f"nodes are nested deeper than {MAXIMUM_DEPTH}",
        place=Place(file=node.document.file, line=node.line),
        remedy="Export a flatter scene.",
    )


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

    def node(self, node: Node, depth: int) -> Node:
        if depth > MAXIMUM_DEPTH:
            raise too_deep(node)
        if id(node) not in self._copies:
            fields = {name: self._value(item, depth) for name, item in node.fields.items()}
            given = {name: item for name, item in fields.items() if item is not None}
            self._copies[id(node)] = Node(node.type, given, node.line, node.document, node.name, self._inside)
        return self._copies[id(node)]

    def _value(self, value: Any, depth: int) -> Any:
        if isinstance(value, Reference):
            return self._values.get(value.name)
        if isinstance(value, Node):
            return self.node(value, depth + 1)
        if isinstance(value, list):
            return [self._value(item, depth) for item in value]
        return value if isinstance(value, Numbers | str | bool) else None
