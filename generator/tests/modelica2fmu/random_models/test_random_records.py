"""Fields of records have the values that modifiers give them, or the model is refused.

``CMB_RECORDS=200`` takes so many packages.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

import pytest
from random_builds import sampled, wrong_values
from random_records import random_records

FEW = 1
MANY = int(os.environ.get("CMB_RECORDS", "30"))


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    for seed in seeds:
        model = random_records(seed)
        yield seed, model.text, partial(wrong_values, model.values)


def test_a_few_packages(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_packages(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + MANY)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > MANY // 5
