"""Random packages of classes that extend, modify and redeclare each other, each with the values that they must have.

Few names are used, so that modifiers, their values and the scopes around have the same ones.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace

from class_semantics import (
    ClassDefinition,
    ClassInScope,
    Declaration,
    Instance,
    Meaning,
    Modifier,
    NoMeaningError,
    Path,
    Scope,
    Slot,
    Sum,
    class_of,
    element,
    indices,
    path_text,
)
from class_text import class_text

PARAMETERS = ("k", "p", "q")
COMPONENTS = ("a", "b", "h")
CLASSES = ("Part", "Unit", "Law")
CLASS_ELEMENT = "T"
WORLD = "w"  # an inner component, and what is outer
WORLD_CLASS = "World"


@dataclass(frozen=True)
class RandomClasses:
    """A package named P with a model M.

    Attributes:
        values: of all parameters and variables of M.
        absent: how the names begin of what M must not have.
    """

    text: str
    values: dict[str, float]
    absent: tuple[str, ...]


def random_classes(seed: int) -> RandomClasses | None:
    """Nothing where values would depend on themselves."""
    writer = _Writer(random.Random(seed))
    try:
        writer.fill()
        model = writer.root().part("M")
        values = {path_text(path): value for path, value in model.values()}
    except NoMeaningError:
        return None
    absent = tuple(f"{path_text(path)}{mark}" for path in model.absent() for mark in ".[")
    return RandomClasses(class_text(writer.package), values, absent)


class _Writer:
    def __init__(self, choose: random.Random) -> None:
        self.choose = choose
        self.package = ClassDefinition("P", "package")
        self._number = 0

    def root(self) -> Instance:
        """The package as far as it is written."""
        return Instance(ClassInScope(self.package, None), Meaning(), None)

    def fill(self) -> None:
        self._model(self.package, WORLD_CLASS)
        for name in ("A", "B", "C")[: self.choose.randint(1, 3)]:
            self._package(name)
        for _ in range(self.choose.randint(1, 3)):
            self._number += 1
            self._model(self.package, f"{self.choose.choice(CLASSES)}{self._number}")
        self._model(self.package, "M", parts=self.choose.randint(3, 5))

    def _chance(self, probability: float) -> bool:
        return self.choose.random() < probability

    def _digit(self) -> float:
        return float(self.choose.randint(1, 9))

    # --- packages ---

    def _package(self, name: str) -> None:
        package = ClassDefinition(name, "package")
        others = [each.name for each in self.package.declarations if each.sort == "package"]
        self.package.declarations.append(Declaration(name, "class", sort="package", definition=package))
        if others and self._chance(0.4):
            changed = (("c", Modifier((Sum(self._digit()),))),) if self._chance(0.6) else ()
            package.bases.append((self.choose.choice(others), Modifier(children=changed)))
        else:
            self._constant(package, "c", ())
            if self._chance(0.6):
                self._constant(package, "d", ((2.0, ("c",)),))
        for _ in range(self.choose.randint(1, 2)):
            free = [each for each in CLASSES if each not in self._scope(package).instance.slots]
            if free:
                self._model(package, self.choose.choice(free))

    def _constant(self, package: ClassDefinition, name: str, terms: tuple[tuple[float, Path], ...]) -> None:
        package.declarations.append(Declaration(name, "constant", Modifier((Sum(self._digit(), terms),))))

    def _scope(self, holder: ClassDefinition) -> Scope:
        """Where the names of a package's classes are looked up."""
        around = Scope(self.root(), None)
        return around if holder is self.package else Scope(around.instance.part(holder.name), around)

    def _types(self, holder: ClassDefinition) -> list[str]:
        """The names of the models that a class of this package can use."""
        scope = self._scope(holder)
        names = [name for name, slot in scope.instance.slots.items() if _is_class(slot, "model")]
        root = scope.instance if scope.parent is None else scope.parent.instance
        if scope.parent is not None:
            names += [name for name, slot in root.slots.items() if _is_class(slot, "model")]
        for package, slot in root.slots.items():
            if _is_class(slot, "package") and package != holder.name:
                inside = root.part(package).slots.items()
                names += [f"{package}.{name}" for name, inner in inside if _is_class(inner, "model")]
        return names

    # --- models ---

    def _model(self, holder: ClassDefinition, name: str, parts: int | None = None) -> None:
        types = self._types(holder)
        model = ClassDefinition(name, "model")
        here = ClassInScope(model, self._scope(holder))
        if parts is None and types and self._chance(0.15):
            base = self.choose.choice(types)
            holder.declarations.append(Declaration(name, "class", self._modifier(here, base, types, 0), base))
            return
        if types and self._chance(0.4):
            base = self.choose.choice(types)
            model.bases.append((base, Modifier()))  # values of modifiers name what is inherited
            model.bases[0] = (base, self._modifier(here, base, types, 1))
        for _ in range(self.choose.randint(1, 2)):
            free = [each for each in PARAMETERS if each not in _known(here).slots]
            if free:
                model.declarations.append(
                    Declaration(self.choose.choice(free), "parameter", Modifier((self._parameter(here),)))
                )
        if name != WORLD_CLASS and WORLD not in _known(here).slots:
            self._world(here, types, "inner" if parts else "")
        if types and CLASS_ELEMENT not in _known(here).slots and self._chance(0.2):
            model.declarations.append(
                Declaration(CLASS_ELEMENT, "class", type_name=self.choose.choice(types), is_replaceable=True)
            )
        for _ in range(parts or self.choose.randint(0, 2)):
            if types:
                self._component(here, types)
        self._redeclare_inherited(here, types)
        self._number += 1
        model.declarations.append(Declaration(f"y{self._number}", "variable", Modifier((self._variable(here),))))
        holder.declarations.append(Declaration(name, "class", definition=model))

    def _world(self, here: ClassInScope, types: list[str], prefix: str) -> None:
        """An inner or outer component of one name for all, or none."""
        prefix = prefix or self.choose.choice(["", "", "", "outer", "outer", "inner"])
        if prefix:
            modifier = self._modifier(here, WORLD_CLASS, types, 0) if prefix == "inner" else Modifier()
            here.definition.declarations.append(
                Declaration(WORLD, "component", modifier, WORLD_CLASS, scope_prefix=prefix)
            )

    def _redeclare_inherited(self, here: ClassInScope, types: list[str]) -> None:
        """As elements of the class."""
        own = {each.name for each in here.definition.declarations}
        for name, slot in list(_known(here).slots.items()):
            declared = slot.declaration
            if name in own or declared.kind != "component" or not declared.is_replaceable or not self._chance(0.4):
                continue
            fitting = _fitting(here, slot, types)
            if fitting:
                chosen = self.choose.choice(fitting)
                modifier = self._modifier(here, chosen, types, 1)
                here.definition.declarations.append(
                    replace(declared, type_name=chosen, modifier=modifier, is_redeclaration=True, constraint=None)
                )

    def _component(self, here: ClassInScope, types: list[str]) -> None:
        known = _known(here)
        self._number += 1
        free = [each for each in COMPONENTS if each not in known.slots] or [f"x{self._number}"]
        of_element = CLASS_ELEMENT in known.slots and self._chance(0.5)
        name, type_name = self.choose.choice(free), CLASS_ELEMENT if of_element else self.choose.choice(types)
        size = self.choose.choice([0, 0, 0, 2])
        is_replaceable = not size and not of_element and self._chance(0.4)
        modifier = self._modifier(here, type_name, types, 2, size)
        constraint = None
        if is_replaceable and self._chance(0.3):
            lineage = _lineage(class_of(type_name, here.scope))
            base = self.choose.choice([each for each in types if class_of(each, here.scope).definition in lineage])
            constraint = (base, self._modifier(here, base, types, 0))
        is_absent = not is_replaceable and self._chance(0.1)
        here.definition.declarations.append(
            Declaration(name, "component", modifier, type_name, size, is_replaceable, constraint, is_absent=is_absent)
        )

    # --- modifiers ---

    def _modifier(self, here: ClassInScope, type_name: str, types: list[str], depth: int, size: int = 0) -> Modifier:
        """Of a class by its name; see ``_modifier_of``."""
        found = class_of(type_name, Scope(_known(here), here.scope))
        return self._modifier_of(here, found, types, depth, size)

    def _modifier_of(
        self, here: ClassInScope, found: ClassInScope, types: list[str], depth: int, size: int
    ) -> Modifier:
        """What is modified and redeclared of a class, so many components deep, or of an array of them."""
        children: list[tuple[str, Modifier]] = []
        for name, slot in Instance(found, Meaning(), None).slots.items():
            child = self._modifier_of_element(here, slot, types, depth, size)
            if child is not None:
                children.append((name, child))
        return Modifier(children=tuple(children))

    def _modifier_of_element(
        self, here: ClassInScope, slot: Slot, types: list[str], depth: int, size: int
    ) -> Modifier | None:
        declared = slot.declaration
        if declared.scope_prefix == "outer":
            return None
        if declared.kind == "parameter" and self._chance(0.4):
            if size and self._chance(0.6):
                return Modifier(tuple(self._parameter(here) for _ in range(size)))
            return Modifier((self._parameter(here),), is_each=bool(size))
        is_single = not declared.size and not declared.is_absent
        if declared.kind == "component" and is_single and depth > 0 and self._chance(0.5):
            fitting = _fitting(here, slot, types) if declared.is_replaceable and not size else []
            if fitting and self._chance(0.6):
                chosen = self.choose.choice(fitting)
                return replace(self._modifier(here, chosen, types, depth - 1), redeclared=chosen)
            inner = self._modifier_of(here, class_of(declared.type_name, slot.scope), types, 0, size)
            return inner if inner.children else None
        if declared.kind == "class" and declared.is_replaceable and not size and self._chance(0.5):
            fitting = _fitting(here, slot, types)
            if fitting:
                chosen = self.choose.choice(fitting)
                inner = self._modifier(here, chosen, types, 0) if self._chance(0.3) else Modifier()
                return replace(inner, redeclared=chosen)
        return None

    # --- values ---

    def _parameter(self, here: ClassInScope) -> Sum:
        """A value of constants and of the class's own parameters."""
        paths = _constants(here.scope)
        paths += [(name,) for name, slot in _known(here).slots.items() if slot.declaration.kind == "parameter"]
        return self._sum(paths, 1) if self._chance(0.6) else Sum(self._digit())

    def _variable(self, here: ClassInScope) -> Sum:
        """A value of all that the class can name."""
        return self._sum(_constants(here.scope) + _paths(_known(here), (), 2), 4)

    def _sum(self, paths: list[Path], most: int) -> Sum:
        chosen = [self.choose.choice(paths) for _ in range(self.choose.randint(1, most))] if paths else []
        return Sum(self._digit(), tuple((float(self.choose.randint(1, 3)), path) for path in chosen))


def _known(here: ClassInScope) -> Instance:
    """A class as far as it is written."""
    return Instance(here, Meaning(), None)


def _is_class(slot: Slot, sort: str) -> bool:
    return slot.declaration.kind == "class" and slot.declaration.sort == sort


def _lineage(found: ClassInScope) -> list[ClassDefinition]:
    lineage = [found.definition]
    for base, _ in found.definition.bases:
        lineage += _lineage(class_of(base, found.scope))
    return lineage


def _fitting(here: ClassInScope, slot: Slot, types: list[str]) -> list[str]:
    """The classes that can take the place of an element's."""
    declared = slot.declaration
    wanted = declared.constraint[0] if declared.constraint else declared.type_name
    base = class_of(wanted, slot.scope).definition
    return [name for name in types if base in _lineage(class_of(name, here.scope))]


def _constants(scope: Scope | None) -> list[Path]:
    """Those of the packages around, and of those that these hold."""
    paths: list[Path] = []
    while scope is not None:
        for name, slot in scope.instance.slots.items():
            if slot.declaration.kind == "constant":
                paths.append((name,))
            elif _is_class(slot, "package"):
                inside = scope.instance.part(name).slots.items()
                paths += [(name, each) for each, inner in inside if inner.declaration.kind == "constant"]
        scope = scope.parent
    return paths


def _paths(known: Instance, head: Path, depth: int) -> list[Path]:
    paths: list[Path] = []
    for name, slot in known.slots.items():
        declared = slot.declaration
        if declared.kind in ("parameter", "variable"):
            paths.append((*head, name))
        elif declared.scope_prefix == "outer":
            if not head:
                of_world = Instance(class_of(declared.type_name, slot.scope), Meaning(), None)
                paths += _paths(of_world, (name,), 0)
        elif declared.kind == "component" and depth > 0 and not declared.is_absent:
            for index in indices(declared):
                paths += _paths(known.part(name, index), head + element(name, index), depth - 1)
    return paths
