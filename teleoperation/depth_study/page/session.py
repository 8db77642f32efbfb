"""Observers' sessions: who sees what next, which tab may answer, and where a broken session goes on."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

from contact_foundation.errors import CmbError, InputError

from depth_study.arrays import IntArray
from depth_study.design.sequences import sequences_without_end
from depth_study.page.scene import TECHNIQUES, scene_data, technique_data, view_of
from depth_study.page.viewing import Viewing
from depth_study.record.answers import GREATEST, LEAST
from depth_study.record.database import Answer, StudyDatabase

MAX_OBSERVERS = 1000
_MAX_TAB = 64


class OtherTabError(CmbError):
    """The session goes on in another tab."""


class StudySessions:
    """The sessions of a study; may be used from several threads.

    Args:
        database: keeps the answers.
        viewing: lengths of cameras and screen.
    """

    def __init__(self, database: StudyDatabase, viewing: Viewing) -> None:
        self._database = database
        self._viewing = viewing
        self._lock = threading.RLock()
        self._more: Iterator[IntArray] = sequences_without_end(database.design, database.seed)
        self._sequences: list[IntArray] = []
        self._tabs: dict[int, str] = {}

    def start(self) -> dict[str, Any]:
        """What the page's first view shows: the title, the next free number and the scene."""
        known = self._database.observers()
        total = len(self._database.design.names)
        return {
            "title": self._database.design.title,
            "total": total,
            "free": max(known, default=0) + 1,
            "unfinished": [number for number, count in known.items() if count < total],
            "scene": scene_data(self._viewing),
            "techniques": [technique_data(technique) for technique in self._goggles()],
        }

    def begin(self, observer: object, tab: object) -> dict[str, Any]:
        """Begins an observer's session, or goes on with it; from now on this tab answers, and no other.

        Raises:
            InputError: the number is none of an observer.
            StorageError: the observer could not be stored.
        """
        number, own = _observer(observer), _tab(tab)
        with self._lock:
            if number not in self._database.observers():
                self._database.add_observer(number, self._sequence(number))
            self._tabs[number] = own
            return self._state(number)

    def answer(self, data: dict[str, Any]) -> dict[str, Any]:
        """Stores an answer, which is on the disk when this returns.

        Args:
            data: `observer`, `tab`, `position` (from 0), `absolute`, `relative` (None at position 0), `seconds`.

        Raises:
            InputError: something is no number from 1 to 9.
            OtherTabError: another tab has taken the session over.
            AnsweredError: another constellation is the next to be answered.
            StorageError: it could not be stored.
        """
        observer, tab = _observer(data.get("observer")), _tab(data.get("tab"))
        position = data.get("position")
        if isinstance(position, bool) or not isinstance(position, int):
            raise InputError("the answer does not say which constellation it is about", remedy="Reload the page.")
        absolute = _score(data.get("absolute"), "absolute")
        relative = None if position == 0 else _score(data.get("relative"), "relative")
        given = data.get("seconds")
        seconds = float(given) if isinstance(given, int | float) and not isinstance(given, bool) else None
        with self._lock:
            if self._tabs.setdefault(observer, tab) != tab:
                raise OtherTabError(
                    f"the session of observer {observer} goes on in another tab",
                    remedy="Answer there, or take it over here by reloading this page.",
                )
            self._database.store(observer, Answer(position, absolute, relative, seconds))
            return self._state(observer)

    def delete(self, observer: object) -> dict[str, Any]:
        """Deletes an observer's answers.

        Raises:
            InputError: there is no such observer.
        """
        number = _observer(observer)
        with self._lock:
            self._database.delete_observer(number)
            self._tabs.pop(number, None)
            return self.start()

    def _state(self, observer: int) -> dict[str, Any]:
        design = self._database.design
        sequence = self._database.sequence(observer)
        done = self._database.answers_of(observer)
        position = len(done)
        state: dict[str, Any] = {"observer": observer, "total": len(sequence), "position": position}
        if position >= len(sequence):
            return {**state, "finished": True}
        constellation = design.constellations[sequence[position]]
        levels = {factor.name: level for factor, level in zip(design.factors, constellation, strict=True)}
        return {**state, "finished": False, "levels": levels, "view": view_of(levels, self._viewing)}

    def _goggles(self) -> list[str]:
        """The design's techniques for two eyes that the page can show."""
        levels = [
            level for factor in self._database.design.factors if factor.name == "technique" for level in factor.levels
        ]
        return [level for level in levels if level in TECHNIQUES and level != "plain"]

    def _sequence(self, observer: int) -> IntArray:
        while len(self._sequences) < observer:
            self._sequences.append(next(self._more))
        return self._sequences[observer - 1]


def _observer(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= MAX_OBSERVERS:
        raise InputError(
            f"observers are numbers from 1 to {MAX_OBSERVERS}, not {str(value)[:20]!r}", remedy="Give another number."
        )
    return value


def _tab(value: object) -> str:
    if not isinstance(value, str) or not 1 <= len(value) <= _MAX_TAB:
        raise InputError("the page does not say which tab it is", remedy="Reload the page.")
    return value


def _score(value: object, kind: str) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not LEAST <= value <= GREATEST:
        raise InputError(
            f"the {kind} answer is {str(value)[:20]!r}, no whole number from {LEAST} to {GREATEST}",
            remedy="Choose one of the numbers.",
        )
    return value
