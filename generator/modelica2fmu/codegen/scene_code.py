"""C of a model's contact scenes: how bodies move, and calls of the engine for those that pass through each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from modelica2fmu.codegen.c_expressions import c_text
from modelica2fmu.codegen.c_functions import Function, FunctionFrame, single_function
from modelica2fmu.codegen.rolled_code import rolled
from modelica2fmu.codegen.statements import Statement, Write
from modelica2fmu.codegen.symbol_places import PROLOGUE, SymbolPlaces
from modelica2fmu.equations.scenes import Scene

_STEP = "double duration, const double *begin, const double *end, fmurt_motion_at at, void *context"
_FOUND = "int *pair, double *number"


@dataclass(frozen=True)
class SceneCode:
    """The code of a model's scenes.

    Attributes:
        functions: that the table names.
        table: C of the array ``scene``; empty if there is none.
        count: of scenes.
    """

    functions: tuple[Function, ...] = ()
    table: str = ""
    count: int = 0


def scene_code(scenes: Sequence[Scene], places: SymbolPlaces) -> SceneCode:
    """Writes the scenes."""
    if not scenes:
        return SceneCode()
    functions = []
    rows = []
    for number, scene in enumerate(scenes, 1):
        functions += [_motion(number, scene, places), _passage(number, scene, places)]
        names = f"fmurt_scene_{number}_motion, fmurt_scene_{number}_passage"
        rows.append(f"{{{scene.body_count}, {names}, {c_text(scene.manager)}}}")
    table = f"static const fmurt_scene scene[] = {{{', '.join(rows)}}};\n\n"
    return SceneCode(tuple(functions), table, len(rows))


def passage_call(handle: str, bodies: str, count: str, body_count: int) -> str:
    """C that asks for the bodies of a broad phase that pass through each other."""
    return (
        f"cmb_modelica_find_passage_among((int)({handle}), {bodies}, {count}, {body_count}, duration, begin, end, at, "
        "context, pair, number);"
    )


PASSAGE_PARAMETERS = f"{_STEP}, {_FOUND}"


def _function(name: str, signature: str, statement: Statement, places: SymbolPlaces) -> Function:
    frame = FunctionFrame(places.location, places.work, signature, PROLOGUE, lambda _: False)
    return single_function(name, [statement], frame)


def _motion(number: int, scene: Scene, places: SymbolPlaces) -> Function:
    def lines(write: Write) -> list[str]:
        return rolled([f"m[{place}] = {write(value)};" for place, value in enumerate(scene.motion)])

    signature = "fmurt_values *v, double *m"
    return _function(f"fmurt_scene_{number}_motion", signature, Statement(scene.motion, lines), places)


def _passage(number: int, scene: Scene, places: SymbolPlaces) -> Function:
    def lines(write: Write) -> list[str]:
        if scene.is_broadphase:
            return [passage_call(write(scene.handle), "NULL", "0", scene.body_count)]
        return [
            f"cmb_modelica_find_passage((int)({write(scene.handle)}), {scene.body_count}, duration, begin, end, at, "
            "context, pair, number);"
        ]

    signature = f"fmurt_values *v, {PASSAGE_PARAMETERS}"
    return _function(f"fmurt_scene_{number}_passage", signature, Statement((scene.handle,), lines), places)
