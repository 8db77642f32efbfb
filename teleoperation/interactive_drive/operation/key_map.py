"""``controls.toml``: which keys and gamepad axes set which inputs.

```toml
[[key]]
key = "ArrowUp"      # as browsers name keys: KeyboardEvent.code
control = "speed"    # input or tunable parameter of the FMU
value = 1.0          # while the key is held
rest = 0.0           # when it is let go; without it the value stays

[[axis]]
axis = 1             # of the gamepad, counted from 0
control = "speed"
low = 1.0            # value at -1
high = -1.0          # value at +1
dead_zone = 0.1      # share of the axis around its middle that counts as the middle
```
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import zip_longest
from pathlib import Path
from typing import Any, NoReturn

from contact_foundation.errors import InputError, Place
from contact_foundation.toml_text import read_toml
from fmu_regression.results.result import close_names_remedy

from interactive_drive.machine.controls import Control

_KEY_PAIRS = (("ArrowUp", "ArrowDown"), ("ArrowRight", "ArrowLeft"), ("KeyW", "KeyS"), ("KeyD", "KeyA"))
_AXES = (1, 0, 3, 2)
_DOWN_IS_POSITIVE = {1, 3}
RESERVED_KEYS = ("Space", "Period", "KeyR")
_DEAD_ZONE = 0.1
_MOST_AXES = 64


@dataclass(frozen=True)
class KeyBinding:
    """A key that sets a control to a value while it is held; to ``rest`` when it is let go, unless that is None."""

    key: str
    control: str
    value: float
    rest: float | None


@dataclass(frozen=True)
class AxisBinding:
    """A gamepad axis that sets a control between two values; ``dead_zone`` is a share of the axis from 0 to below 1."""

    axis: int
    control: str
    low: float
    high: float
    dead_zone: float


@dataclass(frozen=True)
class KeyMap:
    """All bindings."""

    keys: tuple[KeyBinding, ...] = ()
    axes: tuple[AxisBinding, ...] = ()

    def as_data(self) -> dict[str, Any]:
        """For the page's script."""
        return {"keys": [asdict(key) for key in self.keys], "axes": [asdict(axis) for axis in self.axes]}


def default_key_map(controls: Sequence[Control]) -> KeyMap:
    """Arrows, then W S and D A, and the gamepad's first four axes for the first inputs that are real numbers.

    Letting go brings an input back to its start value.
    """
    inputs = [control for control in controls if control.is_input and control.kind == "Real"]
    keys: list[KeyBinding] = []
    axes: list[AxisBinding] = []
    for control, pair, axis in zip_longest(inputs[: len(_KEY_PAIRS)], _KEY_PAIRS, _AXES):
        if control is None:
            break
        keys.append(KeyBinding(pair[0], control.name, control.high, control.start))
        keys.append(KeyBinding(pair[1], control.name, control.low, control.start))
        low, high = (control.high, control.low) if axis in _DOWN_IS_POSITIVE else (control.low, control.high)
        axes.append(AxisBinding(axis, control.name, low, high, _DEAD_ZONE))
    return KeyMap(tuple(keys), tuple(axes))


def read_key_map(file: Path, controls: Sequence[Control]) -> KeyMap:
    """Reads a file of bindings.

    Raises:
        InputError: the file is wrong; the entry is named.
    """
    return _Reader(file, controls).key_map(read_toml(file, "a file of keys and axes"))


class _Reader:
    def __init__(self, file: Path, controls: Sequence[Control]) -> None:
        self._file = file
        self._controls = {control.name: control for control in controls}

    def key_map(self, content: Mapping[str, Any]) -> KeyMap:
        unknown = sorted(set(content) - {"key", "axis"})
        if unknown:
            self._wrong(f"{unknown[0]} has no meaning", "Known are [[key]] and [[axis]].")
        return KeyMap(
            tuple(self._key(entry, f"key {k + 1}") for k, entry in enumerate(self._list(content, "key"))),
            tuple(self._axis(entry, f"axis {k + 1}") for k, entry in enumerate(self._list(content, "axis"))),
        )

    def _key(self, entry: Mapping[str, Any], where: str) -> KeyBinding:
        self._known(entry, where, {"key", "control", "value", "rest"})
        key = entry.get("key")
        if not isinstance(key, str) or not key:
            self._wrong(f"{where}: key is no text", 'Name a key as browsers do, e.g. "ArrowUp" or "KeyW".')
        if key in RESERVED_KEYS:
            self._wrong(f"{where}: {key} pauses, steps or resets", "Take another key.")
        control = self._control(entry, where)
        rest = self._number(entry, "rest", where, control) if "rest" in entry else None
        return KeyBinding(key, control.name, self._number(entry, "value", where, control), rest)

    def _axis(self, entry: Mapping[str, Any], where: str) -> AxisBinding:
        self._known(entry, where, {"axis", "control", "low", "high", "dead_zone"})
        axis = entry.get("axis")
        if not isinstance(axis, int) or isinstance(axis, bool) or not 0 <= axis < _MOST_AXES:
            self._wrong(f"{where}: axis is no number from 0 to {_MOST_AXES - 1}", "Count the gamepad's axes from 0.")
        control = self._control(entry, where)
        dead_zone = entry.get("dead_zone", _DEAD_ZONE)
        if isinstance(dead_zone, bool) or not isinstance(dead_zone, int | float) or not 0 <= dead_zone < 1:
            self._wrong(f"{where}: dead_zone is no share from 0 to below 1", "Give a share of the axis.")
        low, high = (self._number(entry, name, where, control) for name in ("low", "high"))
        return AxisBinding(axis, control.name, low, high, float(dead_zone))

    def _list(self, content: Mapping[str, Any], name: str) -> list[Mapping[str, Any]]:
        entries = content.get(name, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            self._wrong(f"{name} is no list of tables", f"Write [[{name}]].")
        return entries

    def _known(self, entry: Mapping[str, Any], where: str, names: set[str]) -> None:
        unknown = sorted(set(entry) - names)
        if unknown:
            self._wrong(f"{where}: {unknown[0]} has no meaning", f"Known are {', '.join(sorted(names))}.")

    def _control(self, entry: Mapping[str, Any], where: str) -> Control:
        name = entry.get("control")
        if not isinstance(name, str) or name not in self._controls:
            self._wrong(
                f"{where}: {name!r} is no input and no parameter shown",
                close_names_remedy(str(name), list(self._controls)) if self._controls else "The FMU has no inputs.",
            )
        return self._controls[name]

    def _number(self, entry: Mapping[str, Any], name: str, where: str, control: Control) -> float:
        value = entry.get(name)
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            self._wrong(f"{where}: {name} is no number", f"Give a value of {control.name}.")
        if not control.low <= value <= control.high:
            self._wrong(
                f"{where}: {name} = {value:g} is outside {control.low:g} to {control.high:g}",
                f"These are the ends of {control.name}.",
            )
        return float(value)

    def _wrong(self, what: str, remedy: str) -> NoReturn:
        raise InputError(what, place=Place(file=self._file), remedy=remedy)
