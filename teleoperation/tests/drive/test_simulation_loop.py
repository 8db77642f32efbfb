"""The loop of the simulation's process with a machine and a clock that the tests hold."""

from __future__ import annotations

from collections import deque

import numpy as np
import pytest
from contact_foundation.errors import SimulationError
from interactive_drive.machine.machine import Moment
from interactive_drive.pacing.pacer import Pacer
from interactive_drive.process.messages import (
    Frame,
    Measure,
    Measured,
    Mode,
    Pause,
    Record,
    RecordedRow,
    Reset,
    Restore,
    Run,
    Save,
    SetSpeed,
    SetValues,
    SingleStep,
    Status,
    Stop,
)
from interactive_drive.process.simulation_loop import MOST_CHECKPOINTS, SimulationLoop

STEP = 0.25


class CountingMachine:
    """x grows by the input push with every step; fails where x would exceed 100."""

    signals, at_end = ("x",), False

    def __init__(self, keeps_states: bool = True) -> None:
        self.keeps_states = keeps_states
        self.time, self.x, self.push = 0.0, 0.0, 1.0
        self.alive: set[int] = set()
        self.saved = self.starts = 0

    def set(self, values):
        self.push = values.get("push", self.push)

    def step(self):
        if self.x + self.push > 100:
            raise SimulationError("x is too large")
        self.x += self.push
        self.time += STEP

    def row(self):
        return np.array([self.x])

    def save(self):
        self.saved += 1
        self.alive.add(self.saved)
        return Moment((self.saved, self.x, self.push), self.time)

    def restore(self, moment):
        if not self.keeps_states or moment.state[0] not in self.alive:
            raise SimulationError("no such state")
        _, self.x, self.push = moment.state
        self.time = moment.time

    def free(self, moment):
        self.alive.remove(moment.state[0])

    def start_anew(self):
        self.starts += 1
        self.time, self.x, self.push = 0.0, 0.0, 1.0


class Reports(list):
    def post(self, message):
        self.append(message)

    show = post

    def of(self, kind):
        return [message for message in self if isinstance(message, kind)]


def drive(script, machine=None):
    """Runs the loop over a script: commands, or numbers of steps to let pass."""
    machine = machine or CountingMachine()
    clock = [0.0]

    def sleep(seconds):
        clock[0] += seconds

    reports, todo = Reports(), deque(script)

    def inbox(_timeout):
        if not todo:
            return [Stop()]
        if isinstance(todo[0], int):
            if todo[0] > 1:
                todo[0] -= 1
            else:
                todo.popleft()
            return []
        return [todo.popleft()]

    SimulationLoop(machine, Pacer(STEP, lambda: clock[0], sleep), inbox, reports).run()
    return machine, reports


def last_status(reports) -> Status:
    return reports.of(Status)[-1]


def test_it_starts_paused_with_a_frame():
    machine, reports = drive([5])
    assert machine.time == 0
    assert last_status(reports).mode is Mode.PAUSED
    assert [frame.time for frame in reports.of(Frame)] == [0.0]


def test_running_pausing_and_single_steps():
    machine, reports = drive([Run(), 7, Pause(), 3])
    assert machine.x == 8  # the step after the command, and seven more
    assert last_status(reports).mode is Mode.PAUSED
    machine, reports = drive([SingleStep(), 2, SingleStep()])
    assert machine.x == 2
    assert [frame.values[0] for frame in reports.of(Frame)] == [0, 1, 2]


def test_a_single_step_while_running_pauses():
    machine, reports = drive([Run(), 3, SingleStep(), 4])
    assert machine.x == 5
    assert last_status(reports).mode is Mode.PAUSED


def test_values_count_from_the_next_step_and_their_stamp_comes_back():
    machine, reports = drive([Run(), 1, SetValues({"push": 10.0}, 77.0), 1])
    frames = reports.of(Frame)
    assert [(frame.values[0], frame.stamp) for frame in frames] == [(0, 0), (1, 0), (2, 0), (12, 77), (22, 77)]
    assert machine.push == 10


def test_slow_motion_is_told():
    _, reports = drive([SetSpeed(0.25)])
    assert last_status(reports).speed == 0.25


def test_a_saved_state_is_restored_and_paused():
    machine, reports = drive([SingleStep(), Save(), SingleStep(), SingleStep()])
    number = last_status(reports).saved[0].number
    machine, reports = drive([SingleStep(), Save(), Run(), 2, Restore(number), 2])
    assert (machine.time, machine.x) == (STEP, 1)
    assert last_status(reports).mode is Mode.PAUSED
    assert reports.of(Frame)[-1].time == STEP


def test_reset_goes_to_the_start_and_keeps_running():
    machine, reports = drive([Run(), 5, Reset()])
    assert machine.x == 1
    assert machine.starts == 0
    assert last_status(reports).mode is Mode.RUNNING


def test_reset_of_a_machine_without_states_starts_it_anew():
    machine, reports = drive([Run(), 5, Pause(), Reset()], CountingMachine(keeps_states=False))
    assert (machine.x, machine.starts) == (0, 1)
    assert not last_status(reports).keeps_states


def test_a_failure_is_told_and_the_last_good_state_is_offered():
    script = [Run(), 9, SetValues({"push": 95.0}), 5]
    _, reports = drive(script)
    status = last_status(reports)
    assert status.mode is Mode.FAILED
    assert status.message == "x is too large"
    last = status.saved[-1]
    assert last.automatic
    assert last.time == 2.0  # every second; the failure comes at 2.5 s
    machine, reports = drive([*script, Run(), 2, Restore(last.number), SetValues({"push": 1.0}), Run(), 1])
    assert last_status(reports).mode is Mode.RUNNING
    assert machine.x == 8 + 2


def test_reset_ends_a_failure():
    machine, reports = drive([SetValues({"push": 101.0}), Run(), 1, Reset()])
    assert last_status(reports).mode is Mode.PAUSED
    assert last_status(reports).message == ""
    assert machine.x == 0


def test_checkpoints_do_not_pile_up():
    machine, reports = drive([Run(), 99])
    saved = last_status(reports).saved
    assert len(saved) == MOST_CHECKPOINTS
    assert saved[-1].time == 25.0
    assert len(machine.alive) == MOST_CHECKPOINTS + 1  # and the start


def test_a_record_has_every_step_and_ends_where_time_goes_back():
    _, reports = drive([SingleStep(), Record(on=True), Run(), 4, Reset(), 2])
    assert [row.values[0] for row in reports.of(RecordedRow)] == [1, 2, 3, 4, 5, 6]
    assert not last_status(reports).recording
    assert any(status.message == "the record ended: the machine was reset" for status in reports.of(Status))


def test_measuring():
    _, reports = drive([Run(), 9, Measure(afresh=True), 4, Measure()])
    first, second = reports.of(Measured)
    assert first.record.steps == 10
    assert second.record.steps == 5
    assert first.record.missed == 0


@pytest.mark.parametrize("command", [Restore(99), Save(), Record(on=False), Pause()])
def test_commands_that_have_nothing_to_do_do_no_harm(command):
    machine, reports = drive([SetValues({"push": 101.0}), SingleStep(), command, 2])
    assert last_status(reports).mode is Mode.FAILED
    assert machine.x == 0
