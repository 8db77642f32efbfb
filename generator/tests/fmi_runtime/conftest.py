"""FMUs of the hand-written models, packaged once a session."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import fixture_models as models
import pytest
from modelica2fmu.description.model_description import ModelDescription
from modelica2fmu.library.external_code import ExternalCode
from modelica2fmu.packaging import FmiVersion, package_fmu
from modelica2fmu.packaging.runtime_sources import runtime_folders

Packager = Callable[[ModelDescription, str], Path]


@pytest.fixture(scope="session")
def objects(fmu_cache: Path) -> Path:
    """Objects of the runtime, kept for all FMUs that are not about how it is compiled."""
    return fmu_cache / "objects"


@pytest.fixture(scope="session")
def package(tmp_path_factory: pytest.TempPathFactory, objects: Path) -> Packager:
    """Packages a fixture by its description and the name of its C file."""

    def build(description: ModelDescription, name: str) -> Path:
        target = tmp_path_factory.mktemp("fmu") / f"{name}.fmu"
        return package_fmu(description, models.source(name), target, objects_folder=objects)

    return build


@pytest.fixture(scope="session")
def oscillator(package: Packager) -> Path:
    return package(models.OSCILLATOR, "oscillator")


@pytest.fixture(scope="session")
def ball(package: Packager) -> Path:
    return package(models.BALL, "ball")


@pytest.fixture(scope="session")
def schedule(package: Packager) -> Path:
    return package(models.SCHEDULE, "schedule")


@pytest.fixture(scope="session")
def switching(package: Packager) -> Path:
    return package(models.SWITCHING, "switching")


@pytest.fixture(scope="session")
def external_code(tmp_path_factory: pytest.TempPathFactory) -> ExternalCode:
    """A static library of external functions that needs a shared one that needs another one."""
    folder = tmp_path_factory.mktemp("external")

    def run(*command: str | Path) -> None:
        subprocess.run([str(part) for part in command], check=True, cwd=models.FIXTURES)

    run("gcc", "-shared", "-fPIC", "-o", folder / "libdigitsbase.so", "digits_base.c")
    run("gcc", "-shared", "-fPIC", "-o", folder / "libdigits.so", "digits.c", f"-L{folder}", "-ldigitsbase")
    run("gcc", "-c", "-fPIC", *(f"-I{path}" for path in runtime_folders()), "-o", folder / "guard.o", "guard.c")
    run("ar", "rcs", folder / "libguard.a", folder / "guard.o")
    return ExternalCode(
        include_directories=(models.FIXTURES,),
        libraries=("guard", "digits", "digitsbase"),
        library_directories=(folder,),
    )


@pytest.fixture(scope="session")
def guarded(package: Packager, external_code: ExternalCode) -> Path:
    return package(replace(models.GUARDED, external=external_code), "guarded")


@pytest.fixture(scope="session")
def package3(tmp_path_factory: pytest.TempPathFactory, objects: Path) -> Packager:
    """The same for FMI 3.0."""

    def build(description: ModelDescription, name: str) -> Path:
        target = tmp_path_factory.mktemp("fmu3") / f"{name}.fmu"
        source = models.source(name)
        return package_fmu(description, source, target, version=FmiVersion.FMI3, objects_folder=objects)

    return build


@pytest.fixture(scope="session")
def ball3(package3: Packager) -> Path:
    return package3(models.BALL, "ball")


@pytest.fixture(scope="session")
def schedule3(package3: Packager) -> Path:
    return package3(models.SCHEDULE, "schedule")


@pytest.fixture(scope="session")
def oscillator3(package3: Packager) -> Path:
    return package3(models.OSCILLATOR, "oscillator")
