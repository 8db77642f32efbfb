"""Places of a flattened model beside the sources that it was made from."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.class_instances import Role, Value
from modelica2fmu.crosscheck.class_library import ClassLibrary
from modelica2fmu.crosscheck.class_syntax import Extent
from modelica2fmu.crosscheck.component_sizes import SIZE_OF_COMPONENTS

RawSpan = Mapping[str, int]

# What describes a variable that an expression names, not the expression.
_NOT_WRITTEN_HERE: Final = frozenset({"component_ref", "name"})
_WRITTEN: Final = (
    "variables",
    "equations",
    "structured_equations",
    "initial_equations",
    "initial_structured_equations",
    "algorithms",
    "initial_algorithms",
    "when_chains",
)
_LONGEST_TEXT: Final = 60
_OWN_CLASS: Final = "give it in a class of its own, as in `model Stiff = Spring(k = 2)`, and use that"
_REMEDIES: Final = {
    Role.CONSTRAINT: "repeat it in the declaration and in each redeclaration; for a class, in classes of their own, as"
    " in `model Stiff = Spring(k = 2)`, as which it is declared and redeclared",
    Role.CLASS: "give it in a class of its own, as in `model Stiff = Spring(k = 2)`, and redeclare as that",
}
_DOTTED: Final = "write it with parentheses: a(k = 2) in place of a.k = 2"
_WHOLE_RECORD: Final = "give the whole record there, as in material = Steel(restitution = 0.3)"
_RECORD: Final = f"another modifier gives fields of this record, and its other fields are lost: {_WHOLE_RECORD}"
_REDECLARE: Final = (
    "redeclare it in a class that extends the one with the declaration directly, and use that class; or in the modifier"
    " of a component whose class has the declaration"
)


def spans(tree: Any) -> Iterator[RawSpan]:
    """Places of an expression and of its parts, outermost first."""
    stack = [tree]
    while stack:
        item = stack.pop()
        if isinstance(item, dict):
            span = item.get("span")
            if isinstance(span, dict):
                yield span
            stack.extend(value for key, value in reversed(item.items()) if key not in _NOT_WRITTEN_HERE)
        elif isinstance(item, list):
            stack.extend(reversed(item))


def objects(tree: Any) -> Iterator[Mapping[str, Any]]:
    """All objects of a tree, each before those in it."""
    stack = [tree]
    while stack:
        item = stack.pop()
        if isinstance(item, list):
            stack.extend(item)
        elif isinstance(item, dict):
            stack.extend(item.values())
            yield item


def named(tree: Any) -> Iterator[str]:
    """All names in an expression: of variables, literals of enumerations and constants."""
    for item in objects(tree):
        if "VarRef" in item:
            yield item["VarRef"]["name"]["name"]


class WrittenPlaces:
    """Where anything of a flattened model was written.

    Args:
        flat: as the front end gives it.
        library: the sources.
    """

    def __init__(self, flat: Mapping[str, Any], library: ClassLibrary) -> None:
        starts: dict[int, set[int]] = {}
        for span in spans([flat[kind] for kind in _WRITTEN]):
            starts.setdefault(span["source"], set()).add(span["start"])
        self._starts = {library.file(source): sorted(found) for source, found in starts.items()}

    def any_in(self, extent: Extent) -> bool:
        """= true, if something begins in a range."""
        starts = self._starts.get(extent.file, [])
        number = bisect_left(starts, extent.start)
        return number < len(starts) and starts[number] < extent.end


@dataclass(frozen=True)
class FlatReading:
    """The sources, and how to speak of them.

    Attributes:
        library: the sources that the front end was given.
        place_of: the place of a range of a file.
    """

    library: ClassLibrary
    place_of: Callable[[Extent], Place]

    def begins_in(self, span: RawSpan, extent: Extent) -> bool:
        """= true, if the first byte lies in a range."""
        return extent.holds(self.library.file(span["source"]), span["start"])

    def ends_in(self, span: RawSpan, extent: Extent) -> bool:
        """= true, if the last byte lies in a range."""
        return extent.holds(self.library.file(span["source"]), span["end"] - 1)

    def extent(self, span: RawSpan) -> Extent | None:
        """The range of a place in a file that was read."""
        file = self.library.file(span["source"])
        return None if file is None else Extent(file, span["start"], span["end"])

    def text(self, extent: Extent) -> str:
        """What is written there, in one line."""
        return " ".join(self.library.text(extent).split())

    def shown(self, extent: Extent) -> str:
        """The same for messages, not too long."""
        text = self.text(extent)
        return text if len(text) <= _LONGEST_TEXT else text[: _LONGEST_TEXT - 3] + "..."

    def taken(self, tree: Any) -> str:
        """What the front end takes instead, for messages."""
        extent = next((found for span in spans(tree) if (found := self.extent(span)) is not None), None)
        return "no value" if extent is None else self.shown(extent)

    def ignored_value(self, name: str, value: Value, tree: Any, remedy: str | None = None) -> UnsupportedModelError:
        """A value of a variable or of an attribute was left out.

        Args:
            name: of the variable or attribute.
            value: that holds.
            tree: the expression that the front end has instead.
            remedy: what to do, if not what the place of the value suggests.
        """
        dotted = value.modifier is not None and value.modifier.is_dotted
        extent = value.extent if value.modifier is None else value.modifier.extent
        where = f" in a {value.role.value}" if value.role in (Role.CONSTRAINT, Role.CLASS) else ""
        return UnsupportedModelError(
            f"the front end does not carry {self.shown(extent)}{where} through to {name}, which would be "
            f"{self.taken(tree)}",
            place=self.place_of(extent),
            remedy=remedy or (_DOTTED if dotted else _REMEDIES.get(value.role, _OWN_CLASS)),
        )

    def forgotten_record(self, name: str, value: Value, tree: Any, cause: Extent | None) -> UnsupportedModelError:
        """A record lost its value where another modifier gives some fields.

        Args:
            name: of the field.
            value: that holds.
            tree: the expression that the front end has instead.
            cause: the other modifier, if it is known.
        """
        error = self.ignored_value(name, value, tree, _RECORD)
        return (
            error
            if cause is None
            else UnsupportedModelError(error.message, place=self.place_of(cause), remedy=error.remedy)
        )

    def field_beside_value(self, name: str, record: str, value: Value) -> UnsupportedModelError:
        """A modifier gives a field of a record that is bound as a whole another value.

        Args:
            name: of the field.
            record: its name.
            value: of the field.
        """
        extent = value.extent if value.modifier is None else value.modifier.extent
        return UnsupportedModelError(
            f"{self.shown(extent)} gives {name} a value, and {record} has one as a whole:"
            " tools differ in which one holds",
            place=self.place_of(extent),
            remedy=_WHOLE_RECORD,
        )

    def ignored_redeclaration(self, name: str, extent: Extent, consequence: str = "") -> UnsupportedModelError:
        """A component or class was not replaced."""
        return UnsupportedModelError(
            f"the front end does not carry {self.shown(extent)} through to {name}{consequence}",
            place=self.place_of(extent),
            remedy=_REDECLARE,
        )

    def misread_array(self, name: str, extent: Extent, remedy: str) -> UnsupportedModelError:
        """Elements of an array of components got wrong pieces of an array."""
        return UnsupportedModelError(
            f"the front end does not take {self.shown(extent)} apart rightly: {name} would have a wrong value",
            place=self.place_of(extent),
            remedy=remedy,
        )

    def folded_array(self, name: str, extent: Extent) -> UnsupportedModelError:
        """An array of components became one component."""
        return UnsupportedModelError(
            f"the front end does not know how many elements the array of components {name} has",
            place=self.place_of(extent),
            remedy=SIZE_OF_COMPONENTS,
        )

    def lost_right_side(self, span: RawSpan) -> UnsupportedModelError:
        """A derivative of an element in a for-loop was taken for 0."""
        extent = self.extent(span)
        return UnsupportedModelError(
            "the front end takes 0 for the right side of a derivative of an element in this for-loop",
            place=Place() if extent is None else self.place_of(extent),
            remedy="give the right sides in the loop, a[i] = ..., and the derivatives at once: der(v) = a",
        )
