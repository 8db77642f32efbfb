"""The Standard Library's tables: CombiTable1D, CombiTable2D and CombiTimeTable.

In the library a table is an external object, made once and asked again and again. Here it is the record of what it was
made of, known at translation, and each question becomes a call of a function of the runtime (``fmurt_table.c``) that
gets the table's points as constant arrays: nothing has to be made, copied or freed in an instance.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from contact_foundation.errors import InputError, UnsupportedModelError

from modelica2fmu.expand.scalar_model import CallArgument
from modelica2fmu.interpreter import arrays
from modelica2fmu.interpreter.arrays import Record, Value
from modelica2fmu.library.table_files import read_table
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

_PREFIX: Final = "ModelicaStandardTables_"
_NO_NAME: Final = "NoName"
# Modelica.Blocks.Types.Smoothness
_LINEAR, _CONSTANT = 1, 3

Number = float | Node
Lookup = Callable[[str, Sequence[CallArgument]], Node]
"""Makes a call of a C function with a Real result; given its name and arguments."""


def is_table_function(name: str) -> bool:
    """True for the C functions of the Standard Library's tables."""
    return name.startswith(_PREFIX)


@dataclass(frozen=True)
class Tables:
    """Evaluates the functions of tables.

    Attributes:
        lookup: see :data:`Lookup`.
        number: the number that a value has at translation.
        file: the file that a name in a model means.
    """

    lookup: Lookup
    number: Callable[[Value], float]
    file: Callable[[str], Path]

    def call(self, name: str, values: Mapping[str, Value]) -> tuple[Value, ...]:
        """The outputs of a C function by its name.

        Args:
            name: of the C function.
            values: the Modelica function's inputs by their names.

        Raises:
            UnsupportedModelError: a kind of table that is not translated.
            InputError: a table that is wrong.
        """
        kind, _, action = name.removeprefix(_PREFIX).partition("_")
        if action.startswith("init"):
            return (self._table(kind, values),)
        table = values["tableID"]
        assert isinstance(table, Record)
        if kind == "CombiTable1D":
            return (self._curve(action, table, values),)
        if kind == "CombiTable2D":
            return (self._surface(action, table, values),)
        return (self._over_time(action, table, values),)

    # --- making ---

    def _table(self, kind: str, values: Mapping[str, Value]) -> Record:
        file_name, table_name = values["fileName"], values["tableName"]
        if not isinstance(file_name, str) or not isinstance(table_name, str):
            raise UnsupportedModelError("a table whose name depends on variables is not translated")
        if file_name.strip() not in ("", _NO_NAME):
            delimiter, header = values.get("delimiter", ","), values.get("nHeaderLines", 0)
            points = read_table(self.file(file_name), table_name, str(delimiter), int(self.number(header)))
        elif table_name.strip() not in ("", _NO_NAME):
            raise UnsupportedModelError(f"the table {table_name} of a C function (usertab) is not translated")
        else:
            points = self._points(values["table"])
        columns = [int(self.number(item)) for item in arrays.scalars(values["columns"])] if "columns" in values else []
        if not columns and kind == "CombiTable1D":
            kind = "CombiTable2D"  # as library_repairs writes it
        record = Record({**values, "table": points, "columns": columns})
        _check(kind, points, columns)
        smoothness = self._whole(record, "smoothness")
        if kind == "CombiTable2D" and smoothness not in (_LINEAR, _CONSTANT):
            raise UnsupportedModelError(
                "a CombiTable2D with a smooth surface is not translated",
                remedy="take smoothness = LinearSegments or ConstantSegments, or more points",
            )
        return record

    def _points(self, table: Value) -> np.ndarray:
        if not isinstance(table, np.ndarray) or table.ndim != 2 or table.size == 0:
            raise InputError("a table has no points")
        return np.array([self.number(item) for item in table.reshape(-1)], dtype=float).reshape(table.shape)

    def _whole(self, table: Record, field: str) -> int:
        return int(self.number(table.fields[field]))

    # --- asking ---

    def _column(self, table: Record, values: Mapping[str, Value]) -> tuple[CallArgument, CallArgument]:
        """Abscissas and ordinates of the curve that a function is about."""
        points, columns = table.fields["table"], table.fields["columns"]
        number = int(self.number(values["icol"]))
        if not 1 <= number <= len(columns):
            raise InputError(f"a table with {len(columns)} columns is asked for number {number}")
        return _reals(points[:, 0]), _reals(points[:, columns[number - 1] - 1])

    def _kind(self, table: Record) -> list[CallArgument]:
        return [_integer(self._whole(table, "smoothness")), _integer(self._whole(table, "extrapolation"))]

    def _curve(self, action: str, table: Record, values: Mapping[str, Value]) -> Value:
        points = table.fields["table"]
        if action.endswith("Abscissa"):
            return float(points[0 if action.startswith("minimum") else -1, 0])
        x, y = self._column(table, values)

        def value(order: int) -> Node:
            u = _real(_scalar(values["u"]))
            return self.lookup(
                "fmurt_table_value", [x, y, _integer(len(points)), *self._kind(table), u, _integer(order)]
            )

        if action == "getValue":
            return value(0)
        if action == "getDerValue":
            return ex.multiply(value(1), _scalar(values["der_u"]))
        raise _unsupported(action)

    def _surface(self, action: str, table: Record, values: Mapping[str, Value]) -> Value:
        points = table.fields["table"]
        x, y, z = points[1:, 0], points[0, 1:], points[1:, 1:]
        if action.endswith("Abscissa"):
            end = 0 if action.startswith("minimum") else -1
            return arrays.stack([float(x[end]), float(y[end])])

        def value(order: int) -> Node:
            grid = [_reals(x), _integer(len(x)), _reals(y), _integer(len(y)), _reals(z.reshape(-1))]
            place = [_real(_scalar(values[name])) for name in ("u1", "u2")]
            return self.lookup("fmurt_table_surface", [*grid, *self._kind(table), *place, _integer(order)])

        if action == "getValue":
            return value(0)
        if action == "getDerValue":
            rates = [ex.multiply(value(order), _scalar(values[f"der_u{order}"])) for order in (1, 2)]
            return ex.add(*rates)
        raise _unsupported(action)

    def _over_time(self, action: str, table: Record, values: Mapping[str, Value]) -> Value:
        points = table.fields["table"]
        if action.endswith("Time"):
            return float(points[0 if action.startswith("minimum") else -1, 0])
        start, shift = (_real(self._time(table.fields[name])) for name in ("startTime", "shiftTime"))
        if action == "nextTimeEvent":
            rules = [_integer(self._whole(table, "extrapolation")), start, shift]
            time = _real(_scalar(values["timeIn"]))
            events = _integer(self._whole(table, "timeEvents"))
            count = _integer(len(points))
            return self.lookup("fmurt_table_next_event", [_reals(points[:, 0]), count, *rules, events, time])
        x, y = self._column(table, values)

        def value(order: int) -> Node:
            times = [_real(_scalar(values[name])) for name in ("timeIn", "nextTimeEvent", "pre_nextTimeEvent")]
            count = _integer(len(points))
            return self.lookup(
                "fmurt_table_at_time", [x, y, count, *self._kind(table), start, shift, *times, _integer(order)]
            )

        if action == "getValue":
            return value(0)
        if action == "getDerValue":
            return ex.multiply(value(1), _scalar(values["der_timeIn"]))
        raise _unsupported(action)

    @staticmethod
    def _time(value: Value) -> Number:
        return _scalar(value)


def _check(kind: str, points: np.ndarray, columns: Sequence[int]) -> None:
    width = points.shape[1]
    wrong = [number for number in columns if not 1 <= number <= width]
    if wrong:
        raise InputError(f"a table with {width} columns has no column {wrong[0]}")
    if not np.isfinite(points[1:] if kind == "CombiTable2D" else points).all():
        raise InputError("a table has points that are not finite")
    axes = [points[1:, 0], points[0, 1:]] if kind == "CombiTable2D" else [points[:, 0]]
    if any(len(axis) == 0 for axis in axes):
        raise InputError("a table has no points")
    for axis in axes:
        steps = np.diff(axis)
        if (steps < 0).any() or (kind != "CombiTimeTable" and (steps == 0).any()):
            raise InputError("the abscissas of a table do not rise")


def _unsupported(action: str) -> UnsupportedModelError:
    return UnsupportedModelError(f"the function {action} of tables is not translated")


def _scalar(value: Value) -> Number:
    (item,) = arrays.scalars(value)
    assert isinstance(item, float | int | Node)
    return item


def _reals(items: np.ndarray) -> CallArgument:
    return CallArgument("Real", tuple(float(item) for item in items), is_array=True, is_output=False, is_constant=True)


def _real(value: Number) -> CallArgument:
    return CallArgument("Real", (value,), is_array=False, is_output=False)


def _integer(value: int) -> CallArgument:
    return CallArgument("Integer", (value,), is_array=False, is_output=False)
