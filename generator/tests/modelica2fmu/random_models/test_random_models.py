"""Expressions of arrays in random models have the values that numpy finds, or the model is refused with its line.

``CMB_MODELS=200`` takes so many models.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from random_builds import sampled
from random_model import RandomModel, random_model

FEW = 1
MANY = int(os.environ.get("CMB_MODELS", "30"))
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


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    """Those of seeds whose values are not too large."""
    for seed in seeds:
        model = random_model(seed)
        values = [np.abs(at[each.name]) for at in map(model.values, TIMES) for each in model.variables]
        if all(np.max(each) <= LARGEST for each in values):
            yield seed, model.text, partial(wrong_values, model)


def test_a_few_models(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)))
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_models(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + MANY)))
    assert not failures, "\n".join(failures)
    assert taken > MANY // 2
