"""Reads the VRML files of a folder and compares them with VTK. As a script: counts.

python vrml_collection.py FOLDER ...     at most 400 files of each folder, evenly taken from all
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from cad2modelica.vrml_scene import read_scene
from cmb_base.errors import InputError
from scipy.spatial import cKDTree
from vtk_oracle import prepared, text_of, understood, vtk_points

MOST_FILES = 400  # of each folder
SINGLE = 2e-6  # of the size: VTK computes in single precision
REASONS = (
    "leaves the assembly's folder",
    "which does not exist",
    "is not valid VRML 2.0",
    "is not a VRML 2.0 file",
)


@dataclass(frozen=True)
class Outcome:
    """What came of a file.

    Attributes:
        refusal: the reader's message; empty if the file was read.
        shapes: number of shapes read.
        uncompared: why VTK did not check it; empty if it did.
        distance: of VTK's corners from ours, over the tolerance of single precision.
        complete: whether VTK shows all corners that we read, too; it leaves out a shape now and then.
    """

    refusal: str = ""
    shapes: int = 0
    uncompared: str = ""
    distance: float = 0.0
    complete: bool = False

    @property
    def reason(self) -> str:
        """The known reason of the refusal; empty if it is none of these."""
        return next((words for words in REASONS if words in self.refusal), "")


def files_of(folder: Path, most: int = MOST_FILES) -> list[Path]:
    """Files of a folder in the order of their names, evenly taken from all if there are more."""
    found = sorted(file for ending in ("wrl", "wrl.gz", "wrz") for file in folder.rglob(f"*.{ending}"))
    return found[:: max(1, -(-len(found) // most))]


def examine(file: Path, folder: Path, scratch: Path) -> Outcome:
    """Reads a file of a folder, and compares the corners of its faces with those that VTK shows."""
    try:
        scene = read_scene(file, folder)
    except InputError as error:
        return Outcome(refusal=str(error))
    points = [vertices[np.unique(triangles)] for vertices, triangles in (shape.placed() for shape in scene.shapes)]
    text = text_of(file)
    if not points:
        return Outcome(uncompared="no faces")
    if not understood(text):
        return Outcome(shapes=len(points), uncompared="beyond VTK's importer")
    plain = scratch / "plain.wrl"
    plain.write_text(prepared(text))
    theirs = vtk_points(plain, scratch)
    if theirs is None or len(theirs) < 4:
        return Outcome(shapes=len(points), uncompared="VTK crashed" if theirs is None else "VTK shows nothing")
    ours = np.concatenate(points)
    tolerance = SINGLE * np.ptp(ours, axis=0).max()
    return Outcome(
        shapes=len(points),
        distance=float(cKDTree(ours).query(theirs)[0].max() / tolerance),
        complete=bool(cKDTree(theirs).query(ours)[0].max() <= tolerance),
    )


def main() -> None:
    """Prints the counts of each folder, and what is wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="+")
    parser.add_argument("--most", type=int, default=MOST_FILES)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        for folder in given.folder:
            counts: Counter[str] = Counter()
            for file in files_of(folder, given.most):
                outcome = examine(file, folder, Path(name))
                counts["files"] += 1
                if outcome.refusal:
                    counts[f"refused: {outcome.reason or outcome.refusal}"] += 1
                    continue
                counts["read"] += 1
                counts[f"not compared: {outcome.uncompared}" if outcome.uncompared else "compared"] += 1
                counts["complete in VTK"] += outcome.complete
                if outcome.distance > 1.0:
                    counts["apart"] += 1
                    sys.stdout.write(f"{file}: {outcome.distance:g} tolerances\n")
            sys.stdout.write(f"{folder}: {dict(sorted(counts.items()))}\n")


if __name__ == "__main__":
    main()
