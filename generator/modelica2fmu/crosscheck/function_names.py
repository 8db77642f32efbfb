"""Functions of the same name in several classes, of which rumoca 0.10 takes one for all.

A function that is called by its name alone has that name in the flattened model; what a name with dots means is written
there in full.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from contact_foundation.errors import Place, UnsupportedModelError

from modelica2fmu.crosscheck.flattened.flat_reading import FlatReading, objects

_EXPRESSIONS = (
    "variables",
    "equations",
    "structured_equations",
    "assert_equations",
    "initial_equations",
    "initial_structured_equations",
    "initial_assert_equations",
    "algorithms",
    "initial_algorithms",
    "when_chains",
)


def check_function_names(flat: Mapping[str, Any], model: str, reading: FlatReading) -> None:
    """Refuses calls that the front end mixes up.

    Args:
        flat: as the front end gives it.
        model: full name.
        reading: the sources.

    Raises:
        UnsupportedModelError: one name stands for several functions.
    """
    called = {name for name in flat["functions"] if "." not in name}
    if not called:
        return
    meant: dict[str, int] = {}
    for tree in (*(flat[kind] for kind in _EXPRESSIONS), flat["functions"]):
        for name, number, span in _calls(tree, called):
            if meant.setdefault(name, number) != number:
                extent = None if span is None else reading.extent(span)
                raise UnsupportedModelError(
                    f"several classes have a function {name}, and the front end takes one of them for all",
                    place=Place(component=model) if extent is None else reading.place_of(extent),
                    remedy=f"call each by a name with dots, as in Package.{name}(u), or give them different names",
                )


def _calls(tree: Any, called: set[str]) -> Iterator[tuple[str, int, Mapping[str, int] | None]]:
    """Name, number of the declaration, and place of the calls by one of some names."""
    for item in objects(tree):
        call = item.get("FunctionCall")
        if not isinstance(call, dict):
            continue
        place = call["name"] if "name" in call else call["comp"]
        parts: list[dict[str, Any]] = place.get("parts") or (place.get("component_ref") or {}).get("parts") or []
        if len(parts) == 1 and parts[0]["ident"] in called and parts[0].get("def_id") is not None:
            yield parts[0]["ident"], parts[0]["def_id"], call.get("span") or parts[0]["span"]
