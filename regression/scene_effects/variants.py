"""Variants of a scene, each with other effects switched on."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.output import whole_file

from scene_effects.choices import EFFECTS, Change, Friction, Restitution
from scene_effects.manager import Manager, Parameters

FULL_POINTS = 4
MEMORYLESS = "restitution memoryless"


@dataclass(frozen=True)
class Variant:
    """A variant: what it is called and what it changes; ``change`` None stands for the model as it is."""

    name: str
    change: Change | None


def fullest(manager: Manager, parameters: Parameters) -> Change:
    """Every effect on: anchored friction, restitution by events, torques of friction where radii are given."""
    has_radii = any(parameters.pair["spinRadius"]) or any(parameters.pair["rollingLever"])
    return Change(
        friction=Friction.ANCHORED,
        restitution=Restitution.BY_EVENT if manager.regards_restitution else None,
        turning=True if has_radii else None,
        point_capacity=max(FULL_POINTS, manager.point_capacity),
    )


def variants_of(
    manager: Manager,
    parameters: Parameters,
    touching: Collection[int],
    effects: Collection[str] = EFFECTS,
) -> tuple[Variant, ...]:
    """The variants that differ from the fullest one by one effect, then the one with as little as possible.

    Args:
        manager: as the model has it.
        parameters: its numbers.
        touching: pairs, counted from 0, that touch.
        effects: those to vary, of EFFECTS.
    """
    full = fullest(manager, parameters)
    single: list[tuple[str, Change]] = []
    if "friction" in effects:
        single.append(("friction regularised", Change(friction=Friction.REGULARISED)))
        single.append(("friction none", Change(friction=Friction.NONE)))
    if "restitution" in effects and manager.regards_restitution:
        single.append((MEMORYLESS, memoryless(manager, parameters)))
        single.append(("restitution none", without_restitution(manager, parameters)))
    if "turning" in effects and full.turning:
        single.append(("spin and rolling off", Change(turning=False)))
    if "points" in effects:
        single.append(("1 point a pair", Change(point_capacity=1)))
    if "pairs" in effects and 0 < len(touching) < len(manager.pairs):
        count = len(touching)
        single.append((f"{count} of {len(manager.pairs)} pairs", Change(kept_pairs=tuple(sorted(touching)))))
    found = [Variant(name, full.with_(change)) for name, change in single]
    least = full
    for name, change in single:
        least = least if name == MEMORYLESS else least.with_(change)
    if least not in [variant.change for variant in found]:
        found.append(Variant("all of these off", least))
    return tuple(found)


def memoryless(manager: Manager, parameters: Parameters) -> Change:
    """Restitution without events; effective masses from the bodies' masses where the model does not use its own."""
    if manager.restitution is Restitution.MEMORYLESS:
        return Change(restitution=Restitution.MEMORYLESS)
    masses = []
    for k, (a, b) in enumerate(manager.pairs):
        inverse = 1 / parameters.masses[a - 1] + 1 / parameters.masses[b - 1]
        given = parameters.pair["effectiveMass"][k] or _UNKNOWN_MASS
        masses.append(1 / inverse if inverse > 0 and math.isfinite(inverse) else given)
    return Change(restitution=Restitution.MEMORYLESS, values={"effectiveMass": tuple(masses)})


_UNKNOWN_MASS = 1.0
"""kg; the effective mass of a pair of bodies whose masses the FMU does not show."""
_DAMPING_AT_REST = 20.0
"""Damping factor by which ContactMultiBody.NormalForce.dampingRate damps a contact that starts at rest."""


def without_restitution(manager: Manager, parameters: Parameters) -> Change:
    """No restitution; contacts are damped as events would have them damped that start at rest."""
    if manager.restitution is Restitution.NONE:
        return Change(restitution=Restitution.NONE)
    rate = _DAMPING_AT_REST / parameters.rest_speed
    return Change(restitution=Restitution.NONE, values={"steadyRate": (rate,) * len(manager.pairs)})


_RESTITUTION: Mapping[Restitution, tuple[tuple[str, str], ...]] = {
    Restitution.BY_EVENT: (
        ("useRestitution", "true"),
        ("restitutionMethod", "ContactMultiBody.Types.RestitutionMethod.ImpactSpeed"),
    ),
    Restitution.MEMORYLESS: (
        ("useRestitution", "true"),
        ("restitutionMethod", "ContactMultiBody.Types.RestitutionMethod.Memoryless"),
    ),
    Restitution.NONE: (("useRestitution", "false"),),
}
_LIBRARY_DEFAULTS: Mapping[str, float] = {
    "contactRadius": 0.01,
    "damping": 1e3,
    "effectiveMass": 0.0,
    "steadyRate": 0.5,
    "spinRadius": 0.0,
    "rollingLever": 0.0,
}
"""Parameters of pairs whose default is one number; those that have it need not be written again."""


def modification(change: Change, manager: Manager, parameters: Parameters) -> str:
    """A change as a Modelica modification, e.g. "contacts(friction=...)"; "" if nothing changes.

    Where pairs are left out, the parameters of the others are written too, as their arrays become shorter.
    """
    assignments: list[tuple[str, str]] = []
    if change.friction is not None:
        assignments.append(("friction", f"ContactMultiBody.Types.Friction.{change.friction.value}"))
    if change.restitution is not None:
        assignments += _RESTITUTION[change.restitution]
    if change.turning is not None:
        assignments.append(("useTurningFriction", "true" if change.turning else "false"))
    if change.point_capacity is not None:
        assignments.append(("pointCapacity", str(change.point_capacity)))
    if change.law is not None:
        assignments.append(("normalLaw", f"ContactMultiBody.Types.NormalLaw.{change.law}"))
    if change.exponent is not None:
        assignments.append(("exponent", repr(change.exponent)))
    if change.backend is not None:
        assignments.append(("backend", f"ContactMultiBody.Types.Backend.{change.backend}"))
    if change.geometry is not None:
        assignments.append(("geometry", "{" + ",".join(_text(descriptor) for descriptor in change.geometry) + "}"))
    values = dict(change.values)
    if change.kept_pairs is not None:
        pairs = (manager.pairs[k] for k in change.kept_pairs)
        assignments.append(("pairs", "{" + ",".join(f"{{{a},{b}}}" for a, b in pairs) + "}"))
        every = {**parameters.pair, **values}
        values = {
            name: tuple(numbers[k] for k in change.kept_pairs)
            for name, numbers in every.items()
            if set(numbers) != {_LIBRARY_DEFAULTS.get(name)}
        }
    assignments += [(name, _numbers(numbers)) for name, numbers in values.items()]
    if not assignments:
        return ""
    text = ", ".join(f"{name}={value}" for name, value in assignments)
    for name in reversed(manager.name.split(".")):
        text = f"{name}({text})"
    return text


def write_variant(path: Path, model: str, modification: str) -> None:
    """Writes a Modelica file whose model, named as the file, extends ``model`` with a modification."""
    base = f"{model}({modification})" if modification else model
    # The front end looks for libraries that the file names; the base model's own names are not enough for it.
    imports = "".join(f"  import {library};\n" for library in ("Modelica", "ContactMultiBody"))
    text = f'model {path.stem} "A variant of {model}"\n{imports}  extends {base};\nend {path.stem};\n'
    with whole_file(path) as staging:
        staging.write_text(text, encoding="utf-8", newline="\n")


def _text(text: str) -> str:
    """A text in Modelica."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def _numbers(numbers: tuple[float, ...]) -> str:
    """An array in Modelica, shorter where all numbers are the same."""
    if len(numbers) > 2 and len(set(numbers)) == 1:
        return f"fill({numbers[0]!r}, {len(numbers)})"
    return "{" + ",".join(repr(number) for number in numbers) + "}"
