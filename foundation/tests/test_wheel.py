"""The program runs from an installed wheel, without the checkout."""

from __future__ import annotations

import os
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import contact_data
import pytest

CHECKOUT = Path(__file__).resolve().parents[2]
DROP = """model Drop
  inner Modelica.Mechanics.MultiBody.World world;
  Modelica.Mechanics.MultiBody.Parts.Body body(
    m=1, r_CM={0, 0, 0}, r_0(start={0, 2, 0}, each fixed=true), v_0(each fixed=true));
  annotation(experiment(StopTime=0.1, Tolerance=1e-6));
end Drop;
"""

pytestmark = [
    pytest.mark.full,
    pytest.mark.skipif(not contact_data.contact_engine().is_file(), reason="the contact engine is not installed"),
]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    subprocess.run(["git", "clone", "-q", CHECKOUT, source], check=True)
    # What set-up built lies beside the sources and is not in git.
    (source / ".deps").symlink_to(contact_data.dependencies())
    resources = contact_data.modelica_library() / "Resources"
    for name in ("Include", "Library"):
        (source / "ContactMultiBody" / "Resources").mkdir(exist_ok=True)
        (source / "ContactMultiBody" / "Resources" / name).symlink_to(resources / name)
    build = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--wheel-dir", folder, source]
    subprocess.run(build, check=True)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def program(wheel, tmp_path_factory):
    """`cmb` in an environment of its own, which sees this one's dependencies but not its checkout."""
    home = tmp_path_factory.mktemp("installed")
    venv.create(home / "venv", with_pip=False)
    packages = next((home / "venv" / "lib").glob("python3*/site-packages"))
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(packages)
    here = Path(pytest.__file__).parents[1]
    for path in here.iterdir():  # packages alone: a .pth file of the editable installation would lead back
        if "editable" not in path.name and path.suffix != ".pth" and not (packages / path.name).exists():
            (packages / path.name).symlink_to(path)

    def run(*arguments):
        environment = {**os.environ, "HOME": str(home), "XDG_CACHE_HOME": str(home / "cache"), "MODELICAPATH": ""}
        environment.pop("PYTHONPATH", None)
        command = [
            home / "venv" / "bin" / "python",
            "-c",
            "import sys; from cmb.main import main; sys.exit(main())",
            *arguments,
        ]
        return subprocess.run(command, cwd=home, env=environment, capture_output=True, text=True, check=False)

    return run


def test_wheel_holds_library_engine_and_schema(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    assert "contact_data/ContactMultiBody/package.mo" in names
    assert "contact_data/MultiBodyCore/Modelica/package.mo" in names
    assert "contact_data/schema/assembly.xsd" in names
    assert any(name.endswith("linux64/libContactMultiBody.a") for name in names)
    assert any(name.endswith("libsundials_cvode.a") for name in names)
    assert not any("/examples/" in name for name in names)


def test_help(program):
    result = program("--help")
    assert result.returncode == 0, result.stderr


def test_model_becomes_an_fmu_and_is_simulated(program, tmp_path):
    model = tmp_path / "Drop.mo"
    model.write_text(DROP)
    built = program("fmu", "Drop", "--source", model, "--output", tmp_path / "drop.fmu")
    assert built.returncode == 0, built.stderr
    simulated = program("simulate", tmp_path / "drop.fmu", "--output", tmp_path / "drop.csv")
    assert simulated.returncode == 0, simulated.stderr
    assert (tmp_path / "drop.csv").is_file()


def test_regress_without_a_folder_says_what_lacks(program):
    result = program("regress")
    assert result.returncode == 2
    assert "no cases of its own" in result.stderr
