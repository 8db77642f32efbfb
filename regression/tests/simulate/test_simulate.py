"""Simulating an FMU whose motion is known: values, event rows, parameters, failures."""

from __future__ import annotations

import faulthandler
import math
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError, SimulationError
from contact_foundation.progress import silent
from fmu_regression.fmi.binding import Mode
from fmu_regression.simulate.limited_process import run_limited
from fmu_regression.simulate.model_exchange import absolute_tolerances
from fmu_regression.simulate.simulation import simulate

FIRST = math.sqrt(0.2)  # fall from 1 m at 10 m/s2
BOUNCES = [FIRST, 2 * FIRST, 2.5 * FIRST]  # e = 0.5 halves every flight


@pytest.mark.parametrize("relative", [1e-2, 1e-4, 1e-6, 1e-8])
def test_absolute_tolerances_never_ask_for_a_share_of_a_share(relative: float) -> None:
    """Small nominal values tell the size that matters; those of other units are scaled."""
    meters, stretch, pressure = absolute_tolerances(relative, np.array([1.0, 1e-4, 1e5]))
    assert meters == pytest.approx(np.clip(1e-3 * relative, 1e-9, 1e-7))
    assert stretch == pytest.approx(min(meters, 1e-4 * relative))
    assert pressure == pytest.approx(1e5 * meters)
    assert absolute_tolerances(relative, np.array([1.0 - 1e-12])) == pytest.approx(meters)


def exact(time: np.ndarray) -> np.ndarray:
    height = 1 - 5 * time**2
    speed = 10 * FIRST
    for k, start in enumerate(BOUNCES):
        v = speed * 0.5 ** (k + 1)
        height = np.where(time >= start, v * (time - start) - 5 * (time - start) ** 2, height)
    return height


def test_a_failure_is_told_by_the_error_alone(bouncing_mass: Path, capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SimulationError, match="cannot be evaluated"):
        simulate(bouncing_mass, parameters={"fails_at": 0.3})
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("mode", ["me", "cs"])
def test_values_follow_the_closed_form(bouncing_mass: Path, mode: Mode) -> None:
    result = simulate(bouncing_mass, stop=1.1, interval=0.01, tolerance=1e-9, mode=mode)
    assert np.abs(result["h"] - exact(result.time)).max() < 1e-7
    assert result.mode == mode
    assert list(result.signals) == ["h", "v"]


def test_output_times_are_the_grid_and_both_sides_of_events(bouncing_mass: Path) -> None:
    signals = ["h", "v", "bounces", "beats", "rises[1,2]"]
    result = simulate(bouncing_mass, signals=signals, stop=1.1, interval=0.02, tolerance=1e-9)
    assert list(result.signals) == signals
    left = result.event_rows()
    bounce = left[np.diff(result["bounces"])[left] == 1]
    assert result.time[bounce] == pytest.approx(BOUNCES[:2], abs=1e-7)
    assert result["v"][bounce + 1] == pytest.approx(-0.5 * result["v"][bounce])
    assert (result["rises[1,2]"][bounce] == 0).all()
    assert (result["rises[1,2]"][bounce + 1] == 1).all()
    beats = left[np.diff(result["beats"])[left] == 1]
    assert result.time[beats] == pytest.approx([0.25, 0.5, 0.75, 1.0], abs=0)
    regular = np.unique(result.time)
    grid = np.linspace(0, 1.1, 56)
    assert np.isin(np.round(grid, 12), np.round(regular, 12)).all()
    extra = np.setdiff1d(np.round(regular, 12), np.round(grid, 12))
    assert extra.size == 2 + 2  # two bounces, beats at 0.25 and 0.75; the other beats lie on the grid


def test_last_step_may_be_shorter(bouncing_mass: Path) -> None:
    for mode in ("me", "cs"):
        result = simulate(bouncing_mass, stop=0.35, interval=0.1, mode=mode)
        assert result.time[-1] == 0.35
        assert np.isin([0.0, 0.1, 0.2, 0.30000000000000004], result.time).all()


def test_parameters_change_the_motion(bouncing_mass: Path) -> None:
    result = simulate(bouncing_mass, stop=0.2, parameters={"g": "2", "h": 3.0, "v": 1})
    assert result["h"][-1] == pytest.approx(3 + 0.2 - 0.04, abs=1e-7)


def test_counters_count(bouncing_mass: Path) -> None:
    result = simulate(bouncing_mass, stop=1.1, tolerance=1e-6)
    counters = result.counters
    assert counters is not None
    assert counters.state_events == 2
    assert counters.time_events == 4
    assert counters.steps >= 55
    assert counters.evaluations > counters.steps
    assert simulate(bouncing_mass, stop=0.1, mode="cs").counters is None


def test_repeats_to_the_bit(bouncing_mass: Path) -> None:
    first, second = (simulate(bouncing_mass, stop=1.0) for _ in range(2))
    assert first.time.tobytes() == second.time.tobytes()
    assert first["h"].tobytes() == second["h"].tobytes()


@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize("failure", [2, 3])
def test_failing_model_is_an_error_with_its_message(bouncing_mass: Path, mode: Mode, failure: int) -> None:
    with pytest.raises(SimulationError, match=r"cannot be computed at t = 0\.[3-6]") as caught:
        simulate(bouncing_mass, parameters={"fails_at": 0.3, "failure": failure}, mode=mode)
    assert caught.value.exit_status == 1


def test_chattering_is_an_error_not_an_endless_run(bouncing_mass: Path) -> None:
    # With a beat of length 0 the next time event always lies at the present time.
    with pytest.raises(SimulationError, match="events at one time"):
        simulate(bouncing_mass, parameters={"beat": 0})


def test_chatter_is_told_within_seconds(bouncing_mass: Path) -> None:
    # Bounces without loss, 25 million a second.
    with pytest.raises(SimulationError, match=r"(?s)the model chatters at t = .*event indicator 1\b.*hysteresis"):
        simulate(bouncing_mass, parameters={"h": 0.0, "v": 0.02, "g": 1e6, "e": 1.0}, time_limit=60)


@pytest.mark.parametrize(
    "numbers",
    [{"stop": np.inf}, {"stop": np.nan}, {"start": -np.inf}, {"interval": np.nan}, {"time_limit": 0.0},
     {"time_limit": np.nan}, {"tolerance": np.nan}, {"max_step": np.nan}],
)  # fmt: skip
def test_numbers_that_make_no_sense_are_wrong_input(numbers: dict[str, float], bouncing_mass: Path) -> None:
    with pytest.raises(InputError, match=r"must (be|lie)"):
        simulate(bouncing_mass, **numbers)  # type: ignore[arg-type]


def test_time_limit(bouncing_mass: Path) -> None:
    with pytest.raises(SimulationError, match="given up"):
        simulate(bouncing_mass, stop=1000, interval=1e-4, mode="cs", time_limit=0.2)


def test_processor_time_limit(bouncing_mass: Path) -> None:
    with pytest.raises(SimulationError, match=r"given up after 0\.1 s of processor time at t ="):
        simulate(bouncing_mass, stop=1000, interval=1e-4, mode="cs", time_limit=60, cpu_limit=0.1)
    with pytest.raises(SimulationError, match=r"0\.1 s of processor time: a call of the FMU did not return"):
        run_limited(lambda _: [None for _ in iter(int, 1)], 60, silent, "Endless", cpu_limit=0.1)
    with pytest.raises(InputError, match="processor time"):
        simulate(bouncing_mass, cpu_limit=1.0)


@pytest.mark.parametrize("mode", ["me", "cs"])
def test_a_call_that_does_not_return_is_stopped(bouncing_mass: Path, mode: Mode) -> None:
    # It hangs at once, so that the time limit between steps has no say, however slow the machine.
    with pytest.raises(SimulationError, match=r"given up after 0\.1 s.*a call of the FMU did not return"):
        simulate(bouncing_mass, parameters={"fails_at": -1, "failure": 101}, mode=mode, time_limit=0.1)


@pytest.fixture
def no_dump() -> Iterator[None]:
    """A process that crashes on purpose does not write its traceback between the tests' dots."""
    was_enabled = faulthandler.is_enabled()
    faulthandler.disable()
    yield
    if was_enabled:
        faulthandler.enable(file=sys.__stderr__)


@pytest.mark.usefixtures("no_dump")
def test_a_crash_of_the_fmu_is_an_error(bouncing_mass: Path) -> None:
    with pytest.raises(SimulationError, match="crashed: signal SIGABRT"):
        simulate(bouncing_mass, parameters={"fails_at": 0.3, "failure": 100}, mode="cs", time_limit=60)


def test_a_limit_changes_nothing_else(bouncing_mass: Path) -> None:
    seen: list[float] = []
    free, limited = (
        simulate(
            bouncing_mass,
            stop=1.0,
            interval=0.01,
            time_limit=limit,
            progress=lambda _, share, __="": seen.append(share),
        )
        for limit in (None, 60)
    )
    assert limited.time.tobytes() == free.time.tobytes()
    assert limited["h"].tobytes() == free["h"].tobytes()
    assert limited.counters == free.counters
    assert seen.count(1.0) == 2
    with pytest.raises(SimulationError, match="cannot be computed") as caught:
        simulate(bouncing_mass, parameters={"fails_at": 0.3}, time_limit=60)
    assert caught.value.place is not None
    assert caught.value.place.component == "BouncingMass"


def test_progress_is_reported(bouncing_mass: Path) -> None:
    seen: list[float] = []
    simulate(
        bouncing_mass, stop=20, interval=1e-4, mode="cs", progress=lambda _phase, share, _text="": seen.append(share)
    )
    assert seen[-1] == 1.0
    assert seen == sorted(seen)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"signals": ["hh"]}, "did you mean h"),
        ({"parameters": {"f": 1}}, "no such variable"),
        ({"parameters": {"bounces": 1}}, "cannot be set"),
        ({"parameters": {"e": "fast"}}, "not a value of type Real"),
        ({"parameters": {"failure": 1.5}}, "not a value of type Integer"),
        ({"stop": 0.0}, "stop time"),
        ({"tolerance": 0.0}, "tolerance"),
        ({"interval": -1.0}, "interval"),
        ({"interval": 1e-12}, "rows"),
    ],
)
def test_wrong_input_names_what_is_wrong(bouncing_mass: Path, arguments: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        simulate(bouncing_mass, **arguments)  # type: ignore[arg-type]


def test_no_fmu(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        simulate(tmp_path / "missing.fmu")
    text = tmp_path / "text.fmu"
    text.write_text("not a zip")
    with pytest.raises(InputError, match="not a valid FMU"):
        simulate(text)
