"""Geometry files end up inside of the FMU."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from contact_data import checkout, core_subset
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu, translate
from modelica2fmu.library.standard_library import StandardLibrary, find_standard_library
from modelica2fmu.report import BuildReport

LIBRARY = checkout() / "ContactMultiBody"
CORE = StandardLibrary(core_subset(), "", "core subset")

pytestmark = pytest.mark.skipif(
    not (LIBRARY / "Resources" / "Library" / "linux64" / "libcontactmultibody.so").is_file(),
    reason="the contact engine is not installed",
)

# A cube of 100 mm, in millimetres.
CUBE = "".join(f"v {x} {y} {z}\n" for z in (-50, 50) for y in (-50, 50) for x in (-50, 50)) + "".join(
    f"f {face}\n" for face in ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6")
)

PACKAGE = """package MeshDemo "Bodies from files"
  annotation (uses(Modelica(version="4.1.0"), ContactMultiBody(version="0.1.0")));
end MeshDemo;
"""

MODEL = """within MeshDemo;
model Cube "A cube from a file rests on a floor"
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  ContactMultiBody.Parts.Body cube(
    m=1, r_CM={0,0,0}, I_11=0.01, I_22=0.01, I_33=0.01,
    geometry=ContactMultiBody.Shapes.FUNCTION("FILE", 1e-3),
    r_0(start={0,0,0.0499019}, each fixed=true), v_0(each fixed=true), angles_fixed=true, w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=2, geometry={cube.geometry,floor.geometry}, material={cube.material,floor.material}, pointCapacity=4,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given, stiffness={1e5});
equation
  connect(cube.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=1, Tolerance=1e-8));
end Cube;
"""


def package(folder: Path, function: str, file: str) -> Path:
    parts = folder / "MeshDemo"
    (parts / "Resources").mkdir(parents=True)
    (parts / "Resources" / "my cube.obj").write_text(CUBE, encoding="utf-8")
    (parts / "package.mo").write_text(PACKAGE, encoding="utf-8")
    (parts / "package.order").write_text("Cube\n", encoding="utf-8")
    (parts / "Cube.mo").write_text(MODEL.replace("FUNCTION", function).replace("FILE", file), encoding="utf-8")
    return parts


def test_fmu_carries_its_mesh(tmp_path: Path, fmu_cache: Path) -> None:
    parts = package(tmp_path / "models", "meshFile", "modelica://MeshDemo/Resources/my cube.obj")
    output = tmp_path / "cube.fmu"
    build_fmu("MeshDemo.Cube", [parts, LIBRARY], output, BuildOptions(cache=fmu_cache))
    shutil.rmtree(parts)
    result = simulate_fmu(str(output), stop_time=1.0, fmi_type="CoSimulation", output=["cube.r_0[3]"])
    assert result["cube.r_0[3]"][-1] == pytest.approx(0.05 - 9.81e-5, abs=1e-8)


def test_a_file_that_changed_is_read_again(tmp_path: Path, fmu_cache: Path) -> None:
    """Wherever it stands: this one by a path relative to the model's folder, outside of Resources."""
    parts = package(tmp_path / "models", "hullFile", "Meshes/cube.obj")
    mesh = parts / "Meshes" / "cube.obj"
    mesh.parent.mkdir()
    mesh.write_text(CUBE, encoding="utf-8")

    def build() -> BuildReport:
        return build_fmu("MeshDemo.Cube", [parts, LIBRARY], tmp_path / "cube.fmu", BuildOptions(cache=fmu_cache))

    first = build()
    assert first.files == (mesh,)
    assert build().cached
    mesh.write_text(CUBE.replace("50", "60"), encoding="utf-8")
    again = build()
    assert not again.cached
    result = simulate_fmu(str(again.fmu), stop_time=0.01, fmi_type="CoSimulation", output=["contacts.distance[1]"])
    assert result["contacts.distance[1]"][0] == pytest.approx(-0.01 - 9.81e-5)


@pytest.mark.parametrize("library", ["core subset", "Standard Library"])
def test_load_resource_names_the_file(tmp_path: Path, library: str) -> None:
    """As the documentation of meshFile says, and other tools need it."""
    chosen = CORE if library == "core subset" else find_standard_library()
    if library != "core subset" and chosen.origin == CORE.origin:
        pytest.skip("no Modelica Standard Library is installed")
    parts = package(tmp_path / "models", "hullFile", "modelica://MeshDemo/Resources/my cube.obj")
    model = parts / "Cube.mo"
    text = model.read_text(encoding="utf-8")
    called = re.sub(r'"(modelica://[^"]*)"', r'Modelica.Utilities.Files.loadResource("\1")', text)
    model.write_text(called, encoding="utf-8")
    translation = translate("MeshDemo.Cube", [parts, LIBRARY], chosen)
    texts = [value for call in translation.scalar.calls for arg in call.args for value in arg.values]
    hull = next(text for text in texts if isinstance(text, str) and text.startswith("cmb/1 hull"))
    assert "file" not in hull
    assert "-0.05,-0.05,-0.05" in hull


@pytest.mark.full
def test_absolute_names_are_written_out_too(tmp_path: Path) -> None:
    parts = package(tmp_path / "models", "hullFile", str(tmp_path / "models/MeshDemo/Resources/my cube.obj"))
    translation = translate("MeshDemo.Cube", [parts, LIBRARY], CORE)
    texts = [value for call in translation.scalar.calls for arg in call.args for value in arg.values]
    hull = next(text for text in texts if isinstance(text, str) and text.startswith("cmb/1 hull"))
    assert "file" not in hull
    assert "-0.05,-0.05,-0.05" in hull


@pytest.mark.parametrize(
    ("file", "part"),
    [
        pytest.param("modelica://MeshDemo/Resources/none.obj", "none.obj", marks=pytest.mark.full),
        ("modelica://MeshDemo/../secret.obj", "leaves its package"),
        pytest.param("/none/at/all.stl", "/none/at/all.stl", marks=pytest.mark.full),
        pytest.param("/etc/hostname", ".stl, .obj or .ply", marks=pytest.mark.full),
    ],
)
def test_missing_files_are_named(tmp_path: Path, file: str, part: str) -> None:
    parts = package(tmp_path / "models", "meshFile", file)
    with pytest.raises(InputError, match=part):
        translate("MeshDemo.Cube", [parts, LIBRARY], CORE)
