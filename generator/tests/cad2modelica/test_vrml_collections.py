"""VRML files as many programs write them, read and compared with VTK.

Runs where Debian's packages kicad-packages3d, whitedune-docs or castle-game-engine-doc are installed, or where
CMB_VRML_COLLECTION names folders (separated by colons).
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from cad2modelica.vrml_scene import read_scene
from cmb_base.errors import InputError
from scipy.spatial import cKDTree
from vtk_oracle import prepared, text_of, understood, vtk_points

INSTALLED = (
    "/usr/share/kicad/3dmodels",
    "/usr/share/doc/whitedune-docs",
    "/usr/share/doc/castle-game-engine-doc",
)
MOST_FILES = 400  # of each folder, evenly taken from all
WORDS_OF_REFUSAL = (
    "leaves the assembly's folder",
    "which does not exist",
    "is not valid VRML 2.0",
    "is not a VRML 2.0 file",
)


def folders() -> list[Path]:
    named = os.environ.get("CMB_VRML_COLLECTION")
    return [Path(name) for name in (named.split(":") if named else INSTALLED) if Path(name).is_dir()]


def files_of(folder: Path) -> list[Path]:
    found = sorted(file for ending in ("wrl", "wrl.gz", "wrz") for file in folder.rglob(f"*.{ending}"))
    return found[:: max(1, -(-len(found) // MOST_FILES))]


@pytest.mark.skipif(not folders(), reason="no collection of VRML files is installed")
@pytest.mark.parametrize("folder", folders(), ids=lambda folder: folder.name)
def test_collection(folder: Path, tmp_path: Path) -> None:
    """Every file is read, or refused for a reason in the file; every corner that VTK shows is ours, at its place."""
    pytest.importorskip("vtk", reason="VTK is the oracle for positions")
    refused, compared, complete, wrong = [], 0, 0, []
    for file in files_of(folder):
        try:
            scene = read_scene(file, folder)
        except InputError as error:
            refused.append(file)
            if not any(words in str(error) for words in WORDS_OF_REFUSAL):
                wrong.append(str(error))
            continue
        points = [vertices[np.unique(triangles)] for vertices, triangles in (shape.placed() for shape in scene.shapes)]
        text = text_of(file)
        if not points or not understood(text):
            continue
        plain = tmp_path / "plain.wrl"
        plain.write_text(prepared(text))
        theirs = vtk_points(plain, tmp_path)
        if theirs is None or len(theirs) < 4:
            continue
        ours = np.concatenate(points)
        tolerance = 2e-6 * np.ptp(ours, axis=0).max()  # VTK computes in single precision
        compared += 1
        complete += cKDTree(theirs).query(ours)[0].max() <= tolerance  # VTK leaves out a shape now and then
        if (distance := cKDTree(ours).query(theirs)[0].max()) > tolerance:
            wrong.append(f"{file}: {distance}")
    assert not wrong
    assert complete > compared / 2
