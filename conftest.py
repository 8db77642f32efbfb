"""What all tests share: their order, a cache, so that what one test has built the others find, and FMUs by hand."""

from __future__ import annotations

import gc
import os
import subprocess
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import fmpy
import pytest
from contact_foundation.cache import user_cache
from fmu_regression.fmi.fmi2_binding import restore_fmpy_logger

# What takes longest comes first, so that no process is left alone with it at last (scripts/test); browsers apart from
# each other.
LONGEST_FIRST = (
    # build no FMUs, while another process compiles what all FMUs have in common
    "viewer/tests/test_viewer_in_browser.py",
    "generator/tests/modelica2fmu/frontend/test_connections.py",
    # of the full tier
    "command/tests/regression_cases/test_loose_tolerances.py",
    "command/tests/regression_cases/test_reference_cases.py",
    "command/tests/regression_cases/test_loop_closures.py",
    "generator/tests/cad2modelica/kinematics/test_every_loop.py",
    "command/tests/generation/test_anton.py",
    "generator/tests/modelica2fmu/test_fast_bodies.py",
    # of both
    "command/tests/generation/test_hammer.py",
    "generator/tests/cad2modelica/kinematics/test_joints_and_loops.py",
    "generator/tests/fmi_runtime/test_built_fmus.py",
    "Resources/tests/test_core_motion.py",
    "generator/tests/cad2modelica/test_generation.py",
    "command/tests/regression_cases/test_any_size.py",
    "regression/tests/report/test_report_in_browser.py",
    "generator/tests/modelica2fmu/random_models/test_random_classes.py",
    "generator/tests/modelica2fmu/random_models/test_random_events.py",
    "generator/tests/modelica2fmu/random_models/test_random_models.py",
    "Resources/tests/test_core_drives.py",
    "teleoperation/tests/depth/test_page_in_browser.py",
    "generator/tests/modelica2fmu/crosscheck/test_modifiers.py",
    "generator/tests/modelica2fmu/expand/test_bounds.py",
    "library-tests/text/test_flatten.py",
    "generator/tests/modelica2fmu/frontend/test_remedies.py",
    "teleoperation/tests/drive/test_drive_in_browser.py",
    "generator/tests/modelica2fmu/test_simulated_models.py",
    "generator/tests/modelica2fmu/frontend/test_concatenation.py",
    "generator/tests/modelica2fmu/test_models_of_parts.py",
    "generator/tests/cad2modelica/kinematics/test_overconstrained_loops.py",
    "generator/tests/modelica2fmu/expand/test_geometry_files.py",
    "command/tests/studies/test_study_command.py",
    "command/tests/generation/test_assign.py",
    "library-tests/simulation/test_laws.py",
    "generator/tests/cad2modelica/collision/test_collision_shapes.py",
    "generator/tests/modelica2fmu/frontend/test_front_end_errors.py",
    "generator/tests/cad2modelica/urdf/test_urdf.py",
    "command/tests/fmus/test_hand_written_scene.py",
    "generator/tests/cad2modelica/urdf/test_mimic.py",
    "teleoperation/tests/depth/test_sequences.py",
    "generator/tests/cad2modelica/mjcf/test_mjcf.py",
    "regression/tests/accuracy_study/test_study_runs.py",
    "generator/tests/modelica2fmu/crosscheck/test_evaluated_values.py",
    "regression/tests/simulate/test_simulate.py",
    "regression/tests/report/test_report.py",
    "generator/tests/fmi_runtime/test_packaging.py",
)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Puts the longest files first; the rest stays in its order."""
    place = {name: number for number, name in enumerate(LONGEST_FIRST)}
    items.sort(key=lambda item: place.get(item.nodeid.split("::")[0], len(place)))


def pytest_collection_finish() -> None:
    """Takes what was collected, thousands of tests that all stay, out of the work of the garbage collector."""
    gc.collect()
    gc.freeze()


@pytest.fixture(autouse=True)
def fmpy_logger() -> Iterator[None]:
    """Leaves no logger of a test in FMPy, which would hand it the messages of FMUs of later tests, or crash on it."""
    yield
    restore_fmpy_logger()


@pytest.fixture(scope="session", autouse=True)
def cache_home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """XDG_CACHE_HOME of a run of the tests: empty at its beginning, one folder for all of its processes."""
    own = tmp_path_factory.getbasetemp()
    home = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "cache"
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("XDG_CACHE_HOME", str(home))
        yield home


@pytest.fixture(scope="session")
def fmu_cache(cache_home: Path) -> Path:
    """``BuildOptions.cache`` of such tests as are not about building itself; the program finds it there too."""
    return user_cache("fmu", {"XDG_CACHE_HOME": str(cache_home)})


@pytest.fixture(scope="session")
def hand_written_fmu(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Path], Path]:
    """Makes an FMU of FMI 2.0 from a C file and the description beside it (.xml), of the same name."""
    common = Path(__file__).parent / "regression" / "tests" / "fixtures"  # fmi2_common.h
    includes = [f"-I{folder}" for folder in (Path(fmpy.__file__).parent / "c-code", common)]

    def make(source: Path) -> Path:
        target = tmp_path_factory.mktemp("fmu") / f"{source.stem}.fmu"
        library = target.with_suffix(".so")
        options = ["-std=c11", "-D_GNU_SOURCE", "-O1", "-shared", "-fPIC", *includes]
        subprocess.run(["gcc", *options, "-o", library, source, "-lm"], check=True)
        with zipfile.ZipFile(target, "w") as archive:
            archive.write(source.with_suffix(".xml"), "modelDescription.xml")
            archive.write(library, f"binaries/{fmpy.platform}/{library.name}")
        return target

    return make
