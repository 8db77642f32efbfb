"""What FMUs carry of the contact engine: itself, and the library that the model chooses as back end alone."""

from __future__ import annotations

import re
import subprocess
import zipfile
from pathlib import Path

import pytest
from contact_data import checkout
from contact_foundation.errors import BuildError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.packaging.shared_libraries import copy_modules

LIBRARY = checkout() / "ContactMultiBody"
ENGINE = LIBRARY / "Resources" / "Library" / "linux64"
C_LIBRARY = {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"}

pytestmark = pytest.mark.skipif(
    not (ENGINE / "libContactMultiBody.a").is_file(), reason="the contact engine is not installed"
)

MODEL = """model Chosen
  extends ContactMultiBody.Examples.BallOnFloor(contacts(backend=ContactMultiBody.Types.Backend.BACKEND));
  annotation (experiment(StopTime=0.1, Tolerance=1e-6));
end Chosen;
"""


def build(folder: Path, backend: str, cache: Path) -> Path:
    source = folder / "Chosen.mo"
    source.write_text(MODEL.replace("BACKEND", backend), encoding="utf-8")
    build_fmu("Chosen", [source, LIBRARY], folder / "chosen.fmu", BuildOptions(cache=cache))
    return folder / "chosen.fmu"


def binaries(fmu: Path) -> set[str]:
    with zipfile.ZipFile(fmu) as archive:
        return {name.removeprefix("binaries/") for name in archive.namelist() if name.startswith("binaries/")}


@pytest.mark.full
def test_the_engine_of_an_fmu_needs_the_c_library_alone(tmp_path: Path, fmu_cache: Path) -> None:
    fmu = build(tmp_path, "Automatic", fmu_cache)
    assert binaries(fmu) == {"linux64/Chosen.so"}
    with zipfile.ZipFile(fmu) as archive:
        library = archive.extract("binaries/linux64/Chosen.so", tmp_path)
    dynamic = subprocess.run(["readelf", "-d", library], capture_output=True, text=True, check=True).stdout
    assert set(re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic)) <= C_LIBRARY


@pytest.mark.full
@pytest.mark.skipif(not (ENGINE / "libContactMultiBodyFcl.so").is_file(), reason="the engine was built without FCL")
def test_a_back_end_travels_where_the_model_chooses_it(
    tmp_path: Path, fmu_cache: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fmu = build(tmp_path, "Fcl", fmu_cache)
    files = binaries(fmu)
    assert {"linux64/Chosen.so", "linux64/libContactMultiBodyFcl.so"} < files
    assert any(name.startswith("linux64/libfcl.so") for name in files)
    assert not any("Libccd" in name or "Coal" in name for name in files)
    assert simulate_fmu(str(fmu), stop_time=0.05)["time"][-1] == 0.05

    bare = tmp_path / "bare.fmu"
    with zipfile.ZipFile(fmu) as whole, zipfile.ZipFile(bare, "w") as rest:
        for name in whole.namelist():
            if "libContactMultiBodyFcl" not in name:
                rest.writestr(name, whole.read(name))
    # By FMPy's own logger: it keeps the last one for the whole process, which would call this one after its end.
    with pytest.raises(Exception, match="fmi2"):
        simulate_fmu(str(bare), stop_time=0.05)
    assert "libContactMultiBodyFcl.so is not in" in capsys.readouterr().out


def test_a_module_that_is_not_installed_is_missed(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"the module libContactMultiBodyCoal\.so, which the model needs, is not in"):
        copy_modules(["libContactMultiBodyCoal.so"], [tmp_path], tmp_path)
