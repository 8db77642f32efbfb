"""Descriptions of FMUs are read again where, and only where, they differ."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from contact_foundation.errors import InputError
from fmu_regression.fmi import description as module
from fmu_regression.fmi.description import read_description
from fmu_regression.fmi.fmu import open_fmu


def rewritten(fmu: Path, target: Path, old: str, new: str) -> None:
    with zipfile.ZipFile(fmu) as archive, zipfile.ZipFile(target, "w") as copy:
        for name in archive.namelist():
            content = archive.read(name)
            copy.writestr(name, content.replace(old.encode(), new.encode()) if name.endswith(".xml") else content)


def test_another_fmu_in_the_same_place_is_read(bouncing_mass: Path, tmp_path: Path) -> None:
    fmu = tmp_path / "a.fmu"
    rewritten(bouncing_mass, fmu, "", "")
    name = read_description(fmu).name
    rewritten(bouncing_mass, fmu, f'modelName="{name}"', 'modelName="Other"')
    assert read_description(fmu).name == "Other"
    rewritten(bouncing_mass, fmu, "ModelVariables", "ModelVariable")
    with pytest.raises(InputError, match="not a valid FMU"):
        read_description(fmu)
    rewritten(bouncing_mass, fmu, "", "")
    assert read_description(fmu).name == name


def test_the_same_description_is_read_once(
    bouncing_mass: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = read_description(bouncing_mass)
    copy = tmp_path / "copy.fmu"
    copy.write_bytes(bouncing_mass.read_bytes())
    monkeypatch.setattr(module, "read_model_description", None)
    assert read_description(copy) == first


def test_an_fmu_is_unpacked_without_what_only_compilers_and_readers_need(bouncing_mass: Path, tmp_path: Path) -> None:
    fmu = tmp_path / "a.fmu"
    fmu.write_bytes(bouncing_mass.read_bytes())
    with zipfile.ZipFile(fmu, "a") as archive:
        for name in ("sources/a.c", "documentation/index.html", "resources/sources/a.csv", "extra/a.json"):
            archive.writestr(name, "")
    with open_fmu(fmu) as opened, opened.instantiate("cs"):
        found = {path.relative_to(opened.folder).as_posix() for path in opened.folder.rglob("*") if path.is_file()}
    assert {"resources/sources/a.csv", "extra/a.json", "modelDescription.xml"} <= found
    assert not {"sources/a.c", "documentation/index.html"} & found
