"""Every scene of the project's studies has what its study asks of it; a study whose scene has not is refused whole."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from accuracy_study.definition import load_study
from accuracy_study.scene_models import SceneModels
from cmb.modelica_sources import find_sources
from modelica2fmu.build import BuildOptions, build_fmu
from program import ROOT

STUDY = load_study(ROOT / "Resources" / "studies" / "all.toml")


@pytest.mark.full
@pytest.mark.parametrize("name", [scene.name for scene in STUDY.scenes])
def test_a_scene_has_every_knob_that_is_asked_of_it(
    name: str,
    engine: None,  # noqa: ARG001
    fmu_cache: Path,
    tmp_path: Path,
) -> None:
    def build(model: str, sources: Sequence[Path], fmu: Path) -> None:
        build_fmu(model, find_sources(model, sources), fmu, BuildOptions(cache=fmu_cache))

    study = STUDY.only([name])
    assert SceneModels(study, study.scenes[0], build, tmp_path).problems() == []
