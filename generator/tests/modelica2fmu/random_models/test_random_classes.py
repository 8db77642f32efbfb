"""Modifiers, redeclarations and inheritance in random classes mean what the language says, or the model is refused.

``CMB_CLASSES=200`` takes so many packages.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

import pytest
from fmpy import read_model_description, simulate_fmu
from random_builds import sampled
from random_classes import RandomClasses, random_classes

FEW = 1
MANY = int(os.environ.get("CMB_CLASSES", "30"))
ROUNDING = 1e-9


def wrong_values(model: RandomClasses, fmu: Path) -> list[str]:
    """The parameters and variables that have another value, are missing, or should not be there."""
    found = {each.name for each in read_model_description(str(fmu)).modelVariables}
    wrong = [f"{name} is missing" for name in model.values if name not in found]
    wrong += [f"{name} is there" for name in found if name.startswith(model.absent)]
    names = [name for name in model.values if name in found]
    result = simulate_fmu(str(fmu), stop_time=0.1, output_interval=0.1, output=names)
    for name in names:
        value, expected = float(result[name][-1]), model.values[name]
        if abs(value - expected) > ROUNDING * (1 + abs(expected)):
            wrong.append(f"{name} = {value}, not {expected}")
    return wrong


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    """Those of seeds whose values do not depend on themselves."""
    for seed in seeds:
        model = random_classes(seed)
        if model is not None:
            yield seed, model.text, partial(wrong_values, model)


def test_a_few_packages(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_packages(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + MANY)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > MANY // 3
