"""FMPy keeps one logger for the whole process; a simulation must not leave a dead one behind."""

from __future__ import annotations

import gc
from pathlib import Path

import fmpy.fmi2
import pytest
from fmu_regression.fmi.fmu import open_fmu


def test_fmpy_still_logs_after_a_simulation(bouncing_mass: Path, capfd: pytest.CaptureFixture[str]) -> None:
    for _ in range(3):
        with open_fmu(bouncing_mass) as opened, opened.instantiate("me"):
            pass
        gc.collect()
    # What an FMU calls that another user of FMPy in this process has instantiated.
    fmpy.fmi2.defaultCallbacks.logger(None, b"other", 0, b"", b"still heard")
    assert "still heard" in capfd.readouterr().out
