"""Builds the models of random samplers and collects what is wrong of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from contact_foundation.errors import InputError, UnsupportedModelError
from fmpy import read_model_description, simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

ROUNDING = 1e-9


def wrong_values(expected: Mapping[str, float], fmu: Path) -> list[str]:
    """The parameters and variables that are missing or have another value."""
    found = {each.name for each in read_model_description(str(fmu)).modelVariables}
    wrong = [f"{name} is missing" for name in expected if name not in found]
    names = [name for name in expected if name in found]
    result = simulate_fmu(str(fmu), stop_time=0.1, output_interval=0.1, output=names)
    for name in names:
        value = float(result[name][-1])
        if abs(value - expected[name]) > ROUNDING * (1 + abs(expected[name])):
            wrong.append(f"{name} = {value}, not {expected[name]}")
    return wrong


def sampled(
    folder: Path, cache: Path, models: Iterable[tuple[int, str, Callable[[Path], Iterable[str]]]], name: str = "M"
) -> tuple[int, list[str]]:
    """How many models were built, as refused ones count for nothing, and what is wrong of them.

    Args:
        folder: an empty one.
        cache: of ``BuildOptions``, for what all FMUs have in common.
        models: seed, text of a file, and what is wrong of its model's FMU.
        name: of the model.
    """
    source, fmu = folder / f"{name.partition('.')[0]}.mo", folder / "M.fmu"
    taken, failures = 0, []
    for seed, text, wrong in models:
        source.write_text(text, encoding="utf-8")
        try:
            build_fmu(name, [source], fmu, BuildOptions(cache=cache))
        except (InputError, UnsupportedModelError):
            continue
        taken += 1
        failures += [f"seed {seed}: {each}\n{text}" for each in wrong(fmu)]
    return taken, failures
