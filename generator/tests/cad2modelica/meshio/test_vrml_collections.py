"""VRML files as many programs write them, read and compared with VTK and MeshLab.

Runs where Debian's packages kicad-packages3d, whitedune-docs or castle-game-engine-doc are installed, or where
CMB_VRML_COLLECTION names folders (separated by colons).
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from vrml_collection import examine, files_of

INSTALLED = (
    "/usr/share/kicad/3dmodels",
    "/usr/share/doc/whitedune-docs",
    "/usr/share/doc/castle-game-engine-doc",
)


def folders() -> list[Path]:
    named = os.environ.get("CMB_VRML_COLLECTION")
    return [Path(name) for name in (named.split(":") if named else INSTALLED) if Path(name).is_dir()]


@pytest.mark.skipif(not folders(), reason="no collection of VRML files is installed")
@pytest.mark.parametrize("folder", folders(), ids=lambda folder: folder.name)
@pytest.mark.parametrize(("oracle", "package"), [("VTK", "vtk"), ("MeshLab", "pymeshlab")])
def test_collection(folder: Path, oracle: str, package: str, tmp_path: Path) -> None:
    """Every file is read, or refused for a reason in the file; what an oracle shows is ours, at its place."""
    pytest.importorskip(package, reason=f"{oracle} is the oracle for positions")
    found = {file: examine(file, folder, tmp_path, (oracle,)) for file in files_of(folder)}
    assert [outcome.refusal for outcome in found.values() if outcome.refusal and not outcome.reason] == []
    compared = [(file, comparison) for file, outcome in found.items() for comparison in outcome.compared]
    assert {str(file): comparison.distance for file, comparison in compared if comparison.distance > 1.0} == {}
    assert sum(comparison.complete for _, comparison in compared) > len(compared) / 2
