"""What steps may err, and their order: the FMU in co-simulation and the importer in model exchange agree."""

from __future__ import annotations

import ctypes
import subprocess
from pathlib import Path

import numpy as np
import pytest
from fmu_regression.simulate.error_weights import highest_order, share_of_tolerance
from modelica2fmu.packaging.runtime_sources import runtime_file


@pytest.fixture(scope="module")
def runtime(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    source = runtime_file("fmurt_tolerance.c")
    target = tmp_path_factory.mktemp("tolerance") / "tolerance.so"
    command = ["gcc", "-std=c11", "-shared", "-fPIC", f"-I{Path(source).parent}", str(source), "-lm", "-o", str(target)]
    subprocess.run(command, check=True)
    library = ctypes.CDLL(str(target))
    library.fmurt_share_of_tolerance.argtypes = [ctypes.c_double, ctypes.c_double]
    library.fmurt_share_of_tolerance.restype = ctypes.c_double
    library.fmurt_highest_order.argtypes = [ctypes.c_double]
    return library


def test_both_share_the_tolerance_alike_and_take_the_same_orders(runtime: ctypes.CDLL) -> None:
    random = np.random.default_rng(6)
    steps = [0.0, *(10.0 ** random.uniform(-9, 1, 300))]
    for step in steps:
        for tolerance in (1e-6, *(10.0 ** random.uniform(-12, 0, 10))):
            assert runtime.fmurt_share_of_tolerance(step, tolerance) == share_of_tolerance(step, tolerance)
            assert runtime.fmurt_highest_order(tolerance) == highest_order(tolerance)
