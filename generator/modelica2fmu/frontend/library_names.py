"""Names of libraries, written so that the front end loads them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from modelica2fmu.frontend.runner import Request
from modelica2fmu.library.standard_library import STANDARD_PARTS


def packages(roots: Sequence[Path]) -> list[str]:
    """Names of the libraries in folders."""
    found = [root.name for root in roots if (root / "package.mo").is_file()]
    return found + [
        name
        for root in roots
        for name in STANDARD_PARTS
        if (root / name / "package.mo").is_file() or (root / f"{name}.mo").is_file()
    ]


def naming(names: Sequence[str]) -> str:
    """A class that names packages."""
    imports = "".join(f"  import {name};\n" for name in dict.fromkeys(names))
    return f"class 'cmb libraries'\n{imports}end 'cmb libraries';\n"


def about_a_copy(request: Request, package: Path, root: Path) -> Request:
    """The same request about a copy of the model's package, with the libraries beside it.

    Args:
        request: whose roots may hold the package.
        package: its folder.
        root: the folder that holds the copy and nothing else.
    """
    others = [each for each in map(Path, request.roots) if each.resolve() != package.resolve()]
    text = naming([package.name, *packages(others)])
    return replace(request, roots=(str(root), *map(str, others)), file="libraries.mo", text=text)
