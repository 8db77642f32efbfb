"""A small part of the campaign of random scenes."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_data import modelica_library
from contact_promises.soak.campaign import all_runs, soak
from modelica2fmu.build import BuildOptions, build_fmu

pytestmark = pytest.mark.full


@pytest.mark.parametrize("seed", [1, 3])
def test_random_scenes_keep_the_promises(seed: int, tmp_path: Path, fmu_cache: Path, engine: None) -> None:  # noqa: ARG001
    def build(model: str, source: Path, output: Path) -> None:
        build_fmu(model, (source, modelica_library()), output, BuildOptions(cache=fmu_cache))

    runs = all_runs(tolerances=(1e-3, 1e-5, 1e-7))
    rows = list(soak([seed], runs, tmp_path / "rows.csv", build))
    assert len(rows) == len(runs)
    failed = {(seed, row["importer"], row["mode"], row["tolerance"]): row["failure"] for row in rows if row["failure"]}
    assert failed == {}
