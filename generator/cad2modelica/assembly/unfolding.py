"""Nested assemblies unfolded: every part and joint once for each instance, with the instance's own poses."""

from __future__ import annotations

from dataclasses import dataclass, field

from contact_foundation.errors import InputError
from lxml import etree

from cad2modelica.assembly.elements import NAMESPACE, ElementReader
from cad2modelica.geometry.spatial import IDENTITY, Pose
from cad2modelica.mechanism.model import GROUND

MAXIMUM_PARTS = 2000
MAXIMUM_NESTING = 100


@dataclass(frozen=True)
class PartDescription:
    """A part before its geometry is read.

    Attributes:
        outer: pose of the assembly or instance that lists the part.
        local: of the part in what lists it, before any instance places it elsewhere.
        placements: poses in the world that instances around it give it, the outermost first, each with the path of
            the instance ("leg/foot/").
    """

    name: str
    element: etree._Element
    outer: Pose
    local: Pose
    placements: tuple[tuple[str, Pose], ...] = ()

    @property
    def pose(self) -> Pose:
        """The pose in the world, at the start."""
        return self.seen_from("")

    def seen_from(self, prefix: str) -> Pose:
        """The pose in the world as what stands at a path knows it: by the placements of instances that it lists.

        A definition knows nothing of where instances of it place its parts.
        """
        for instance, pose in self.placements:
            if not prefix.startswith(instance):
                return pose
        return self.outer @ self.local


@dataclass(frozen=True)
class JointDescription:
    """A joint before it is read; ``start`` holds the instance's own attributes of the start."""

    name: str
    element: etree._Element
    outer: Pose
    prefix: str
    start: dict[str, str] | None


@dataclass
class Unfolded:
    """All parts and joints."""

    parts: list[PartDescription] = field(default_factory=list)
    joints: list[JointDescription] = field(default_factory=list)
    instances: int = 0


@dataclass
class _Own:
    """What instances say about what is inside them, by path from the outermost assembly; the outermost wins.

    Placements are elements, paths of instances, and poses in the world.
    """

    placements: dict[str, list[tuple[etree._Element, str, Pose]]] = field(default_factory=dict)
    starts: dict[str, etree._Element] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)


class Unfolder:
    """Unfolds one assembly.

    Args:
        root: the assembly's element.
        read: reads poses and records problems.
    """

    def __init__(self, root: etree._Element, read: ElementReader) -> None:
        self._root = root
        self._read = read
        self._result = Unfolded()
        self._own = _Own()

    def unfold(self) -> Unfolded:
        """All parts and joints of the assembly.

        Raises:
            InputError: definitions contain themselves, or unfold to too much.
        """
        definitions = self._definitions()
        self._unfold(self._root, IDENTITY, "", definitions)
        for path, placements in self._own.placements.items():
            self._refuse_unused(path, placements[0][0], "part")
        for path, element in self._own.starts.items():
            self._refuse_unused(path, element, "joint")
        return self._result

    def _refuse_unused(self, path: str, element: etree._Element, kind: str) -> None:
        if f"{kind}:{path}" not in self._own.used:
            names = [item.name for item in (self._result.parts if kind == "part" else self._result.joints)]
            self._read.unknown("the instance", path, names, element)

    def _definitions(self) -> dict[str, etree._Element]:
        definitions: dict[str, etree._Element] = {}
        for element in self._root.iterfind(f"{{{NAMESPACE}}}definitions/{{{NAMESPACE}}}definition"):
            name = element.get("name", "")
            if name in definitions:
                self._read.duplicate("definition", name, element)
            definitions[name] = element
        self._refuse_circles(definitions)
        return definitions

    def _refuse_circles(self, definitions: dict[str, etree._Element]) -> None:
        """Definitions must not contain themselves, whether they are used or not."""
        finished: set[str] = set()

        def visit(name: str, opened: tuple[str, ...]) -> None:
            if name in finished or name not in definitions:
                return
            for element in definitions[name].iterfind(f"{{{NAMESPACE}}}instances/{{{NAMESPACE}}}instance"):
                inner = element.get("of", "")
                if inner in (*opened, name):
                    circle = " in ".join(repr(item) for item in (inner, name, *reversed(opened)))
                    raise InputError(
                        f"the definition contains itself: {circle}",
                        place=self._read.place(element),
                        remedy="Break the circle: an assembly cannot be a part of itself.",
                    )
                if len(opened) >= MAXIMUM_NESTING:
                    raise InputError(
                        f"definitions are nested deeper than {MAXIMUM_NESTING}",
                        place=self._read.place(element),
                        remedy="Simplify the assembly.",
                    )
                visit(inner, (*opened, name))
            finished.add(name)

        for name in definitions:
            visit(name, ())

    def _unfold(
        self, content: etree._Element, outer: Pose, prefix: str, definitions: dict[str, etree._Element]
    ) -> None:
        result, names = self._result, set[str]()
        for element in content.iterfind(f"{{{NAMESPACE}}}parts/{{{NAMESPACE}}}part"):
            path = prefix + self._own_name("part", element, names)
            if len(result.parts) >= MAXIMUM_PARTS:
                raise self._too_many("parts", element)
            local = self._read.pose(element.find(f"{{{NAMESPACE}}}pose"))
            placements = tuple((instance, pose) for _, instance, pose in self._own.placements.get(path, []))
            self._own.used |= {f"part:{path}"} if placements else set()
            result.parts.append(PartDescription(path, element, outer, local, placements))
        for element in content.iterfind(f"{{{NAMESPACE}}}instances/{{{NAMESPACE}}}instance"):
            name = self._own_name("instance", element, names)
            definition = element.get("of", "")
            if definition not in definitions:
                self._read.unknown("the instance", definition, definitions, element)
                continue
            result.instances += 1
            if result.instances > MAXIMUM_PARTS:
                raise self._too_many("instances", element)
            inner = outer @ self._read.pose(element.find(f"{{{NAMESPACE}}}pose"))
            self._note_own(element, inner, f"{prefix}{name}/")
            self._unfold(definitions[definition], inner, f"{prefix}{name}/", definitions)
        joint_names: set[str] = set()
        for element in content.iterfind(f"{{{NAMESPACE}}}joints/{{{NAMESPACE}}}joint"):
            path = prefix + self._own_name("joint", element, joint_names)
            own = self._own.starts.get(path)
            self._own.used |= {f"joint:{path}"} if own is not None else set()
            start = {str(key): str(value) for key, value in own.items() if key != "joint"} if own is not None else None
            result.joints.append(JointDescription(path, element, outer, prefix, start))

    def _note_own(self, instance: etree._Element, pose: Pose, prefix: str) -> None:
        for element in instance.iterfind(f"{{{NAMESPACE}}}placement"):
            placed = pose @ self._read.pose(element.find(f"{{{NAMESPACE}}}pose"))
            self._own.placements.setdefault(prefix + element.get("part", ""), []).append((element, prefix, placed))
        for element in instance.iterfind(f"{{{NAMESPACE}}}jointStart"):
            self._own.starts.setdefault(prefix + element.get("joint", ""), element)

    def _too_many(self, what: str, element: etree._Element) -> InputError:
        return InputError(
            f"unfolds to more than {MAXIMUM_PARTS} {what}",
            place=self._read.place(element),
            remedy="Simplify the assembly.",
        )

    def _own_name(self, kind: str, element: etree._Element, names: set[str]) -> str:
        name = element.get("name", "")
        if name in names:
            self._read.duplicate(kind, name, element)
        if kind == "part" and name == GROUND:
            self._read.problems.add(
                f"a part cannot be named {GROUND!r}", self._read.place(element), "Choose another name."
            )
        names.add(name)
        return name
