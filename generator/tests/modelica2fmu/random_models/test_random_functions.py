"""Functions with algorithms in random models have the values that the language gives them, or the model is refused.

``CMB_FUNCTIONS=200`` takes so many models.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from random_builds import sampled
from random_functions import RandomFunctions, random_functions

FEW = 1
MANY = int(os.environ.get("CMB_FUNCTIONS", "30"))
TIMES = (0.3, 0.9)
ROUNDING = 1e-9


def wrong_values(model: RandomFunctions, fmu: Path) -> list[str]:
    """The elements of all results that are not what an own reading of the functions makes of them."""
    names = list(model.values(TIMES[0]))
    result = simulate_fmu(str(fmu), stop_time=1.0, output_interval=0.1, output=names)
    wrong = []
    for time in TIMES:
        row = int(np.argmin(np.abs(result["time"] - time)))
        for name, expected in model.values(float(result["time"][row])).items():
            found = float(result[name][row])
            if not abs(found - expected) <= ROUNDING * (1 + abs(expected)):
                wrong.append(f"{name} = {found} at {time} s, not {expected}")
    return wrong


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    for seed in seeds:
        model = random_functions(seed)
        yield seed, model.text, partial(wrong_values, model)


def test_a_few_models(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_models(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + MANY)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > MANY // 2
