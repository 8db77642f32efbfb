"""The tree of bodies: which become parts, where they stand, what belongs to them, and which joints hold them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from lxml import etree

from cad2modelica.geometry.spatial import IDENTITY, Array, Pose
from cad2modelica.mechanism.model import GROUND
from cad2modelica.mjcf.document import ACTUATORS, COPY, MAIN, MjcfDocument
from cad2modelica.mjcf.elements import Item, MjcfElements

WORLD = "world"
_JOINTS = ("joint", "freejoint")
_SILENT = frozenset(("camera", "light"))
_LOST = {"composite": "composite", "flexcomp": "flexcomp", "attach": "attach", "plugin": "plugin"}


@dataclass(frozen=True, eq=False)
class PlacedItem:
    """A geom, inertial or site with the pose of the frame it stands in, in the axes of the part it belongs to."""

    item: Item
    inner: Pose


@dataclass(eq=False)
class Body:
    """A body of the model.

    Attributes:
        host: name of the part it belongs to: its own if joints move it, else that of the body it is fixed to.
        inner: its pose in that part.
        world: its pose in the world, at joint position zero.
        parent: the body that carries it; None for the world itself.
        joints: that move it, the one nearest to the parent first; with the frames they stand in, in the body.
    """

    name: str
    element: etree._Element
    host: str
    inner: Pose
    world: Pose
    parent: Body | None
    is_static: bool
    joints: list[PlacedItem] = field(default_factory=list)
    geoms: list[PlacedItem] = field(default_factory=list)
    inertial: PlacedItem | None = None
    weightless: float = 0.0


@dataclass(eq=False)
class BodyTree:
    """All bodies by name, the world first and each after its parent; sites by name; what was not read, by kind."""

    bodies: dict[str, Body] = field(default_factory=dict)
    sites: dict[str, tuple[Body, Pose]] = field(default_factory=dict)
    lost: dict[str, int] = field(default_factory=dict)


def read_bodies(document: MjcfDocument, elements: MjcfElements) -> BodyTree:
    """Reads the sections ``worldbody``."""
    reader = _BodyReader(document, elements)
    for section in document.sections("worldbody"):
        reader.read_world(section)
    return reader.tree


class _BodyReader:
    def __init__(self, document: MjcfDocument, elements: MjcfElements) -> None:
        self._document = document
        self._elements = elements
        self.tree = BodyTree()

    def read_world(self, section: etree._Element) -> None:
        world = self.tree.bodies.get(WORLD)
        if world is None:
            world = Body(WORLD, section, WORLD, IDENTITY, IDENTITY, None, is_static=True)
            self.tree.bodies[WORLD] = world
        self._walk(world, section, section.get("childclass", MAIN))

    def _walk(self, root: Body, section: etree._Element, child_class: str) -> None:
        # A stack instead of recursion: chains of bodies may be long.
        stack = [(root, section, child_class)]
        while stack:
            body, element, name = stack.pop()
            inner = self._read_contents(body, element, IDENTITY, name)
            for child, frame, inherited in reversed(inner):
                stack.append((self._body(child, frame, body, inherited), child, child.get("childclass", inherited)))

    def _read_contents(
        self, body: Body, element: etree._Element, frame: Pose, child_class: str
    ) -> list[tuple[etree._Element, Pose, str]]:
        """Takes what stands in a body; returns the bodies in it with their frames and default classes."""
        inside: list[tuple[etree._Element, Pose, str]] = []
        copies = np.zeros(3)
        for child in self._document.children(element):
            tag = str(child.tag)
            if tag == "body":
                inside.append((child, frame, child_class))
            elif tag == "frame":
                moved, copies = self._frame(child, copies)
                inside += self._read_contents(body, child, frame @ moved, child.get("childclass", child_class))
            elif tag in _LOST or tag in ACTUATORS:
                self.tree.lost[tag] = self.tree.lost.get(tag, 0) + 1
            elif tag not in _SILENT:
                self._take(body, self._document.item(child, child_class), frame)
        return inside

    def _frame(self, element: etree._Element, copies: Array) -> tuple[Pose, Array]:
        """The pose of a frame; and of a copy of a replication, where the next copy stands."""
        item = Item(element, {str(k): str(v) for k, v in element.items()})
        copy = element.get(COPY)
        if copy is None:
            return self._elements.pose(item), copies
        number = int(copy)
        position = copies if number else np.zeros(3)
        # Multiples of the angles, not powers of the rotation: so the compiler does, which matters for several axes.
        turn = self._elements.euler(number * self._elements.numbers(item, "turn", (0.0, 0.0, 0.0)))
        step = turn @ self._elements.numbers(item, "offset", (0.0, 0.0, 0.0))
        return Pose(position, turn), position + step

    def _take(self, body: Body, item: Item, frame: Pose) -> None:
        inner = body.inner @ frame
        if item.tag == "geom":
            body.geoms.append(PlacedItem(item, inner))
        elif item.tag == "inertial":
            body.inertial = PlacedItem(item, inner)
        elif item.tag == "site":
            self.tree.sites[item.name] = (body, frame @ self._site_pose(item))
        elif item.tag not in _JOINTS:
            known = "body, joint, freejoint, geom, inertial, site, frame, replicate"
            self._elements.problems.add(
                f"the element {item.tag!r} is not known here", self._elements.place(item.element), f"Known: {known}."
            )
        elif body.parent is None:
            place = self._elements.place(item.element)
            self._elements.problems.add("the world has no joints", place, "Put the joint into a body.")

    def _site_pose(self, item: Item) -> Pose:
        if item.has("fromto"):
            ends = self._elements.numbers(item, "fromto", (0.0,) * 6)
            return Pose((ends[:3] + ends[3:]) / 2, IDENTITY.rotation)
        return self._elements.pose(item)

    def _body(self, element: etree._Element, frame: Pose, parent: Body, child_class: str) -> Body:
        name = self._name(element, parent)
        item = Item(element, {str(k): str(v) for k, v in element.items()})
        local = frame @ self._elements.pose(item)
        world = parent.world @ local
        joints = self._joints(element, IDENTITY, element.get("childclass", child_class))
        if item.text("mocap") == "true":
            self._elements.notes.append(f"body {name!r} is moved by the simulator (mocap): it stands in the world here")
        if joints:
            body = Body(name, element, name, IDENTITY, world, parent, is_static=False, joints=joints)
        elif parent.parent is None:
            body = Body(name, element, name, IDENTITY, world, parent, is_static=True)
        else:
            body = Body(name, element, parent.host, parent.inner @ local, world, parent, parent.is_static)
        body.weightless = self._elements.number(item, "gravcomp")
        self.tree.bodies[name] = body
        return body

    def _joints(self, element: etree._Element, frame: Pose, child_class: str) -> list[PlacedItem]:
        found = []
        copies = np.zeros(3)
        for child in self._document.children(element):
            if child.tag in _JOINTS:
                found.append(PlacedItem(self._document.item(child, child_class), frame))
            elif child.tag == "frame":
                moved, copies = self._frame(child, copies)
                found += self._joints(child, frame @ moved, child.get("childclass", child_class))
        return found

    def _name(self, element: etree._Element, parent: Body) -> str:
        """The body's name; one made of its parent's if it has none, or has one that another has too."""
        given = element.get("name", "")
        if given and given not in self.tree.bodies and given != GROUND:
            return given
        if given in self.tree.bodies:
            place = self._elements.place(element)
            self._elements.problems.add(f"there are two bodies {given!r}", place, "Rename one of them.")
        base = f"{GROUND} body" if given == GROUND else f"{parent.name} body"
        number = 1
        while (name := base if number == 1 else f"{base} {number}") in self.tree.bodies:
            number += 1
        return name
