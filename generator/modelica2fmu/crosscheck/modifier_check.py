"""Whether what a model modifies is there: names in modifiers of the user's own classes.

The front end finds most names that are not, some of them behind errors about places of libraries, and takes attributes
that no type has without a word.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from contact_foundation.errors import InputError, Place
from contact_foundation.near_names import did_you_mean

from modelica2fmu.crosscheck.class_instances import ClassInstance, Component, UnknownError
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Base, ComponentDeclaration, Extent, Modifier
from modelica2fmu.crosscheck.class_tokens import UnreadableError
from modelica2fmu.crosscheck.near_names import near_names
from modelica2fmu.crosscheck.own_classes import found_class, model_class, own_classes

# Modelica 3.6, section 4.8.
_OF_ALL: Final = ("quantity", "start", "fixed")
_OF_NUMBERS: Final = (*_OF_ALL, "min", "max")
_ATTRIBUTES: Final = {
    "Real": (*_OF_NUMBERS, "unit", "displayUnit", "nominal", "unbounded", "stateSelect"),
    "Integer": _OF_NUMBERS,
    "Boolean": _OF_ALL,
    "String": _OF_ALL,
}
_ARRAY: Final = re.compile(r"\w+\s*\[([^\[\]]+)\]")
_ONE_VALUE: Final = re.compile(r"[+-]?\s*(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|true|false")
_PLAIN: Final = re.compile(r"[+-]?\s*[\w.]+(?:\s*[-+*/^]\s*[\w.]+)*")
_WORD: Final = re.compile(r"[\w.]+")
_SIZED: Final = re.compile(r"=\s*[\w.]+\s*\[")
_PARTIAL: Final = "only classes that extend it are complete: name one of them"


def check_modifiers(
    model: str, library: ClassLibrary, own: Path, place_of: Callable[[Extent], Place]
) -> InputError | None:
    """Holds the modifiers that the user wrote against the classes they modify, as far as these are found.

    Args:
        model: full name.
        library: the sources.
        own: file or folder of the user's own classes; others are taken as right.
        place_of: the place of a range of a file.

    Returns:
        The error of the first component whose class is not found here; the front end may find it.

    Raises:
        InputError: a modifier names nothing that its class has or gives an array one value, or the model is partial.
    """
    root = model_class(model, library)
    if root is None:
        return None
    if root.definition.is_partial:
        raise InputError(
            f"the {root.definition.kind} {model} is partial", place=place_of(root.definition.extent), remedy=_PARTIAL
        )
    return _ModifierCheck(model, library, own, place_of).run(root)


@dataclass(frozen=True)
class _ModifierCheck:
    model: str
    library: ClassLibrary
    own: Path
    place_of: Callable[[Extent], Place]

    def run(self, root: ClassInstance) -> InputError | None:
        """Raises InputError at the first modifier of nothing, in the order in which components are declared."""
        missing: list[InputError] = []
        for each in own_classes(root, self.own):
            absent = _missing_base(each)
            if absent is not None:
                missing.append(self._missing(absent.type_name, absent.extent, self.model))
                continue
            for base in each.definition.bases:
                found = found_class(each, base.type_name)
                if found is not None:
                    self._arguments(base.arguments, found, ".".join(base.type_name), self.model, "", each)
            for component in each.definition.components.values():
                found = found_class(each, component.type_name)
                if found is None:
                    missing.append(
                        self._missing(component.type_name, component.extent, f"{self.model}.{component.name}")
                    )
                else:
                    self._component(component, found, each)
        return missing[0] if missing else None

    def _missing(self, name: tuple[str, ...], extent: Extent, component: str) -> InputError:
        place = self.place_of(extent)
        return InputError(
            f"there is no class {'.'.join(name)}",
            place=Place(file=place.file, line=place.line, component=component),
            remedy=near_names(name, self.model, self.library),
        )

    def _component(self, component: ComponentDeclaration, found: ClassInstance, scope: ClassInstance) -> None:
        is_array = component.sizes_of_type is not None or _ARRAY.match(self.library.text(component.extent)) is not None
        owner = f"{component.name}[1]." if is_array else f"{component.name}."
        where = f"{self.model}.{component.name}"
        self._arguments(component.arguments, found, ".".join(component.type_name), where, owner, scope)

    def _arguments(
        self,
        arguments: tuple[Modifier, ...],
        found: ClassInstance,
        type_name: str,
        component: str,
        owner: str,
        scope: ClassInstance,
    ) -> None:
        """``owner``: what stands before the name of a member of ``found`` in the class ``scope`` that modifies it."""
        for argument in arguments:
            try:
                self._argument(argument.of_first_name(), found, type_name, component, owner, scope)
            except (UnknownError, UnreadableError, RecursionError):
                continue

    def _argument(
        self,
        argument: Modifier,
        found: ClassInstance,
        type_name: str,
        component: str,
        owner: str,
        scope: ClassInstance,
    ) -> None:
        name = argument.path[0]
        if argument.removes:
            return
        predefined = found.predefined
        if predefined is not None:
            kind = "enumeration" if predefined.definition.is_enumeration else predefined.definition.name
            attributes = _ATTRIBUTES.get(kind, _OF_NUMBERS)
            if kind in (*_ATTRIBUTES, "enumeration") and name not in attributes:
                shown = type_name if type_name == kind else f"{type_name} ({kind})"
                raise self._unknown(argument, f"{shown} has no attribute {name}", list(attributes), component)
            return
        element = found.component(name)
        inner = element.type if element is not None else found.class_element(name)
        if inner is None:
            known = list(dict.fromkeys(found.component_names()))
            if not known:  # stands for a class that is yet to be chosen, as the state of a medium
                return
            raise self._unknown(argument, f"{type_name} has no {name} that could be modified", known, component)
        if element is not None:
            self._shape(argument, element, type_name, component, owner, scope)
        if argument.redeclared is None:
            inside = f"{component}.{name}"
            self._arguments(argument.arguments, inner, f"{type_name}.{name}", inside, f"{owner}{name}.", scope)

    def _shape(
        self,
        argument: Modifier,
        element: Component,
        type_name: str,
        component: str,
        owner: str,
        scope: ClassInstance,
    ) -> None:
        """Raises InputError where an array is given one value."""
        declared = _ARRAY.match(self.library.text(element.declarations[-1]))
        of_type = element.sizes_of_type
        # Of arrays of arrays, Real[2] x[3], the text is left to the front end.
        if (declared is None) == (of_type is None) or argument.value is None:
            return
        given = " ".join(self.library.text(argument.value).split())
        if not self._is_one_value(given, scope):
            return
        place = self.place_of(argument.value)
        shape = declared[1] if declared is not None else self.library.text(of_type)[1:-1] if of_type else ""
        sizes = [size.strip() for size in shape.split(",")]
        filled = ", ".join(size if size.isdecimal() else f"{owner}{size}" for size in sizes)
        is_plain = all(re.fullmatch(r"\w+", size) for size in sizes)
        raise InputError(
            f"{argument.path[0]} of {type_name} is an array [{shape.strip()}], and {given} is one value",
            place=Place(file=place.file, line=place.line, component=component),
            remedy=f"write {f'fill({given}, {filled})' if is_plain else 'an array'}",
        )

    def _is_one_value(self, given: str, scope: ClassInstance) -> bool:
        """= true, if a text is a number, or a sum or product of numbers and of variables that are no arrays."""
        if _ONE_VALUE.fullmatch(given) is not None:
            return True
        words = _WORD.findall(given) if _PLAIN.fullmatch(given) is not None else []
        return bool(words) and all(_ONE_VALUE.fullmatch(word) or self._is_scalar(word, scope) for word in words)

    def _is_scalar(self, name: str, scope: ClassInstance) -> bool:
        """= true, if a name is that of a variable of a predefined type, and of no array."""
        component = scope.component(name)
        if component is None:
            return name == "time"
        classes = [] if component.type.predefined is None else [component.type]
        while classes:  # a type may be one of arrays: type Vector = Real[3]
            found = classes.pop()
            if found.definition.is_short and _SIZED.search(self.library.text(found.definition.extent)):
                return False
            classes += found.bases
        is_array = component.sizes_of_type is not None or _ARRAY.match(self.library.text(component.declarations[-1]))
        return component.type.predefined is not None and not is_array

    def _unknown(self, argument: Modifier, message: str, known: list[str], component: str) -> InputError:
        place = self.place_of(argument.extent)
        return InputError(
            message,
            place=Place(file=place.file, line=place.line, component=component),
            remedy=did_you_mean(argument.path[0], known) or f"it has {', '.join(known[:8])}",
        )


def _missing_base(instance: ClassInstance) -> Base | None:
    try:
        return instance.missing_base()
    except (UnreadableError, RecursionError):
        return None
