"""A model as one tree: included files are put in place, replications are written out, default classes are known."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from copy import deepcopy
from functools import cached_property
from pathlib import Path

from contact_foundation.errors import CmbError, Place
from lxml import etree

from cad2modelica.meshio.mesh_reference import MeshReferences
from cad2modelica.mjcf.elements import FILE_MARK, Item, MjcfElements
from cad2modelica.source.xml_document import read_xml

MOST_INCLUDES = 500
MOST_ELEMENTS = 200_000
COPY = "cmb-copy"
MAIN = "main"
ACTUATORS = frozenset(
    (
        "general",
        "motor",
        "position",
        "velocity",
        "intvelocity",
        "damper",
        "cylinder",
        "muscle",
        "adhesion",
        "plugin",
        "dcmotor",
    )
)
ACTUATOR = "actuator"
"""Key of the defaults that all kinds of actuators share."""
KIND = "cmb-kind"
"""Attribute of these defaults: the kind of actuator that they were written for."""
_PARTIAL = frozenset(("size", "friction", "range", "ctrlrange", "forcerange", "gainprm", "biasprm"))
"""Lists of which a shorter one replaces the first numbers only."""
_GROUPS = {
    "constraint": frozenset(("equality", "frictionloss", "limit", "contact")),
    "passive": frozenset(("spring", "damper")),
}
"""Flags that stand for several others."""

Attributes = dict[str, str]


class MjcfDocument:
    """The sections of a model.

    Args:
        root: the element ``mujoco``; it is changed: what it includes is put into it.
        elements: reads attributes, and takes problems.
        references: finds files that are included.
    """

    def __init__(self, root: etree._Element, elements: MjcfElements, references: MeshReferences) -> None:
        self._elements = elements
        self._references = references
        self._included: set[Path] = {elements.file.resolve()}
        self._include(root)
        self._root = root
        self._copied = 0
        self._classes: dict[str, dict[str, Attributes]] = {MAIN: {}}
        for section in self.sections("default"):
            self._read_class(section, section.get("class", MAIN), {})

    def sections(self, name: str) -> Iterator[etree._Element]:
        """All elements of a name directly below the root."""
        return self._root.iterchildren(name)

    def section_items(self, section: str) -> Iterator[Item]:
        """All elements in the sections of a name, with their defaults."""
        for element in self.sections(section):
            for child in element.iterchildren():
                yield self.item(child, MAIN)

    @cached_property
    def disabled(self) -> frozenset[str]:
        """Flags that the options switch off, as "gravity", "contact", "limit", or "spring"."""
        flags: dict[str, str] = {}
        for option in self.sections("option"):
            for flag in option.iterchildren("flag"):
                flags |= {str(key): str(value) for key, value in flag.items()}
        off = {key for key, value in flags.items() if value == "disable"}
        return frozenset(off.union(*(_GROUPS[key] for key in off & _GROUPS.keys())))

    def item(self, element: etree._Element, child_class: str) -> Item:
        """An element with its attributes.

        Args:
            element: it.
            child_class: default class of elements that name none of their own.
        """
        name = element.get("class") or child_class
        known = self._classes.get(name)
        if known is None:
            self._elements.problems.add(
                f"the default class {name!r} does not exist", self._elements.place(element), "Correct the name."
            )
            known = self._classes[MAIN]
        key = ACTUATOR if element.tag in ACTUATORS else str(element.tag)
        return Item(element, merged(known.get(key, {}), {str(k): str(v) for k, v in element.items()}))

    # ----- included files -----

    def _include(self, parent: etree._Element) -> None:
        for element in list(parent.iter("include")):
            holder = element.getparent()
            if holder is None:
                continue
            for child in self._contents(element):
                element.addprevious(child)
            holder.remove(element)
        # What was included may include.
        if parent.find(".//include") is not None:
            self._include(parent)

    def _contents(self, element: etree._Element) -> list[etree._Element]:
        place = self._elements.place(element)
        reference = element.get("file", "")
        try:
            file = self._references.find(reference, place)
            if file.resolve() in self._included:
                self._elements.problems.add(
                    f"includes {reference!r} for a second time", place, "Include a file once only, and none in itself."
                )
                return []
            self._included.add(file.resolve())
            if len(self._included) > MOST_INCLUDES:
                self._elements.problems.add(f"more than {MOST_INCLUDES} files are included", place, "Include fewer.")
                return []
            root = read_xml(file)
        except CmbError as error:
            self._elements.problems.record(error)
            return []
        children = list(root)
        for child in children:
            child.set(FILE_MARK, str(file))
        return children

    # ----- default classes -----

    def _read_class(self, element: etree._Element, name: str, inherited: Mapping[str, Attributes]) -> None:
        known = self._classes.get(name, {})
        own = {key: dict(values) for key, values in (known or inherited).items()}
        for child in element:
            tag = str(child.tag)
            if tag == "default":
                continue
            key = ACTUATOR if tag in ACTUATORS else tag
            values = {str(k): str(v) for k, v in child.items() if k != FILE_MARK}
            own[key] = merged(own.get(key, {}), values)
            if key == ACTUATOR:
                own[key][KIND] = tag
        self._classes[name] = own
        for child in element.iterchildren("default"):
            inner = child.get("class")
            if inner is None:
                message = "a default inside another needs a class"
                self._elements.problems.add(message, self._elements.place(child), "Add the attribute class.")
                continue
            self._read_class(child, inner, own)

    # ----- replications -----

    def children(self, element: etree._Element) -> Iterator[etree._Element]:
        """Children of a body, with replications written out as frames."""
        for child in list(element):
            if child.tag == "replicate":
                yield from self._replicated(child)
            else:
                yield child

    def _replicated(self, element: etree._Element) -> Iterator[etree._Element]:
        """One frame for each copy, each displaced against the one before it; names get a number each."""
        item = self.item(element, MAIN)
        count = self._elements.integer(item, "count", 0)
        if not any(COPY in around.attrib for around in element.iterancestors()):  # else counted with the outer one
            self._copied += _written_out(element)
        if count < 1 or self._copied > MOST_ELEMENTS:
            size = sum(1 for _ in element.iter())
            self._elements.problems.add(
                f"count={count} copies of {size} elements",
                self._elements.place(element),
                f"From 1 to {MOST_ELEMENTS} elements in all.",
            )
            return
        separator = element.get("sep", "")
        digits = len(str(count - 1))
        for number in range(count):
            copy = etree.Element("frame")
            for key in ("childclass", FILE_MARK):
                if element.get(key) is not None:
                    copy.set(key, element.get(key, ""))
            copy.set(COPY, f"{number}")
            copy.set("offset", element.get("offset", "0 0 0"))
            copy.set("turn", element.get("euler", "0 0 0"))
            for child in element:
                copy.append(deepcopy(child))
            for inner in copy.iter():
                for key in ("name", "joint", "joint1", "joint2", "body", "body1", "body2", "site", "target"):
                    if inner is not copy and inner.get(key) is not None:
                        inner.set(key, f"{inner.get(key)}{separator}{number:0{digits}}")
            yield copy


def _written_out(element: etree._Element) -> int:
    """How many elements this one comes to, with all replications in it."""
    count = element.get("count", "") if element.tag == "replicate" else "1"
    return (int(count[:12]) if count.isdecimal() else 0) * (1 + sum(map(_written_out, element)))


def merged(defaults: Mapping[str, str], own: Mapping[str, str]) -> Attributes:
    """An element's own attributes over its defaults."""
    result = {**defaults, **own}
    for key in _PARTIAL & defaults.keys() & own.keys():
        words = own[key].split()
        result[key] = " ".join([*words, *defaults[key].split()[len(words) :]])
    return result


def place_of(elements: MjcfElements, item: Item) -> Place:
    """Where an item stands."""
    return elements.place(item.element, item.name or None)
