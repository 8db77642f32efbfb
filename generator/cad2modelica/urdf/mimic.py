"""Joints of robot descriptions that follow others: the element mimic, and where such joints start."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lxml import etree

from cad2modelica.mechanism.model import Coupling
from cad2modelica.source.lost import Lost
from cad2modelica.urdf.elements import UrdfElements

SCALAR = ("revolute", "continuous", "prismatic")


def read_couplings(joints: Sequence[etree._Element], elements: UrdfElements) -> tuple[Coupling, ...]:
    """The couplings that can be kept, in the order of the file; a note on each that cannot.

    Args:
        joints: all elements ``joint``.
        elements: reads numbers, and takes the notes.
    """
    types = {joint.get("name", ""): joint.get("type", "") for joint in joints}
    found: dict[str, Coupling] = {}
    for joint in joints:
        mimic = joint.find("mimic")
        if mimic is None:
            continue
        follower, leader = joint.get("name", ""), mimic.get("joint", "")
        ratio = float(elements.numbers(mimic, "multiplier", (1.0,))[0])
        offset = float(elements.numbers(mimic, "offset", (0.0,))[0])
        if leader not in types:
            reason = "which does not exist"
        elif types[follower] not in SCALAR or types[leader] not in SCALAR:
            reason = "but only revolute, continuous and prismatic joints can be coupled"
        elif ratio == 0.0:
            reason = "but with the multiplier 0"
        elif _leads_back(follower, leader, found):
            reason = "which follows it"
        else:
            found[follower] = Coupling(follower, leader, ratio, offset)
            continue
        note = f"joint {follower!r} is to follow joint {leader!r} (mimic), {reason}: it moves by itself"
        elements.notes.append(Lost(note))
    return tuple(found.values())


def start_position(name: str, couplings: Mapping[str, Coupling]) -> float:
    """Coordinate of a joint where all joints that lead stand at zero."""
    coupling = couplings.get(name)
    if coupling is None:
        return 0.0
    return coupling.ratio * start_position(coupling.leader, couplings) + coupling.offset


def _leads_back(follower: str, leader: str, found: Mapping[str, Coupling]) -> bool:
    current = leader
    while current in found and current != follower:
        current = found[current].leader
    return current == follower
