"""A study's database: one SQLite file with the design, the observers' sequences and every answer.

Each answer is on the disk when it was stored (full synchronisation); a program or machine that stops in between leaves
the answers before it. What is deleted is overwritten.
"""

from __future__ import annotations

import json
import math
import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
from contact_foundation.errors import CmbError, InputError, Place

from depth_study.arrays import IntArray
from depth_study.design.design_file import parse_design
from depth_study.design.factors import Design
from depth_study.record.answers import GREATEST, LEAST, Answers

_APPLICATION = 0x434D4253
_FORMAT = 1
_WAIT = 5.0
_SCHEMA = f"""
CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE observer (number INTEGER PRIMARY KEY CHECK (number >= 1), sequence TEXT NOT NULL) STRICT;
CREATE TABLE answer (
  observer INTEGER NOT NULL REFERENCES observer (number) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position >= 0),
  constellation TEXT NOT NULL,
  absolute INTEGER NOT NULL CHECK (absolute BETWEEN {LEAST} AND {GREATEST}),
  relative INTEGER CHECK (relative BETWEEN {LEAST} AND {GREATEST}),
  seconds REAL,
  answered TEXT NOT NULL,
  PRIMARY KEY (observer, position),
  CHECK ((position = 0) = (relative IS NULL))
) STRICT;
PRAGMA application_id = {_APPLICATION};
PRAGMA user_version = {_FORMAT};
"""


class StorageError(CmbError):
    """An answer could not be stored: the disk is full, or the database is written to by another program."""


class AnsweredError(CmbError):
    """The answer does not belong to what is to be answered next."""


@dataclass(frozen=True)
class Answer:
    """An answer to one constellation.

    Attributes:
        position: in the observer's sequence, from 0.
        absolute: 1 to 9.
        relative: 1 to 9, 5 for the same as the one before; None at position 0.
        seconds: from showing to answering; None if it is not known.
    """

    position: int
    absolute: int
    relative: int | None
    seconds: float | None = None


class StudyDatabase:
    """An open database; may be used from several threads.

    Attributes:
        path: the file.
        design: what is studied.
        seed: of the sequences.
    """

    def __init__(self, path: Path, connection: sqlite3.Connection) -> None:
        self.path = path
        self._connection = connection
        self._lock = threading.RLock()
        with self._errors():
            values = dict(connection.execute("SELECT key, value FROM study"))
        if set(values) < {"design", "seed"}:
            raise InputError("holds no study yet", place=Place(file=path), remedy="Name another file, or remove it.")
        self.design_text: str = values["design"]
        self.design: Design = parse_design(self.design_text, path)
        self.seed = int(values["seed"])
        self._numbers = {name: number for number, name in enumerate(self.design.names)}

    def close(self) -> None:
        """Closes the file."""
        with self._lock:
            self._connection.close()

    def observers(self) -> dict[int, int]:
        """Numbers of the observers that began, and how many constellations each has answered."""
        with self._lock, self._errors():
            rows = self._connection.execute(
                "SELECT number, count(position) FROM observer LEFT JOIN answer ON observer = number "
                "GROUP BY number ORDER BY number"
            )
            return dict(rows.fetchall())

    def add_observer(self, number: int, sequence: IntArray) -> None:
        """Notes an observer and the sequence of constellations' numbers; does nothing if the observer is known."""
        names = json.dumps([self.design.names[k] for k in sequence])
        with self._lock, self._errors(), self._connection as transaction:
            transaction.execute("INSERT OR IGNORE INTO observer VALUES (?, ?)", (number, names))

    def sequence(self, observer: int) -> IntArray:
        """The sequence of an observer.

        Raises:
            InputError: the observer is not known.
        """
        with self._lock, self._errors():
            row = self._connection.execute("SELECT sequence FROM observer WHERE number = ?", (observer,)).fetchone()
        if row is None:
            raise self._unknown(observer)
        return self._sequence(observer, row[0])

    def answers_of(self, observer: int) -> tuple[Answer, ...]:
        """The answers of one observer in the order of showing."""
        with self._lock, self._errors():
            rows = self._connection.execute(
                "SELECT position, absolute, relative, seconds FROM answer WHERE observer = ? ORDER BY position",
                (observer,),
            ).fetchall()
        return tuple(Answer(*row) for row in rows)

    def store(self, observer: int, answer: Answer) -> None:
        """Stores an answer; it is on the disk when this returns.

        Raises:
            AnsweredError: another constellation is the next to be answered.
            StorageError: it could not be stored; nothing that was stored before is lost.
        """
        self.store_all(observer, [answer])

    def store_all(self, observer: int, answers: list[Answer], at: datetime | None = None) -> None:
        """Stores answers that follow each other, all or none, given at a time (now); raises what `store` does."""
        sequence = self.sequence(observer)
        now = (at or datetime.now(UTC)).isoformat(timespec="seconds")
        with self._lock, self._errors(), self._connection as transaction:
            query = "SELECT count(*) FROM answer WHERE observer = ?"
            (done,) = transaction.execute(query, (observer,)).fetchone()
            for position, answer in enumerate(answers, done):
                if answer.position != position:
                    raise AnsweredError(
                        f"constellation {answer.position + 1} of observer {observer} is not the next to be answered",
                        remedy=f"Go on with number {position + 1}.",
                    )
                if position >= len(sequence):
                    raise AnsweredError(f"observer {observer} has answered all constellations")
                name = self.design.names[sequence[position]]
                transaction.execute(
                    "INSERT INTO answer VALUES (?, ?, ?, ?, ?, ?, ?)",
                    (observer, position, name, answer.absolute, answer.relative, _finite(answer.seconds), now),
                )

    def delete_observer(self, observer: int) -> None:
        """Deletes an observer with all answers; what the file held of them is overwritten.

        Raises:
            InputError: the observer is not known.
        """
        with self._lock, self._errors():
            with self._connection as transaction:
                found = transaction.execute("DELETE FROM observer WHERE number = ?", (observer,)).rowcount
            if not found:
                raise self._unknown(observer)

    def answers(self) -> Answers:
        """All answers, of all observers who gave one."""
        with self._lock, self._errors():
            rows = self._connection.execute(
                "SELECT observer, position, absolute, relative FROM answer ORDER BY observer, position"
            ).fetchall()
            texts = dict(self._connection.execute("SELECT number, sequence FROM observer"))
        observers = tuple(sorted({row[0] for row in rows}))
        place = {observer: k for k, observer in enumerate(observers)}
        count = len(self.design.constellations)
        sequences = np.array([self._sequence(o, texts[o]) for o in observers], dtype=np.intp).reshape(-1, count)
        absolute = np.full(sequences.shape, np.nan)
        relative = absolute.copy()
        for observer, position, first, second in rows:
            absolute[place[observer], position] = first
            relative[place[observer], position] = np.nan if second is None else second
        return Answers(self.design, observers, sequences, absolute, relative)

    def _sequence(self, observer: int, text: str) -> IntArray:
        try:
            numbers = [self._numbers[name] for name in json.loads(text)]
        except (KeyError, ValueError, TypeError) as error:
            raise InputError(
                f"the sequence of observer {observer} names a constellation that the design does not have",
                place=Place(file=self.path),
                remedy="Restore the file from a copy.",
            ) from error
        return np.array(numbers, dtype=np.intp)

    def _unknown(self, observer: int) -> InputError:
        return InputError(
            f"there is no observer {observer}",
            place=Place(file=self.path),
            remedy=f"Known are {', '.join(map(str, self.observers())) or 'none'}.",
        )

    @contextmanager
    def _errors(self) -> Iterator[None]:
        with _errors_about(self.path):
            yield


def create_database(path: Path, design_text: str, seed: int) -> StudyDatabase:
    """Makes a database for a study; nothing is there before it is whole.

    Args:
        path: a file that does not exist, or an empty one.
        design_text: TOML of the design.
        seed: of the observers' sequences.

    Raises:
        InputError: the file is there already or cannot be made, or the design cannot be studied.
    """
    parse_design(design_text, path)
    if path.exists() and path.stat().st_size:
        raise InputError("is there already", place=Place(file=path), remedy="Name another file, or remove it first.")
    path.parent.mkdir(parents=True, exist_ok=True)
    new = not path.exists()
    connection = _connect(path)
    try:
        with _errors_about(path):
            connection.executescript(f"BEGIN IMMEDIATE; {_SCHEMA}")
            connection.execute("INSERT INTO study VALUES ('design', ?)", (design_text,))
            connection.execute("INSERT INTO study VALUES ('seed', ?)", (str(seed),))
            connection.commit()
        return StudyDatabase(path, connection)
    except BaseException:
        connection.close()
        if new:
            path.unlink(missing_ok=True)
        raise


def open_database(path: Path) -> StudyDatabase:
    """Opens a study's database; what a program that was ended was writing is taken back.

    Raises:
        InputError: there is none, it is not one of a study, or it is damaged. The file is left as it is.
    """
    if not path.is_file():
        raise InputError("is no file", place=Place(file=path), remedy="Name the database of a study.")
    connection = _connect(path)
    try:
        with _errors_about(path):
            (application,) = connection.execute("PRAGMA application_id").fetchone()
            (version,) = connection.execute("PRAGMA user_version").fetchone()
            if application != _APPLICATION:
                empty = path.stat().st_size == 0
                raise InputError(
                    "holds nothing yet" if empty else "is a database, but not one of a depth study",
                    place=Place(file=path),
                    remedy="Name a file that `cmb depth-study run` or `simulate` has written.",
                )
            if version != _FORMAT:
                raise InputError(f"has format {version}", place=Place(file=path), remedy=f"Known is {_FORMAT}.")
            (state,) = connection.execute("PRAGMA quick_check(1)").fetchone()
            if state != "ok":
                raise _damaged(path, state)
        return StudyDatabase(path, connection)
    except BaseException:
        connection.close()
        raise


def _connect(path: Path) -> sqlite3.Connection:
    with _errors_about(path):
        connection = sqlite3.connect(path, timeout=_WAIT, check_same_thread=False)
        connection.execute("PRAGMA foreign_keys = ON")
        connection.execute("PRAGMA synchronous = FULL")
        connection.execute("PRAGMA secure_delete = ON")
        return connection


@contextmanager
def _errors_about(path: Path) -> Iterator[None]:
    place = Place(file=path)
    try:
        yield
    except sqlite3.OperationalError as error:
        text = str(error)
        if "full" in text:
            raise StorageError("the disk is full", place=place, remedy="Free space, then answer once more.") from error
        if "locked" in text or "busy" in text:
            message = "another program is writing to the database"
            raise StorageError(message, place=place, remedy="End that, then answer once more.") from error
        if "readonly" in text or "unable to open" in text:
            raise InputError("cannot be written to", place=place, remedy="Name another file.") from error
        if "malformed" in text or "no such" in text:
            raise _damaged(path, text) from error
        raise StorageError(f"could not be written: {text}", place=place, remedy="Answer once more.") from error
    except sqlite3.IntegrityError as error:
        raise AnsweredError(f"is no possible answer: {error}", place=place) from error
    except sqlite3.DatabaseError as error:
        raise _damaged(path, str(error)) from error


def _damaged(path: Path, reason: str) -> InputError:
    return InputError(
        f"is damaged ({reason.splitlines()[0]})",
        place=Place(file=path),
        remedy="It is left as it is. Restore it from a copy, or save what can be read:\n"
        f'  sqlite3 "{path}" .recover | sqlite3 recovered.db',
    )


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
