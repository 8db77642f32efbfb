"""Fixtures: a hand-written FMU whose motion is known in closed form."""

from __future__ import annotations

import subprocess
import zipfile
from pathlib import Path

import fmpy
import pytest

FIXTURES = Path(__file__).parent / "fixtures"


@pytest.fixture(scope="session")
def bouncing_mass(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU of a mass that bounces on a rigid floor: h(0) = 1 m, g = 10 m/s2, e = 0.5."""
    folder = tmp_path_factory.mktemp("fmu")
    library = folder / "bouncing_mass.so"
    headers = Path(fmpy.__file__).parent / "c-code"
    subprocess.run(
        [
            "gcc",
            "-std=c11",
            "-O1",
            "-shared",
            "-fPIC",
            f"-I{headers}",
            "-o",
            library,
            FIXTURES / "bouncing_mass.c",
            "-lm",
        ],
        check=True,
    )
    target = folder / "bouncing_mass.fmu"
    with zipfile.ZipFile(target, "w") as archive:
        archive.write(FIXTURES / "bouncing_mass.xml", "modelDescription.xml")
        archive.write(library, f"binaries/{fmpy.platform}/bouncing_mass.so")
    return target
