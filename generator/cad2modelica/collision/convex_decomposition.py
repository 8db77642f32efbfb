"""Convex decomposition of a closed mesh with CoACD or V-HACD.

Sources: X. Wei, M. Liu, Z. Ling, H. Su, "Approximate Convex Decomposition for 3D Meshes with Collision-Aware Concavity
and Tree Search", ACM Transactions on Graphics 41 (4), 2022. K. Mamou, "Volumetric Hierarchical Approximate Convex
Decomposition", in: E. Lengyel, ed., Game Engine Gems 3, 2016.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Any
from zipfile import BadZipFile

import numpy as np
from contact_foundation.cache import user_cache
from contact_foundation.child_process import ChildLimits, run_child
from contact_foundation.scratch import scratch_folder
from numpy.typing import NDArray

from cad2modelica.collision.decomposition_cache import content_key, read_pieces, write_pieces
from cad2modelica.geometry.mesh import Indices
from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import Decomposer

MAXIMUM_CORNERS = 64  # of a piece: the cost of a distance grows with them
MAXIMUM_TRIANGLES = 50_000  # CoACD's time grows with them: about half a minute here
_PACKAGES = {Decomposer.COACD: "coacd", Decomposer.VHACD: "vhacdx"}
_PROCESSES = {
    Decomposer.COACD: "cad2modelica.collision.coacd_process",
    Decomposer.VHACD: "cad2modelica.collision.vhacd_process",
}
_NAMES = {Decomposer.COACD: "CoACD", Decomposer.VHACD: "V-HACD"}
TIME_LIMIT = 30  # s of processor time for small meshes: CoACD does not end on a few
TRIANGLES_PER_SECOND = 500  # that a larger mesh has more; both are about five times what CoACD takes for 16 pieces
PIECES_IN_TIME = 16  # more of them have more time
WALL_FACTOR = 20  # times as long by the clock, for a machine that is busy otherwise
SEED = 0
SEARCH = {"resolution": 1000, "nodes": 10, "iterations": 30}  # of the search; CoACD: 2000, 20, 150


Task = Mapping[str, NDArray[Any] | np.generic]


@dataclass(frozen=True)
class Decomposition:
    """Pieces of a body, or why there are none.

    Attributes:
        pieces: corners of the convex pieces, each of shape (n, 3), m; empty if the body could not be decomposed.
        failure: what went wrong, for the notes, also where another decomposer helped; empty if nothing did.
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

    The same mesh gives the same pieces: the search has a fixed seed. Results are kept in the user's cache, and so is
    that there is none within the time. Where CoACD gives no pieces, V-HACD is asked.

    Args:
        vertices: of a closed mesh, shape (n, 3), m.
        triangles: shape (m, 3), counter-clockwise seen from outside.
        error: concavity a piece may keep with CoACD, Hausdorff distance of body and pieces with V-HACD, m.
        maximum_pieces: largest number of pieces; counts before the error.
        decomposer: what decomposes.
    """
    if len(triangles) > MAXIMUM_TRIANGLES:
        return Decomposition((), f"has {len(triangles)} triangles, more than {MAXIMUM_TRIANGLES}; export it coarser")
    done = _decomposed(vertices, triangles, error, maximum_pieces, decomposer)
    if done.pieces or decomposer is Decomposer.VHACD:
        return done
    instead = _decomposed(vertices, triangles, error, maximum_pieces, Decomposer.VHACD)
    failure = f"{done.failure}; {f'{_NAMES[Decomposer.VHACD]} instead' if instead.pieces else instead.failure}"
    return Decomposition(instead.pieces, failure)


def _decomposed(
    vertices: Array, triangles: Indices, error: float, maximum_pieces: int, decomposer: Decomposer
) -> Decomposition:
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
    return Decomposition(pieces, "" if pieces else f"{_NAMES[decomposer]} took longer than {_time_limit(task)} s")


def _time_limit(task: Task) -> int:
    """Seconds of processor time, by what is to be done."""
    triangles, pieces = len(np.asarray(task["triangles"])), int(task["pieces"])
    return int((TIME_LIMIT + triangles / TRIANGLES_PER_SECOND) * max(1.0, pieces / PIECES_IN_TIME))


def _run(task: Task, decomposer: Decomposer) -> tuple[tuple[Array, ...] | None, str]:
    """Pieces, none if the time was not enough; None and the reason if the run itself failed."""
    name = _NAMES[decomposer]
    with scratch_folder("decomposition") as folder:
        task_file, result_file = folder / "task.npz", folder / "result.npz"
        np.savez(task_file, allow_pickle=False, **task)
        # -P: what lies in the current folder is no module of ours.
        command = [sys.executable, "-P", "-m", _PROCESSES[decomposer], str(task_file), str(result_file)]
        limit = _time_limit(task)
        end = run_child(command, ChildLimits(limit, WALL_FACTOR * limit))
        if end.overran == "wall":
            return None, f"{name} took longer than {WALL_FACTOR * limit} s on a busy machine"
        if end.overran == "cpu":
            return (), ""
        if end.status != 0:
            return None, f"{name} failed with status {end.status}: {end.complaint}"
        try:
            with np.load(result_file, allow_pickle=False) as result:
                pieces = tuple(np.asarray(result[entry]) for entry in result.files)
        except (OSError, ValueError, BadZipFile):
            return None, f"{name} wrote no result"
    return (pieces, "") if pieces else (None, f"{name} found no pieces")
