"""The CAD samples are what their scripts make of them with the CAD kernel."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import read_assembly
from cad2modelica.geometry.mesh import bodies, join, volume_integrals, weld
from contact_data import checkout

SAMPLES = checkout() / "Resources" / "cad"


@pytest.mark.skipif(importlib.util.find_spec("cadquery") is None, reason="CadQuery is not installed")
@pytest.mark.parametrize(("name", "written"), [("hammer", ("xml", "wrl", "step")), ("anton", ("xml", "wrl"))])
def test_script_makes_the_committed_files(name: str, written: tuple[str, ...], tmp_path: Path) -> None:
    """Numbers agree to the kernel's accuracy; meshes enclose the same volumes, whatever their triangles."""
    folder = SAMPLES / name
    subprocess.run([sys.executable, str(folder / f"make_{name}.py"), str(tmp_path)], check=True, timeout=120)
    assert {file.name for file in tmp_path.iterdir()} == {f"{name}.{ending}" for ending in written}
    committed, made = (read_assembly(place / f"{name}.xml") for place in (folder, tmp_path))
    assert [part.name for part in committed.parts] == [part.name for part in made.parts]
    for ours, theirs in zip(committed.parts, made.parts, strict=True):
        first, second = ours.mass_properties, theirs.mass_properties
        assert first.mass == pytest.approx(second.mass, rel=1e-9)
        np.testing.assert_allclose(first.center_of_mass, second.center_of_mass, atol=1e-9)
        np.testing.assert_allclose(first.inertia, second.inertia, atol=1e-9 * np.abs(second.inertia).max())
        volumes = [
            sum(volume_integrals(*piece).volume for piece in bodies(*weld(*join(part.meshes))))
            for part in (ours, theirs)
        ]
        assert volumes[0] == pytest.approx(volumes[1], rel=1e-3)
