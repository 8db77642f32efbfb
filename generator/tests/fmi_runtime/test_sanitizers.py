"""The runtime under the address, undefined-behaviour and thread sanitizers, driven by C programs."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import fixture_models as models
import pytest
from modelica2fmu.description import ModelDescription
from modelica2fmu.packaging import SolverOptions
from modelica2fmu.packaging.dependencies import find_fmi_headers, find_sundials
from modelica2fmu.packaging.interface_tables import interface_source
from modelica2fmu.packaging.package import RUNTIME

MODELS = {
    "oscillator": models.OSCILLATOR,
    "ball": models.BALL,
    "schedule": models.SCHEDULE,
    "guarded": models.GUARDED,
    "switching": models.SWITCHING,
}
EXTERNAL = {"guarded": ("guard", "digits", "digits_base")}


def build(name: str, description: ModelDescription, driver: str, sanitizer: str, folder: Path) -> Path:
    (folder / "cmb_interface.c").write_text(interface_source(description, SolverOptions()), encoding="utf-8")
    program = folder / driver
    sources = [*sorted(RUNTIME.glob("*.c")), folder / "cmb_interface.c"]
    sources += [models.FIXTURES / f"{file}.c" for file in (driver, name, *EXTERNAL.get(name, ()))]
    sundials = find_sundials()
    includes = [f"-I{path}" for path in (RUNTIME, models.FIXTURES, find_fmi_headers(), sundials.include)]
    command = ["gcc", "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-O1", "-g", f"-fsanitize={sanitizer}"]
    command += ["-fno-sanitize-recover=all", *includes, *map(str, sources), str(sundials.archive), "-lm", "-lpthread"]
    subprocess.run([*command, "-o", str(program)], check=True)
    return program


@pytest.mark.parametrize(
    ("driver", "name"), [("driver", name) for name in MODELS] + [("driver3", "ball"), ("driver3", "schedule")]
)
def test_random_calls_break_nothing(driver: str, name: str, tmp_path: Path) -> None:
    program = build(name, MODELS[name], driver, "address,undefined", tmp_path)
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=1:detect_stack_use_after_return=1"}
    done = subprocess.run(
        [program, "1", "60"], capture_output=True, text=True, check=False, timeout=120, env=environment
    )
    assert done.returncode == 0, done.stdout + done.stderr[-4000:]
    assert done.stderr == ""
    answers = [int(number) for number in re.findall(r"\d+", done.stdout)]
    assert answers[0] > 1000  # both what is permitted and what is not was tried
    assert answers[3] > 1000


def test_threads_share_nothing(tmp_path: Path) -> None:
    program = build("ball", models.BALL, "parallel", "thread", tmp_path)
    done = subprocess.run([program], capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr[-4000:]
    assert float(done.stdout) == pytest.approx(0.0, abs=2.0)
