"""How the structures of two generated mechanics differ, in words."""

from __future__ import annotations

from collections.abc import Mapping

from cad2modelica.structure.entries import BodyEntry, JointEntry, Structure, ends
from cad2modelica.structure.renames import Renamed, Renames


def differences(before: Structure, after: Structure, renames: Renames) -> tuple[str, ...]:
    """What has changed, one line each: what is gone, new, seems renamed, or is joined in another way."""
    lines = _differences_of_names(before.bodies, after.bodies, renames.parts)
    old = {joint.source: joint for joint in before.joints}
    new = {joint.source: joint for joint in after.joints}
    lines += _gone("joint", [name for name in old if name not in new], renames.joints)
    found = {renamed.name for renamed in renames.joints.values()}
    lines += [
        f"joint {name!r} is new ({joint.type} from {joint.parent!r} to {joint.child!r})"
        for name, joint in new.items()
        if name not in old and name not in found
    ]
    for name, joint in new.items():
        if name in old:
            lines += _changes_of_joint(old[name], joint, renames)
    if before.contacts != after.contacts:
        lines.append(_change_of_contacts(before, after))
    if not lines and before != after:
        lines.append("the order of parts or joints has changed")
    return tuple(lines)


def _change_of_contacts(before: Structure, after: Structure) -> str:
    if bool(before.contacts) != bool(after.contacts):
        return f"there is {'now a' if after.contacts else 'no'} contact manager"
    return f"contacts is a {'CompiledContactManager' if after.contacts == 'compiled' else 'ContactManager'} now"


def _gone(kind: str, names: list[str], renamed: Mapping[str, Renamed]) -> list[str]:
    lines = []
    for name in names:
        guess = renamed.get(name)
        hint = f"; renamed {guess.name!r}, it seems: {guess.reason}" if guess is not None else ""
        lines.append(f"{kind} {name!r} is gone{hint}")
    return lines


def _differences_of_names(
    before: tuple[BodyEntry, ...], after: tuple[BodyEntry, ...], renamed: Mapping[str, Renamed]
) -> list[str]:
    old = {item.source: item.name for item in before}
    new = {item.source: item.name for item in after}
    found = {guess.name for guess in renamed.values()}
    lines = _gone("part", [source for source in old if source not in new], renamed)
    lines += [f"part {source!r} is new" for source in new if source not in old and source not in found]
    lines += [
        f"part {source!r} was called {old[source]!r} in the model, and is called {name!r}"
        for source, name in new.items()
        if source in old and old[source] != name
    ]
    return lines


def _changes_of_joint(before: JointEntry, after: JointEntry, renames: Renames) -> list[str]:
    """What has become of a joint that kept its name; that its parts are called otherwise is said of the parts."""
    if renames.ends_now(before) != ends(after):
        was, now = (f"{kind} from {parent!r} to {child!r}" for kind, parent, child in (ends(before), ends(after)))
        return [f"joint {after.source!r} was {was}, and is {now}"]
    if before.constraint != after.constraint:
        return [f"joint {after.source!r} is {'now' if after.constraint else 'no longer'} a planar loop constraint"]
    if before.name != after.name:
        return [f"joint {after.source!r} was called {before.name!r} in the model, and is called {after.name!r}"]
    return []
