"""FMUs that the builder makes of a model with contacts, in both versions of the standard."""

from __future__ import annotations

import ctypes
import os
import re
import shutil
import subprocess
import sys
import threading
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from contact_data import checkout
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.build import build_platform_binary
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from fmpy.validation import validate_fmu
from lxml import etree
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.packaging import FmiVersion
from modelica2fmu.packaging.dependencies import find_sundials

LIBRARY = checkout() / "ContactMultiBody"
MODEL = "ContactMultiBody.Examples.BallOnFloor"
KINDS = ("ModelExchange", "CoSimulation")
STANDARD_HEADERS = {
    f"{name}.h"
    for name in (
        "errno", "float", "limits", "math", "pthread", "setjmp", "stdarg", "stdbool", "stddef", "stdint", "stdio",
        "stdlib", "string",
    )
}  # fmt: skip
GRAVITY, MASS, RADIUS, STIFFNESS = 9.81, 1.0, 0.1, 1e6


@pytest.fixture(scope="session", params=list(FmiVersion), ids=lambda version: f"fmi{version}")
def ball_on_floor(request: pytest.FixtureRequest, fmu_cache: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if not any((LIBRARY / "Resources" / "Library").glob("*/libContactMultiBody.a")):
        pytest.skip("the contact engine is not built; run scripts/setup")
    target = tmp_path_factory.mktemp("ball") / "ball.fmu"
    report = build_fmu(MODEL, [LIBRARY], target, BuildOptions(fmi=request.param, cache=fmu_cache))
    assert report.fmi == request.param
    return report.fmu


class Unpacked:
    """An unpacked FMU and instances of it, the same for both versions."""

    def __init__(self, fmu: Path, folder: Path) -> None:
        extract(str(fmu), str(folder))
        self.folder = folder
        self.description = read_model_description(str(folder))
        self.reference = {v.name: v.valueReference for v in self.description.modelVariables}
        self.two = self.description.fmiVersion == "2.0"

    @contextmanager
    def instance(self, *, co_simulation: bool = True, **starts: float) -> Iterator[Any]:
        """An instance at the end of initialization; in model exchange in continuous-time mode."""
        part = self.description.coSimulation if co_simulation else self.description.modelExchange
        kinds = (FMU2Slave, FMU2Model) if self.two else (FMU3Slave, FMU3Model)
        made = kinds[0 if co_simulation else 1](
            guid=self.description.guid,
            modelIdentifier=part.modelIdentifier,
            unzipDirectory=str(self.folder),
            instanceName="instance",
        )
        made.instantiate()
        for name, value in starts.items():
            self.set(made, name, value)
        if self.two:
            made.setupExperiment(startTime=0.0, tolerance=1e-8)
            made.enterInitializationMode()
        else:
            made.enterInitializationMode(tolerance=1e-8, startTime=0.0)
        made.exitInitializationMode()
        if not co_simulation:
            made.newDiscreteStates() if self.two else made.updateDiscreteStates()
            made.enterContinuousTimeMode()
        yield made
        made.terminate()
        made.freeInstance()

    def set(self, instance: Any, name: str, value: float) -> None:
        (instance.setReal if self.two else instance.setFloat64)([self.reference[name]], [value])

    def get(self, instance: Any, name: str) -> float:
        return float((instance.getReal if self.two else instance.getFloat64)([self.reference[name]])[0])

    def sensitivity(self, instance: Any, unknown: str, known: str) -> float:
        references = ([self.reference[unknown]], [self.reference[known]])
        function = instance.getDirectionalDerivative
        return float(function(*references, [1.0])[0])


@pytest.fixture(scope="session")
def unpacked(ball_on_floor: Path, tmp_path_factory: pytest.TempPathFactory) -> Unpacked:
    return Unpacked(ball_on_floor, tmp_path_factory.mktemp("unpacked"))


def advance(instance: Any, begin: float, end: float, step: float = 0.01) -> None:
    for k in range(round((end - begin) / step)):
        instance.doStep(begin + k * step, step)


def depth_at_rest(stiffness: float, mass: float) -> float:
    return mass * GRAVITY / stiffness


def test_fmpy_finds_nothing_wrong(ball_on_floor: Path) -> None:
    """But for the names: to parse them takes FMPy 5 s."""
    read_model_description(str(ball_on_floor), validate=True, validate_model_structure=True)


@pytest.mark.full
def test_fmpy_finds_nothing_wrong_with_names_either(ball_on_floor: Path) -> None:
    assert validate_fmu(str(ball_on_floor)) == []


def test_every_xml_file_is_valid_by_the_schemas_of_the_standard(unpacked: Unpacked) -> None:
    version = 2 if unpacked.two else 3
    schemas = Path(fmpy.__file__).parent / "schema" / f"fmi{version}"
    names = {
        "modelDescription.xml": "ModelDescription",
        "sources/buildDescription.xml": "BuildDescription",
        "terminalsAndIcons/terminalsAndIcons.xml": "TerminalsAndIcons",
    }
    found = {path.relative_to(unpacked.folder).as_posix() for path in unpacked.folder.rglob("*.xml")}
    assert found == ({"modelDescription.xml"} if unpacked.two else set(names))
    for name in found:
        schema = etree.XMLSchema(etree.parse(str(schemas / f"fmi{version}{names[name]}.xsd")))
        schema.assertValid(etree.parse(str(unpacked.folder / name)))


def test_nothing_of_the_translation_shows(unpacked: Unpacked) -> None:
    """Results of external calls and other symbols of the translation are no variables of the modeller."""
    root = etree.parse(str(unpacked.folder / "modelDescription.xml")).getroot()
    assert root.get("variableNamingConvention") == "structured"
    assert not [name for name in unpacked.reference if re.search(r"\$|call", name)]


def test_every_variable_is_described_and_every_unit_defined(unpacked: Unpacked) -> None:
    description = unpacked.description
    # The Standard Library leaves some variables of its world without a word; the core subset here has none of these.
    assert [v.name for v in description.modelVariables if not (v.description or v.name.startswith("world."))] == []
    units = {unit.name: unit for unit in description.unitDefinitions}
    shown = {v.name: v.unit or (v.declaredType.unit if v.declaredType else None) for v in description.modelVariables}
    assert {unit for unit in shown.values() if unit} <= set(units)
    force = units["N"].baseUnit
    assert (force.kg, force.m, force.s) == (1, 1, -2)
    (degree,) = units["rad"].displayUnits
    assert degree.name == "deg"
    assert float(degree.factor) == pytest.approx(180 / np.pi)
    experiment = description.defaultExperiment
    assert float(experiment.stopTime) == 3.0
    assert float(experiment.tolerance) > 0.0
    variables = {v.name: v for v in description.modelVariables}
    assert shown["der(ball.v_0[3])"] == "m/s2"
    for name in ("contacts.stiffness[1]", "ball.m", "e", "ball.material.muDynamic"):
        assert (variables[name].variability, bool(variables[name].description)) == ("tunable", True)
    assert variables["height"].variability == "fixed"  # of the start only


@pytest.mark.parametrize("kind", KINDS)
def test_the_ball_rises_to_the_square_of_its_restitution(ball_on_floor: Path, kind: str) -> None:
    height, restitution = 2.0, 0.6
    fall = np.sqrt(2.0 * height / GRAVITY)
    result = simulate_fmu(
        str(ball_on_floor), fmi_type=kind, stop_time=2.0 * fall, output_interval=1e-3, relative_tolerance=1e-9,
        start_values={"height": height, "e": restitution}, output=["ball.r_0[3]", "contacts.normalForce[1]"],
        record_events=False,
    )  # fmt: skip
    after = result["time"] > 1.2 * fall
    assert result["ball.r_0[3]"][after].max() - RADIUS == pytest.approx(
        restitution**2 * height,
        rel=1e-2,  # the weight, which acts during the contact too, costs up to so much
    )
    assert np.all(result["contacts.normalForce[1]"][result["ball.r_0[3]"] > RADIUS] == 0.0)


def test_stiffness_and_mass_are_tunable_while_it_runs(unpacked: Unpacked) -> None:
    """A ball at rest sinks to where its weight is carried, whatever was set when."""
    with unpacked.instance(e=0.2, height=1e-4) as ball:
        advance(ball, 0.0, 1.0)
        assert -unpacked.get(ball, "contacts.distance[1]") == pytest.approx(depth_at_rest(1e6, 1.0), rel=1e-3)
        unpacked.set(ball, "contacts.stiffness[1]", 4e6)
        advance(ball, 1.0, 2.0)
        assert -unpacked.get(ball, "contacts.distance[1]") == pytest.approx(depth_at_rest(4e6, 1.0), rel=1e-3)
        unpacked.set(ball, "ball.m", 3.0)
        advance(ball, 2.0, 3.0)
        assert -unpacked.get(ball, "contacts.distance[1]") == pytest.approx(depth_at_rest(4e6, 3.0), rel=1e-3)
        assert unpacked.get(ball, "contacts.normalForce[1]") == pytest.approx(3.0 * GRAVITY, rel=1e-3)


def test_directional_derivatives_through_the_contact_engine(unpacked: Unpacked) -> None:
    depth = 1e-4
    with unpacked.instance(co_simulation=False, e=1.0, height=-depth) as ball:
        unknown = "der(ball.v_0[3])"
        force = STIFFNESS * depth
        assert unpacked.get(ball, unknown) == pytest.approx(force / MASS - GRAVITY, rel=1e-6)
        slope = unpacked.sensitivity(ball, unknown, "ball.r_0[3]")
        assert slope == pytest.approx(-STIFFNESS / MASS, rel=1e-4)
        assert unpacked.sensitivity(ball, unknown, "contacts.stiffness[1]") == pytest.approx(depth, rel=1e-4)
        assert unpacked.sensitivity(ball, unknown, "ball.m") == pytest.approx(-force / MASS**2, rel=1e-4)


def test_instances_in_threads_do_what_one_alone_does(unpacked: Unpacked) -> None:
    def heights(restitution: float, results: list[float]) -> None:
        with unpacked.instance(e=restitution, height=0.2) as ball:
            for k in range(40):
                ball.doStep(0.02 * k, 0.02)
                results.append(unpacked.get(ball, "ball.r_0[3]"))

    alone: list[list[float]] = [[] for _ in range(4)]
    together: list[list[float]] = [[] for _ in range(4)]
    for k in range(4):
        heights(0.2 * k, alone[k])
    threads = [threading.Thread(target=heights, args=(0.2 * k, together[k])) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
    assert together == alone
    assert len({tuple(results) for results in alone}) == 4


def test_only_functions_of_the_standard_are_visible(unpacked: Unpacked) -> None:
    """The contact engine, CVODE and C++ inside cannot clash with another FMU's or the importer's own."""
    identifier = unpacked.description.coSimulation.modelIdentifier
    (library,) = unpacked.folder.glob(f"binaries/*/{identifier}.so")
    listed = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True)
    symbols = {line.split()[-1] for line in listed.stdout.splitlines()}
    prefix = "fmi2" if unpacked.two else "fmi3"
    assert f"{prefix}DoStep" in symbols
    assert [symbol for symbol in symbols if not re.fullmatch(prefix + r"[A-Z]\w+", symbol)] == []
    strong = ctypes.CDLL(str(library))
    assert not hasattr(strong, "fmurt_model")


def test_it_runs_from_any_folder(ball_on_floor: Path, tmp_path: Path) -> None:
    """Unpacked where names have blanks and other letters, and run from elsewhere in a process of its own."""
    folder = tmp_path / "an Ordner with ünusual näme"
    with zipfile.ZipFile(ball_on_floor) as archive:
        archive.extractall(folder)
    script = (
        "import sys, fmpy; r = fmpy.simulate_fmu(sys.argv[1], fmi_type=sys.argv[2], stop_time=0.5,"
        " output=['ball.r_0[3]']); print(r['ball.r_0[3]'].min())"
    )
    for kind in KINDS:
        done = subprocess.run(
            [sys.executable, "-c", script, str(folder), kind], capture_output=True, text=True, cwd="/", check=True
        )
        assert 0.09 < float(done.stdout.split()[-1]) < RADIUS


@pytest.mark.full
def test_the_sources_build_the_same_binary_again(ball_on_floor: Path, unpacked: Unpacked, tmp_path: Path) -> None:
    """With nothing but the folder, a compiler, CVODE and the contact engine's library."""
    if shutil.which("cmake") is None:
        pytest.skip("CMake is not installed")
    folder = tmp_path / "fmu"
    shutil.copytree(unpacked.folder, folder)
    identifier = unpacked.description.coSimulation.modelIdentifier
    (binary,) = folder.glob(f"binaries/*/{identifier}.so")
    binary.unlink()
    libraries = [find_sundials().archive.parent, LIBRARY / "Resources" / "Library" / "linux64"]
    environment = {name: value for name, value in os.environ.items() if name not in ("CPATH", "C_INCLUDE_PATH")}
    for command in (
        ["cmake", "-S", folder / "sources", "-B", tmp_path / "build",
         f"-DCMAKE_LIBRARY_PATH={';'.join(map(str, libraries))}"],
        ["cmake", "--build", tmp_path / "build", "-j2"],
    ):  # fmt: skip
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, timeout=120)
        assert done.returncode == 0, done.stdout + done.stderr
    shutil.copyfile(tmp_path / "build" / f"{identifier}.so", binary)

    def heights(fmu: Path) -> Any:
        result = simulate_fmu(str(fmu), fmi_type="CoSimulation", stop_time=1.0, output=["ball.r_0[3]"])
        return result["ball.r_0[3]"]

    assert np.allclose(heights(folder), heights(ball_on_floor), rtol=0.0, atol=1e-9)


@pytest.mark.full
def test_fmpy_builds_the_sources_of_fmi_3(ball_on_floor: Path, unpacked: Unpacked, tmp_path: Path) -> None:
    """As docs/fmu.md says: FMPy reads the files from buildDescription.xml, folders and libraries must be named."""
    if unpacked.two:
        pytest.skip("FMI 2.0 has no description of the build")
    if shutil.which("cmake") is None:
        pytest.skip("CMake is not installed")
    folder = tmp_path / "fmu"
    shutil.copytree(unpacked.folder, folder)
    (binary,) = folder.glob(f"binaries/*/{unpacked.description.coSimulation.modelIdentifier}.so")
    binary.unlink()
    listed = etree.parse(str(folder / "sources" / "buildDescription.xml"))
    names = [str(library.get("name")) for library in listed.iter("Library")]
    folders = [find_sundials().archive.parent, LIBRARY / "Resources" / "Library" / "linux64"]
    libraries = [*(f"-L{path}" for path in folders), *(f"-l{name}" for name in names), "-lm", "-Wl,-rpath,$ORIGIN"]
    build_platform_binary(
        folder,
        cmake_options={
            "FMI_INCLUDE_DIRS:STRING": f"{folder}/sources;{folder}/sources/external",
            "CMAKE_C_STANDARD_LIBRARIES:STRING": " ".join(libraries),
        },
    )

    def heights(fmu: Path) -> Any:
        result = simulate_fmu(str(fmu), fmi_type="CoSimulation", stop_time=1.0, output=["ball.r_0[3]"])
        return result["ball.r_0[3]"]

    assert np.allclose(heights(folder), heights(ball_on_floor), rtol=0.0, atol=1e-9)


def test_headers_of_the_sources_are_all_there(unpacked: Unpacked) -> None:
    """No source includes a file that lies neither in the folder nor in the system."""
    sources = unpacked.folder / "sources"
    for source in sources.glob("*.c"):
        command = ["gcc", "-std=c11", "-nostdinc", "-M", "-MG", "-I", sources, "-I", sources / "external", source]
        listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        missing = {name for name in listed.replace("\\\n", " ").split()[1:] if not Path(name).is_file()}
        assert missing <= STANDARD_HEADERS, source.name
