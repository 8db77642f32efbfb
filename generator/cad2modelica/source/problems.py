"""Collects problems of the input, so that one run reports them all."""

from __future__ import annotations

from contact_foundation.errors import CmbError, InputError, Place, ProblemList


class Problems:
    """A list of problems found so far."""

    def __init__(self, summary: str) -> None:
        self._summary = summary
        self._found: list[CmbError] = []

    def add(self, message: str, place: Place, remedy: str | None = None) -> None:
        """Records one problem."""
        self._found.append(InputError(message, place=place, remedy=remedy))

    def record(self, error: CmbError) -> None:
        """Records a problem that was raised as an error, once: several parts may share a broken file."""
        if all(str(error) != str(known) for known in self._found):
            self._found.append(error)

    def raise_if_any(self) -> None:
        """Ends the reading if problems were recorded.

        Raises:
            CmbError: the only problem.
            ProblemList: several problems, in the order of the input.
        """
        if len(self._found) == 1:
            raise self._found[0]
        if self._found:
            raise ProblemList(self._summary, self._found)
