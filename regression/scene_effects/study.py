"""The table of effects: the fullest variant of a scene against variants with one effect less."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from contact_foundation.errors import InputError, SimulationError
from contact_foundation.progress import Progress, silent

from scene_effects.choices import EFFECTS
from scene_effects.manager import Manager
from scene_effects.measurement import Bench, Measurement
from scene_effects.observation import PairObservation, observe
from scene_effects.variants import Variant, fullest, variants_of

FULLEST = "everything on"


@dataclass(frozen=True)
class EffectStudy:
    """What the effects of a scene cost.

    Attributes:
        model: qualified name.
        manager: as the model has it.
        observations: one for each pair, from the fullest variant.
        duration: s simulated.
        measurements: the fullest variant, those with less, and the model as it is last; differences are from the first.
    """

    model: str
    manager: Manager
    observations: tuple[PairObservation, ...]
    duration: float
    measurements: tuple[Measurement, ...]


def measure_fullest(bench: Bench) -> tuple[Measurement, tuple[PairObservation, ...]]:
    """The variant with every effect on, and what the pairs did in it.

    Raises:
        SimulationError: it cannot be built or simulated.
    """
    full = bench.measure(Variant(FULLEST, fullest(bench.manager, bench.parameters)))
    if full.result is None:
        raise SimulationError(f"{bench.model} with every effect on failed: {full.error}")
    return full, observe(bench.manager, bench.parameters, full.result)


def study_effects(bench: Bench, effects: Collection[str] = EFFECTS, progress: Progress = silent) -> EffectStudy:
    """Measures every variant of a scene.

    Args:
        bench: builds and runs.
        effects: those to vary, of EFFECTS.
        progress: receives the phase "variants".

    Raises:
        InputError: an effect is unknown.
        SimulationError: the fullest variant cannot be built or simulated.
    """
    unknown = sorted(set(effects) - set(EFFECTS))
    if unknown:
        raise InputError(f"{unknown[0]!r} is no effect", remedy=f"choose of {', '.join(EFFECTS)}")
    full, observations = measure_fullest(bench)
    touching = [k for k, pair in enumerate(observations) if pair.touches]
    variants = variants_of(bench.manager, bench.parameters, touching, effects)
    measured = [full]
    for k, variant in enumerate(variants):
        progress("variants", k / len(variants), variant.name)
        measured.append(bench.measure(variant).against(bench.manager, full))
    progress("variants", 1.0)
    measured.append(bench.as_modelled.against(bench.manager, full))
    assert full.result is not None
    duration = float(full.result.time[-1] - full.result.time[0])
    return EffectStudy(bench.model, bench.manager, observations, duration, tuple(measured))
