"""Convex decomposition of a closed mesh with CoACD or V-HACD.

Sources: X. Wei, M. Liu, Z. Ling, H. Su, "Approximate Convex Decomposition for 3D Meshes with Collision-Aware Concavity
and Tree Search", ACM Transactions on Graphics 41 (4), 2022. K. Mamou, "Volumetric Hierarchical Approximate Convex
Decomposition", in: E. Lengyel, ed., Game Engine Gems 3, 2016.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from cmb_base.cache import user_cache
from numpy.typing import NDArray

from cad2modelica.decomposition_cache import content_key, read_pieces, write_pieces
from cad2modelica.mesh import Indices
from cad2modelica.model import Decomposer
from cad2modelica.spatial import Array

MAXIMUM_CORNERS = 64  # of a piece: the cost of a distance grows with them
MAXIMUM_TRIANGLES = 50_000  # CoACD's time grows with them: about half a minute here
_PACKAGES = {Decomposer.COACD: "coacd", Decomposer.VHACD: "vhacdx"}
_PROCESSES = {Decomposer.COACD: "cad2modelica.coacd_process", Decomposer.VHACD: "cad2modelica.vhacd_process"}
_NAMES = {Decomposer.COACD: "CoACD", Decomposer.VHACD: "V-HACD"}
TIME_LIMIT = 600.0  # s
SEED = 0
SEARCH = {"resolution": 1000, "nodes": 10, "iterations": 30}  # of the search; CoACD: 2000, 20, 150


Task = Mapping[str, NDArray[Any] | np.generic]


@dataclass(frozen=True)
class Decomposition:
    """Pieces of a body, or why there are none.

    Attributes:
        pieces: corners of the convex pieces, each of shape (n, 3), m; empty if the body could not be decomposed.
        failure: what went wrong, for the notes; empty if nothing did.
    """

    pieces: tuple[Array, ...]
    failure: str = ""


def decompose(
    vertices: Array,
    triangles: Indices,
    error: float,
    maximum_pieces: int,
    decomposer: Decomposer = Decomposer.COACD,
) -> Decomposition:
    """Splits a body into convex pieces that stand for it within an error, if the count allows it.

    The same mesh gives the same pieces: the search has a fixed seed. Results are kept in the user's cache.

    Args:
        vertices: of a closed mesh, shape (n, 3), m.
        triangles: shape (m, 3), counter-clockwise seen from outside.
        error: concavity a piece may keep with CoACD, Hausdorff distance of body and pieces with V-HACD, m.
        maximum_pieces: largest number of pieces; counts before the error.
        decomposer: what decomposes.
    """
    if len(triangles) > MAXIMUM_TRIANGLES:
        return Decomposition((), f"has {len(triangles)} triangles, more than {MAXIMUM_TRIANGLES}; export it coarser")
    package = _PACKAGES[decomposer]
    try:
        tool = f"{package} {version(package)}"
    except PackageNotFoundError:
        return Decomposition((), f"the Python package {package} is not installed")
    task: Task = {
        "vertices": np.ascontiguousarray(vertices, dtype=np.float64),
        "triangles": np.ascontiguousarray(triangles, dtype=np.int32),
        "error": np.float64(error),
        "pieces": np.int64(maximum_pieces),
        "corners": np.int64(MAXIMUM_CORNERS),
        "seed": np.int64(SEED),
        **{name: np.int64(value) for name, value in SEARCH.items()},
    }
    entry = user_cache("decomposition") / f"{content_key(tool, task)}.json"
    pieces = read_pieces(entry)
    if pieces is None:
        pieces, failure = _run(task, decomposer)
        if pieces is None:
            return Decomposition((), failure)
        write_pieces(entry, pieces)
    return Decomposition(pieces)


def _run(task: Task, decomposer: Decomposer) -> tuple[tuple[Array, ...] | None, str]:
    with tempfile.TemporaryDirectory(prefix="cmb-") as folder:
        task_file, result_file = Path(folder) / "task.npz", Path(folder) / "result.npz"
        np.savez(task_file, allow_pickle=False, **task)
        # -P: what lies in the current folder is no module of ours.
        command = [sys.executable, "-P", "-m", _PROCESSES[decomposer], str(task_file), str(result_file)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
        except subprocess.TimeoutExpired:
            return None, f"took longer than {TIME_LIMIT:g} s"
        if done.returncode != 0:
            last = (done.stderr.strip().splitlines() or ["no message"])[-1]
            return None, f"{_NAMES[decomposer]} failed with status {done.returncode}: {last}"
        try:
            with np.load(result_file, allow_pickle=False) as result:
                pieces = tuple(np.asarray(result[name]) for name in result.files)
        except (OSError, ValueError, BadZipFile):
            return None, f"{_NAMES[decomposer]} wrote no result"
    return (pieces, "") if pieces else (None, f"{_NAMES[decomposer]} found no pieces")
