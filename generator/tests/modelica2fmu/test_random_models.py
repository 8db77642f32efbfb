"""Expressions of arrays in random models have the values that numpy finds, or the model is refused with its line.

``CMB_MODELS=200`` takes so many models.
"""

from __future__ import annotations

import itertools
import os
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError, UnsupportedModelError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from random_model import RandomModel, random_model

FEW = 2
MANY = int(os.environ.get("CMB_MODELS", "60"))
TIMES = (0.3, 0.9)
LARGEST = 1e8  # beyond it sums of products lose the digits that are compared


def element_names(name: str, shape: tuple[int, ...]) -> list[str]:
    places = itertools.product(*(range(1, size + 1) for size in shape))
    return [f"{name}[{','.join(map(str, place))}]" if place else name for place in places]


def wrong_values(model: RandomModel, fmu: Path) -> list[str]:
    """The elements of all variables whose values differ from those of numpy."""
    names = [name for each in model.variables for name in element_names(each.name, each.shape)]
    result = simulate_fmu(str(fmu), stop_time=1.0, output_interval=0.1, output=names)
    wrong = []
    for time in TIMES:
        row = int(np.argmin(np.abs(result["time"] - time)))
        values = model.values(float(result["time"][row]))
        expected = np.concatenate([np.ravel(values[each.name]) for each in model.variables])
        found = np.array([float(result[name][row]) for name in names])
        with np.errstate(invalid="ignore"):
            off = ~(np.abs(found - expected) <= 1e-7 * (1 + np.abs(expected)))
        wrong += [f"{names[place]} = {found[place]}, not {expected[place]}" for place in np.flatnonzero(off)]
    return wrong


def sampled(folder: Path, seeds: range) -> tuple[int, list[str]]:
    """How many models were taken, and what is wrong of them."""
    taken, failures = 0, []
    for seed in seeds:
        model = random_model(seed)
        if any(
            np.max(np.abs(values[each.name])) > LARGEST
            for values in map(model.values, TIMES)
            for each in model.variables
        ):
            continue
        (folder / "M.mo").write_text(model.text, encoding="utf-8")
        try:
            build_fmu("M", [folder / "M.mo"], folder / "M.fmu", BuildOptions())
        except (InputError, UnsupportedModelError):
            continue
        taken += 1
        failures += [f"seed {seed}: {wrong}\n{model.text}" for wrong in wrong_values(model, folder / "M.fmu")[:1]]
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
