"""Reads the VRML files of a folder and compares them with VTK and MeshLab. As a script: counts.

python vrml_collection.py FOLDER ...     at most 400 files of each folder, evenly taken from all
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from cad2modelica.meshio.vrml_scene import read_scene
from contact_foundation.errors import InputError
from meshlab_oracle import distances, meshlab_triangles, round_error, with_faces
from scipy.spatial import cKDTree
from vtk_oracle import prepared, text_of, understood, vtk_points

MOST_FILES = 400  # of each folder
SINGLE = 2e-6  # of the size: both oracles compute in single precision
ROUND = re.compile(r"\b(Sphere|Cylinder|Cone)\b")
REASONS = (
    "leaves the assembly's folder",
    "which does not exist",
    "is not valid VRML 2.0",
    "is not a VRML 2.0 file",
)


@dataclass(frozen=True)
class Comparison:
    """What an oracle says.

    Attributes:
        unknown: why it says nothing; empty if it does.
        distance: of its corners from ours, over the tolerance.
        complete: whether it shows all that we read, too; both leave out some shapes.
    """

    unknown: str = ""
    distance: float = 0.0
    complete: bool = False


@dataclass(frozen=True)
class Outcome:
    """What came of a file.

    Attributes:
        refusal: the reader's message; empty if the file was read.
        shapes: number of shapes read.
        comparisons: by oracle; none of a file without faces.
    """

    refusal: str = ""
    shapes: int = 0
    comparisons: Mapping[str, Comparison] = field(default_factory=dict)

    @property
    def reason(self) -> str:
        """The known reason of the refusal; empty if it is none of these."""
        return next((words for words in REASONS if words in self.refusal), "")

    @property
    def compared(self) -> list[Comparison]:
        """What the oracles say that know the file."""
        return [comparison for comparison in self.comparisons.values() if not comparison.unknown]


def files_of(folder: Path, most: int = MOST_FILES) -> list[Path]:
    """Files of a folder in the order of their names, evenly taken from all if there are more."""
    found = sorted(file for ending in ("wrl", "wrl.gz", "wrz") for file in folder.rglob(f"*.{ending}"))
    return found[:: max(1, -(-len(found) // most))]


def examine(file: Path, folder: Path, scratch: Path, oracles: Sequence[str] = ("VTK", "MeshLab")) -> Outcome:
    """Reads a file of a folder, and compares the corners of its faces with those that the oracles show."""
    try:
        scene = read_scene(file, folder)
    except InputError as error:
        return Outcome(refusal=str(error))
    placed = [shape.placed() for shape in scene.shapes]
    if not placed:
        return Outcome()
    corners = np.concatenate([vertices[triangles] for vertices, triangles in placed])
    found = {oracle: ORACLES[oracle](file, corners, scratch) for oracle in oracles}
    return Outcome(shapes=len(placed), comparisons=found)


def _with_vtk(file: Path, corners: np.ndarray, scratch: Path) -> Comparison:
    text = text_of(file)
    if not understood(text):
        return Comparison(unknown="beyond VTK's importer")
    plain = scratch / "plain.wrl"
    plain.write_text(prepared(text))
    theirs = vtk_points(plain, scratch)
    if theirs is None or len(theirs) < 4:
        return Comparison(unknown="crashed" if theirs is None else "shows nothing")
    ours = corners.reshape(-1, 3)
    tolerance = SINGLE * np.ptp(ours, axis=0).max()
    return Comparison(
        distance=float(cKDTree(ours).query(theirs)[0].max() / tolerance),
        complete=bool(cKDTree(theirs).query(ours)[0].max() <= tolerance),
    )


def _with_meshlab(file: Path, corners: np.ndarray, scratch: Path) -> Comparison:
    text = text_of(file)
    plain = file
    if file.read_bytes()[:2] == b"\x1f\x8b" or with_faces(text) != text:  # a copy, which finds no other files
        plain = scratch / "plain.wrl"
        plain.write_text(with_faces(text))
    theirs = meshlab_triangles(plain, scratch)
    if theirs is None:
        return Comparison(unknown="refuses or crashes")
    size = float(np.ptp(corners.reshape(-1, 3), axis=0).max())
    tolerance = SINGLE * size + (round_error(size) if ROUND.search(text) else 0.0)
    of_theirs, of_ours = distances(corners, theirs)
    return Comparison(distance=of_theirs / tolerance, complete=of_ours <= tolerance)


ORACLES = {"VTK": _with_vtk, "MeshLab": _with_meshlab}


def main() -> None:
    """Prints the counts of each folder, and what is wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="+")
    parser.add_argument("--most", type=int, default=MOST_FILES)
    parser.add_argument("--oracle", choices=list(ORACLES), action="append")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        for folder in given.folder:
            counts: Counter[str] = Counter()
            for file in files_of(folder, given.most):
                outcome = examine(file, folder, Path(name), given.oracle or tuple(ORACLES))
                counts["files"] += 1
                if outcome.refusal:
                    counts[f"refused: {outcome.reason or outcome.refusal}"] += 1
                    continue
                counts["read"] += 1
                counts["compared" if outcome.compared else "not compared" if outcome.shapes else "no faces"] += 1
                for oracle, comparison in outcome.comparisons.items():
                    counts[f"{oracle}: {comparison.unknown or 'compared'}"] += 1
                    counts[f"{oracle}: complete"] += comparison.complete
                    if comparison.distance > 1.0:
                        counts[f"{oracle}: apart"] += 1
                        sys.stdout.write(f"{file}: {comparison.distance:g} tolerances from {oracle}\n")
            sys.stdout.write(f"{folder}: {dict(sorted(counts.items()))}\n")


if __name__ == "__main__":
    main()
