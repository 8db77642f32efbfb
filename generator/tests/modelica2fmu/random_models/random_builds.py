"""Builds the models of random samplers and collects what is wrong of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from contact_foundation.errors import InputError, UnsupportedModelError
from modelica2fmu.build import BuildOptions, build_fmu


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
