"""The release is whole: the unpacked library simulates, and others can build the engine from it."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from contact_data import checkout, modelica_library
from fmu_regression.simulate.simulation import simulate
from program import Cmb

ROOT = checkout()


@pytest.fixture(scope="module")
def archive(engine: None, tmp_path_factory: pytest.TempPathFactory) -> Path:  # noqa: ARG001
    target = tmp_path_factory.mktemp("release") / "library.zip"
    subprocess.run([sys.executable, ROOT / "scripts" / "release", "--output", target], check=True, timeout=60)
    return target


@pytest.fixture(scope="module")
def unpacked(archive: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("unpacked")
    with zipfile.ZipFile(archive) as opened:
        opened.extractall(folder)
    return folder / "ContactMultiBody"


def test_holds_the_package_and_no_tests(unpacked: Path) -> None:
    def modelica(folder: Path) -> set[str]:
        return {path.relative_to(folder).as_posix() for path in folder.rglob("*.mo")}

    assert modelica(unpacked) == modelica(modelica_library())
    assert not list(unpacked.rglob("*.py"))
    assert (unpacked / "LICENSE").is_file()


TOOLS = ("OpenModelica", "Dymola", "SimulationX", "Modelon Impact")


def test_says_how_to_open_it_in_each_tool(unpacked: Path) -> None:
    """The zip's README, the file that enters it into Dymola's menu, and the guide's notes."""
    readme = (unpacked / "README.txt").read_text("utf-8")
    assert all(tool in readme for tool in TOOLS)
    assert re.search(r"Wolfram System +File.*\n +Modeler", readme)
    version = re.search(r'^ *version="([\d.]+)"', (unpacked / "package.mo").read_text("utf-8"), re.MULTILINE)
    assert version is not None
    assert f'version="{version[1]}"' in (unpacked / "libraryinfo.mos").read_text("utf-8")
    headings = re.findall(r"<h4>(.*?)</h4>", (unpacked / "UsersGuide" / "ToolNotes.mo").read_text("utf-8"))
    assert {*TOOLS, "Wolfram System Modeler"} <= set(headings)
    assert list((unpacked / "Resources" / "Scripts").glob("*.mos"))


def test_equal_files_give_equal_bytes(archive: Path, tmp_path: Path) -> None:
    again = tmp_path / "again.zip"
    subprocess.run([sys.executable, ROOT / "scripts" / "release", "--output", again], check=True, timeout=60)
    assert again.read_bytes() == archive.read_bytes()


@pytest.mark.full
def test_the_unpacked_library_simulates(unpacked: Path, cmb: Cmb, tmp_path: Path) -> None:
    done = cmb("fmu", "ContactMultiBody.Examples.BallOnFloor", "--source", unpacked, "--output", tmp_path / "ball.fmu")
    assert done.returncode == 0, done.stderr
    result = simulate(tmp_path / "ball.fmu", signals=["ball.r_0[3]"], stop=3.0, tolerance=1e-6, interval=0.01)
    assert result["ball.r_0[3]"][-1] == pytest.approx(0.1 - 9.81e-6, abs=1e-7)


@pytest.mark.skipif(shutil.which("cmake") is None, reason="CMake is not installed")
def test_the_sources_are_complete(unpacked: Path, tmp_path: Path) -> None:
    source = unpacked / "Resources" / "Source" / "external-c"
    options = ["-DCMB_TESTS=OFF", "-DCMB_BENCH=OFF", "-DCMB_FUZZ=OFF"]
    done = subprocess.run(
        ["cmake", "-S", source, "-B", tmp_path / "build", *options], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
