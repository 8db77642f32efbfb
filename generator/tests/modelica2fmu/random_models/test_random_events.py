"""Random models with events run as the language says, in model exchange and in co-simulation.

``CMB_EVENTS=200`` takes so many models.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from random_builds import sampled
from random_events import END, AmbiguousError, RandomEvents, random_events

FEW = 1
MANY = int(os.environ.get("CMB_EVENTS", "20"))
STEP = 0.0041  # of the output: no event of the models is at a multiple of it


def deviations(model: RandomEvents, fmu: Path, mode: str) -> Iterator[str]:
    """The variables that are not what the language makes of them, each where it is first so."""
    names = list(model.start)
    result = simulate_fmu(
        str(fmu), fmi_type=mode, stop_time=END, output_interval=STEP, relative_tolerance=1e-7, output=names
    )
    ticks = result["time"] / STEP
    rows = np.flatnonzero((np.abs(ticks - np.round(ticks)) < 1e-7) & (result["time"] > STEP / 2))[::10]
    expected = model.run(result["time"][rows])
    for name in names:
        wrong = np.flatnonzero(np.abs(result[name][rows] - expected[name]) > 2e-4)
        if len(wrong) > 0:
            row = wrong[0]
            found = result[name][rows][row]
            yield f"{mode}: {name} = {found}, not {expected[name][row]}, at {result['time'][rows][row]}"


def wrong_values(model: RandomEvents, fmu: Path) -> Iterator[str]:
    """Those of both modes."""
    for mode in ("ModelExchange", "CoSimulation"):
        yield from deviations(model, fmu, mode)


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    """Those of seeds whose run is not ambiguous."""
    for seed in seeds:
        model = random_events(seed)
        with suppress(AmbiguousError):
            model.run(np.array([END]))
            yield seed, model.text(), partial(wrong_values, model)


def test_a_few_models(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)))
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_models(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + MANY)))
    assert not failures, "\n".join(failures)
    assert taken > MANY // 2
