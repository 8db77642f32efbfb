"""Small Modelica models translated and simulated once a session."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
from contact_data import checkout, core_subset
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, BuildReport, Translation, build_fmu, translate
from modelica2fmu.library.standard_library import StandardLibrary

Builder = Callable[[str], BuildReport]
Simulator = Callable[..., Any]
Translator = Callable[[str], Translation]


def model_name(text: str) -> str:
    """Name of the first class of a Modelica text."""
    return text.split(None, 2)[1]


@pytest.fixture(scope="session")
def write_model(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Writes a text into a file of its own, named after its class."""

    def write(text: str) -> Path:
        folder = tmp_path_factory.mktemp("model")
        path = folder / f"{model_name(text)}.mo"
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture(scope="session")
def build(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path, write_model: Callable[[str], Path]) -> Builder:
    """Builds the FMU of a text; the same text is built once."""
    reports: dict[str, BuildReport] = {}

    def run(text: str) -> BuildReport:
        key = hashlib.sha256(text.encode()).hexdigest()
        if key not in reports:
            output = tmp_path_factory.mktemp("fmu") / "model.fmu"
            reports[key] = build_fmu(model_name(text), [write_model(text)], output, BuildOptions(cache=fmu_cache))
        return reports[key]

    return run


@pytest.fixture(scope="session")
def built_with_library(
    tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path, write_model: Callable[[str], Path]
) -> Callable[[str], Path]:
    """Builds the FMU of a text that uses ContactMultiBody; the same text is built once."""
    fmus: dict[str, Path] = {}

    def run(text: str) -> Path:
        if text not in fmus:
            fmus[text] = tmp_path_factory.mktemp("fmu") / "model.fmu"
            sources = [write_model(text), checkout() / "ContactMultiBody"]
            build_fmu(model_name(text), sources, fmus[text], BuildOptions(cache=fmu_cache))
        return fmus[text]

    return run


@pytest.fixture(scope="session")
def translated(write_model: Callable[[str], Path]) -> Translator:
    """Translates a text without compiling it."""

    def run(text: str) -> Translation:
        return translate(model_name(text), [write_model(text)], StandardLibrary(core_subset(), "", "core subset"))

    return run


@pytest.fixture(scope="session")
def simulate(build: Builder) -> Simulator:
    """Builds a text and simulates it by an independent importer."""

    def run(
        text: str,
        outputs: list[str],
        stop: float = 1.0,
        tolerance: float = 1e-9,
        interval: float | None = None,
        start_values: Mapping[str, Any] | None = None,
        fmi_type: str = "ModelExchange",
        **options: Any,
    ) -> Any:
        return simulate_fmu(
            str(build(text).fmu),
            fmi_type=fmi_type,
            output=outputs,
            stop_time=stop,
            relative_tolerance=tolerance,
            output_interval=interval or stop / 20,
            start_values=dict(start_values or {}),
            **options,
        )

    return run
