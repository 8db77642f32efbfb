"""The report of the hammer that comes with the tests' closed forms."""

from __future__ import annotations

from pathlib import Path

import pytest
from fmu_regression.report.simulation_report import write_report
from fmu_regression.results.result import read_csv, write_csv
from synthetic import hammer, write_scene


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """result.csv, scene.json and report.html of the hammer."""
    folder = tmp_path_factory.mktemp("report")
    content, result = hammer()
    write_scene(content, folder / "scene.json")
    write_csv(result, folder / "result.csv")
    write_report(read_csv(folder / "result.csv"), folder / "scene.json", folder / "report.html")
    return folder
