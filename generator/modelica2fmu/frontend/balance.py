"""What is wrong with a model that has more or fewer equations than unknowns."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, Final

from modelica2fmu.frontend.runner import Request
from modelica2fmu.library.class_text import without_comments_and_strings

_MANAGER: Final = re.compile(r"\bContactManager\s+(?P<name>\w+)\s*[(;\"]")
_COUNTED: Final = re.compile(r"\bContactManager\s+(?P<name>\w+)\s*\([^;]*?\bn\s*=\s*(?P<count>\d+)\b", re.S)
_MOST_FRAMES: Final = 1000
_PARTIAL: Final = "cmb partial model"
_UNBALANCED: Final = re.compile(r"unbalanced model: (\d+) equations, (\d+) unknowns")
_ROOTLESS: Final = re.compile(r"Connections\.branch\((\w+)[^()]*\) belongs to .* with no Connections\.root")
_WORLD: Final = re.compile(r"(?:^|;)(?P<prefixes>[\w\s]*?)\b(?:[A-Za-z]\w*\.)*MultiBody\.World\s+(?P<name>\w+)")


def lacks_equations(error: str) -> bool:
    """= true, if an error says that a model has fewer equations than unknowns."""
    found = _UNBALANCED.search(error)
    return found is not None and int(found[1]) < int(found[2])


def is_unbalanced(error: str) -> bool:
    """= true, if an error says that a model has more or fewer equations than unknowns."""
    return _UNBALANCED.search(error) is not None


def loose_component(error: str) -> str | None:
    """The component that an error finds connected to nothing that has an orientation."""
    found = _ROOTLESS.search(error)
    return None if found is None else found[1]


def world_without_inner(text: str) -> str | None:
    """Name of a component of MultiBody's ``World`` that is declared without ``inner``, so that no part finds it."""
    found = (each for each in _WORLD.finditer(without_comments_and_strings(text)))
    return next((each["name"] for each in found if not {"inner", "outer"} & set(each["prefixes"].split())), None)


def unbalanced_form(request: Request) -> Request | None:
    """Asks for the flattened form in spite of that; None for a model whose text rumoca finds itself.

    A partial model may lack equations: an empty one that extends the model is flattened in its place.
    """
    if request.text is None:
        return None
    partial = f"partial model '{_PARTIAL}'\n  extends {request.model};\nend '{_PARTIAL}';\n"
    return replace(request, text=request.text + partial, model=f"'{_PARTIAL}'")


def frames_without_connect(text: str) -> list[str]:
    """Elements ``manager.frame[k]`` of components declared with ``n=N`` that no ``connect`` of the text names.

    Only where every connect names its element by a number; ``manager.frame`` where none names any. For models that
    cannot even be flattened as they are.
    """
    names = [declared["name"] for declared in _MANAGER.finditer(text)]
    found = [f"{name}.frame" for name in names if re.search(rf"\b{name}\.frame\b", text) is None]
    for declared in _COUNTED.finditer(text):
        name, count = declared["name"], int(declared["count"])
        subscripts = re.findall(rf"\b{name}\.frame\[\s*([^\]]*?)\s*\]", text)
        if not subscripts or count > _MOST_FRAMES or not all(item.isdecimal() for item in subscripts):
            continue
        found += [f"{name}.frame[{number}]" for number in range(1, count + 1) if str(number) not in subscripts]
    return found


def unplaced_frames(flat: Mapping[str, Any]) -> list[str]:
    """Connectors with an orientation that nothing decides: they are connected to nothing that has a place.

    Args:
        flat: the flattened model; its graph of orientations is that of Modelica 3.6, section 9.4.
    """
    placed = set(flat["definite_roots"]) | {root for root, _ in flat["potential_roots"]}
    edges = [*flat["branches"], *flat["optional_edges"]]
    reached = -1
    while reached != len(placed):
        reached = len(placed)
        placed.update(end for edge in edges if not placed.isdisjoint(edge) for end in edge)
    orientations = flat["record_instances"].keys() - placed
    return [name for name in _unconnected(flat) if f"{name}.R" in orientations]


def _unconnected(flat: Mapping[str, Any]) -> Iterator[str]:
    """Connectors whose flows are zero, for they are connected to nothing; each once, in order."""
    origins = (equation["origin"] for equation in flat["equations"])
    flows = (origin["UnconnectedFlow"]["variable"] for origin in origins if "UnconnectedFlow" in origin)
    yield from dict.fromkeys(flow.rpartition(".")[0] for flow in flows)
