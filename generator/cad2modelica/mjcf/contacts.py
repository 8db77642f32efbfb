"""Which bodies may touch: masks of geoms, pairs that are excluded, and pairs that are named."""

from __future__ import annotations

from cad2modelica.mechanism.model import GROUND, ContactSettings, DecompositionLimits
from cad2modelica.mjcf.document import MjcfDocument
from cad2modelica.mjcf.elements import Item, MjcfElements
from cad2modelica.mjcf.parts import MjcfParts
from cad2modelica.source.lost import Lost

FRICTION_RULE = "maximum"
"""MuJoCo takes the larger of two coefficients of friction."""


def pair_geoms(document: MjcfDocument) -> set[str]:
    """Names of the geoms in explicit pairs."""
    pairs = [item for item in document.section_items("contact") if item.tag == "pair"]
    return {item.text(key) for item in pairs for key in ("geom1", "geom2")}


def contact_settings(
    document: MjcfDocument, elements: MjcfElements, parts: MjcfParts, *, lossy: bool
) -> ContactSettings:
    """Contacts as the model has them, by parts and planes.

    Args:
        document: the model.
        elements: reads attributes.
        parts: parts, planes and geoms.
        lossy: whether bodies were left out, so that names of theirs are no mistakes.
    """
    if "contact" in document.disabled:
        return ContactSettings(all_pairs=False, friction_rule=FRICTION_RULE)
    excluded: list[tuple[str, str]] = []
    included: list[tuple[str, str]] = []
    for item in document.section_items("contact"):
        names = _names(item, elements, parts, lossy=lossy)
        if names is None or names[0] == names[1] or GROUND in names:
            continue
        (excluded if item.tag == "exclude" else included).append(names)
    wanted = {frozenset(pair) for pair in included}
    # An explicit pair counts although masks or an exclusion say otherwise.
    excluded = [pair for pair in excluded if frozenset(pair) not in wanted]
    excluded += [pair for pair in _kept_apart(parts) if frozenset(pair) not in wanted]
    return ContactSettings(
        all_pairs=_are_all_wanted(document),
        excluded=tuple(dict.fromkeys(excluded)),
        included=tuple(dict.fromkeys(included)),
        # Meshes collide as their hulls in the format itself; nothing else needs decomposition.
        decomposition=DecompositionLimits(triangles=0),
        friction_rule=FRICTION_RULE,
    )


def _names(item: Item, elements: MjcfElements, parts: MjcfParts, *, lossy: bool) -> tuple[str, str] | None:
    """The parts, planes or the ground that an exclusion or a pair is about; None if it names what is not there."""
    if item.tag not in ("exclude", "pair"):
        return None
    kind, known = ("geom", parts.of_geom) if item.tag == "pair" else ("body", parts.hosts)
    found: list[str] = []
    for number in (1, 2):
        name = item.text(f"{kind}{number}")
        host = known.get(name)
        if host is None and lossy:
            elements.notes.append(Lost(f"{elements.place(item.element)}: {kind}{number} {name!r} is not there"))
            return None
        if host is None:
            place = elements.place(item.element)
            elements.problems.add(f"{kind}{number} {name!r} does not exist", place, "Correct the name.")
            return None
        found.append(host)
    return found[0], found[1]


def _are_all_wanted(document: MjcfDocument) -> bool:
    """Whether contacts other than explicit pairs are wanted."""
    return not any(option.get("collision") == "predefined" for option in document.sections("option"))


def _kept_apart(parts: MjcfParts) -> list[tuple[str, str]]:
    """Pairs of parts and planes of which no geoms' masks match."""
    sides: dict[str, set[tuple[int, int]]] = {
        name: {geom.masks for geom in parts.geoms.get(name, ())} for name in parts.parts
    }
    sides |= {plane.name: {masks} for plane, masks in parts.planes}
    names = [name for name, masks in sides.items() if masks]
    return [
        (first, second)
        for number, first in enumerate(names)
        for second in names[number + 1 :]
        if not any(a & d or c & b for a, b in sides[first] for c, d in sides[second])
    ]
