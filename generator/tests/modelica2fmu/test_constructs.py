"""Each construct of the documentation's table does what it has to do, or is refused by name, file and line."""

from __future__ import annotations

from pathlib import Path

import construct_table as table
import numpy as np
import pytest
from contact_data import checkout
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

DOCUMENTATION = checkout() / "docs" / "fmu-builder.md"


def written(case, folder: Path) -> Path:
    name = getattr(case, "name", "Refused")
    source = folder / "Constructs.mo"
    source.write_text(
        f"package Constructs\n{case.classes}  model {name}\n  {case.text}\n  end {name};\nend Constructs;\n",
        encoding="utf-8",
    )
    return source


@pytest.mark.parametrize("fmi_type", ["ModelExchange", "CoSimulation"])
@pytest.mark.parametrize("case", table.COVERED, ids=lambda case: case.name)
def test_constructs_compute_their_closed_forms(case, fmi_type, fmu_cache, tmp_path_factory):
    folder = tmp_path_factory.getbasetemp() / f"constructs-{case.name}"
    fmu = folder / "model.fmu"
    if not fmu.exists():
        folder.mkdir(exist_ok=True)
        build_fmu(f"Constructs.{case.name}", [written(case, folder)], fmu, BuildOptions(cache=fmu_cache))
    names = [name for name, _ in case.expected.values()]
    grid = np.arange(0.05, 2.0, 0.05) + 1e-3  # beside the events, which are at multiples of 0.025 and 1/3
    result = simulate_fmu(
        str(fmu), fmi_type=fmi_type, stop_time=2.0, relative_tolerance=1e-9, output=names, output_interval=1e-3
    )
    rows = np.searchsorted(result["time"], grid - 1e-9)
    time = result["time"][rows]
    assert time == pytest.approx(grid, abs=1e-6)
    for construct, (name, closed_form) in case.expected.items():
        assert result[name][rows].astype(float) == pytest.approx(closed_form(time), abs=2e-6), construct


@pytest.mark.parametrize("case", table.REFUSED, ids=lambda case: case.construct)
def test_refused_constructs_are_named_with_their_place(case, tmp_path):
    source = written(case, tmp_path)
    with pytest.raises(InputError) as caught:
        build_fmu("Constructs.Refused", [source], tmp_path / "out.fmu")
    assert case.message in caught.value.message
    assert caught.value.place is not None
    assert caught.value.place.file is not None
    assert caught.value.place.file.name == source.name
    if case.by == "builder":
        assert caught.value.place.line is not None
    assert [path.name for path in tmp_path.iterdir()] == [source.name]


def test_documentation_has_the_table_of_these_tests():
    text = DOCUMENTATION.read_text(encoding="utf-8")
    assert "\n".join(table.rows()) in text, "write the output of construct_table.py into docs/fmu-builder.md"
