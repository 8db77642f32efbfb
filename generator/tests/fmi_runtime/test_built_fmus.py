"""FMUs that the builder makes of models with contacts, in both versions of the standard."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path
from typing import Any

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from lxml import etree
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.packaging import FmiVersion

LIBRARY = Path(__file__).resolve().parents[3] / "ContactMultiBody"
KINDS = ("ModelExchange", "CoSimulation")
DROP, RADIUS, STIFFNESS, GRAVITY = 1.0, 0.05, 1e6, 9.81


@pytest.fixture(scope="session", params=list(FmiVersion), ids=lambda version: f"fmi{version}")
def ball_on_floor(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("ball") / "ball.fmu"
    options = BuildOptions(fmi=request.param)
    report = build_fmu("ContactMultiBody.Examples.BallOnFloor", [LIBRARY], target, options)
    assert report.fmi == request.param
    return report.fmu


def variables(fmu: Path) -> dict[str, Any]:
    return {variable.name: variable for variable in read_model_description(str(fmu)).modelVariables}


def test_fmpy_finds_nothing_wrong(ball_on_floor: Path) -> None:
    assert validate_fmu(str(ball_on_floor)) == []


def test_nothing_of_the_translation_shows(ball_on_floor: Path) -> None:
    """Results of external calls and other symbols of the translation are no variables of the modeller."""
    with zipfile.ZipFile(ball_on_floor) as archive:
        root = etree.fromstring(archive.read("modelDescription.xml"))
    assert root.get("variableNamingConvention") == "structured"
    assert not [name for name in variables(ball_on_floor) if re.search(r"\$|call", name)]
