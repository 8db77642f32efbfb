"""Modifiers, redeclarations and inheritance in random classes mean what the language says, or the model is refused.

``CMB_CLASSES=200`` takes so many packages.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

import pytest
from fmpy import read_model_description
from random_builds import sampled, wrong_values
from random_classes import RandomClasses, random_classes

FEW = 1
MANY = int(os.environ.get("CMB_CLASSES", "30"))


def wrong_variables(model: RandomClasses, fmu: Path) -> list[str]:
    """The parameters and variables that have another value, are missing, or should not be there."""
    found = read_model_description(str(fmu)).modelVariables
    extra = [f"{each.name} is there" for each in found if each.name.startswith(model.absent)]
    return extra + wrong_values(model.values, fmu)


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    """Those of seeds whose values do not depend on themselves."""
    for seed in seeds:
        model = random_classes(seed)
        if model is not None:
            yield seed, model.text, partial(wrong_variables, model)


def test_a_few_packages(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_packages(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + MANY)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > MANY // 3
