"""Parts of a model that know each other through contacts alone, as free bodies do.

Bodies out of each other's reach do not act on each other, so that the integrator may follow each with steps of its
own. What belongs to a part is found from the equations: states and variables that depend on each other in any other way
than through the engine's response are one part.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from modelica2fmu.equations.blocks import Assignment, Block, needed_blocks
from modelica2fmu.expand.scalar_model import CallArgument, ExternalCall, Kind, ScalarModel, derivative_name
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

RESPONSE: Final = "cmb_modelica_response"
_LEAST_STATES: Final = 100  # STATES_OF_A_RACE of fmurt_solver.c: below, explicit steps are not tried
_LEAST_PARTS: Final = 4
_MOST_FIXED: Final = 16  # bodies, each of which is looked at beside every part
_MOST_KINDS: Final = 8
_POSITION, _ROTATION, _VELOCITY, _ANGULAR = 1, 3, 4, 5  # arguments of the response: how bodies move
_FORCE, _TORQUE = 17, 18  # what acts on them
MOTION: Final = ((_POSITION, 3), (_ROTATION, 9), (_VELOCITY, 3), (_ANGULAR, 3))
"""Arguments that tell how bodies move, and how many numbers a body has in each."""
_SUBSCRIPT: Final = re.compile(r"\[\d+")

STATE: Final = "state:"
PARAMETER: Final = "parameter:"
WRENCH: Final = "wrench:"


@dataclass(frozen=True)
class PartKind:
    """What parts that differ by their states, bodies and parameters alone have in common.

    Expressions contain the symbols ``STATE`` with a number, ``WRENCH`` with one (of each body three forces and three
    torques) and ``PARAMETER`` with a name.

    Attributes:
        motion: of each body position, rotation, velocity and angular velocity, as the engine takes them.
        rates: derivatives of the states.
        parameters: symbols of the parameters.
    """

    motion: tuple[tuple[float | Node, ...], ...]
    rates: tuple[float | Node, ...]
    parameters: tuple[str, ...]


@dataclass(frozen=True)
class Part:
    """States and bodies that belong together.

    Attributes:
        kind: number of the kind.
        states: their numbers.
        bodies: 0-based numbers of bodies in the engine's call.
        parameters: names of the parameters, in the order of the kind's.
    """

    kind: int
    states: tuple[int, ...]
    bodies: tuple[int, ...]
    parameters: tuple[str, ...]


@dataclass(frozen=True)
class Parts:
    """A model's parts.

    Attributes:
        call: of the engine's response.
        body_count: of all bodies.
        fixed: 0-based numbers of those that belong to no part.
        kinds: of parts.
        parts: all of them; each state belongs to one.
    """

    call: ExternalCall
    body_count: int
    fixed: tuple[int, ...]
    kinds: tuple[PartKind, ...]
    parts: tuple[Part, ...]


def find_parts(simulation: Sequence[Block], states: Sequence[str], model: ScalarModel) -> Parts | None:
    """The parts of a model without lasting assertions at level error, or nothing where it is not made of many.

    Args:
        simulation: sorted blocks.
        states: names of the states, in order.
        model: variables.
    """
    if len(states) < _LEAST_STATES or model.relations:
        return None
    blocks = needed_blocks(simulation, [derivative_name(name) for name in states])
    calls = [block for block in blocks if isinstance(block, ExternalCall)]
    steps = [block for block in blocks if isinstance(block, Assignment) and not block.is_discrete]
    if len(calls) != 1 or len(steps) + 1 != len(blocks) or calls[0].symbol != RESPONSE:
        return None
    return _Finder(calls[0], steps, states, model).run()


class _Finder:
    def __init__(
        self, call: ExternalCall, steps: Sequence[Assignment], states: Sequence[str], model: ScalarModel
    ) -> None:
        self._call = call
        self._steps = steps
        self._states = states
        self._model = model
        self._parent: dict[str, str] = {}
        self._body_count = len(call.args[_POSITION].values) // 3

    def run(self) -> Parts | None:
        fixed = self._unite()
        if fixed is None:
            return None
        states: dict[str, list[int]] = {}
        bodies: dict[str, list[int]] = {}
        for number, name in enumerate(self._states):
            states.setdefault(self._root(name), []).append(number)
        for body in range(self._body_count):
            if body not in fixed:
                bodies.setdefault(self._root(_body(body)), []).append(body)
        if len(states) < _LEAST_PARTS or set(states) != set(bodies):
            return None
        return self._parts([(states[root], bodies[root]) for root in states], fixed)

    # --- what belongs together ---

    def _unite(self) -> list[int] | None:
        """Unites all that depends on each other; the bodies that never move, or nothing where a part cannot be told."""
        for name in self._states:
            self._parent[name] = name
        outputs: dict[str, int] = {}
        for position in (_FORCE, _TORQUE):
            for k, value in enumerate(self._call.args[position].values):
                assert isinstance(value, Node)
                outputs[value.name] = k // 3
        for body in range(self._body_count):
            self._parent[_body(body)] = _body(body)
        known = set(self._states)
        for step in self._steps:
            self._parent.setdefault(step.target, step.target)
        targets = {step.target for step in self._steps}
        for step in self._steps:
            for name in ex.symbols(step.value):
                if name in known or name in targets:
                    self._join(step.target, name)
                elif name in outputs:
                    self._join(step.target, _body(outputs[name]))
                elif not self._is_known(name):
                    return None
        fixed = []
        for body in range(self._body_count):
            moving = [name for name in ex.symbols(*self._motion(body)) if not self._is_known(name)]
            if not moving:
                fixed.append(body)
            for name in moving:
                if name not in known and name not in targets:
                    return None
                self._join(_body(body), name)
        others = [value for k, item in enumerate(self._call.args) if k not in dict(MOTION) for value in _inputs(item)]
        if len(fixed) > _MOST_FIXED or not all(self._is_known(name) for name in ex.symbols(*others)):
            return None
        return fixed

    def _is_known(self, name: str) -> bool:
        """True for parameters of the model and what else is not changed by time or states."""
        variable = self._model.variables.get(name)
        return variable is not None and variable.kind in (Kind.PARAMETER, Kind.CONSTANT, Kind.FREE_PARAMETER)

    def _motion(self, body: int) -> list[float | Node]:
        return [
            value
            for position, size in MOTION
            for value in self._call.args[position].values[size * body : size * (body + 1)]
            if not isinstance(value, str)
        ]

    def _root(self, name: str) -> str:
        while self._parent[name] != name:
            self._parent[name] = self._parent[self._parent[name]]
            name = self._parent[name]
        return name

    def _join(self, one: str, other: str) -> None:
        self._parent[self._root(one)] = self._root(other)

    # --- what they have in common ---

    def _parts(self, members: Sequence[tuple[list[int], list[int]]], fixed: Sequence[int]) -> Parts | None:
        mapping: dict[str, float | Node] = {}
        names: dict[int, dict[str, str]] = {}  # of the parameters of each part, by symbol
        parameters = self._parameters()
        for number, (states, bodies) in enumerate(members):
            for k, state in enumerate(states):
                mapping[self._states[state]] = ex.symbol(f"{STATE}{k}")
            for k, body in enumerate(bodies):
                for position, start in ((_FORCE, 6 * k), (_TORQUE, 6 * k + 3)):
                    for axis, value in enumerate(self._call.args[position].values[3 * body : 3 * body + 3]):
                        assert isinstance(value, Node)
                        mapping[value.name] = ex.symbol(f"{WRENCH}{start + axis}")
            names[number] = _symbols_of(parameters[self._root(self._states[states[0]])])
            mapping.update({name: ex.symbol(symbol) for symbol, name in names[number].items()})
        substituted = ex.Substitution(mapping)
        for step in self._steps:
            mapping[step.target] = substituted(step.value)
        kinds: dict[PartKind, int] = {}
        parts = []
        for number, (states, bodies) in enumerate(members):
            motion = tuple(tuple(substituted(value) for value in self._motion(body)) for body in bodies)
            rates = tuple(substituted(ex.symbol(derivative_name(self._states[state]))) for state in states)
            read = ex.symbols(*rates, *(value for row in motion for value in row))
            symbols = tuple(name for name in read if name.startswith(PARAMETER))
            kind = kinds.setdefault(PartKind(motion, rates, symbols), len(kinds))
            parts.append(Part(kind, tuple(states), tuple(bodies), tuple(names[number][name] for name in symbols)))
        if len(kinds) > _MOST_KINDS:
            return None
        return Parts(self._call, self._body_count, tuple(fixed), tuple(kinds), tuple(parts))

    def _parameters(self) -> dict[str, list[tuple[str, bool]]]:
        """The parameters that each part reads, and whether it is the only one."""
        readers: dict[str, dict[str, None]] = {}
        roots_of_parts = {self._root(name) for name in self._states}
        sources = [(step.target, [step.value]) for step in self._steps]
        sources += [(_body(body), self._motion(body)) for body in range(self._body_count)]
        for target, roots in sources:
            part = self._root(target)
            if part not in roots_of_parts:
                continue
            for name in ex.symbols(*roots):
                if self._is_known(name):
                    readers.setdefault(name, {})[part] = None
        result: dict[str, list[tuple[str, bool]]] = {part: [] for part in roots_of_parts}
        for name, parts in readers.items():
            for part in parts:
                result[part].append((name, len(parts) == 1))
        return result


def _symbols_of(parameters: Sequence[tuple[str, bool]]) -> dict[str, str]:
    """Symbols of a part's parameters; those of parts alone are the same for ``body[1].m`` and ``body[2].m``."""
    result: dict[str, str] = {}
    for name, is_own in parameters:
        symbol = PARAMETER + (_SUBSCRIPT.sub("[", name, count=1) if is_own else name)
        result[symbol if symbol not in result else PARAMETER + name] = name
    return result


def _body(number: int) -> str:
    return f"body:{number}"


def _inputs(argument: CallArgument) -> list[float | Node]:
    if argument.is_output:
        return []
    return [value for value in argument.values if not isinstance(value, str)]
