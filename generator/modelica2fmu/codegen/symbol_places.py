"""C text of the places where symbols live, and of assignments to them."""

from __future__ import annotations

from typing import Final

from modelica2fmu.codegen.c_expressions import bare, c_text
from modelica2fmu.codegen.c_functions import FunctionFrame
from modelica2fmu.codegen.slots import Slots, Store
from modelica2fmu.codegen.statements import Put, Statement, Stored, WorkSpace
from modelica2fmu.equations.lanes import LANES, lanes_at
from modelica2fmu.equations.tangents import is_tangent
from modelica2fmu.expand.scalar_model import INITIAL, TERMINAL, TIME, unwrapped
from modelica2fmu.symbolic.expression import Node

SIGNATURE: Final = "fmurt_values *v"
PROLOGUE: Final = (
    "  double *const restrict r = v->real;",
    "  double *const restrict w = v->work;",
    "  int *const restrict i = v->integer;",
    "  int *const restrict b = v->boolean;",
    "  (void)r; (void)w; (void)i; (void)b;",
)
_ARRAYS: Final = {Store.REAL: "r", Store.INTEGER: "i", Store.BOOLEAN: "b"}
_STORED: Final = {Store.REAL: Stored.NUMBER, Store.BOOLEAN: Stored.TRUTH}
_PREVIOUS: Final = {Store.REAL: "v->pre_real", Store.INTEGER: "v->pre_integer", Store.BOOLEAN: "v->pre_boolean"}


class SymbolPlaces:
    """Where the symbols of a model live.

    Attributes:
        slots: of the variables.
        work: the work arrays, in which start values and tangents are kept.
    """

    def __init__(self, slots: Slots, work: WorkSpace) -> None:
        self.slots = slots
        self.work = work
        self._starts: dict[str, int] = {}
        self._tangents: dict[str, int] = {}

    def frame(self, more_parameters: str = "", more_prologue: tuple[str, ...] = ()) -> FunctionFrame:
        """The frame of functions that use the symbols."""
        return FunctionFrame(
            self.location, self.work, SIGNATURE + more_parameters, (*PROLOGUE, *more_prologue), is_tangent
        )

    def tangent(self, name: str) -> int:
        """Offset of a tangent in the work array."""
        if name not in self._tangents:
            self._tangents[name] = self.work.real(LANES)
        return self._tangents[name]

    def put_tangents(self, names: tuple[str, ...]) -> int:
        """Gives tangents places that follow each other; the offset of the first."""
        offset = self.work.real(len(names) * LANES)
        self._tangents.update({name: offset + k * LANES for k, name in enumerate(names)})
        return offset

    def location(self, name: str) -> str:
        """C lvalue of a symbol."""
        slot = self.slots.of.get(name)
        if slot is not None:
            return f"{_ARRAYS[slot.store]}[{slot.index}]"
        if is_tangent(name):
            return lanes_at(self.tangent(name))
        if name == TIME:
            return "v->time"
        if name == INITIAL:
            return "v->initial"
        if name == TERMINAL:
            return "v->terminal"
        if name.startswith("relation["):
            return f"v->relation[{int(name[9:-1]) - 1}]"
        if name.startswith("start("):
            inner = name[6:-1]
            if inner not in self._starts:
                self._starts[inner] = self.work.real(1)
            return f"w[{self._starts[inner]}]"
        wrapper, inner = unwrapped(name)
        slot = self.slots.of.get(inner)
        if wrapper == "pre" and slot is not None:
            return f"{_PREVIOUS[slot.store]}[{slot.index}]"
        raise AssertionError(f"no place for {name}")

    def store(self, name: str, text: str) -> str:
        """The C statement that stores the value of a C expression in a symbol."""
        slot = self.slots.of.get(name) or self.slots.of.get(unwrapped(name)[1])
        target = self.location(name)
        if slot is None or slot.store is Store.REAL:
            return f"{target} = {bare(text)};"
        if slot.store is Store.BOOLEAN:
            return f"{target} = ({text} != 0);"
        rounded = f"fmurt_round_integer(v, &{target}, {bare(text)}, {c_text(unwrapped(name)[1])})"
        return f"if ({rounded} != FMURT_RESULT_OK) return FMURT_RESULT_DISCARD;"

    def assign(self, name: str, value: float | Node, is_discrete: bool = False) -> Statement:
        """The assignment of an expression to a symbol."""
        slot = self.slots.of.get(name) or self.slots.of.get(unwrapped(name)[1])
        store = Store.REAL if slot is None else slot.store
        put = Put(self.location(name), name, _STORED.get(store, Stored.OTHERWISE))
        return Statement((value,), lambda write: [self.store(name, write(value))], is_discrete, put=put)


def set_work(offset: int, value: float | Node) -> Statement:
    """The assignment of an expression to an element of the work array."""
    place = f"w[{offset}]"
    return Statement((value,), lambda write: [f"{place} = {bare(write(value))};"], put=Put(place))


def set_lanes(offset: int, value: float | Node, symbol: str | None = None) -> Statement:
    """The assignment of a vector, which ``symbol`` may name; an expression without vectors is zero."""
    place = lanes_at(offset)
    if not isinstance(value, Node):
        put = Put(place, symbol, Stored.OTHERWISE)
        return Statement((), lambda _: [f"{place} = (fmurt_lanes){{0}};"], put=put)
    return Statement((value,), lambda write: [f"{place} = {bare(write(value))};"], put=Put(place, symbol))
