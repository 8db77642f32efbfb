"""VTK's VRML importer as the oracle for world positions, fed with what it understands.

It ignores center and scaleOrientation, applies a Transform's fields in the order of the text instead of the standard's,
loses shear (a rotation below unequal scales), cannot read numbers like .5, tessellates round shapes in its own way, and
leaves out some shapes altogether.
"""

from __future__ import annotations

import gzip
import re
from pathlib import Path

import numpy as np
from oracle_process import imported
from scipy.spatial import cKDTree

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_FIELD = re.compile(r"(translation|rotation|scale)(?:[\s,]+" + _NUMBER + r"){3,4}(?=[\s,}])")
_TRANSFORM = re.compile(r"\bTransform\b\s*\{")
_BEYOND = re.compile(
    r"\b(center|scaleOrientation|Sphere|Cylinder|Cone|Billboard|Inline|EXTERNPROTO|PROTO|Extrusion|ElevationGrid|Switch|LOD"
    r"|colorPerVertex)\b"
)
_LARGEST_TEXT = 3_000_000

_IMPORT = """
import sys
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

vtk.vtkObject.GlobalWarningDisplayOff()
importer = vtk.vtkVRMLImporter()
importer.SetFileName(sys.argv[1])
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
importer.SetRenderWindow(window)
importer.Update()
actors = importer.GetRenderer().GetActors()
actors.InitTraversal()
found = [np.zeros((0, 3))]
while (actor := actors.GetNextActor()) is not None:
    if actor.GetMapper() is None:
        continue
    actor.GetMapper().Update()
    data = actor.GetMapper().GetInput()
    if data is None or data.GetNumberOfPolys() == 0:
        continue
    matrix = np.array([[actor.GetMatrix().GetElement(i, j) for j in range(4)] for i in range(4)])
    used = np.unique(vtk_to_numpy(data.GetPolys().GetConnectivityArray()))
    own = vtk_to_numpy(data.GetPoints().GetData()).astype(float)[used]
    found.append(own @ matrix[:3, :3].T + matrix[:3, 3])
np.save(sys.argv[2], np.concatenate(found))
"""


def vtk_points(file: Path, folder: Path) -> np.ndarray | None:
    """World positions of all corners of faces, shape (n, 3); None if VTK crashes.

    Args:
        file: a VRML file of plain Transforms and IndexedFaceSets.
        folder: for intermediate files.
    """
    return imported(_IMPORT, file, folder / "points.npy")


def distance_of_sets(first: np.ndarray, second: np.ndarray) -> float:
    """The greatest distance from a point of one set to the other set (Hausdorff)."""
    return float(max(cKDTree(second).query(first)[0].max(), cKDTree(first).query(second)[0].max()))


def text_of(file: Path) -> str:
    data = file.read_bytes()
    return (gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data).decode("utf-8", errors="replace")


def understood(text: str) -> bool:
    """True, if VTK can be the oracle for this text once it is prepared."""
    return len(text) < _LARGEST_TEXT and not _BEYOND.search(text)


def prepared(text: str) -> str:
    """The text with each Transform's fields in the order VTK needs, without comments and numbers like .5."""
    text = re.sub(r'#[^\n"]*', "", text)
    text = re.sub(r"(?<![\d\w.])([-+]?)\.(\d)", r"\g<1>0.\2", text)
    edits: list[tuple[int, int, str]] = []
    for opening in _TRANSFORM.finditer(text):
        fields: dict[str, str] = {}
        depth, position = 1, opening.end()
        while position < len(text) and depth:
            depth += {"{": 1, "[": 1, "}": -1, "]": -1}.get(text[position], 0)
            found = _FIELD.match(text, position) if depth == 1 and not text[position - 1].isalnum() else None
            if found:
                fields[found.group(1)] = found.group(0)
                edits.append((position, found.end(), ""))
            position = found.end() if found else position + 1
        ordered = " ".join(fields[name] for name in ("translation", "rotation", "scale") if name in fields)
        edits.append((opening.end(), opening.end(), f" {ordered} "))
    for begin, end, new in sorted(edits, key=lambda edit: (-edit[0], -edit[1])):
        text = text[:begin] + new + text[end:]
    return "#VRML V2.0 utf8\n" + text
