"""Fields of records have the values that modifiers give them, or the model is refused.

``CMB_RECORDS=200`` takes so many packages.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

import pytest
from fmpy import read_model_description, simulate_fmu
from random_builds import sampled
from random_records import RandomRecords, random_records

FEW = 1
MANY = int(os.environ.get("CMB_RECORDS", "30"))
ROUNDING = 1e-9


def wrong_values(model: RandomRecords, fmu: Path) -> list[str]:
    """The fields that are missing or have another value."""
    found = {each.name for each in read_model_description(str(fmu)).modelVariables}
    names = [name for name in model.values if name in found]
    result = simulate_fmu(str(fmu), stop_time=0.1, output_interval=0.1, output=names)
    wrong = [f"{name} is missing" for name in model.values if name not in found]
    for name in names:
        value, expected = float(result[name][-1]), model.values[name]
        if abs(value - expected) > ROUNDING * (1 + abs(expected)):
            wrong.append(f"{name} = {value}, not {expected}")
    return wrong


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    for seed in seeds:
        model = random_records(seed)
        yield seed, model.text, partial(wrong_values, model)


def test_a_few_packages(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_packages(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + MANY)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > MANY // 5
