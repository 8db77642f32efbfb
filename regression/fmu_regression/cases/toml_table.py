"""Reading TOML files whose every mistake is told with file and key."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from contact_foundation.errors import CmbError, InputError, Place

from fmu_regression.compare.checks import Window
from fmu_regression.fmi.description import StartValue


class TomlTable:
    """A TOML table whose keys are taken one by one; what is left over is an error."""

    def __init__(self, path: Path, where: str, content: Any, problems: list[CmbError]) -> None:
        self._path, self._where, self._problems = path, where, problems
        self._left = dict(content) if isinstance(content, dict) else {}
        if not isinstance(content, dict):
            self.wrong("", "is not a table")

    def wrong(self, key: str, what: str) -> None:
        """Notes that a key, or the table itself where it is "", is wrong."""
        component = f"{self._where}.{key}" if key else self._where
        self._problems.append(InputError(what, place=Place(file=self._path, component=component)))

    def has(self, key: str) -> bool:
        """Whether a key is there that was not taken."""
        return key in self._left

    def number(
        self, key: str, default: float | None = None, *, positive: bool = False, least: float | None = None
    ) -> float:
        """A finite number; nan where it is wrong. Required without a default."""
        value = self._take(key, default)
        if value is None:
            return math.nan
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            self.wrong(key, f"{value!r} is not a number")
            return math.nan
        if (positive and not value > 0) or (least is not None and value < least):
            self.wrong(key, f"{value!r} is too small")
        return float(value)

    def optional_number(self, key: str, *, positive: bool = False) -> float | None:
        """A number, or None where the key is missing."""
        return self.number(key, positive=positive) if self.has(key) else None

    def optional_count(self, key: str) -> int | None:
        """An integer that is not negative, or None where the key is missing or wrong."""
        if not self.has(key):
            return None
        value = self._left.pop(key)
        if isinstance(value, bool) or not isinstance(value, int) or value < 0:
            self.wrong(key, f"{value!r} is not a count")
            return None
        return value

    def text(self, key: str, default: str | None = None) -> str:
        """A text; required and not empty without a default."""
        value = self._take(key, default)
        if value is None:
            return ""
        if not isinstance(value, str) or (not value and default is None):
            self.wrong(key, f"{value!r} is not a text")
            return ""
        return value

    def choice(self, key: str, choices: tuple[str, ...], default: str | None = None) -> str:
        """One of some words; the first one where it is wrong."""
        value = self.text(key, default)
        if value and value not in choices:
            self.wrong(key, f"{value!r} is none of {', '.join(choices)}")
            return choices[0]
        return value

    def texts(self, key: str) -> tuple[str, ...]:
        """A list of texts; empty where the key is missing."""
        value = self._take(key, [])
        if not isinstance(value, list) or not all(isinstance(item, str) and item for item in value):
            self.wrong(key, "is not a list of texts")
            return ()
        return tuple(value)

    def optional_numbers(self, key: str) -> tuple[float, ...] | None:
        """A list of finite numbers, or None where the key is missing or wrong."""
        if not self.has(key):
            return None
        value = self._left.pop(key)
        if not isinstance(value, list) or not all(
            isinstance(item, int | float) and not isinstance(item, bool) and math.isfinite(item) for item in value
        ):
            self.wrong(key, "is not a list of numbers")
            return None
        return tuple(float(item) for item in value)

    def window(self) -> Window | None:
        """The key ``window``: from and to, s."""
        pair = self.optional_numbers("window")
        if pair is None:
            return None
        if len(pair) != 2 or not pair[0] < pair[1]:
            self.wrong("window", "is not [from, to] with from < to")
            return None
        return pair[0], pair[1]

    def signals(self) -> tuple[str, ...]:
        """The key ``name`` or the key ``sum``."""
        if self.has("name") == self.has("sum"):
            self.wrong("name", "give either name (one signal) or sum (a list of signals)")
        names = self.texts("sum") if self.has("sum") else (self.text("name"),)
        return tuple(name for name in names if name) or ("",)

    def file(self, key: str, folder: Path) -> Path | None:
        """A path below the folder of the file that is read, or None where the key is missing."""
        if not self.has(key):
            return None
        text = self.text(key)
        return self.below(key, text, folder) if text else None

    def below(self, key: str, text: str, folder: Path) -> Path | None:
        """A relative path as one below a folder; None and a problem where it is absolute."""
        path = Path(text)
        if path.is_absolute():
            self.wrong(key, f"{text!r} must be relative to the file that names it")
            return None
        return folder / path

    def values(self, key: str) -> Mapping[str, StartValue]:
        """A table of numbers, texts and Booleans; empty where the key is missing."""
        value = self._take(key, {})
        if not isinstance(value, dict) or not all(isinstance(v, int | float | str | bool) for v in value.values()):
            self.wrong(key, "is not a table of numbers, texts or Booleans")
            return {}
        return MappingProxyType(dict(value))

    def skip(self, key: str) -> None:
        """Takes a key that is read elsewhere."""
        self._left.pop(key, None)

    def done(self) -> None:
        """Notes every key that was not taken as a problem."""
        for key in self._left:
            self.wrong(key, "is not a key of this table")

    def _take(self, key: str, default: Any) -> Any:
        if key not in self._left:
            if default is None:
                self.wrong(key, "is missing")
            return default
        return self._left.pop(key)
