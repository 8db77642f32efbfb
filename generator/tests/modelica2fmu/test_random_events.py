"""Random models with events run as the language says, in model exchange and in co-simulation.

``CMB_EVENTS=200`` takes so many models.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError, UnsupportedModelError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from random_events import END, AmbiguousError, RandomEvents, random_events

FEW = 2
MANY = int(os.environ.get("CMB_EVENTS", "60"))
STEP = 0.0041  # of the output: no event of the models is at a multiple of it


def deviation(model: RandomEvents, fmu: Path, mode: str) -> str | None:
    """The first variable that is not what the language makes of it; None if all are."""
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
            return (
                f"{mode}: {name} = {result[name][rows][row]}, not {expected[name][row]}, at {result['time'][rows][row]}"
            )
    return None


def sampled(folder: Path, seeds: Iterable[int]) -> tuple[int, list[str]]:
    """How many models were taken, and what is wrong of them."""
    taken, failures = 0, []
    for seed in seeds:
        model = random_events(seed)
        try:
            model.run(np.array([END]))
            (folder / "M.mo").write_text(model.text(), encoding="utf-8")
            build_fmu("M", [folder / "M.mo"], folder / "M.fmu", BuildOptions())
        except (AmbiguousError, InputError, UnsupportedModelError):
            continue
        taken += 1
        wrong = [deviation(model, folder / "M.fmu", mode) for mode in ("ModelExchange", "CoSimulation")]
        failures += [f"seed {seed}, {each}\n{model.text()}" for each in wrong if each is not None]
    return taken, failures


def test_a_few_models(tmp_path):
    taken, failures = sampled(tmp_path, range(FEW))
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_models(tmp_path):
    taken, failures = sampled(tmp_path, range(1000, 1000 + MANY))
    assert not failures, "\n".join(failures)
    assert taken > MANY // 2
