"""The simulation in its own process, and messages that never hold anybody up."""

from __future__ import annotations

import math
import threading
import time
from dataclasses import replace

import numpy as np
import pytest
from interactive_drive.process.messages import Frame, Mode, Record, RecordedRow, Run, SetValues, SingleStep, Status
from interactive_drive.process.outbox import Outbox
from interactive_drive.process.simulator import Simulator


class Listener:
    """Collects reports and waits for one."""

    def __init__(self) -> None:
        self.reports = []
        self._changed = threading.Condition()

    def __call__(self, report) -> None:
        with self._changed:
            self.reports.append(report)
            self._changed.notify_all()

    def rows(self):
        return [report for report in self.reports if isinstance(report, RecordedRow)]

    def wait_for(self, condition, limit=20.0):
        with self._changed:
            found = self._changed.wait_for(lambda: next(filter(condition, self.reports), None), limit)
        assert found is not None, self.reports[-3:]
        return found


def status_is(mode):
    return lambda report: isinstance(report, Status) and report.mode is mode


@pytest.fixture
def heard():
    return Listener()


@pytest.fixture
def simulator(plan, heard):
    simulator = Simulator(plan, heard)
    simulator.start()
    yield simulator
    simulator.stop()


def test_it_runs_in_real_time_and_a_crash_is_told(simulator, heard):
    heard.wait_for(status_is(Mode.PAUSED))
    simulator.send(SetValues({"force": 1.0}, 5.0))
    simulator.send(Run())
    simulator.send(Record(on=True))
    frame = heard.wait_for(lambda report: isinstance(report, Frame) and report.time > 0.3)
    simulator.send(Record(on=False))
    heard.wait_for(lambda report: isinstance(report, Status) and report.recording)
    heard.wait_for(lambda _: [r for r in heard.reports if isinstance(r, Status)][-1].recording is False)
    time_, v = np.array([(row.time, row.values[1]) for row in heard.rows()]).T
    assert np.diff(time_) == pytest.approx(0.01)  # every step, none twice
    assert np.diff(v) == pytest.approx((1 - v[:-1]) * -math.expm1(-0.01))  # and as a batch run computes it
    assert frame.stamp == 5.0
    assert frame.values[2] == 1.0
    simulator.send(SetValues({"damping": 95.0}))
    ended = heard.wait_for(status_is(Mode.ENDED))
    assert "signal SIGABRT in the FMU" in ended.message
    heard.reports.clear()
    simulator.restart()
    simulator.send(SingleStep())
    assert heard.wait_for(lambda report: isinstance(report, Frame) and report.time == pytest.approx(0.01))


def test_a_machine_too_heavy_slows_down(plan, heard):
    simulator = Simulator(replace(plan, start_values={"pause": 0.02}), heard)
    simulator.start()
    try:
        simulator.send(Run())
        frame = heard.wait_for(lambda report: isinstance(report, Frame) and report.steps >= 40)
    finally:
        simulator.stop()
    assert 0.1 < frame.factor < 0.5
    assert frame.missed == frame.steps


def test_an_fmu_that_cannot_be_opened_is_told(plan, heard, tmp_path):
    broken = tmp_path / "broken.fmu"
    broken.write_text("no zip")
    simulator = Simulator(replace(plan, fmu=broken), heard)
    simulator.start()
    ended = heard.wait_for(status_is(Mode.ENDED))
    simulator.stop()
    assert "broken.fmu: not a valid FMU" in ended.message
    assert sum(isinstance(report, Status) for report in heard.reports) == 1


def test_a_reader_that_waits_gets_the_newest_and_every_ordered_message():
    sent, gate = [], threading.Event()

    def send(message):
        gate.wait(10)
        sent.append(message)

    outbox = Outbox(send)
    outbox.post("begin")
    time.sleep(0.05)
    began = time.monotonic()
    for number in range(1000):
        outbox.show(number)
        if number % 100 == 0:
            outbox.post(RecordedRow(float(number), None))
    assert time.monotonic() - began < 1.0  # nobody waited for the reader
    gate.set()
    outbox.close()
    assert sent[0] == "begin"
    assert [row.time for row in sent[1:-1]] == [100.0 * k for k in range(10)]
    assert sent[-1] == 999


def test_values_that_wait_are_merged():
    sent, gate = [], threading.Event()
    outbox = Outbox(lambda message: (gate.wait(10), sent.append(message)), lambda old, new: {**old, **new})
    outbox.post({})
    time.sleep(0.05)
    outbox.show({"a": 1, "b": 1})
    outbox.show({"b": 2})
    gate.set()
    outbox.close()
    assert sent == [{}, {"a": 1, "b": 2}]


def test_values_count_in_the_step_that_is_asked_for_after_them():
    """Also where something else is being sent: a command does not overtake them."""
    gate, sent = threading.Event(), []
    outbox = Outbox(lambda message: (gate.wait(10), sent.append(message)), lambda old, new: old + new)
    outbox.post(["first"])
    for messages in (["a"], ["b"]):
        outbox.show(messages)
    outbox.post(["step"])
    outbox.show(["c"])
    gate.set()
    outbox.close()
    assert sent == [["first"], ["a", "b"], ["step"], ["c"]]


def test_a_broken_pipe_ends_an_outbox_quietly():
    def send(_message):
        raise BrokenPipeError

    outbox = Outbox(send)
    outbox.post(1)
    time.sleep(0.05)
    outbox.post(2)
    outbox.close()
