"""C of a model's parts: how their bodies move, their derivatives, and calls of the engine for some of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Final

from modelica2fmu.codegen.c_functions import Function, FunctionFrame, single_function
from modelica2fmu.codegen.rolled_code import rolled
from modelica2fmu.codegen.scene_code import PASSAGE_PARAMETERS, passage_call
from modelica2fmu.codegen.slots import Slots, Store
from modelica2fmu.codegen.statements import Statement, WorkSpace, Write
from modelica2fmu.codegen.symbol_places import PROLOGUE, SymbolPlaces
from modelica2fmu.equations.parts import MOTION, PARAMETER, RESPONSE, STATE, WRENCH, PartKind, Parts
from modelica2fmu.symbolic.expression import Node

_SIGNATURE: Final = (
    "fmurt_values *v, const unsigned *slot, const int *body, const double *restrict x, double *restrict m, "
    "double *restrict rate"
)
_PROLOGUE: Final = (
    "  const double *const r = v->real;",
    "  (void)r; (void)slot; (void)body; (void)x; (void)m; (void)rate;",
)
_PROPERTIES: Final = (*range(6, 15), 16)  # arguments of the response: arrays of numbers
_HANDLE, _CHOICE, _NUMBER = 0, 15, 16


@dataclass(frozen=True)
class PartCode:
    """The code of a model's parts.

    Attributes:
        functions: that the tables name.
        tables: C of the description ``parts``; empty if there is none.
    """

    functions: tuple[Function, ...] = ()
    tables: str = ""


def part_code(parts: Parts | None, places: SymbolPlaces) -> PartCode:
    """Writes the parts; nothing where there are none, or where they have parameters that are no real numbers."""
    if parts is None or not all(_are_real(part.parameters, places.slots) for part in parts.parts):
        return PartCode()
    return _Writer(parts, places).run()


def _are_real(names: Sequence[str], slots: Slots) -> bool:
    return all((slot := slots.of.get(name)) is not None and slot.store is Store.REAL for name in names)


class _Writer:
    def __init__(self, parts: Parts, places: SymbolPlaces) -> None:
        self._parts = parts
        self._places = places
        n = parts.body_count
        self._motion = dict(
            zip(
                (position for position, _ in MOTION),
                accumulate((n * size for _, size in MOTION), initial=0),
                strict=False,
            )
        )
        self._force, self._torque = 18 * n, 21 * n
        sizes = [len(parts.call.args[position].values) for position in _PROPERTIES]
        offsets = list(accumulate(sizes, initial=24 * n))
        self._properties = dict(zip(_PROPERTIES, offsets, strict=False))
        self._size = offsets[-1]

    def run(self) -> PartCode:
        functions = [function for k, kind in enumerate(self._parts.kinds) for function in self._kind(k, kind)]
        functions += [self._prepare(), self._response(), self._passage(), self._radii()]
        return PartCode(tuple(functions), self._tables())

    # --- kinds ---

    def _kind(self, number: int, kind: PartKind) -> Iterator[Function]:
        def location(name: str) -> str:
            if name.startswith(STATE):
                return f"x[{name.removeprefix(STATE)}]"
            if name.startswith(PARAMETER):
                return f"r[slot[{kind.parameters.index(name)}]]"
            body, axis = divmod(int(name.removeprefix(WRENCH)), 6)
            return f"m[{(self._force, self._torque)[axis // 3] + axis % 3} + 3 * body[{body}]]"

        frame = FunctionFrame(location, WorkSpace(), _SIGNATURE, _PROLOGUE, lambda _: False)
        motion = [
            _put(f"m[{self._motion[position] + k} + {size} * body[{body}]]", values[start + k])
            for body, values in enumerate(kind.motion)
            for (position, size), start in zip(MOTION, (0, 3, 12, 15), strict=True)
            for k in range(size)
        ]
        yield single_function(f"fmurt_kind_{number + 1}_motion", motion, frame)
        rates = [_put(f"rate[{k}]", value) for k, value in enumerate(kind.rates)]
        yield single_function(f"fmurt_kind_{number + 1}_rates", rates, frame)

    # --- the engine ---

    def _function(self, name: str, signature: str, statement: Statement, unused: str) -> Function:
        frame = FunctionFrame(
            self._places.location,
            self._places.work,
            signature,
            (*PROLOGUE, f"  {unused}"),
            lambda _: False,
        )
        return single_function(name, [statement], frame)

    def _prepare(self) -> Function:
        """What the engine is asked with that parts do not change."""
        items: list[tuple[int, float | Node]] = []
        args = self._parts.call.args
        for position, offset in self._properties.items():
            items += [(offset + k, _numeric(value)) for k, value in enumerate(args[position].values)]
        for body in self._parts.fixed:
            for position, size in MOTION:
                start = size * body
                items += [
                    (self._motion[position] + start + k, _numeric(value))
                    for k, value in enumerate(args[position].values[start : start + size])
                ]

        def lines(write: Write) -> list[str]:
            return rolled([f"m[{place}] = {write(value)};" for place, value in items])

        statement = Statement(tuple(value for _, value in items), lines)
        return self._function("fmurt_parts_prepare", "fmurt_values *v, double *m", statement, "(void)m;")

    def _response(self) -> Function:
        args = self._parts.call.args
        handle, choice = _numeric(args[_HANDLE].values[0]), [_numeric(value) for value in args[_CHOICE].values]

        def lines(write: Write) -> list[str]:
            values = ", ".join(f"(int)({write(value)})" for value in choice)
            motion = [f"m + {self._motion[position]}" for position, _ in MOTION]
            properties = [f"m + {self._properties[position]}" for position in _PROPERTIES[:-1]]
            passed = [
                f"(int)({write(handle)})",
                "bodies",
                "count",
                motion[0],
                str(self._parts.body_count),
                *motion[1:],
                *properties,
                "choice",
                f"m + {self._properties[_NUMBER]}",
                f"m + {self._force}",
                f"m + {self._torque}",
            ]
            return [f"const int choice[] = {{{values}}};", f"{RESPONSE}_among({', '.join(passed)});"]

        statement = Statement((handle, *choice), lines)
        signature = "fmurt_values *v, const int *bodies, size_t count, double *m"
        return self._function("fmurt_parts_response", signature, statement, "(void)bodies; (void)count; (void)m;")

    def _passage(self) -> Function:
        handle = _numeric(self._parts.call.args[_HANDLE].values[0])

        def lines(write: Write) -> list[str]:
            return [passage_call(write(handle), "bodies", "count", self._parts.body_count)]

        signature = f"fmurt_values *v, const int *bodies, size_t count, {PASSAGE_PARAMETERS}"
        unused = "(void)bodies; (void)count;"
        return self._function("fmurt_parts_passage", signature, Statement((handle,), lines), unused)

    def _radii(self) -> Function:
        handle = _numeric(self._parts.call.args[_HANDLE].values[0])

        def lines(write: Write) -> list[str]:
            return [f"cmb_modelica_body_radii((int)({write(handle)}), {self._parts.body_count}, radius);"]

        signature = "fmurt_values *v, double *radius"
        return self._function("fmurt_parts_radii", signature, Statement((handle,), lines), "(void)radius;")

    # --- tables ---

    def _tables(self) -> str:
        parts = self._parts
        states, bodies, slots = _Column("part_state"), _Column("part_body"), _Column("part_slot", "unsigned")
        rows = []
        for part in parts.parts:
            parameters = [self._places.slots.of[name].index for name in part.parameters]
            cells = (states.add(part.states), bodies.add(part.bodies), slots.add(parameters))
            rows.append(f"{{part_kind + {part.kind}, {', '.join(cells)}}}")
        kinds = [
            f"{{{len(kind.rates)}, {len(kind.motion)}, fmurt_kind_{k + 1}_motion, fmurt_kind_{k + 1}_rates}}"
            for k, kind in enumerate(parts.kinds)
        ]
        fixed = ", ".join(str(body) for body in parts.fixed) or "0"
        return f"""static const fmurt_part_kind part_kind[] = {{{_lines(kinds)}}};
{states.text()}{bodies.text()}{slots.text()}static const fmurt_part part[] = {{{_lines(rows)}}};
static const int fixed_body[] = {{{fixed}}};
static const fmurt_parts parts = {{
  .part_count = {len(parts.parts)},
  .part = part,
  .body_count = {parts.body_count},
  .fixed_count = {len(parts.fixed)},
  .fixed = fixed_body,
  .memory_count = {self._size},
  .prepare = fmurt_parts_prepare,
  .response = fmurt_parts_response,
  .passage = fmurt_parts_passage,
  .radii = fmurt_parts_radii,
}};

"""


class _Column:
    """Rows of numbers one after the other in one array."""

    def __init__(self, name: str, c_type: str = "int") -> None:
        self._name = name
        self._type = c_type
        self._numbers: list[int] = []

    def add(self, numbers: Sequence[int]) -> str:
        """C of a pointer to a new row."""
        start = len(self._numbers)
        self._numbers += numbers
        return f"{self._name} + {start}"

    def text(self) -> str:
        """C of the array."""
        return (
            f"static const {self._type} {self._name}[] = {{{_lines([str(k) for k in self._numbers] or ['0'], 16)}}};\n"
        )


def _lines(items: Sequence[str], each: int = 1) -> str:
    rows = [", ".join(items[start : start + each]) for start in range(0, len(items), each)]
    return ",\n  ".join(rows)


def _put(place: str, value: float | Node) -> Statement:
    text: Callable[[Write], list[str]] = lambda write: [f"{place} = {write(value)};"]  # noqa: E731
    return Statement((value,), text)


def _numeric(value: float | str | Node) -> float | Node:
    assert not isinstance(value, str)
    return value
