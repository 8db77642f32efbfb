"""Initial conditions that others determine already: they choose nothing, and must hold nevertheless."""

from __future__ import annotations

from typing import Final

from contact_foundation.errors import Place

from modelica2fmu.expand.scalar_model import ScalarAssert
from modelica2fmu.interpreter.arrays import Text
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_RELATIVE: Final = 1e-5  # start values are written with some digits, and systems solved to 1e-12
_ABSOLUTE: Final = 1e-9


def initial_check(residual: float | Node, text: str, place: Place) -> ScalarAssert:
    """That a residual is zero beside its terms at the end of initialization.

    Args:
        residual: the condition.
        text: what it is called.
        place: where it is written.
    """
    left, right = _sides(residual)
    allowed: float | Node = ex.add(
        ex.multiply(_RELATIVE, ex.add(ex.unary("abs", left), ex.unary("abs", right))), _ABSOLUTE
    )
    holds = ex.less_equal(ex.unary("abs", ex.subtract(left, right)), allowed)
    start = f"initial conditions contradict each other: by the others, {text} ({place.without_folder()}) fails: "
    parts = [part if isinstance(part, Node) else f"{part:g}" for part in (left, right)]
    return ScalarAssert(holds, Text((start, parts[0], " is not ", parts[1])))


def _sides(residual: float | Node) -> tuple[float | Node, float | Node]:
    if isinstance(residual, Node) and residual.op == "sub":
        first, second = residual.args
        return ex.value_of(first), ex.value_of(second)
    return residual, 0.0
