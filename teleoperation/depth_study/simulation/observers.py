"""Observers that are drawn by chance from known levels: with scale, bias, noise and carry-over."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place, ProblemList
from contact_foundation.toml_text import read_toml

from depth_study.arrays import FloatArray, IntArray
from depth_study.record.answers import GREATEST, LEAST, SAME

_MIDDLE = (LEAST + GREATEST) / 2


@dataclass(frozen=True)
class Population:
    """What observers are drawn from; standard deviations but for the carry-over.

    A score is (1 - k) level + k level before + noise with the carry-over k; an observer's absolute answer is
    5 + bias + scale (score - 5), the relative one 5 + bias + scale (difference of scores without their noise + noise),
    each rounded to a number from 1 to 9.
    """

    scale: float = 0.2
    bias: float = 0.6
    relative_bias: float = 0.3
    noise: float = 1.0
    relative_noise: float = 1.0
    carry_over: float = 0.0


@dataclass(frozen=True)
class DrawnAnswers:
    """Answers of drawn studies, in the order of showing, and what the observers drawn were.

    Attributes:
        absolute: 1 to 9; shape (studies, observers, positions).
        relative: 1 to 9, NaN at the first position; same shape.
        scale, bias: of the observers; shape (studies, observers).
    """

    absolute: FloatArray
    relative: FloatArray
    scale: FloatArray
    bias: FloatArray

    def panel_levels(self, levels: FloatArray) -> FloatArray:
        """True levels in the scale of each study's mean observer; shape (studies, constellations)."""
        scale, bias = self.scale.mean(-1, keepdims=True), self.bias.mean(-1, keepdims=True)
        return np.asarray(_MIDDLE + bias + scale * (levels - _MIDDLE))


def draw_answers(
    levels: FloatArray, sequences: IntArray, population: Population, studies: int, chance: np.random.Generator
) -> DrawnAnswers:
    """Draws studies whose observers all finish.

    Args:
        levels: true ones; shape (constellations,).
        sequences: of constellations' numbers; shape (observers, positions).
        population: what observers are drawn from.
        studies: how many studies.
        chance: random numbers.
    """
    shape = (studies, *sequences.shape)
    people = (studies, sequences.shape[0], 1)
    spread = math.sqrt(math.log1p(population.scale**2))
    scale = np.exp(chance.normal(-(spread**2) / 2, spread, people))
    bias = chance.normal(0, population.bias, people)
    shown = levels[sequences]
    before = np.concatenate([shown[:, :1], shown[:, :-1]], axis=1)
    seen = shown + population.carry_over * (before - shown)
    score = seen + chance.normal(0, population.noise, shape)
    absolute = _answer(_MIDDLE + bias + scale * (score - _MIDDLE))
    steps = np.diff(seen, axis=1) + chance.normal(0, population.relative_noise, (*shape[:2], shape[2] - 1))
    relative = np.full(shape, np.nan)
    relative[..., 1:] = _answer(SAME + chance.normal(0, population.relative_bias, people) + scale * steps)
    return DrawnAnswers(absolute, relative, scale[..., 0], bias[..., 0])


def _answer(value: FloatArray) -> FloatArray:
    return np.clip(np.rint(value), LEAST, GREATEST)


def load_population(path: Path) -> Population:
    """The population that a TOML file holds.

    Raises:
        InputError: the file cannot be read or is no TOML; ProblemList with all that is wrong in it.
    """
    data = read_toml(path)
    names = [field.name for field in fields(Population)]
    problems = []
    for key, value in data.items():
        place = Place(file=path, component=key)
        if key not in names:
            problems.append(InputError("is not known", place=place, remedy=f"Known are {', '.join(names)}."))
        elif isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            problems.append(InputError(f"is {value!r}, no number", place=place, remedy="Give a finite number."))
        elif key == "carry_over" and not -1 < value < 1:
            problems.append(InputError(f"is {value:g}", place=place, remedy="Give a share between -1 and 1."))
        elif key != "carry_over" and value < 0:
            problems.append(InputError(f"is {value:g}", place=place, remedy="Standard deviations are not negative."))
    if problems:
        raise ProblemList(f"{path}: observers cannot be drawn", problems)
    return Population(**{key: float(value) for key, value in data.items()})
