"""A simulated study's database, as if observers had answered."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
from contact_foundation.output import whole_file

from depth_study.arrays import FloatArray, IntArray
from depth_study.record.database import Answer, create_database
from depth_study.simulation.observers import Population, draw_answers

_NEVER = datetime(1970, 1, 1, tzinfo=UTC)  # nobody answered, and equal seeds shall give equal files


def write_simulated_study(
    target: Path, design_file: Path, sequences: IntArray, levels: FloatArray, population: Population, seed: int
) -> None:
    """Writes the database of one study whose observers are drawn; it appears whole or not at all.

    Args:
        target: a file that does not exist.
        design_file: TOML of the design.
        sequences: of the observers 1, 2, ...; shape (observers, positions).
        levels: true ones; shape (constellations,).
        population: what observers are drawn from.
        seed: of the chance.
    """
    drawn = draw_answers(levels, sequences, population, 1, np.random.default_rng((seed, len(sequences), 1)))
    with whole_file(target) as staging:
        database = create_database(staging, design_file.read_text(encoding="utf-8"), seed)
        try:
            for observer, sequence in enumerate(sequences, 1):
                absolute, relative = drawn.absolute[0, observer - 1], drawn.relative[0, observer - 1]
                database.add_observer(observer, sequence)
                database.store_all(
                    observer,
                    [
                        Answer(k, int(score), None if k == 0 else int(difference))
                        for k, (score, difference) in enumerate(zip(absolute, np.nan_to_num(relative), strict=True))
                    ],
                    at=_NEVER,
                )
        finally:
            database.close()
