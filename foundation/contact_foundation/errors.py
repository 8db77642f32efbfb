"""The error family of ContactMultiBody."""

from __future__ import annotations

import errno
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

EXIT_INPUT = 2
EXIT_FAILURE = 1
NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT})
"""Errors of the system where a disk is full: no fault of what was to be written."""


@dataclass(frozen=True)
class Place:
    """Where a problem lies.

    Attributes:
        file: the file as the user named it, if it lies in one.
        line: 1-based line in ``file``.
        component: the part, joint, variable or Modelica class concerned.
    """

    file: Path | None = None
    line: int | None = None
    component: str | None = None

    def without_folder(self) -> Place:
        """The same without the file's folder, for what must not depend on the machine."""
        return self if self.file is None else replace(self, file=Path(self.file.name))

    def __str__(self) -> str:
        parts = []
        if self.file is not None:
            parts.append(f"{self.file}:{self.line}" if self.line is not None else str(self.file))
        if self.component:
            parts.append(self.component)
        return ": ".join(parts)


class CmbError(Exception):
    """Base of all errors that ContactMultiBody reports to its user.

    Args:
        message: what is wrong, one sentence.
        place: where.
        remedy: what the user can do about it.
    """

    exit_status = EXIT_FAILURE

    def __init__(self, message: str, *, place: Place | None = None, remedy: str | None = None) -> None:
        self.message = message
        self.place = place
        self.remedy = remedy
        super().__init__(str(self))

    def __str__(self) -> str:
        place = str(self.place) if self.place is not None else ""
        text = f"{place}: {self.message}" if place else self.message
        return f"{text}\n  {self.remedy}" if self.remedy else text


class InputError(CmbError):
    """The user's input is wrong (exit status 2)."""

    exit_status = EXIT_INPUT


class UnsupportedModelError(InputError):
    """A model uses a construct that the FMU builder does not translate (exit status 2)."""


class BuildError(CmbError):
    """A tool that the program runs failed (compiler, linker), or a required part is not installed."""


class SimulationError(CmbError):
    """A simulation could not be carried through."""


class ProblemList(InputError):
    """Several problems found in one pass over the input.

    Args:
        summary: one line that says what was read.
        problems: the single errors, in the order of the input; at least one.
    """

    def __init__(self, summary: str, problems: Iterable[CmbError]) -> None:
        self.problems: Sequence[CmbError] = tuple(problems)
        count = len(self.problems)
        text = f"{summary}: {count} problem{'' if count == 1 else 's'}"
        super().__init__("\n".join([text, *(f"- {problem}" for problem in self.problems)]))
