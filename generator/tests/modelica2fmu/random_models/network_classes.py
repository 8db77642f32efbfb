"""Classes of parts that are connected, and their instances with the connection sets that the language makes of them.

Modelica Language Specification 3.6, 9.2: a port is inside where it belongs to a component of the class that connects
it, outside where it is the class's own; flows of a set add up to zero, those of outside ports with the other sign.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from network_parts import FLOW, PARTS, POTENTIAL, Terms, is_given

Port = tuple[str, bool]  # its path, and whether it is outside


@dataclass(frozen=True)
class Component:
    """A part or an instance of a class.

    Attributes:
        size: of an array, 0 for a scalar.
        factor: of its parameter k, by that of the class or by 1.
        is_absolute: = true, if the factor is its parameter.
        is_present: = false, if its condition fails.
    """

    name: str
    kind: str
    size: int = 0
    factor: float = 1.0
    is_absolute: bool = True
    is_present: bool = True
    has_condition: bool = False

    @property
    def names(self) -> list[str]:
        return [f"{self.name}[{index + 1}]" for index in range(self.size)] if self.size else [self.name]

    def text(self) -> str:
        value = f"{self.factor:g}" if self.is_absolute else f"{self.factor:g}*k"
        each, size = ("each ", f"[{self.size}]") if self.size else ("", "")
        switch = f" if {'on' if self.is_present else 'not on'}" if self.has_condition else ""
        return f"{self.kind} {self.name}{size}({each}k = {value}){switch};"


@dataclass
class NetworkClass:
    """One with ports, components and connections.

    Attributes:
        ports: its own, each with its connector.
        base: a class that it extends.
        links: pairs of ports in text and one by one, as ``a`` (own) and ``part.a``.
    """

    name: str
    base: NetworkClass | None = None
    ports: dict[str, str] = field(default_factory=dict)
    components: list[Component] = field(default_factory=list)
    links: list[tuple[str, list[tuple[str, str]]]] = field(default_factory=list)

    @property
    def all_ports(self) -> dict[str, str]:
        return (self.base.all_ports if self.base else {}) | self.ports

    @property
    def all_components(self) -> list[Component]:
        return [*(self.base.all_components if self.base else []), *self.components]

    @property
    def all_links(self) -> list[tuple[str, str]]:
        own = [pair for _, pairs in self.links for pair in pairs]
        return [*(self.base.all_links if self.base else []), *own]

    def text(self) -> str:
        head = (
            [f"extends {self.base.name};"] if self.base else ["parameter Real k = 1;", "parameter Boolean on = true;"]
        )
        ports = [f"{connector} {name};" for name, connector in self.ports.items()]
        parts = [component.text() for component in self.components]
        lines = [*head, *ports, *parts, "equation", *(text for text, _ in self.links)]
        body = "\n    ".join(lines)
        return f"model {self.name}\n    {body}\n  end {self.name};"


@dataclass
class Elements:
    """What an instance consists of.

    Attributes:
        parts: their equations by path.
        ports: of all parts and instances, with their connectors.
        sets: of connected ports.
    """

    parts: dict[str, tuple[str, float]] = field(default_factory=dict)
    ports: dict[str, str] = field(default_factory=dict)
    _parent: dict[Port, Port] = field(default_factory=dict)

    def add(self, path: str, found: NetworkClass, known: Mapping[str, NetworkClass], k: float) -> None:
        present: set[str] = set(found.all_ports)
        for component in found.all_components:
            if not component.is_present:
                continue
            own = component.factor * (1.0 if component.is_absolute else k)
            ports = PARTS[component.kind].ports if component.kind in PARTS else known[component.kind].all_ports
            for name in component.names:
                here = f"{path}{name}"
                present |= {f"{name}.{port}" for port in ports}
                self.ports |= {f"{here}.{port}": connector for port, connector in ports.items()}
                for port in ports:
                    self._root((f"{here}.{port}", False))
                if component.kind in PARTS:
                    self.parts[here] = (component.kind, own)
                else:
                    self.add(f"{here}.", known[component.kind], known, own)
        for first, second in found.all_links:
            if first in present and second in present:
                one, other = ((f"{path}{port}", port in found.all_ports) for port in (first, second))
                self._parent[self._root(one)] = self._root(other)

    def _root(self, port: Port) -> Port:
        self._parent.setdefault(port, port)
        while self._parent[port] != port:
            port = self._parent[port]
        return port

    def potentials(self) -> set[str]:
        """Those of all ports."""
        return {f"{path}.{POTENTIAL[connector]}" for path, connector in self.ports.items()}

    def equations(self) -> Iterator[Terms]:
        """Those of parts, and those of sets."""
        for path, (kind, k) in self.parts.items():
            for terms in PARTS[kind].equations(k):
                yield tuple((factor, _inside(path, name)) for factor, name in terms)
        sets: dict[Port, list[Port]] = {}
        for port in list(self._parent):
            sets.setdefault(self._root(port), []).append(port)
        for members in sets.values():
            connector = self.ports[members[0][0]]
            first = f"{members[0][0]}.{POTENTIAL[connector]}"
            for path, _ in members[1:]:
                yield (1.0, first), (-1.0, f"{path}.{POTENTIAL[connector]}")
            yield tuple((-1.0 if is_outside else 1.0, f"{path}.{FLOW[connector]}") for path, is_outside in members)


def _inside(path: str, name: str) -> str:
    if is_given(name):
        return name
    kind, _, inner = name.rpartition(" ")
    return f"{kind} {path}.{inner}" if kind else f"{path}.{inner}"
