"""Worker processes: tasks of killed ones are repeated, nothing is lost."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest
from accuracy_study.cluster import carry_out_on_cluster
from contact_foundation.errors import InputError
from fmu_regression.simulate.workers import carry_out
from worker_tasks import Note, Wrong


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


@pytest.fixture
def cluster(monkeypatch):
    distributed = pytest.importorskip("distributed", reason="distributed is not installed")
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parent))  # the tasks' file is found by workers
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as found:
        yield found


def test_a_cluster_repeats_tasks_of_killed_processes_and_workers(tmp_path, cluster):
    tasks = [Note(tmp_path, k, deaths={1: 1, 4: 9}.get(k, 0)) for k in range(6)]
    counts: list[int] = []

    def done(count: int) -> None:
        counts.append(count)
        if count == 1:  # one of the two workers dies
            os.kill(next(iter(cluster.workers.values())).pid, signal.SIGKILL)

    (lost,) = carry_out_on_cluster(cluster.scheduler_address, tmp_path, tasks, done)
    assert (lost.number, lost.cause) == (4, "signal SIGKILL")
    assert counts == list(range(1, 7))
    assert all((tmp_path / f"done-{k}").exists() for k in range(6) if k != 4)


def test_a_cluster_says_what_is_wrong(tmp_path, cluster):
    with pytest.raises(InputError, match="does not see the folder"):
        carry_out_on_cluster(cluster.scheduler_address, tmp_path / "none", [Note(tmp_path, 0)], lambda _: None)
    with pytest.raises(ValueError, match="wrong"):
        carry_out_on_cluster(cluster.scheduler_address, tmp_path, [Wrong()], lambda _: None)
    with pytest.raises(InputError, match="no scheduler of Dask answers"):
        carry_out_on_cluster("nonsense://here", tmp_path, [Note(tmp_path, 0)], lambda _: None)
