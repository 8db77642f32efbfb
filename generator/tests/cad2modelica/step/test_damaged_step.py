"""STEP files cut anywhere or with bytes changed at random are read, or refused in one message that names the file.

``CMB_STEP_MUTATIONS=N`` draws N of each way.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from cad2modelica.brep.kernel_run import INSTALL, kernel_is_installed
from cad2modelica.brep.step_model import read_step_files
from contact_foundation.errors import InputError
from damage import CHANGES
from step_models import write_hinge

COUNT = int(os.environ.get("CMB_STEP_MUTATIONS", "4"))


@pytest.mark.skipif(not kernel_is_installed(), reason=f"the CAD kernel is not installed. {INSTALL}")
@pytest.mark.parametrize("change", CHANGES)
def test_damaged_step(tmp_path: Path, change: Callable[[bytes, random.Random], bytes]) -> None:
    write_hinge(tmp_path / "hinge.step")
    whole = (tmp_path / "hinge.step").read_bytes()
    files = [tmp_path / f"damaged{seed}.step" for seed in range(COUNT)]
    for seed, file in enumerate(files):
        file.write_bytes(change(whole, random.Random(seed)))
    found = read_step_files(files)
    assert list(found) == files
    for file, result in found.items():
        if isinstance(result, InputError):
            assert result.place is not None
            assert result.place.file == file
        else:
            for occurrence in result.occurrences:
                assert np.isfinite(occurrence.shape.vertices).all()
                assert np.isfinite(occurrence.shape.volume)
    assert len(list(tmp_path.iterdir())) == COUNT + 1
