"""The tree of instances, with mates and joints between them, as an import file gives them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from lxml import etree

from cad2modelica.geometry.spatial import IDENTITY, Array, Pose
from cad2modelica.simscape.elements import Elements

MAXIMUM_INSTANCES = 2000
MAXIMUM_NESTING = 64

Path = tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Instance:
    """A part where it stands.

    Attributes:
        path: identifiers from the root assembly on.
        name: names from the root assembly on, with slashes; unique.
        part: the element ``Part``.
        pose: in the world.
    """

    path: Path
    name: str
    part: etree._Element
    pose: Pose


@dataclass(frozen=True, eq=False)
class MateSide:
    """One side of a mate: geometry (point and axis or normal) in the axes of an instance or of an assembly.

    Attributes:
        path: identifiers from the root assembly on; of an assembly where that is meant, empty for the root's own axes.
        kind: "point", "line", "plane", "cylinder", "circle", "cone", "sphere" ...
    """

    path: Path
    kind: str
    point: Array
    axis: Array


@dataclass(frozen=True, eq=False)
class Mate:
    """A constraint between two instances."""

    name: str
    kind: str
    sides: tuple[MateSide, ...]
    element: etree._Element


@dataclass(frozen=True, eq=False)
class FrameJoint:
    """A joint that the file names: frames in base and follower, whose z-axes are the joint's."""

    name: str
    kind: str
    base: Path
    follower: Path
    base_frame: Pose
    follower_frame: Pose
    element: etree._Element


@dataclass(eq=False)
class Document:
    """What a file holds.

    Attributes:
        instances: parts by path, in the order of the file.
        assemblies: poses of assemblies by path; the root's path is empty.
        anchors: a part of an assembly that keeps its place in the assembly's axes, by the assembly's path.
        rigid: pairs of parts (or of a part and the root's empty path) that do not move against each other.
        joints, mates: of all assemblies; paths from the root.
    """

    name: str
    instances: dict[Path, Instance] = field(default_factory=dict)
    assemblies: dict[Path, Pose] = field(default_factory=dict)
    anchors: dict[Path, Path] = field(default_factory=dict)
    rigid: list[tuple[Path, Path]] = field(default_factory=list)
    joints: list[FrameJoint] = field(default_factory=list)
    mates: list[Mate] = field(default_factory=list)


def read_document(root: etree._Element, elements: Elements) -> Document:
    """Unfolds the tree of instances.

    Raises:
        InputError: the structure is wrong; a ``ProblemList`` if several problems were found.
    """
    reader = _DocumentReader(root, elements)
    reader.unfold()
    elements.problems.raise_if_any()
    return reader.document


class _DocumentReader:
    def __init__(self, root: etree._Element, elements: Elements) -> None:
        self._elements = elements
        self._parts = {item.get("uid", ""): item for item in root.iterfind("{*}Parts/{*}Part")}
        self._assemblies = {item.get("uid", ""): item for item in root.iterfind("{*}Assemblies/{*}Assembly")}
        found = root.find("{*}RootAssembly")
        self._root = found if found is not None else root
        self._names: set[str] = set()
        self.document = Document(self._root.get("name", ""))
        if found is None:
            elements.problems.add("has no RootAssembly", elements.place(root), "Export an assembly, not a part.")

    def unfold(self) -> None:
        tree = self._root.find("{*}InstanceTree")
        self.document.assemblies[()] = IDENTITY
        grounded = self._children(tree if tree is not None else self._root, (), (), IDENTITY, 0)
        self.document.rigid += [((), path) for path in grounded]
        self._constraints(self._root, (), ())
        if not self.document.instances:
            self._elements.problems.add(
                "places no part", self._elements.place(self._root), "Export an assembly with at least one part."
            )

    def _children(self, element: etree._Element, path: Path, names: Path, pose: Pose, depth: int) -> list[Path]:
        """Unfolds the instances below an element; returns parts that stand still in its axes."""
        still: list[Path] = []
        groups: dict[str, Path] = {}
        for child in element.iterchildren("{*}Instance"):
            if len(self.document.instances) >= MAXIMUM_INSTANCES or depth > MAXIMUM_NESTING:
                self._elements.problems.add(
                    f"has more than {MAXIMUM_INSTANCES} parts, or is nested deeper than {MAXIMUM_NESTING}",
                    self._elements.place(child),
                    "Simplify the assembly.",
                )
                self._elements.problems.raise_if_any()
            held = self._instance(child, path, names, pose, depth)
            if held is None:
                continue
            if child.get("grounded", "").strip().lower() in ("true", "1"):
                still.append(held)
            group = child.get("rigidGroup")
            if group:
                self.document.rigid.append((groups.setdefault(group, held), held))
        return still

    def _instance(self, element: etree._Element, path: Path, names: Path, pose: Pose, depth: int) -> Path | None:
        """Unfolds one instance; returns a part of it that has its pose, if there is any."""
        own = (*path, element.get("uid", ""))
        label = (*names, element.get("name", "") or own[-1])
        placed = pose @ self._elements.pose(element.find("{*}Transform"))
        entity = element.get("entityUid", "")
        if own in self.document.instances or own in self.document.assemblies:
            self._elements.problems.add(
                f"the identifier {own[-1]!r} is given twice", self._elements.place(element), "Export again."
            )
            return None
        part = self._parts.get(entity)
        if part is not None:
            self.document.instances[own] = Instance(own, self._unique("/".join(label), own), part, placed)
            return own
        assembly = self._assemblies.get(entity)
        if assembly is None:
            self._elements.problems.add(
                f"is an instance of {entity!r}, which is neither a part nor an assembly of the file",
                self._elements.place(element),
                "Export the assembly again.",
            )
            return None
        return self._subassembly(element, assembly, own, label, placed, depth)

    def _subassembly(
        self, element: etree._Element, assembly: etree._Element, own: Path, label: Path, placed: Pose, depth: int
    ) -> Path | None:
        self.document.assemblies[own] = placed
        before = len(self.document.instances)
        tree = element if element.find("{*}Instance") is not None else assembly.find("{*}InstanceTree")
        still = self._children(tree, own, label, placed, depth + 1) if tree is not None else []
        inside = list(self.document.instances)[before:]
        self._constraints(assembly, own, label)
        if element.get("rigid", "").strip().lower() in ("true", "1"):
            still = inside
        self.document.rigid += [(still[0], other) for other in still[1:]]
        if still:
            self.document.anchors[own] = still[0]
        return still[0] if still else None

    def _constraints(self, assembly: etree._Element, path: Path, names: Path) -> None:
        """Adds the mates and joints of an assembly, once for each of its instances."""
        for element in _members(assembly, "Joints"):
            frames = [element.find(f"{{*}}{name}") for name in ("BaseFrame", "FollowerFrame")]
            ends = [self._path(frame, path) for frame in frames]
            poses = [self._elements.pose(frame.find("{*}Transform") if frame is not None else None) for frame in frames]
            name = _label(element, names)
            kind = etree.QName(element).localname
            self.document.joints.append(FrameJoint(name, kind, ends[0], ends[1], poses[0], poses[1], element))
        for element in _members(assembly, "Constraints"):
            sides = tuple(self._side(side, path) for side in element.iterchildren("{*}ConstraintGeometry"))
            self.document.mates.append(Mate(_label(element, names), etree.QName(element).localname, sides, element))

    def _side(self, element: etree._Element, path: Path) -> MateSide:
        position = self._elements.numbers(element, "Position", 3) * self._elements.units.length
        kind = element.get("geomType", "")
        axis = np.array([0.0, 0.0, 1.0])
        if element.find("{*}Axis") is not None:
            axis = self._elements.direction(element)
        elif kind not in ("point", "sphere"):
            self._elements.problems.add(
                f"geometry of type {kind!r} has no Axis", self._elements.place(element), "Export again."
            )
        return MateSide(self._path(element, path), kind, position, axis)

    def _path(self, element: etree._Element | None, path: Path) -> Path:
        found = element.find("{*}InstancePath") if element is not None else None
        inner = [(item.text or "").strip() for item in found.iterfind("{*}Uid")] if found is not None else []
        own = (*path, *inner)
        if own not in self.document.instances and own not in self.document.assemblies:
            self._elements.problems.add(
                f"names the instance {'/'.join(inner)!r}, which is not in its assembly",
                self._elements.place(element),
                "Export the assembly again.",
            )
        return own

    def _unique(self, name: str, path: Path) -> str:
        if name in self._names:
            name = f"{name} ({path[-1]})"
        while name in self._names:
            name += "'"
        self._names.add(name)
        return name


def _members(assembly: etree._Element, kind: str) -> Iterator[etree._Element]:
    for group in assembly.iterchildren(f"{{*}}{kind}"):
        yield from group.iterchildren("{*}*")


def _label(element: etree._Element, names: Path) -> str:
    """The name of a mate or joint with those of the assemblies around it."""
    return "/".join((*names, element.get("name", "") or etree.QName(element).localname))
