"""Contact scenes of a model: what the engine is asked for, and how their bodies move.

An integrator that looks at the ends of its steps alone does not see bodies that pass through each other in between. The
engine does, where it is told how they move.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from modelica2fmu.equations.blocks import Block
from modelica2fmu.equations.parts import MOTION, RESPONSE
from modelica2fmu.expand.scalar_model import ExternalCall
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

QUERIES: Final = ("cmb_modelica_query_within", "cmb_modelica_query_volume_within")
_HANDLE: Final = 0
_POSITION, _ROTATION = 2, 4  # arguments of the queries
_VELOCITY, _ANGULAR = "v_0", "w_0"  # how contact managers name the velocities,
_RESULTS: Final = re.compile(r"(?:(.+)\.)?(?:pairDistance\[1\]|responseForce\[1,1\])")  # and what they are told first


@dataclass(frozen=True)
class Scene:
    """Bodies that the engine finds contacts of.

    Attributes:
        manager: name of the contact manager.
        handle: of the scene or the broad phase.
        is_broadphase: whether it is the latter.
        body_count: of bodies.
        motion: positions, rotations, velocities and angular velocities, as the engine takes them.
    """

    manager: str
    handle: float | Node
    is_broadphase: bool
    body_count: int
    motion: tuple[float | Node, ...]


def find_scenes(
    simulation: Sequence[Block], names: Collection[str], replacements: Mapping[str, float | Node]
) -> list[Scene]:
    """The scenes that a model asks the engine for.

    Args:
        simulation: blocks of the simulation.
        names: of all scalar variables, also of removed ones.
        replacements: what the removed ones are.
    """
    managers: dict[str, str] = {}  # by the symbol of their first result
    for name in names:
        found = _RESULTS.fullmatch(name)
        by = replacements.get(name, ex.symbol(name)) if found is not None else None
        if found is not None and isinstance(by, Node) and by.op == "symbol":
            managers[by.name] = found[1] or ""
    scenes = []
    for block in simulation:
        if isinstance(block, ExternalCall) and block.symbol in (RESPONSE, *QUERIES) and block.outputs[0] in managers:
            scene = _scene(block, managers[block.outputs[0]], names, replacements)
            if scene is not None:
                scenes.append(scene)
    return scenes


def _scene(
    call: ExternalCall, manager: str, names: Collection[str], replacements: Mapping[str, float | Node]
) -> Scene | None:
    handle = _numbers(call, _HANDLE)[0]
    if call.symbol == RESPONSE:
        motion = [value for position, _ in MOTION for value in _numbers(call, position)]
        return Scene(manager, handle, True, len(motion) // 18, tuple(motion))
    position, rotation = _numbers(call, _POSITION), _numbers(call, _ROTATION)
    count = len(position) // 3
    velocities = [
        f"{manager}.{name}[{body + 1},{axis + 1}]" if manager else f"{name}[{body + 1},{axis + 1}]"
        for name in (_VELOCITY, _ANGULAR)
        for body in range(count)
        for axis in range(3)
    ]
    if not all(name in names for name in velocities):
        return None  # of a manager of its own kind, whose bodies' velocities nothing tells
    known = [replacements.get(name, ex.symbol(name)) for name in velocities]
    return Scene(manager, handle, False, count, (*position, *rotation, *known))


def _numbers(call: ExternalCall, position: int) -> list[float | Node]:
    return [value for value in call.args[position].values if not isinstance(value, str)]
