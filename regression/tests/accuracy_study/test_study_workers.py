"""Worker processes: tasks of killed ones are repeated, nothing is lost."""

from __future__ import annotations

import os
import signal
from dataclasses import dataclass
from pathlib import Path

import pytest
from accuracy_study.workers import carry_out


@dataclass(frozen=True)
class Note:
    """Writes its file; its process is killed before that the first ``deaths`` times."""

    folder: Path
    number: int
    deaths: int = 0

    def __call__(self) -> None:
        tried = self.folder / f"tried-{self.number}"
        count = len(tried.read_text()) if tried.exists() else 0
        tried.write_text("x" * (count + 1))
        if count < self.deaths:
            os.kill(os.getpid(), signal.SIGKILL)
        (self.folder / f"done-{self.number}").write_text(str(os.getpid()))


@dataclass(frozen=True)
class Wrong:
    """Raises."""

    def __call__(self) -> None:
        raise ValueError("wrong")


@pytest.mark.parametrize("jobs", [1, 3])
def test_tasks_of_killed_processes_are_repeated(tmp_path, jobs):
    tasks = [Note(tmp_path, k, deaths={1: 1, 4: 2}.get(k, 0)) for k in range(7)]
    counts: list[int] = []
    assert carry_out(tasks, jobs, counts.append) == []
    assert counts == list(range(1, 8))
    tried = [len((tmp_path / f"tried-{k}").read_text()) for k in range(7)]
    assert tried == [1, 2, 1, 1, 3, 1, 1]
    assert all((tmp_path / f"done-{k}").exists() for k in range(7))


def test_what_kills_its_process_each_time_is_given_up(tmp_path):
    tasks = [Note(tmp_path, 0, deaths=9), Note(tmp_path, 1)]
    counts: list[int] = []
    (lost,) = carry_out(tasks, 1, counts.append)
    assert (lost.number, lost.cause) == (0, "signal SIGKILL")
    assert counts == [1, 2]
    assert len((tmp_path / "tried-0").read_text()) == 3
    assert (tmp_path / "done-1").exists()


def test_what_a_task_raises_is_raised(tmp_path):
    with pytest.raises(ValueError, match="wrong"):
        carry_out([Note(tmp_path, 0), Wrong()], 2, lambda _: None)
