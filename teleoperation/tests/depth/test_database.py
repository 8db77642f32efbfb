"""Every answer is kept at once; what is half-written, damaged, full or foreign is told, and nothing kept is lost."""

from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys

import numpy as np
import pytest
from contact_foundation.errors import InputError
from depth_study.design.sequences import make_sequences
from depth_study.record import database as database_module
from depth_study.record.database import Answer, AnsweredError, StorageError, create_database, open_database
from small_designs import DESIGN_FILE, thesis

TEXT = DESIGN_FILE.read_text()
SEQUENCES = make_sequences(thesis(), 2, seed=1)


@pytest.fixture
def study(tmp_path):
    database = create_database(tmp_path / "study.db", TEXT, seed=1)
    for observer in (1, 2):
        database.add_observer(observer, SEQUENCES[observer - 1])
    yield database
    database.close()


def test_answers_come_back(study):
    study.store(1, Answer(0, 3, None, 2.5))
    study.store(1, Answer(1, 4, 6))
    study.close()
    again = open_database(study.path)
    assert again.observers() == {1: 2, 2: 0}
    assert again.answers_of(1) == (Answer(0, 3, None, 2.5), Answer(1, 4, 6))
    answers = again.answers()
    assert answers.observers == (1,)
    np.testing.assert_array_equal(answers.sequences, SEQUENCES[:1])
    np.testing.assert_array_equal(answers.absolute[0, :3], [3, 4, np.nan])
    np.testing.assert_array_equal(answers.relative[0, :3], [np.nan, 6, np.nan])
    assert again.seed == 1
    again.close()


@pytest.mark.parametrize(
    "answer",
    [
        Answer(1, 3, 5),
        Answer(0, 0, None),
        Answer(0, 10, None),
        Answer(0, float("nan"), None),
        Answer(0, 3.5, None),
        Answer(0, 3, 5),
    ],
)
def test_impossible_answers_are_refused_and_nothing_is_stored(study, answer):
    with pytest.raises(AnsweredError):
        study.store(1, answer)
    assert study.observers()[1] == 0


def test_several_answers_are_stored_together_or_not_at_all(study):
    with pytest.raises(AnsweredError):
        study.store_all(1, [Answer(0, 3, None), Answer(1, 12, 5)])
    assert study.answers_of(1) == ()


def test_times_that_are_no_numbers_are_left_out(study):
    study.store(1, Answer(0, 3, None, float("nan")))
    assert study.answers_of(1) == (Answer(0, 3, None, None),)


def test_an_answer_given_twice_counts_once(study):
    study.store(1, Answer(0, 3, None))
    with pytest.raises(AnsweredError, match="Go on with number 2"):
        study.store(1, Answer(0, 8, None))
    assert study.answers_of(1) == (Answer(0, 3, None),)


def test_deleted_observers_leave_nothing_in_the_file(study):
    study.store(1, Answer(0, 3, None))
    study.store(2, Answer(0, 7, None))
    first = '["' + study.design.names[SEQUENCES[0][0]]
    assert first.encode() in study.path.read_bytes()
    study.delete_observer(1)
    assert study.observers() == {2: 1}
    study.close()
    assert first.encode() not in study.path.read_bytes()
    with pytest.raises(InputError, match="no observer 1"):
        open_database(study.path).delete_observer(1)


def test_a_full_disk_is_told_and_what_was_stored_stays(study):
    study.store(1, Answer(0, 3, None))
    (pages,) = study._connection.execute("PRAGMA page_count").fetchone()
    study._connection.execute(f"PRAGMA max_page_count = {pages}")
    stored = 1
    with pytest.raises(StorageError, match="the disk is full"):
        for observer in range(3, 500):
            study.add_observer(observer, SEQUENCES[0])
    study._connection.execute(f"PRAGMA max_page_count = {pages + 1000}")
    assert study.observers()[1] == stored
    study.store(1, Answer(1, 4, 5))
    assert study.observers()[1] == 2


def test_another_program_that_writes_is_told(study):
    study._connection.execute("PRAGMA busy_timeout = 50")
    other = sqlite3.connect(study.path)
    other.execute("BEGIN EXCLUSIVE")
    with pytest.raises(StorageError, match="another program"):
        study.store(1, Answer(0, 3, None))
    other.rollback()
    other.close()
    study.store(1, Answer(0, 3, None))


def test_what_a_killed_program_was_writing_is_taken_back(study):
    study.store(1, Answer(0, 3, None))
    study.close()
    script = f"""
import os, signal, sqlite3
c = sqlite3.connect({str(study.path)!r}, isolation_level=None)
c.execute("PRAGMA cache_size = 1")
c.execute("PRAGMA cache_spill = 1")
c.execute("BEGIN")
for k in range(5000):
    c.execute("INSERT INTO observer VALUES (?, ?)", (100 + k, "x" * 500))
os.kill(os.getpid(), signal.SIGKILL)
"""
    done = subprocess.run([sys.executable, "-c", script], check=False)
    assert done.returncode == -signal.SIGKILL
    assert os.path.exists(f"{study.path}-journal")
    again = open_database(study.path)
    assert again.observers() == {1: 1, 2: 0}
    assert again.answers_of(1) == (Answer(0, 3, None),)
    again.close()


def test_a_cut_off_file_is_told_and_left_as_it_is(study):
    study.close()
    whole = study.path.read_bytes()
    study.path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(InputError, match="is damaged") as error:
        open_database(study.path)
    assert ".recover" in str(error.value)
    assert study.path.read_bytes() == whole[: len(whole) // 2]


@pytest.mark.parametrize(
    ("content", "told"),
    [(b"", "holds nothing yet"), (b"observer,answer\n1,3\n" * 100, "is damaged")],
)
def test_other_files_are_told(tmp_path, content, told):
    path = tmp_path / "other.db"
    path.write_bytes(content)
    with pytest.raises(InputError, match=told):
        open_database(path)
    assert path.read_bytes() == content


def test_databases_of_others_are_told(tmp_path):
    path = tmp_path / "other.db"
    other = sqlite3.connect(path)
    other.execute("CREATE TABLE t (x)")
    other.commit()
    other.close()
    with pytest.raises(InputError, match="not one of a depth study"):
        open_database(path)
    with pytest.raises(InputError, match="is there already"):
        create_database(path, TEXT, seed=1)


def test_a_study_that_cannot_be_made_leaves_no_file(tmp_path, monkeypatch):
    path = tmp_path / "study.db"
    monkeypatch.setattr(database_module, "_SCHEMA", "PRAGMA max_page_count = 1; CREATE TABLE study (key, value);")
    with pytest.raises(StorageError, match="the disk is full"):
        create_database(path, TEXT, seed=1)
    assert list(tmp_path.iterdir()) == []
    monkeypatch.undo()
    create_database(path, TEXT, seed=1).close()
    assert open_database(path).observers() == {}


def test_missing_files_are_told(tmp_path):
    with pytest.raises(InputError, match="is no file"):
        open_database(tmp_path / "gone.db")
