"""The runtime under the address, undefined-behaviour and thread sanitizers, driven by C programs."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import fixture_models as models
import pytest
from modelica2fmu.packaging import SolverOptions
from modelica2fmu.packaging.dependencies import find_fmi_headers, find_sundials
from modelica2fmu.packaging.interface_tables import interface_source
from modelica2fmu.packaging.runtime_sources import runtime_files, runtime_folders

MODELS = {
    "oscillator": models.OSCILLATOR,
    "ball": models.BALL,
    "schedule": models.SCHEDULE,
    "guarded": models.GUARDED,
    "switching": models.SWITCHING,
}
QUICK = {"guarded"}
EXTERNAL = {"guarded": ("guard", "digits", "digits_base")}


Builder = Callable[[str, str, str, Path], Path]


@pytest.fixture(scope="session")
def build(tmp_path_factory: pytest.TempPathFactory) -> Builder:
    """Builds a driver with a model, the runtime's objects once for each sanitizer."""
    objects: dict[str, list[Path]] = {}
    sundials = find_sundials()
    includes = [f"-I{path}" for path in (*runtime_folders(), models.FIXTURES, find_fmi_headers(), sundials.include)]
    common = ["gcc", "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-O0", "-g1", "-fno-sanitize-recover=all", *includes]

    def run(*command: str | Path, folder: Path) -> None:
        subprocess.run([str(part) for part in command], check=True, cwd=folder)

    def build_driver(driver: str, name: str, sanitizer: str, folder: Path) -> Path:
        flag = f"-fsanitize={sanitizer}"
        if sanitizer not in objects:
            target = tmp_path_factory.mktemp("runtime")
            run(*common, flag, "-c", *(path for path in runtime_files() if path.suffix == ".c"), folder=target)
            objects[sanitizer] = sorted(target.glob("*.o"))
        (folder / "fmurt_interface.c").write_text(interface_source(MODELS[name], SolverOptions()), encoding="utf-8")
        sources = [models.FIXTURES / f"{file}.c" for file in (driver, name, *EXTERNAL.get(name, ()))]
        run(
            *common, flag, "fmurt_interface.c", *sources, *objects[sanitizer], sundials.archive, "-lm", "-lpthread",
            "-o", driver, folder=folder,
        )  # fmt: skip
        return folder / driver

    return build_driver


@pytest.mark.parametrize(
    ("driver", "name"),
    [
        *(pytest.param("driver", name, marks=() if name in QUICK else pytest.mark.full) for name in MODELS),
        ("driver3", "ball"),
        pytest.param("driver3", "schedule", marks=pytest.mark.full),
    ],
)
def test_random_calls_break_nothing(driver: str, name: str, build: Builder, tmp_path: Path) -> None:
    program = build(driver, name, "address,undefined", tmp_path)
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=1:detect_stack_use_after_return=1"}
    done = subprocess.run(
        [program, "1", "60"], capture_output=True, text=True, check=False, timeout=120, env=environment
    )
    assert done.returncode == 0, done.stdout + done.stderr[-4000:]
    assert done.stderr == ""
    answers = [int(number) for number in re.findall(r"\d+", done.stdout)]
    assert answers[0] > 1000  # both what is permitted and what is not was tried
    assert answers[3] > 1000


def test_threads_share_nothing(build: Builder, tmp_path: Path) -> None:
    program = build("parallel", "ball", "thread", tmp_path)
    done = subprocess.run([program], capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr[-4000:]
    assert float(done.stdout) == pytest.approx(0.0, abs=2.0)
