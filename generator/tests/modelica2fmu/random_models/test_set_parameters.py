"""Parameters that are set on an FMU do what the same values do in the source: FMUs of both begin alike.

``CMB_SETTINGS=50`` takes so many random settings of each model.
"""

from __future__ import annotations

import os
import random
from collections.abc import Mapping
from pathlib import Path

import pytest
from contact_data import checkout
from fmpy import read_model_description, simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

MANY = int(os.environ.get("CMB_SETTINGS", "4"))
CLOSE = 1e-9
MODELS = ("BlockOnMat", "RollingResistance", "BallWithoutEvents")
# Modifiers of a record's fields beside its value are refused, and solvers are no part of the source.
LEFT_OUT = ("cmbSolver.", ".material.")
UNLIMITED = 1e50

Settings = Mapping[str, float]


def modifiers(settings: Settings) -> str:
    """``a(b = 2)`` of ``a.b``."""
    parts = []
    for name, value in settings.items():
        *around, last = name.split(".")
        text = f"{last} = {value!r}"
        for each in reversed(around):
            text = f"{each}({text})"
        parts.append(text)
    return ", ".join(parts)


def begins(fmu: Path, settings: Settings) -> dict[str, float]:
    """The values of all Real variables at the start."""
    found = read_model_description(str(fmu)).modelVariables
    names = [each.name for each in found if each.type == "Real" and not each.name.startswith("cmbSolver.")]
    result = simulate_fmu(str(fmu), start_values=dict(settings), output=names, stop_time=1e-6, output_interval=1e-6)
    return {name: float(result[name][0]) for name in names}


def random_settings(fmu: Path, choose: random.Random) -> Settings:
    """Scalar parameters, each by up to a third larger: within all bounds, and moments of inertia stay possible."""
    found = [
        each
        for each in read_model_description(str(fmu)).modelVariables
        if each.type == "Real" and each.causality == "parameter" and "[" not in each.name
    ]
    values = {
        each.name: float(each.start)
        for each in found
        if 0 < abs(float(each.start)) < UNLIMITED and not any(part in each.name for part in LEFT_OUT)
    }
    factor = round(choose.uniform(1.1, 1.3), 3)
    chosen = choose.sample(sorted(values), choose.randint(1, 4))
    return {name: values[name] * factor for name in chosen}


@pytest.mark.full
@pytest.mark.parametrize("model", MODELS)
def test_set_and_written_parameters_do_the_same(model: str, tmp_path: Path, fmu_cache: Path) -> None:
    library, options = checkout() / "ContactMultiBody", BuildOptions(cache=fmu_cache)
    source = tmp_path / "Changed.mo"

    def built(modified: str, name: str) -> Path:
        source.write_text(f"model Changed\n  extends ContactMultiBody.Examples.{model}{modified};\nend Changed;\n")
        return build_fmu("Changed", [source, library], tmp_path / name, options).fmu

    plain = built("", "plain.fmu")
    choose = random.Random(f"{model} 1")
    for _ in range(MANY):
        settings = random_settings(plain, choose)
        written, as_set = begins(built(f"({modifiers(settings)})", "written.fmu"), {}), begins(plain, settings)
        wrong = {
            name: (as_set[name], value)
            for name, value in written.items()
            if name in as_set and abs(as_set[name] - value) > CLOSE * (1 + abs(value))
        }
        assert not wrong, settings
