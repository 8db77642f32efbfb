"""The FMU's icon is the model's: shapes, their order and colours, bases, and the default where there is none."""

from __future__ import annotations

import io
import zipfile

import numpy as np
import pytest
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.description.icon import model_icon
from modelica2fmu.description.icon_annotation import read_icon
from modelica2fmu.description.icon_rendering import icon_png
from modelica2fmu.options import FmiVersion
from PIL import Image

RED, GREEN, BLUE, CLEAR = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (0, 0, 0, 0)
FILLED = "pattern=LinePattern.None, fillPattern=FillPattern.Solid"


def pixels(data: bytes) -> np.ndarray:
    """Pixels of a PNG, top row first."""
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGBA"))


def drawn(tmp_path, graphics: str, system: str = "") -> np.ndarray:
    file = tmp_path / "M.mo"
    file.write_text(
        f'model M "Icon(graphics={{}}) in a text"\n annotation (Icon({system}graphics={{{graphics}}}));\nend M;\n'
    )
    data = icon_png("M", [file])
    assert data is not None
    return pixels(data)


def at(image: np.ndarray, x: float, y: float) -> tuple[int, ...]:
    """Colour at coordinates from -100 to 100."""
    size = len(image)
    return tuple(int(part) for part in image[int((100 - y) / 200 * size), int((x + 100) / 200 * size)])


def test_shapes_cover_what_they_should_and_later_ones_lie_above(tmp_path):
    image = drawn(
        tmp_path,
        f"Rectangle(extent={{{{-80,-80}},{{0,80}}}}, fillColor={{255,0,0}}, {FILLED}),"
        f"Ellipse(extent={{{{-40,-40}},{{40,40}}}}, fillColor={{0,255,0}}, {FILLED}),"
        f"Polygon(points={{{{50,-90}},{{90,-90}},{{90,-50}}}}, fillColor={{0,0,255}}, {FILLED})",
    )
    assert at(image, -60, 60) == RED
    assert at(image, -20, 0) == at(image, 20, 20) == GREEN
    assert at(image, 35, 35) == CLEAR  # in the ellipse's box
    assert at(image, -35, 35) == RED
    assert at(image, 85, -80) == BLUE
    assert at(image, 55, -60) == CLEAR


def test_shapes_are_turned_about_their_origin(tmp_path):
    image = drawn(
        tmp_path,
        f"Rectangle(origin={{50,0}}, rotation=90, extent={{{{0,-10}},{{60,10}}}}, fillColor={{255,0,0}}, {FILLED})",
    )
    assert at(image, 50, 50) == RED
    assert at(image, 80, 0) == CLEAR


def test_lines_are_drawn_and_curved(tmp_path):
    straight = drawn(tmp_path, "Line(points={{-80,-80},{0,80},{80,-80}}, color={0,0,255}, thickness=2)")
    curved = drawn(
        tmp_path, "Line(points={{-80,-80},{0,80},{80,-80}}, color={0,0,255}, thickness=2, smooth=Smooth.Bezier)"
    )
    assert at(straight, 0, 76) == at(curved, 0, 40) == at(curved, -78, -78) == BLUE
    assert at(curved, 0, 76) == CLEAR  # a parabola touches half way up


def test_other_coordinates_and_expressions(tmp_path):
    image = drawn(
        tmp_path,
        f"Rectangle(extent={{{{0,0}},{{10,10}}}}, fillColor=if big then {{255,0,0}} else {{0,255,0}}, {FILLED}),"
        f"Rectangle(visible=big, extent={{{{0,0}},{{20,20}}}}, fillColor={{0,255,0}}, {FILLED}),"
        f"Rectangle(extent={{{{10,10}},{{20,20}}}}, fillColor={{255,0,0}}, {FILLED})",
        system="coordinateSystem(extent={{0,0},{20,20}}), ",
    )
    assert at(image, 50, 50) == RED
    assert at(image, -50, 50) == CLEAR  # what depends on the model is not shown


def test_bases_lie_below_and_inner_classes_do_not_count(tmp_path):
    folder = tmp_path / "P"
    folder.mkdir()
    (folder / "package.mo").write_text("package P\nend P;\n")
    (folder / "Icons.mo").write_text(
        "within P;\npackage Icons\n partial model Square\n annotation (Icon(graphics={"
        f"Rectangle(extent={{{{-100,-100}},{{100,100}}}}, fillColor={{255,0,0}}, {FILLED})}}));\n"
        " end Square;\nend Icons;\n"
    )
    (folder / "Dot.mo").write_text(
        "within P;\nmodel Dot\n  extends Icons.Square;\n annotation (Icon(graphics={"
        f"Ellipse(extent={{{{-50,-50}},{{50,50}}}}, fillColor={{0,0,255}}, {FILLED})}}));\nend Dot;\n"
    )
    (folder / "Outer.mo").write_text(
        "within P;\nmodel Outer\n record Inner\n  annotation (Icon(graphics={Line(points={{0,0},{1,1}})}));\n"
        " end Inner;\nend Outer;\n"
    )
    (folder / "Circle.mo").write_text("within P;\nmodel Circle\n  extends Circle;\nend Circle;\n")
    data = icon_png("P.Dot", [folder])
    assert data is not None
    image = pixels(data)
    assert (at(image, 0, 0), at(image, 90, 90)) == (BLUE, RED)
    assert read_icon("P.Outer", [folder]) is None
    assert read_icon("P.Circle", [folder]) is None


@pytest.mark.parametrize(
    "text", ["graphics={Line(", "graphics={" + "{" * 500, "graphics=5", "", "graphics={Line(points={{1e999,0},{0,1}})}"]
)
def test_annotations_that_make_no_sense_give_no_icon_or_an_empty_one(tmp_path, text):
    file = tmp_path / "M.mo"
    file.write_text(f"model M\n annotation (Icon({text}));\nend M;\n")
    assert icon_png("M", [file]) is None


@pytest.mark.parametrize(
    ("version", "place"),
    [
        pytest.param(FmiVersion.FMI2, "model.png", marks=pytest.mark.full),
        (FmiVersion.FMI3, "terminalsAndIcons/icon.png"),
    ],
)
def test_fmus_show_the_model_s_icon_or_the_default(tmp_path, fmu_cache, version, place):
    body = "Real x(start = 1, fixed = true);\nequation\n der(x) = -x;"
    shape = f"Ellipse(extent={{{{-50,-50}},{{50,50}}}}, fillColor={{0,0,255}}, {FILLED})"
    (tmp_path / "A.mo").write_text(f"model A\n{body}\n annotation (Icon(graphics={{{shape}}}));\nend A;\n")
    (tmp_path / "B.mo").write_text(f"model B\n{body}\nend B;\n")
    images = {}
    options = BuildOptions(fmi=version, cache=fmu_cache)
    for name in ("A", "B"):
        build_fmu(name, [tmp_path / f"{name}.mo"], tmp_path / f"{name}.fmu", options)
        with zipfile.ZipFile(tmp_path / f"{name}.fmu") as archive:
            images[name] = archive.read(place)
    assert at(pixels(images["A"]), 0, 0) == BLUE
    assert images["B"] == model_icon()
