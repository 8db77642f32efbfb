"""A small part of the campaign of random scenes."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_data import modelica_library
from contact_promises.soak.campaign import all_runs, soak
from contact_promises.soak.machines import random_machine
from contact_promises.soak.scenes import random_scene
from modelica2fmu.build import BuildOptions, build_fmu

pytestmark = pytest.mark.full


@pytest.mark.parametrize(
    ("draw", "seed"), [(random_scene, 1), (random_scene, 3), (random_machine, 2), (random_machine, 5)]
)
def test_random_scenes_keep_the_promises(draw, seed: int, tmp_path: Path, fmu_cache: Path, engine: None) -> None:  # noqa: ARG001
    def build(model: str, source: Path, output: Path) -> None:
        build_fmu(model, (source, modelica_library()), output, BuildOptions(cache=fmu_cache))

    runs = all_runs(tolerances=(1e-3, 1e-5, 1e-7))
    rows = list(soak(draw, [seed], runs, tmp_path / "rows.csv", build))
    assert len(rows) == len(runs)
    failed = {(seed, row["importer"], row["mode"], row["tolerance"]): row["failure"] for row in rows if row["failure"]}
    assert failed == {}
