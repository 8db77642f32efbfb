"""Runs CoACD in a process of its own: ``python -m cad2modelica.collision.coacd_process TASK.npz RESULT.npz``.

Native code that a mesh makes crash takes this process down, not the generator; and what it prints does not mix with the
generator's own output.
"""

from __future__ import annotations

import sys
from pathlib import Path

import coacd
import numpy as np


def main(task: Path, result: Path) -> None:
    """Decomposes the mesh of a task file (arrays vertices, triangles, error, pieces, corners, seed)."""
    with np.load(task, allow_pickle=False) as given:
        coacd.set_log_level("error")
        parts = coacd.run_coacd(
            coacd.Mesh(given["vertices"], given["triangles"]),
            threshold=float(given["error"]),
            real_metric=True,
            max_convex_hull=int(given["pieces"]),
            max_ch_vertex=int(given["corners"]),
            decimate=True,
            preprocess_mode="off",
            resolution=int(given["resolution"]),
            mcts_nodes=int(given["nodes"]),
            mcts_iterations=int(given["iterations"]),
            seed=int(given["seed"]),
        )
    np.savez(result, *(np.asarray(vertices, dtype=np.float64) for vertices, _ in parts))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
