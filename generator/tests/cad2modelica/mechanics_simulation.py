"""Simulates generated mechanics without contacts by rumoca and the project's own MultiBody core."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rumoca
from contact_data import checkout

ROOT = checkout()
CORE = ROOT / "Resources" / "MultiBodyCore"


@dataclass(frozen=True)
class Trajectory:
    """Columns by name at every point of time."""

    time: np.ndarray
    columns: dict[str, np.ndarray]

    def vector(self, name: str) -> np.ndarray:
        """A vector variable, shape (points, 3)."""
        return np.column_stack([self.columns[f"{name}[{k}]"] for k in (1, 2, 3)])

    def matrix(self, name: str) -> np.ndarray:
        """A matrix variable, shape (points, 3, 3)."""
        return np.array([[self.columns[f"{name}[{i},{j}]"] for j in (1, 2, 3)] for i in (1, 2, 3)]).transpose(2, 0, 1)


def load(output: Path, model: str, library: Path = CORE) -> rumoca.Model:
    """Compiles a model of the package in ``output``."""
    libraries = output.parent / "libraries"
    libraries.mkdir(exist_ok=True)
    link = libraries / "ContactMultiBody"
    if not link.exists():
        link.symlink_to(ROOT / "ContactMultiBody")
    session = rumoca.Session([str(library), str(libraries), str(output)])
    return session.load(str(output / model.split(".")[0] / "package.mo"), model=model)


def simulate(output: Path, model: str, stop_time: float, step: float, tolerance: float = 1e-10) -> Trajectory:
    """Simulates with tight tolerances; rows every ``step`` seconds."""
    config = rumoca.SimConfig(rtol=tolerance, atol=tolerance / 100, dt=step)
    result = load(output, model).simulate(stop_time, config=config)
    data = np.asarray(result.to_numpy())
    return Trajectory(np.asarray(result.time), dict(zip(result.names, data, strict=True)))
