"""Icons and diagrams can be drawn, and nothing public lacks an icon."""

from __future__ import annotations

import re
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from types import ModuleType

import pytest
from library_compiler import REPOSITORY
from library_files import ClassFile, class_files
from lxml import etree
from modelica2fmu.description.icon_annotation import Call, read_annotation


@pytest.fixture(scope="module")
def drawing() -> ModuleType:
    loader = SourceFileLoader("render_icons", str(REPOSITORY / "scripts" / "render-icons"))
    spec = spec_from_loader("render_icons", loader)
    assert spec is not None
    module = module_from_spec(spec)
    # Data classes look their module up while it is made.
    sys.modules["render_icons"] = module
    loader.exec_module(module)
    return module


def test_the_sheet_is_svg_and_shows_the_managers(drawing: ModuleType) -> None:
    root = etree.fromstring(drawing.sheet().encode())
    texts = {text.text for text in root.iter("{http://www.w3.org/2000/svg}text")}
    assert {"ContactManager", "VolumeContactManager", "Parts.Ground", "Examples.BallOnFloor"} <= texts


PUBLIC = [
    file
    for file in class_files()
    if file.kind in {"model", "block", "record", "function", "package"}
    and file.full_name.split(".")[0] == "ContactMultiBody"
    and ".Internal" not in file.full_name
]


@pytest.mark.parametrize("file", PUBLIC, ids=lambda file: file.full_name)
def test_public_classes_have_an_icon(drawing: ModuleType, file: ClassFile) -> None:
    own = re.search(r"\bIcon\s*\(", file.text) is not None
    inherits = re.search(r"^  extends [\w.]+", file.text, re.MULTILINE) is not None
    assert own or inherits
    if own and "." in file.full_name:
        name = file.full_name.removeprefix("ContactMultiBody.")
        assert drawing.Drawings().icon(name, "label")


def test_texts_are_drawn_without_their_quotes(drawing: ModuleType) -> None:
    call = read_annotation('Text(extent={{-1,2},{3.5,-4e1}}, textString="%name: a", visible=Types.x)')
    assert isinstance(call, Call)
    assert call.named["extent"] == [[-1.0, 2.0], [3.5, -40.0]]
    assert ">block: a</text>" in drawing.draw(call, "block")
    with pytest.raises(ValueError, match="does not end"):
        read_annotation("Line(points={{0,0}}")


def test_components_with_matrices_are_drawn(drawing: ModuleType) -> None:
    assert ">hammer</text>" in drawing.Drawings().diagram("Examples.HammerOnAnvil")
