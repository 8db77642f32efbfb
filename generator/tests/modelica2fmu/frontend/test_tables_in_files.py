"""Tables that a model names by their files."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.frontend.rewriting.concatenation import with_arrays_written_out
from modelica2fmu.library.standard_library import core_subset, find_standard_library
from scipy.interpolate import RegularGridInterpolator

ROWS = np.array([[0.0, 0.0, 1.0], [1.0, 2.0, -1.0], [2.0, 1.0, 5e-7]])
PLACE = 'tableOnFile=true, tableName="drive", fileName='


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Holds the rows as a text file and as comma-separated values."""
    lines = [" ".join(map(str, row)) for row in ROWS]
    (tmp_path / "drive.txt").write_text("#1\ndouble other(1, 2)\n0 9\ndouble drive(3, 3)  # rows\n" + "\n".join(lines))
    (tmp_path / "drive.csv").write_text("t;y;z\n" + "\n".join(";".join(map(str, row)) for row in ROWS))
    return tmp_path


def written(text: str, folder: Path) -> str:
    return with_arrays_written_out("M", [text], lambda name: folder / name).texts[0]


@pytest.mark.parametrize(
    "declaration",
    [
        f'Modelica.Blocks.Sources.CombiTimeTable t({PLACE}"drive.txt");',
        f'CombiTable1Ds a, t({PLACE}"drive.txt", columns=2:3);',
        f'CombiTable1Dv t[2](each columns={{3}}, each {PLACE.replace(", ", ", each ")}"drive.txt");',
        f'CombiTimeTable t(y(start={{1}}), {PLACE}\n  Modelica.Utilities.Files.loadResource(\n"drive.txt")) "(1)";',
        'CombiTimeTable t(tableOnFile = true, fileName = "drive.csv", delimiter=";", nHeaderLines=1, columns={2});',
        f'extends Modelica.Blocks.Sources.CombiTimeTable({PLACE}"drive.txt");',
        f'CombiTable2Ds t({PLACE}"drive.txt");',
    ],
)
def test_rows_stand_in_the_model_in_as_many_lines(declaration: str, folder: Path) -> None:
    text = f"model M\n  {declaration}\nend M;\n"
    after = written(text, folder)
    matrix = re.search(r"\btable=\[(.*?)\]", after)
    assert matrix is not None
    np.testing.assert_array_equal([[*map(float, row.split(","))] for row in matrix[1].split(";")], ROWS)
    assert re.search(r"tableOnFile\s*=\s*false", after) is not None
    assert "fileName" not in after
    # Those of the table without rows that the file stands for, if none are given.
    assert after.count("columns") == (0 if "2D" in declaration else 1)
    assert after.count("\n") == text.count("\n")


@pytest.mark.parametrize(
    "declaration",
    [
        f"CombiTimeTable t({PLACE}file);",
        f'Mine t({PLACE}"drive.txt");',
        f'CombiTimeTable t({PLACE}"drive.txt", table=[0, 1]);',
        f'CombiTimeTable t; Mine u({PLACE}"drive.txt");',
        'CombiTimeTable t(tableOnFile=on, tableName="drive", fileName="drive.txt");',
        '// CombiTimeTable t(tableOnFile=true, tableName="drive", fileName="drive.txt");',
    ],
)
def test_what_is_not_known_to_be_a_table_in_a_file_stays(declaration: str, folder: Path) -> None:
    text = f"model M\n  {declaration}\nend M;\n"
    assert written(text, folder) == text


def test_files_of_classes_that_a_model_does_not_use_are_not_read(folder: Path) -> None:
    text = f'model Other\n CombiTimeTable t({PLACE}"nowhere.txt");\nend Other;\nmodel M\n Real x;\nend M;\n'
    assert written(text, folder) == text


def test_a_file_that_is_missing_or_holds_no_such_table_is_named(folder: Path) -> None:
    for file, words in (("nowhere.txt", "no such file"), ("drive.csv.txt", "#1"), ("gap.txt", "not finite")):
        (folder / "drive.csv.txt").write_text((folder / "drive.csv").read_text())
        (folder / "gap.txt").write_text("#1\ndouble drive(1, 2)\n0 nan\n")
        with pytest.raises(InputError, match=words) as refused:
            written(f'model M\n CombiTimeTable t({PLACE}"{file}");\nend M;\n', folder)
        assert refused.value.place is not None
        assert refused.value.place.file == folder / file


def test_a_model_follows_its_file_and_is_built_anew_when_that_changes(folder: Path, fmu_cache: Path) -> None:
    """With the Standard Library as a whole, whose tables these are; a package's file by its name in the package."""
    if find_standard_library().folder == core_subset():
        pytest.skip("no Modelica Standard Library is installed")
    package = folder / "Drives"
    package.mkdir()
    (package / "package.mo").write_text("package Drives\nend Drives;\n")
    place = PLACE + 'Modelica.Utilities.Files.loadResource("modelica://Drives/drive.txt")'
    (package / "Drive.mo").write_text(
        f"within Drives;\nmodel Drive\n  Modelica.Blocks.Sources.CombiTimeTable t({place}, columns=2:3);\nend Drive;\n"
    )
    (package / "M.mo").write_text("within Drives;\nmodel M\n  extends Drive;\n  Real x[2] = t.y;\nend M;\n")
    text = (folder / "drive.txt").read_text()
    for factor in (1.0, 3.0):
        (package / "drive.txt").write_text(text.replace("1.0 2.0 -1.0", f"1.0 {2 * factor} {-factor}"))
        build_fmu("Drives.M", [package], folder / "m.fmu", BuildOptions(cache=fmu_cache))
        result = simulate_fmu(
            str(folder / "m.fmu"), output=["x[1]", "x[2]"], stop_time=2.0, output_interval=0.25, relative_tolerance=1e-9
        )
        rows = ROWS * np.array([[1, 1, 1], [1, factor, factor], [1, 1, 1]])
        for name, column in (("x[1]", 1), ("x[2]", 2)):
            expected = np.interp(result["time"], rows[:, 0], rows[:, column])
            np.testing.assert_allclose(result[name], expected, atol=1e-9)


def test_tables_of_two_inputs_are_the_bilinear_surfaces_of_their_points(folder: Path, fmu_cache: Path) -> None:
    """Against SciPy; beyond the points with the slope of the last ones, or as the last one."""
    if find_standard_library().folder == core_subset():
        pytest.skip("no Modelica Standard Library is installed")
    points = np.array([[0.0, -1.0, 1.0, 2.0], [-1.0, 1.0, 2.0, 3.0], [0.5, 4.0, 5.0, 9.0], [3.0, 7.0, 8.0, 0.0]])
    lines = "\n".join(" ".join(map(str, row)) for row in points)
    (folder / "map.txt").write_text(f"#1\ndouble map(4, 4)\n{lines}\n")
    rows = "; ".join(", ".join(map(str, row)) for row in points)
    (folder / "M.mo").write_text(f"""model M
  Modelica.Blocks.Tables.CombiTable2Ds file(tableOnFile=true, tableName="map", fileName="map.txt");
  Modelica.Blocks.Tables.CombiTable2Dv rows(n=2, table=[{rows}],
    extrapolation=Modelica.Blocks.Types.Extrapolation.HoldLastPoint);
  Real u1 = 5*sin(time), u2 = 3*cos(2*time);
equation
  file.u1 = u1;
  file.u2 = u2;
  rows.u1 = {{u1, 0.5}};
  rows.u2 = {{u2, u1}};
end M;
""")
    build_fmu("M", [folder / "M.mo"], folder / "m.fmu", BuildOptions(cache=fmu_cache))
    result = simulate_fmu(
        str(folder / "m.fmu"), output=["u1", "u2", "file.y", "rows.y[1]", "rows.y[2]"], stop_time=3.0,
        output_interval=0.01,
    )  # fmt: skip
    x, y = points[1:, 0], points[0, 1:]
    surface = RegularGridInterpolator((x, y), points[1:, 1:], bounds_error=False, fill_value=None)
    u1, u2 = result["u1"], result["u2"]
    held = np.clip(u1, x[0], x[-1]), np.clip(u2, y[0], y[-1])
    np.testing.assert_allclose(result["file.y"], surface((u1, u2)), atol=1e-12)
    np.testing.assert_allclose(result["rows.y[1]"], surface(held), atol=1e-12)
    np.testing.assert_allclose(result["rows.y[2]"], surface((0.5, np.clip(u1, y[0], y[-1]))), atol=1e-12)
