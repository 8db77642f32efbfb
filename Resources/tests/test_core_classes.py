"""The MultiBody core subset as a package: files, documentation, every class in use somewhere."""

from __future__ import annotations

import re
from pathlib import Path

import core_models
import pytest

CLASSES = list(core_models.core_classes())
# Not instantiated by themselves: connectors live in components, types and packages have no instances.
_INSTANTIATED = ("model", "block")


def test_every_component_class_and_function_is_used_by_a_fixture() -> None:
    texts = "\n".join(file.read_text(encoding="utf-8") for file in core_models.FIXTURES.glob("*.mo"))
    texts += core_models.REFERENCE_MODELS.read_text(encoding="utf-8")
    unused = []
    for name, kind, partial, _ in CLASSES:
        if partial or ".Internal." in name or ".Icons." in name or kind not in (*_INSTANTIATED, "function"):
            continue
        # Models name classes by the last two parts at least, through imports of the packages above.
        last = ".".join(name.split(".")[-2:])
        short = name.split(".")[-1]
        if not re.search(rf"\b{re.escape(last)}\b", texts) and not re.search(rf"\bMB\.{short}\b", texts):
            unused.append(name)
    known = {
        # what only other classes of the subset are made of
        "Modelica.Mechanics.MultiBody.Forces.LineForceWithMass",
        "Modelica.Mechanics.MultiBody.Interfaces.ZeroPosition",
        # accepted without effect; no model of this project uses it
        "Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape",
        # the builder resolves it before the model is flattened; used by generated packages, and tested with them
        "Modelica.Utilities.Files.loadResource",
    }
    assert set(unused) <= known


def test_package_order_lists_every_class() -> None:
    for package in (core_models.CORE / "Modelica").rglob("package.mo"):
        folder = package.parent
        listed = (folder / "package.order").read_text(encoding="utf-8").split()
        assert len(listed) == len(set(listed)), f"{folder}: double entries"
        present = {item.stem for item in folder.glob("*.mo")} - {"package"}
        present |= {item.name for item in folder.iterdir() if (item / "package.mo").is_file()}
        source = package.read_text(encoding="utf-8").split("annotation", 1)[0]
        constants = set(re.findall(r"^\s*constant [\w.]+ (\w+)", source, re.M))
        assert set(listed) == present | constants, f"{folder}"


@pytest.mark.parametrize(("name", "kind", "file"), [(name, kind, file) for name, kind, _, file in CLASSES])
def test_class_is_documented(name: str, kind: str, file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    short = name.split(".")[-1]
    assert re.search(rf'{kind} {short}\b[^;]*?"', text, re.S), "no description"
    assert 'Documentation(info="<html>' in text, "no documentation"
    assert text.count("<html>") == text.count("</html>")
    within = name.rsplit(".", 1)[0] if "." in name else ""
    assert text.startswith(f"within {within};")


@pytest.mark.parametrize("file", [file for *_, file in CLASSES])
def test_declarations_have_descriptions(file: Path) -> None:
    """Parameters, inputs and outputs of public classes say what they are."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", file.read_text(encoding="utf-8"), flags=re.S)
    for declaration in re.findall(r"^  (?:parameter|input|output) [^;]*;", text, re.M):
        assert '"' in declaration.split("annotation")[0], declaration


def test_experiment_of_fixtures() -> None:
    for name in core_models.fixture_names():
        text = core_models.fixture_file(name).read_text(encoding="utf-8")
        assert len(re.findall(r"experiment\(StopTime=[\d.]+, Tolerance=[\de.-]+\)", text)) == 1, name
