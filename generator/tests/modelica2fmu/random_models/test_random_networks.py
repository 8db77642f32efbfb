"""Connected parts move as their equations say, or the model is refused: connections, index reduction, initialization.

``CMB_NETWORKS=200`` takes so many networks.
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
from random_networks import RandomNetwork, random_network

FEW = 10  # of seeds; one in eight has a network that moves
MANY = int(os.environ.get("CMB_NETWORKS", "40"))
END = 2.0
NEAR = 1e-5  # of the greatest variable, at a tolerance of 1e-8


def deviations(model: RandomNetwork, fmu: Path) -> Iterator[str]:
    """The variable of each mode that is farthest off, where one is."""
    for mode in ("ModelExchange", "CoSimulation"):
        result = simulate_fmu(
            str(fmu), fmi_type=mode, stop_time=END, output_interval=0.25, relative_tolerance=1e-8, output=model.names
        )
        for row in (0, 1, 4, len(result) - 1):
            found = np.array([result[name][row] for name in model.names])
            expected = model.values(result["time"][row], model.names)
            errors = np.abs(found - expected) / (1 + np.abs(expected).max())
            if not errors.max() < NEAR:
                worst = int(np.argmax(errors))
                text = f"{model.names[worst]} = {found[worst]}, not {expected[worst]}, at {result['time'][row]}"
                yield f"{mode}: {text}"
                break


def models(seeds: Iterable[int]) -> Iterator[tuple[int, str, Callable[[Path], Iterable[str]]]]:
    """Those that move."""
    for seed in seeds:
        model = random_network(seed)
        if model is not None:
            yield seed, model.text, partial(deviations, model)


def test_a_few_networks(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(FEW)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > 0


@pytest.mark.full
def test_many_networks(tmp_path, fmu_cache):
    taken, failures = sampled(tmp_path, fmu_cache, models(range(1000, 1000 + 8 * MANY)), "P.M")
    assert not failures, "\n".join(failures)
    assert taken > MANY // 2
