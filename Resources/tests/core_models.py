"""Where the MultiBody core subset and its test models lie, and what classes the subset has."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

RESOURCES = Path(__file__).resolve().parents[1]
CORE = RESOURCES / "MultiBodyCore"
MODELS = RESOURCES / "tests" / "models"
FIXTURES = MODELS / "CoreFixtures"
REFERENCE = RESOURCES / "reference"
REFERENCE_MODELS = REFERENCE / "ReferenceModels.mo"

_HEAD = re.compile(
    r"^(?P<partial>partial )?(?P<kind>package|model|block|connector|record|type|function|class) (?P<name>\w+)", re.M
)


def fixture_names() -> list[str]:
    """Names of the test models, in their order."""
    return (FIXTURES / "package.order").read_text(encoding="utf-8").split()


def fixture_file(name: str) -> Path:
    """The file of a test model."""
    return FIXTURES / f"{name}.mo"


def core_classes() -> Iterator[tuple[str, str, bool, Path]]:
    """Full name, kind, whether partial, and file of each class of the subset that has its own file."""
    for file in sorted((CORE / "Modelica").rglob("*.mo")):
        head = _HEAD.search(file.read_text(encoding="utf-8"))
        assert head is not None, f"{file} declares no class"
        parts = file.relative_to(CORE).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "package" else parts)
        yield name, head["kind"], head["partial"] is not None, file


def standard_library() -> Path | None:
    """Folder of a real Modelica Standard Library 4.1, or None: MODELICAPATH, then OpenModelica's folders.

    The folder holds ``Modelica``, or ``Modelica 4.1...``; a library without the usual size is not the real one.
    """
    folders = [Path(item) for item in os.environ.get("MODELICAPATH", "").split(os.pathsep) if item]
    folders += [Path.home() / ".openmodelica" / "libraries", Path("/usr/lib/omlibrary")]
    for folder in folders:
        for package in (folder / "Modelica", *sorted(folder.glob("Modelica 4.1*"))):
            real = (package / "Electrical").is_dir()
            if real and 'version="4.1' in (package / "package.mo").read_text(encoding="utf-8", errors="replace"):
                return folder if package.name == "Modelica" else package
    return None
