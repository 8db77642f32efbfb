"""Pacing with a clock that the tests hold."""

from __future__ import annotations

import math

import pytest
from interactive_drive.pacing.pacer import Pacer


class FakeClock:
    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        assert seconds > 0
        self.now += seconds


@pytest.fixture
def clock() -> FakeClock:
    return FakeClock()


def drive(pacer: Pacer, clock: FakeClock, durations: list[float]) -> None:
    for duration in durations:
        pacer.wait()
        pacer.step_begins()
        clock.now += duration
        pacer.step_ended()


def test_light_steps_follow_the_clock_without_drift(clock):
    pacer = Pacer(0.01, clock, clock.sleep)
    drive(pacer, clock, [0.003] * 1000)
    pacer.wait()
    assert clock.now - 100.0 == pytest.approx(10.0, abs=1e-9)
    assert pacer.missed == 0
    assert pacer.factor == pytest.approx(1.0)


def test_a_slow_step_is_a_missed_deadline_that_is_caught_up_with(clock):
    pacer = Pacer(0.01, clock, clock.sleep)
    drive(pacer, clock, [0.002] * 10 + [0.035] + [0.002] * 10)
    pacer.wait()
    record = pacer.record()
    assert clock.now - 100.0 == pytest.approx(0.21)
    assert record.overruns == pytest.approx((0.025, 0.017, 0.009, 0.001))
    assert record.missed == 4
    assert record.lost == 0


def test_a_scene_too_heavy_slows_down_and_says_by_how_much(clock):
    pacer = Pacer(0.01, clock, clock.sleep)
    drive(pacer, clock, [0.025] * 400)
    assert pacer.missed == 400
    assert pacer.factor == pytest.approx(0.4, rel=1e-3)
    assert pacer.record().lost == pytest.approx(400 * 0.015, abs=0.11)
    light = clock.now
    drive(pacer, clock, [0.001] * 100)  # what was given up is not run after
    pacer.wait()
    assert clock.now - light == pytest.approx(1.0, abs=0.11)


@pytest.mark.parametrize(("speed", "wall"), [(0.5, 2.0), (4.0, 0.25)])
def test_slow_and_fast_motion(clock, speed, wall):
    pacer = Pacer(0.01, clock, clock.sleep)
    pacer.set_speed(speed)
    drive(pacer, clock, [0.001] * 100)
    pacer.wait()
    assert clock.now - 100.0 == pytest.approx(wall)
    assert pacer.factor == pytest.approx(speed)


def test_a_pause_is_no_missed_deadline(clock):
    pacer = Pacer(0.01, clock, clock.sleep)
    drive(pacer, clock, [0.001] * 5)
    clock.now += 60.0
    pacer.begin()
    drive(pacer, clock, [0.001] * 5)
    assert pacer.missed == 0
    assert pacer.factor == pytest.approx(1.0)


def test_late_beginnings_are_jitter(clock):
    def late_sleep(seconds: float) -> None:
        clock.now += seconds + 0.0004

    pacer = Pacer(0.01, clock, late_sleep)
    drive(pacer, clock, [0.001] * 3)
    assert pacer.record().delays == pytest.approx((0.0, 0.0004, 0.0004))
    pacer.clear_record()
    assert pacer.record().delays == ()
    assert math.isfinite(pacer.factor)


def test_processor_time_is_told_apart_from_waiting(clock):
    worked = [0.0]
    pacer = Pacer(0.01, clock, clock.sleep, lambda: worked[0])
    pacer.step_begins()
    clock.now += 0.03
    worked[0] += 0.002
    pacer.step_ended()
    assert pacer.record().durations == pytest.approx((0.03,))
    assert pacer.record().work == pytest.approx((0.002,))
