"""Joints that follow others in a fixed ratio, as components of the library between their axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from cad2modelica.mechanism.model import Assembly, Coupling, Joint, JointType
from cad2modelica.modelica.text import number
from cad2modelica.source.lost import Lost

PACKAGE = "ContactMultiBody.Joints"


@dataclass(frozen=True)
class CouplingView:
    """A component between two joints' axes.

    Attributes:
        leader: its connector at the joint that leads.
        follower: its connector at the joint that follows.
    """

    class_name: str
    modifiers: tuple[str, ...]
    leader: str
    follower: str


def coupling_view(coupling: Coupling, leader: Joint, follower: Joint) -> CouplingView:
    """The component that makes one joint follow another."""
    ratio, offset = coupling.ratio, coupling.offset
    if leader.is_turning == follower.is_turning:
        kind = "RotationalCoupling" if leader.is_turning else "TranslationalCoupling"
        return CouplingView(f"{PACKAGE}.{kind}", _modifiers(ratio, offset), "flange_a", "flange_b")
    if leader.is_turning:
        return CouplingView(f"{PACKAGE}.RackCoupling", _modifiers(ratio, offset), "flangeR", "flangeT")
    # The component says the distance by the angle.
    return CouplingView(f"{PACKAGE}.RackCoupling", _modifiers(1 / ratio, -offset / ratio), "flangeT", "flangeR")


def _modifiers(ratio: float, offset: float) -> tuple[str, ...]:
    return (f"ratio={number(ratio)}", *((f"offset={number(offset)}",) if offset else ()))


def coupling_note(coupling: Coupling, leader: Joint, follower: Joint) -> str:
    """What is coupled, for the user."""

    def unit(joint: Joint) -> str:
        return "m" if joint.type is JointType.PRISMATIC else "rad"

    offset = f" + {coupling.offset:g} {unit(follower)}" if coupling.offset else ""
    ratio = f"{coupling.ratio:g}"
    if unit(follower) != unit(leader):
        ratio += f" {unit(follower)}/{unit(leader)}"
    return f"joint {coupling.follower!r} follows joint {coupling.leader!r}: {ratio} times its coordinate{offset}"


def with_couplings(assembly: Assembly, wanted: bool) -> Assembly:
    """The assembly with its joints coupled as the source says, and notes on it; or with none coupled."""
    if not assembly.couplings:
        return assembly
    joints = {joint.name: joint for joint in assembly.joints}
    if wanted:
        notes = [coupling_note(item, joints[item.leader], joints[item.follower]) for item in assembly.couplings]
        return replace(assembly, notes=(*assembly.notes, *notes))
    names = ", ".join(repr(item.follower) for item in assembly.couplings)
    note = f"joints that would follow others move by themselves, as was asked for: {names}"
    return replace(assembly, couplings=(), notes=(*assembly.notes, note))


def follow(
    couplings: Sequence[Coupling], independent: dict[str, list[bool]], rates: dict[str, list[float]]
) -> list[Lost]:
    """Makes coordinates of joints that follow dependent, and their rates what the leaders' say; changes both.

    Joints that follow stand in no loop: sources with couplings are trees.

    Returns:
        Notes on start speeds that were ignored.
    """
    by_follower = {item.follower: item for item in couplings}
    notes = []

    def rate(name: str) -> float:
        item = by_follower.get(name)
        return rates[name][0] if item is None else item.ratio * rate(item.leader)

    for name in by_follower:
        followed = rate(name)
        if rates[name][0] not in (0.0, followed):
            notes.append(
                Lost(f"joint {name!r}: its start speed follows from the joint it follows; the one given was ignored")
            )
        rates[name] = [followed]
        independent[name] = [False]
    return notes
