"""What the builder asks of OpenModelica and makes of its answers; a script stands in for its compiler."""

from __future__ import annotations

import sys
import zipfile
from pathlib import Path

import pytest
from contact_foundation.errors import BuildError, CmbError, InputError
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.openmodelica import export_fmu, find_compiler
from modelica2fmu.packaging import FmiVersion

MODEL = "Robot.Walk"

# Answers as omc 1.24 prints them: each call's value on a line, messages as one quoted text.
FAKE = f"""#!{sys.executable}
import pathlib, sys, time, zipfile
here = pathlib.Path(__file__).parent
if sys.argv[1:] == ["--version"]:
    print("OpenModelica 1.24.0")
    raise SystemExit
(here / "script.mos").write_text(pathlib.Path(sys.argv[1]).read_text())
(here / "folder").write_text(str(pathlib.Path.cwd()))
time.sleep(float((here / "delay").read_text()))
print((here / "says").read_text())
if (here / "writes").read_text() == "fmu":
    with zipfile.ZipFile("exported.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription/>")
elif (here / "writes").read_text():
    pathlib.Path("exported.fmu").write_text("no archive")
"""


class Omc:
    """The stand-in, its answers and what it was asked."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        program = folder / "omc"
        program.write_text(FAKE)
        program.chmod(0o755)
        self.answer("true", writes="fmu")

    def answer(self, says: str, *, writes: str = "", delay: float = 0.0) -> None:
        for name, text in (("says", says), ("writes", writes), ("delay", repr(delay))):
            (self.folder / name).write_text(text)

    @property
    def script(self) -> list[str]:
        return (self.folder / "script.mos").read_text().splitlines()


@pytest.fixture
def omc(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Omc:
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.delenv("OPENMODELICAHOME", raising=False)
    monkeypatch.setenv("PATH", f"{folder}:/usr/bin:/bin")
    return Omc(folder)


@pytest.fixture
def library(tmp_path: Path) -> StandardLibrary:
    for name in ("Modelica 4.1.0", "ModelicaServices 4.1.0"):
        (tmp_path / "msl" / name).mkdir(parents=True)
        (tmp_path / "msl" / name / "package.mo").write_text("")
    (tmp_path / "msl" / "Complex 4.1.0.mo").write_text("")
    return StandardLibrary(tmp_path / "msl" / "Modelica 4.1.0", "4.1.0", "MODELICAPATH")


@pytest.fixture
def sources(tmp_path: Path) -> list[Path]:
    """The model's package in a folder whose name needs quoting, and a library that it uses."""
    robot = tmp_path / 'a "robot"' / "Robot"
    used = tmp_path / "Used"
    for folder in (robot, used):
        folder.mkdir(parents=True)
        (folder / "package.mo").write_text(f"package {folder.name} end {folder.name};")
    return [robot, used]


def test_the_script_loads_everything_and_exports(
    omc: Omc, library: StandardLibrary, sources: list[Path], tmp_path: Path
) -> None:
    report = export_fmu(MODEL, sources, tmp_path / "out" / "walk.fmu", library, FmiVersion.FMI3)
    with zipfile.ZipFile(report.fmu) as archive:
        assert archive.namelist() == ["modelDescription.xml"]
    assert report.version == "OpenModelica 1.24.0"
    assert "OpenModelica 1.24.0" in report.text()
    loads = [line for line in omc.script if line.startswith("loadFile")]
    base, msl = tmp_path.resolve(), (tmp_path / "msl").resolve()
    robot = str(base / 'a "robot"' / "Robot" / "package.mo").replace('"', '\\"')
    assert loads == [
        f'loadFile("{path}", uses = false);'
        for path in (
            msl / "Complex 4.1.0.mo",
            msl / "ModelicaServices 4.1.0" / "package.mo",
            msl / "Modelica 4.1.0" / "package.mo",
            base / "Used" / "package.mo",
            robot,
        )
    ]
    (export,) = [line for line in omc.script if "buildModelFMU" in line]
    assert export.startswith(
        'buildModelFMU(Robot.Walk, version = "3.0", fmuType = "me_cs", fileNamePrefix = "exported"'
    )
    assert 'setCommandLineOptions("--fmiFlags=s:cvode");' in omc.script
    assert not Path((omc.folder / "folder").read_text()).exists()  # its files are gone


def test_warnings_are_kept(omc: Omc, library: StandardLibrary, sources: list[Path], tmp_path: Path) -> None:
    omc.answer('"Warning: The initial conditions are not fully specified.\n"', writes="fmu")
    report = export_fmu(MODEL, sources, tmp_path / "walk.fmu", library)
    assert report.warnings == ("The initial conditions are not fully specified.",)


@pytest.mark.parametrize(
    ("says", "writes", "error", "text"),
    [
        (
            '""\n"[/home/me/Robot/Walk.mo:12:3-12:20:writable] Error: Class Missing.Part not found in scope Robot.\n"',
            "", InputError, r"/home/me/Robot/Walk\.mo:12: Robot\.Walk: OpenModelica: Class Missing\.Part not found",
        ),
        ('""\n"Error: Too many equations, over-determined system.\n"', "", BuildError, "Too many equations"),
        ("Segmentation fault", "", BuildError, "wrote no FMU: Segmentation fault"),
        ("", "", BuildError, "it said nothing"),
        ("true", "text", BuildError, "wrote no FMU"),
    ],
)  # fmt: skip
def test_failures_say_why_and_leave_what_was_there(
    says: str, writes: str, error: type[CmbError], text: str,
    omc: Omc, library: StandardLibrary, sources: list[Path], tmp_path: Path,
) -> None:  # fmt: skip
    omc.answer(says, writes=writes)
    output = tmp_path / "out" / "walk.fmu"
    output.parent.mkdir()
    output.write_bytes(b"before")
    with pytest.raises(error, match=text):
        export_fmu(MODEL, sources, output, library)
    assert [path.name for path in output.parent.iterdir()] == ["walk.fmu"]
    assert output.read_bytes() == b"before"


def test_a_compiler_that_hangs_is_ended(
    omc: Omc, library: StandardLibrary, sources: list[Path], tmp_path: Path
) -> None:
    omc.answer("true", writes="fmu", delay=60.0)
    with pytest.raises(BuildError, match=r"did not end within 0\.5 s"):
        export_fmu(MODEL, sources, tmp_path / "walk.fmu", library, timeout=0.5)
    assert not (tmp_path / "walk.fmu").exists()


def test_where_it_is_not_installed_the_remedy_is_named(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="omc is not on PATH") as caught:
        find_compiler({"PATH": str(tmp_path)})
    assert "--tool builtin" in str(caught.value)
    with pytest.raises(BuildError, match="OPENMODELICAHOME"):
        find_compiler({"PATH": "/usr/bin", "OPENMODELICAHOME": str(tmp_path)})


def test_a_name_that_is_none_reaches_no_script(
    omc: Omc, library: StandardLibrary, sources: list[Path], tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="no name of a Modelica class"):
        export_fmu('Robot.Walk); system("true"', sources, tmp_path / "walk.fmu", library)
    assert not (omc.folder / "script.mos").exists()
