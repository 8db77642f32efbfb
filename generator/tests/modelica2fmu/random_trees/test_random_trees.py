"""Bodies with joints, forces and sensors of the MultiBody library move as Newton and Euler say, or are refused.

``CMB_TREES=200`` takes so many mechanisms. Of the Modelica Standard Library, where ``MODELICAPATH`` leads to it.
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
from random_tree import RandomTree, random_tree

FEW = 4  # of seeds
MANY = int(os.environ.get("CMB_TREES", "30"))
TIMES = (0.0, 0.25, 0.5, 0.75, 1.0)
INTERVAL = 0.01  # s; importers give up after some hundred steps in one
NEAR = 1e-5  # of values at a tolerance of 1e-8, plus 1
GAIN = 0.2  # by which errors of motions that are sensitive shrink where the tolerance does by 0.01


def error(expected: np.ndarray, model: RandomTree, fmu: Path, mode: str, tolerance: float) -> tuple[float, str]:
    """The largest error, by the value plus 1, and where it is."""
    result = simulate_fmu(
        str(fmu), fmi_type=mode, stop_time=TIMES[-1], output_interval=INTERVAL, relative_tolerance=tolerance,
        output=model.names,
    )  # fmt: skip
    rows = [round(time / INTERVAL) for time in TIMES]
    found = np.array([[result[name][row] for name in model.names] for row in rows])
    errors = np.abs(found - expected) / (1 + np.abs(expected))
    row, column = np.unravel_index(int(np.argmax(errors)), errors.shape)
    where = f"{model.names[column]} = {found[row, column]}, not {expected[row, column]}, at {TIMES[row]}"
    return float(errors[row, column]), where


def deviations(model: RandomTree, fmu: Path) -> Iterator[str]:
    """The variable of each mode that is farthest off, where one is."""
    expected = np.array([model.values(look) for look in model.motion(TIMES)])
    for mode in ("ModelExchange", "CoSimulation"):
        size, where = error(expected, model, fmu, mode, 1e-8)
        if size < NEAR:
            continue
        finer, where = error(expected, model, fmu, mode, 1e-10)
        if not finer < max(NEAR, GAIN * size):
            yield f"{mode}: {where}"


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    for seed in seeds:
        model = random_tree(seed)
        yield seed, model.text, partial(deviations, model)


def test_a_few_trees(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken == FEW


@pytest.mark.full
def test_many_trees(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + MANY)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken == MANY
