"""Random networks of electrical and translational parts in classes, arrays and loops, each with its motion.

Their index is 0 to 3, and what starts is given by start values, initial equations or steady states.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from network_classes import Component, Elements, NetworkClass
from network_motion import CONDITION, Motion, NoMotionError, Vector, motion, rest
from network_parts import PARTS, WAVES, Terms, classes, is_given, wave

CONNECTORS = ("Pin", "Flange")
USUAL = {
    "Pin": ("Resistor", "Resistor", "Capacitor", "Inductor", "Resistor", "Capacitor"),
    "Flange": ("Mass", "Spring", "Damper", "Mass"),
}
STATIC = ("Resistor", "Cubic", "Resistor", "Cubic", "Battery", "Generator", "Supply", "Transformer", "Ground")
SELDOM = ("Battery", "Generator", "Supply", "Transformer", "Motor", "Rod", "Lever", "Pull", "Weight", "Motor")
FACTORS = (0.5, 0.75, 1.0, 1.25, 2.0, 3.0)


@dataclass(frozen=True)
class RandomNetwork:
    """A package P with a model M, its variables, and their values at a time."""

    text: str
    names: Sequence[str]
    values: Callable[[float, Sequence[str]], Vector]


class _Writer:
    def __init__(self, choose: random.Random) -> None:
        self.choose = choose
        self.is_static = choose.random() < 0.15
        self.known: dict[str, NetworkClass] = {}

    def component(self, name: str, kind: str, is_top: bool) -> Component:
        choose = self.choose
        size = choose.choice([2, 3]) if choose.random() < 0.2 else 0
        return Component(
            name,
            kind,
            size,
            choose.choice(FACTORS),
            is_top or choose.random() < 0.6,
            is_present=choose.random() < 0.6,
            has_condition=choose.random() < 0.1,
        )

    def fill(self, found: NetworkClass, is_top: bool) -> None:
        choose = self.choose
        if not is_top:
            for _ in range(choose.choice([1, 2, 2, 3]) if not found.base else choose.choice([0, 0, 1])):
                name = f"p{len(found.all_ports) + 1}"
                found.ports[name] = "Pin" if self.is_static else choose.choice(CONNECTORS)
        kinds = self.kinds(found, is_top)
        choose.shuffle(kinds)
        first = len(found.all_components)
        for number, kind in enumerate(kinds):
            component = self.component(f"x{first + number}", kind, is_top)
            if not component.has_condition:
                component = replace(component, is_present=True)
            found.components.append(component)
        self.connect(found)

    def kinds(self, found: NetworkClass, is_top: bool) -> list[str]:
        """Of what a class has as components."""
        choose = self.choose
        kinds = [name for name in self.known if choose.random() < (0.9 if is_top else 0.4)]
        if self.is_static:
            return [*kinds, *(kind for kind in STATIC if choose.random() < 0.5)]
        connectors = set(found.all_ports.values()) or set(choose.choice([("Pin",), ("Flange",), CONNECTORS]))
        kinds += [kind for name in CONNECTORS if name in connectors for kind in USUAL[name] if choose.random() < 0.6]
        kinds += [kind for kind in SELDOM if choose.random() < 0.12 and set(PARTS[kind].ports.values()) <= connectors]
        if is_top or choose.random() < 0.3:
            kinds += [kind for kind, name in (("Ground", "Pin"), ("Fixed", "Flange")) if name in connectors]
        return kinds

    def connect(self, found: NetworkClass) -> None:
        choose = self.choose
        loose: dict[str, list[str]] = {name: [] for name in CONNECTORS}
        for component in found.all_components:
            kind = component.kind
            ports = dict(PARTS[kind].ports if kind in PARTS else self.known[kind].all_ports)
            names = list(ports)
            if component.size and len(names) > 1 and ports[names[0]] == ports[names[1]] and choose.random() < 0.7:
                self.chain(found, component, names[0], names[1], choose.random() < 0.5)
                for port in names[2:]:
                    loose[ports[port]] += [f"{name}.{port}" for name in component.names]
                loose[ports[names[0]]] += [f"{component.names[0]}.{names[0]}", f"{component.names[-1]}.{names[1]}"]
                continue
            for port, connector in ports.items():
                loose[connector] += [f"{name}.{port}" for name in component.names]
        for connector, ports_here in loose.items():
            own = [name for name, kind in found.ports.items() if kind == connector]
            self.nodes(found, ports_here, own)

    def chain(self, found: NetworkClass, component: Component, first: str, last: str, is_slice: bool) -> None:
        name, size = component.name, component.size
        if is_slice:
            text = f"connect({name}[1:{size - 1}].{last}, {name}[2:{size}].{first});"
        else:
            text = f"for i in 1:{size - 1} loop connect({name}[i].{last}, {name}[i + 1].{first}); end for;"
        pairs = [(f"{name}[{index}].{last}", f"{name}[{index + 1}].{first}") for index in range(1, size)]
        found.links.append((text, pairs))

    def nodes(self, found: NetworkClass, ports: list[str], own: list[str]) -> None:
        """Ports at random nodes, of which each is connected as a tree."""
        choose = self.choose
        ports = [port for port in ports if choose.random() < 0.97]
        choose.shuffle(ports)
        count = max(1, len(own), round(len(ports) * choose.uniform(0.3, 0.55)))
        nodes: list[list[str]] = [[] for _ in range(count)]
        for number, port in enumerate(ports):
            nodes[number if number < count else choose.randrange(count)].append(port)
        for number, port in enumerate(own):
            nodes[number].append(port)
        for members in nodes:
            choose.shuffle(members)
            for number in range(1, len(members)):
                pair = [members[number], members[choose.randrange(number)]]
                choose.shuffle(pair)
                found.links.append((f"connect({pair[0]}, {pair[1]});", [(pair[0], pair[1])]))

    def start(self, elements: Elements, found: Motion) -> tuple[list[str], Vector]:
        """Initial conditions as text, and what starts."""
        choose = self.choose
        given = [name for name in found.names if is_given(name)]
        rows = [found.row(((1.0, name),)) for name in given]
        values = [0.0 if name.startswith("sin ") else 1.0 for name in given]
        states = [f"{path}.{name}" for path, (kind, _) in elements.parts.items() for name in PARTS[kind].states]
        choose.shuffle(states)
        others = [name for name in found.names if not is_given(name) and name not in states]
        choose.shuffle(others)
        lines: list[str] = []
        for name in [*states, *others]:
            if len(rows) == found.freedom:
                break
            terms: Terms = ((1.0, name),)
            value = choose.choice([0.0, 0.25, 0.5, -1.0, 1.5])
            kind = choose.choice(["fixed", "fixed", "equation", "der", "sum"])
            if kind == "der" and name in states:
                terms, value = ((1.0, f"der {name}"),), choose.choice([0.0, 0.0, 1.0])
            elif kind == "sum" and states:
                terms = (*terms, (0.5, choose.choice(states)))
            row = found.row(terms)
            if _is_new(rows, row):
                rows.append(row)
                values.append(value)
                lines.append(_initial(terms, value, kind == "fixed" and name in states))
        if len(rows) < found.freedom or np.linalg.cond(np.array(rows)) > CONDITION:
            raise NoMotionError
        return lines, np.linalg.solve(np.array(rows), np.array(values))


def _is_new(rows: Sequence[Vector], row: Vector) -> bool:
    size = np.linalg.norm(row)
    if size < 1e-3:
        return False
    if not rows:
        return True
    basis, _ = np.linalg.qr(np.array(rows).T)
    return bool(np.linalg.norm(row - basis @ (basis.T @ row)) > 0.02 * size)


def _initial(terms: Terms, value: float, is_start: bool) -> str:
    """An initial equation, or a modifier's text ``path = value``."""
    if is_start and "[" not in terms[0][1]:
        return f"start {terms[0][1]} {value:g}"
    parts = [f"{factor:g}*{f'der({name[4:]})' if name[:4] == 'der ' else name}" for factor, name in terms]
    return f"{' + '.join(parts)} = {value:g};"


def _nested(paths: Sequence[tuple[list[str], str]]) -> str:
    """Modifiers of paths, with those of one component together."""
    heads: dict[str, list[tuple[list[str], str]]] = {}
    for path, value in paths:
        heads.setdefault(path[0], []).append((path[1:], value))
    texts = []
    for head, inner in heads.items():
        inside = inner[0][1] if not inner[0][0] else _nested(inner)
        texts.append(f"{head}({inside})")
    return ", ".join(texts)


def random_network(seed: int) -> RandomNetwork | None:
    """Nothing where the network does not move as one can say."""
    writer = _Writer(random.Random(seed))
    choose = writer.choose
    for number in range(choose.choice([0, 1, 1, 2])):
        unit = NetworkClass(f"Unit{number}", choose.choice([None, *writer.known.values()]))
        writer.fill(unit, False)
        writer.known[unit.name] = unit
    top = NetworkClass("Top")
    writer.fill(top, True)
    elements = Elements()
    elements.add("", top, writer.known, 1.0)
    conditions: list[str] = []
    values: Callable[[float, Sequence[str]], Vector]
    try:
        if writer.is_static:
            still = rest(elements.equations())
            names, values = still.names, still.at
            values(1.0, [])
        else:
            found = motion(elements.equations(), {wave(k) for kind, k in elements.parts.values() if kind in WAVES})
            conditions, start = writer.start(elements, found)
            names, values = found.names, partial(found.at, start)
    except NoMotionError:
        return None
    if not elements.potentials() <= set(names):
        return None
    text = _package([*writer.known.values(), top], conditions)
    return RandomNetwork(text, [name for name in names if not is_given(name)], values)


def _package(units: Sequence[NetworkClass], conditions: Sequence[str]) -> str:
    starts = [line.split()[1:] for line in conditions if line.startswith("start ")]
    change = _nested([(path.split("."), f"start = {value}, fixed = true") for path, value in starts])
    others = [line for line in conditions if not line.startswith("start ")]
    lines = [*classes(), *(unit.text() for unit in units), f"model M extends Top{f'({change})' if change else ''};"]
    if others:
        lines += ["initial equation", *others]
    return "\n  ".join(["package P", *lines, "end M;"]) + "\nend P;\n"
