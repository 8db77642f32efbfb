"""Builds and simulates test models, each once a session."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import core_models
import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from numpy.typing import NDArray

Trajectories = dict[str, NDArray[np.float64]]
Simulator = Callable[..., Trajectories]


@pytest.fixture(scope="session")
def msl() -> Path:
    """Folder of the real Modelica Standard Library; skips where there is none."""
    folder = core_models.standard_library()
    if folder is None:
        pytest.skip("there is no Modelica Standard Library 4.1 on this machine (set MODELICAPATH)")
    return folder


@pytest.fixture(scope="session")
def simulate(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Simulator:
    """Simulates a test model: ``simulate(name, stop, interval, library)``, all continuous variables by name.

    Rows are those of the regular output grid.
    """
    folder = tmp_path_factory.mktemp("fmu")
    known: dict[tuple[str, Path, float, float], Trajectories] = {}

    def run(name: str, stop: float = 1.0, interval: float = 0.05, library: Path = core_models.CORE) -> Trajectories:
        key = (name, library, stop, interval)
        if key not in known:
            fmu = folder / f"{name}_{'core' if library == core_models.CORE else 'msl'}.fmu"
            if not fmu.exists():
                build_fmu(
                    f"CoreFixtures.{name}", [core_models.FIXTURES], fmu, BuildOptions(msl=library, cache=fmu_cache)
                )
            variables = read_model_description(str(fmu)).modelVariables
            names = [item.name for item in variables if item.type == "Real" and item.name != "time"]
            result = simulate_fmu(
                str(fmu),
                stop_time=stop,
                output_interval=interval,
                relative_tolerance=1e-10,
                fmi_type="ModelExchange",
                output=names,
                record_events=False,
            )
            known[key] = {item: np.asarray(result[item], dtype=np.float64) for item in ("time", *names)}
        return known[key]

    return run


@pytest.fixture(scope="session")
def vector() -> Callable[[Trajectories, str], NDArray[np.float64]]:
    """Puts the elements of an array variable together: shape (rows, n) or (rows, n, m)."""

    def together(result: Trajectories, name: str) -> NDArray[np.float64]:
        if f"{name}[1,1]" in result or f"{name}[1, 1]" in result:
            gap = "" if f"{name}[1,1]" in result else " "
            size = [0, 0]
            while f"{name}[{size[0] + 1},{gap}1]" in result:
                size[0] += 1
            while f"{name}[1,{gap}{size[1] + 1}]" in result:
                size[1] += 1
            rows = [
                np.stack([result[f"{name}[{i + 1},{gap}{j + 1}]"] for j in range(size[1])], axis=1)
                for i in range(size[0])
            ]
            return np.stack(rows, axis=1)
        count = 0
        while f"{name}[{count + 1}]" in result:
            count += 1
        assert count, f"{name} is no array of the result"
        return np.stack([result[f"{name}[{i + 1}]"] for i in range(count)], axis=1)

    return together
