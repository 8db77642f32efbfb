"""What is in an FMU file, and that it works wherever it is unpacked."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import fixture_models as models
import pytest
from contact_foundation.errors import BuildError, CmbError, InputError
from fmpy import read_model_description
from lxml import etree
from modelica2fmu.codegen.generated_source import GeneratedSource
from modelica2fmu.description.model_description import ModelDescription, Resource
from modelica2fmu.library.external_code import ExternalCode
from modelica2fmu.packaging import SolverOptions, package_fmu
from modelica2fmu.packaging.dependencies import find_fmi_headers, find_sundials
from modelica2fmu.packaging.fmi2_description import fmi2_description


def unpack(fmu: Path, folder: Path) -> Path:
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    return folder


@pytest.mark.parametrize("name", ["oscillator", "guarded"])
def test_the_library_shows_the_fmi_functions_only(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    folder = unpack(request.getfixturevalue(name), tmp_path)
    (library,) = (folder / "binaries" / "linux64").glob("[A-Z]*.so")
    listed = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True)
    symbols = {line.split()[-1] for line in listed.stdout.splitlines()}
    assert {"fmi2Instantiate", "fmi2DoStep", "fmi2GetDerivatives", "fmi2GetFMUstate"} <= symbols
    assert all(re.match(r"fmi[23][A-Z]", symbol) for symbol in symbols)


def test_nothing_but_system_libraries_is_needed(oscillator: Path, tmp_path: Path) -> None:
    library = unpack(oscillator, tmp_path) / "binaries" / "linux64" / "Oscillator.so"
    dynamic = subprocess.run(["readelf", "-d", library], capture_output=True, text=True, check=True).stdout
    needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic))
    assert needed <= {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"}
    assert "(RPATH)" in dynamic
    assert "[$ORIGIN]" in dynamic
    assert "RUNPATH" not in dynamic


def test_it_runs_elsewhere_with_what_it_brings_along(
    guarded: Path, external_code: ExternalCode, tmp_path: Path
) -> None:
    """The libraries it was linked with are hidden, so only the bundled ones can be found."""
    fmu = shutil.copy(guarded, tmp_path / "moved here.fmu")
    (origin,) = external_code.library_directories
    hidden = origin.with_name("hidden")
    origin.rename(hidden)
    try:
        script = (
            "import sys, fmpy; r = fmpy.simulate_fmu(sys.argv[1], fmi_type=sys.argv[2], stop_time=0.5, output=['x'],"
            " relative_tolerance=1e-8); print(r['x'][-1])"
        )
        environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}
        for kind in ("ModelExchange", "CoSimulation"):
            command = [sys.executable, "-c", script, str(fmu), kind]
            done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd="/", check=True)
            assert float(done.stdout.split()[-1]) == pytest.approx(0.6065306597, abs=1e-6)
    finally:
        hidden.rename(origin)
    with zipfile.ZipFile(fmu) as archive:
        binaries = {name for name in archive.namelist() if name.startswith("binaries/")}
    assert binaries == {f"binaries/linux64/{name}.so" for name in ("Guarded", "libdigits", "libdigitsbase")}


@pytest.mark.parametrize("compiled_anew", [False, pytest.param(True, marks=pytest.mark.full)])
def test_the_same_model_gives_the_same_bytes(
    oscillator: Path, objects: Path, tmp_path: Path, compiled_anew: bool
) -> None:
    target, kept = tmp_path / "other name.fmu", None if compiled_anew else objects
    again = package_fmu(models.OSCILLATOR, models.source("oscillator"), target, objects_folder=kept)
    assert again.read_bytes() == oscillator.read_bytes()


@pytest.mark.full
def test_kept_objects_change_nothing(oscillator: Path, ball: Path, tmp_path: Path) -> None:
    folder = tmp_path / "objects"
    for _ in range(2):
        fmu = package_fmu(models.OSCILLATOR, models.source("oscillator"), tmp_path / "o.fmu", objects_folder=folder)
        assert fmu.read_bytes() == oscillator.read_bytes()
    kept = {path.name: path.stat().st_ino for path in folder.iterdir()}
    assert kept
    other = package_fmu(models.BALL, models.source("ball"), tmp_path / "b.fmu", objects_folder=folder)
    assert other.read_bytes() == ball.read_bytes()
    assert {path.name: path.stat().st_ino for path in folder.iterdir()} == kept  # used, not made again
    for number, path in enumerate(sorted(folder.iterdir())):
        content = path.read_bytes()
        path.write_bytes((b"", content[:-1], content[:-1] + bytes([content[-1] ^ 1]))[number % 3])  # damaged
    fmu = package_fmu(models.OSCILLATOR, models.source("oscillator"), tmp_path / "o.fmu", objects_folder=folder)
    assert fmu.read_bytes() == oscillator.read_bytes()
    for path in folder.iterdir():
        path.unlink()
        path.mkdir()  # can be neither read nor replaced
    assert (
        package_fmu(
            models.OSCILLATOR, models.source("oscillator"), tmp_path / "o.fmu", objects_folder=folder
        ).read_bytes()
        == oscillator.read_bytes()
    )


def test_the_archive_is_tidy(guarded: Path) -> None:
    with zipfile.ZipFile(guarded) as archive:
        names = archive.namelist()
        times = {entry.date_time for entry in archive.infolist()}
        assert archive.read("model.png").startswith(b"\x89PNG")
    assert names == sorted(names)
    assert times == {(1980, 1, 1, 0, 0, 0)}
    assert {"modelDescription.xml", "sources/model.c", "sources/fmi2_functions.c", "sources/fmurt_interface.c"} <= set(
        names
    )
    assert not any(name.endswith((".o", ".map")) for name in names)


def test_licences_of_what_is_inside_come_along(oscillator: Path) -> None:
    if find_sundials().licence is None:
        pytest.skip("this installation of SUNDIALS came without its licence")
    with zipfile.ZipFile(oscillator) as archive:
        assert b"SUNDIALS" in archive.read("documentation/licenses/sundials.txt").upper()


def test_the_sources_compile_as_strict_c(oscillator: Path, tmp_path: Path) -> None:
    folder = unpack(oscillator, tmp_path) / "sources"
    for source in sorted(folder.glob("*.c")):
        command = ["gcc", "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic"]
        command += ["-Wshadow", "-Wstrict-prototypes", "-Werror", f"-I{folder}"]
        command += ["-isystem", str(find_fmi_headers()), "-isystem", str(find_sundials().include), str(source)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr


def test_the_description_says_what_the_model_says(schedule: Path) -> None:
    description = read_model_description(str(schedule))
    variables = {variable.name: variable for variable in description.modelVariables}
    assert description.modelName == "Schedule"
    assert description.coSimulation.canGetAndSetFMUstate
    assert description.coSimulation.canSerializeFMUstate
    assert description.modelExchange.providesDirectionalDerivative
    assert not description.modelExchange.needsExecutionTool
    assert float(description.defaultExperiment.stopTime) == 2.0
    assert [item.name for item in variables["mode"].declaredType.items] == ["up", "down"]
    assert variables["der(x)"].derivative is variables["x"]
    assert [unknown.variable.name for unknown in description.initialUnknowns] == [
        "x", "der(x)", "twice", "level", "ticks", "late", "remark",
    ]  # fmt: skip
    (second,) = [unit for unit in description.unitDefinitions if unit.name == "s"]
    assert (second.baseUnit.s, second.baseUnit.m) == (1, 0)
    (milli,) = second.displayUnits
    assert (milli.name, milli.factor) == ("ms", pytest.approx(1000.0))


def test_the_documentation_shows_what_can_be_set(oscillator: Path) -> None:
    with zipfile.ZipFile(oscillator) as archive:
        page = etree.fromstring(archive.read("documentation/index.html"), etree.HTMLParser())
    texts = {"".join(cell.itertext()) for cell in page.iter("td")}
    assert {"mass", "force", "energy", 'Position "s" <&>', "cmbSolver.maximumStep"} <= texts
    assert "frequency" not in texts


def test_licences_of_bundled_debian_libraries_come_along(tmp_path: Path, objects: Path) -> None:
    """A copy that lies outside the package's folder is recognized by its name."""
    system = Path("/usr/lib/x86_64-linux-gnu/libccd.so.2")
    if not system.exists():
        pytest.skip("libccd is not installed")
    shutil.copyfile(system, tmp_path / "libccd.so.2")
    (tmp_path / "libccd.so").symlink_to("libccd.so.2")
    external = ExternalCode(libraries=("ccd",), library_directories=(tmp_path,))
    source = broken_source("void ccdVec3PointSegmentDist2(void);" + USED + "{ ccdVec3PointSegmentDist2(); }\n")
    model = replace(models.OSCILLATOR, external=external)
    fmu = package_fmu(model, source, tmp_path / "o.fmu", objects_folder=objects)
    with zipfile.ZipFile(fmu) as archive:
        assert "binaries/linux64/libccd.so.2" in archive.namelist()
        assert b"Fiser" in archive.read("documentation/licenses/libccd.so.2.txt")


def test_solver_defaults_reach_the_fmu(tmp_path: Path, objects: Path) -> None:
    options = SolverOptions(relative_tolerance=1e-4, absolute_tolerance=1e-9, maximum_step=0.25)
    source = models.source("oscillator")
    fmu = package_fmu(models.OSCILLATOR, source, tmp_path / "o.fmu", options=options, objects_folder=objects)
    starts = {v.name: v.start for v in read_model_description(str(fmu)).modelVariables if "cmbSolver" in v.name}
    assert [float(starts[f"cmbSolver.{n}"]) for n in ("relativeTolerance", "absoluteTolerance", "maximumStep")] == [
        1e-4, 1e-9, 0.25,
    ]  # fmt: skip


def test_special_characters_stay_what_they_are(oscillator: Path) -> None:
    with zipfile.ZipFile(oscillator) as archive:
        root = etree.fromstring(archive.read("modelDescription.xml"))
    assert root.find(".//ScalarVariable[@name='s']").get("description") == 'Position "s" <&>'


def test_resources_are_packed(tmp_path: Path, objects: Path) -> None:
    data = tmp_path / "table.txt"
    data.write_text("1 2 3", encoding="ascii")
    description = replace(models.OSCILLATOR, resources=(Resource(data, "tables/table.txt"),))
    fmu = package_fmu(description, models.source("oscillator"), tmp_path / "o.fmu", objects_folder=objects)
    with zipfile.ZipFile(fmu) as archive:
        assert archive.read("resources/tables/table.txt") == b"1 2 3"


# Nothing that is linked calls a function of a broken source, so it is made to stay.
USED = "__attribute__((constructor)) static void use(void)"


def broken_source(text: str) -> list[GeneratedSource]:
    return [GeneratedSource("model.c", models.source("oscillator")[0].text + text)]


def variables_with(**change: object) -> tuple[object, ...]:
    first, *rest = models.OSCILLATOR.variables
    return (replace(first, **change), *rest)


@pytest.mark.parametrize(
    ("description", "sources", "error", "text"),
    [
        (models.OSCILLATOR, broken_source("int broken = missing;\n"), BuildError, "error: .missing. undeclared"),
        (models.OSCILLATOR, broken_source("int lost(void);" + USED + "{ lost(); }\n"), BuildError,
         "undefined reference to `lost'"),
        (replace(models.OSCILLATOR, external=ExternalCode(libraries=("absent",))), models.source("oscillator"),
         BuildError, "cannot find -labsent"),
        (replace(models.OSCILLATOR, identifier="no identifier"), models.source("oscillator"), InputError,
         "no C identifier"),
        (models.OSCILLATOR, [GeneratedSource("../model.c", "")], InputError, "no name for a generated C file"),
        (models.OSCILLATOR, [GeneratedSource("fmurt_event.c", "")], InputError, "would be called fmurt_event.c"),
        (replace(models.OSCILLATOR, resources=(Resource(Path(__file__), "../x"),)), models.source("oscillator"),
         InputError, "leaves the folder"),
        (replace(models.OSCILLATOR, states=("s", "lost")), models.source("oscillator"), InputError,
         "lost: this state is not among the variables"),
        (replace(models.OSCILLATOR, variables=variables_with(start=float("inf"))), models.source("oscillator"),
         InputError, "s: the start value inf is not finite"),
        (replace(models.OSCILLATOR, variables=variables_with(start=None)), models.source("oscillator"),
         InputError, "s: a start value is missing"),
        (replace(models.OSCILLATOR, variables=variables_with(description="bell \a")), models.source("oscillator"),
         InputError, "characters that XML does not know"),
    ],
)  # fmt: skip
def test_what_cannot_be_packaged_says_why_and_leaves_nothing(
    description: ModelDescription,
    sources: list[GeneratedSource],
    error: type[CmbError],
    text: str,
    tmp_path: Path,
    objects: Path,
) -> None:
    output = tmp_path / "o.fmu"
    output.write_bytes(b"what was there before")
    with pytest.raises(error, match=text):
        package_fmu(description, sources, output, objects_folder=objects)
    assert [path.name for path in tmp_path.iterdir()] == ["o.fmu"]
    assert output.read_bytes() == b"what was there before"


def test_a_missing_sundials_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CMB_SUNDIALS", str(tmp_path))
    with pytest.raises(BuildError, match="scripts/setup"):
        package_fmu(models.OSCILLATOR, models.source("oscillator"), tmp_path / "o.fmu")


def test_a_missing_compiler_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(BuildError, match="no-such-compiler is not installed"):
        package_fmu(models.OSCILLATOR, models.source("oscillator"), tmp_path / "o.fmu")


def test_shared_libraries_that_report_errors_are_refused(tmp_path: Path, objects: Path) -> None:
    """ModelicaError is not visible outside the FMU's library: only static libraries can call it."""
    source = tmp_path / "loud.c"
    source.write_text('void ModelicaError(const char *);\nvoid loud(void) { ModelicaError("no"); }\n', encoding="ascii")
    subprocess.run(["gcc", "-shared", "-fPIC", "-o", tmp_path / "libloud.so", source], check=True)
    description = replace(
        models.OSCILLATOR, external=ExternalCode(libraries=("loud",), library_directories=(tmp_path,))
    )
    caller = broken_source("void loud(void);" + USED + "{ loud(); }\n")
    with pytest.raises(BuildError, match=r"libloud\.so calls ModelicaError,"):
        package_fmu(description, caller, tmp_path / "o.fmu", objects_folder=objects)


@pytest.mark.parametrize(
    ("name", "convention"),
    [
        ("a.b[1,2].c_d", "structured"),
        ("der(a.b[1].c)", "structured"),
        ("der(a,2)", "structured"),
        ("'odd name'.x[3]", "structured"),
        ("$call[1].scene", "flat"),
        ("a..b", "flat"),
        ("a[1", "flat"),
        ("a b", "flat"),
        ("der(der(a))", "flat"),
    ],
)
def test_the_naming_convention_is_the_one_that_holds(name: str, convention: str) -> None:
    description = replace(models.OSCILLATOR, variables=(*models.OSCILLATOR.variables, models.local(name, 11)))
    assert etree.fromstring(fmi2_description(description)).get("variableNamingConvention") == convention


def test_external_code_finds_the_usual_constants(tmp_path: Path, objects: Path) -> None:
    source = broken_source("double half_turn(void);\ndouble half_turn(void) { return M_PI; }\n")
    assert package_fmu(models.OSCILLATOR, source, tmp_path / "o.fmu", objects_folder=objects).is_file()
