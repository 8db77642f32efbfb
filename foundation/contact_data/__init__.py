"""The data that the programs read: library, core subset, schema, depth study, regression cases, what set-up built.

In a checkout the entries beside this file are links into it; a wheel carries copies. Cases stay in the checkout.
"""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path


def modelica_library() -> Path:
    """The package ContactMultiBody; its ``Resources`` hold the contact engine where set-up has built it."""
    return _entry("ContactMultiBody")


def contact_engine() -> Path:
    """The contact engine for programs other than Modelica tools; the file exists where set-up has built it."""
    return modelica_library() / "Resources" / "Library" / "linux64" / "libcontactmultibody.so"


def core_subset() -> Path:
    """The folder with the project's own subset of Modelica.Mechanics.MultiBody."""
    return _entry("MultiBodyCore")


def assembly_schema() -> Path:
    """The XML Schema of assemblies."""
    return _entry("schema") / "assembly.xsd"


def depth_study() -> Path:
    """The folder with the depth study's design, published levels and observers for simulations."""
    return _entry("depth-study")


def regression_cases() -> Path | None:
    """The folder with the project's regression cases; None in an installation without a checkout."""
    folder = _entry("cases")
    return folder if folder.is_dir() else None


def checkout() -> Path:
    """The checkout's folder, for what works on the project itself: scripts, benchmarks, tests.

    Raises:
        FileNotFoundError: this is an installation without a checkout.
    """
    folder = modelica_library().parent
    if not (folder / "pyproject.toml").is_file():
        raise FileNotFoundError(f"{folder} is no checkout of ContactMultiBody, which this works on")
    return folder


def dependencies() -> Path:
    """The folder with what set-up unpacked or built for FMUs (SUNDIALS); it need not exist."""
    return _entry("dependencies")


def _entry(name: str) -> Path:
    root = files(__name__)
    if not isinstance(root, Path):  # an import from within an archive; compilers and front ends need files
        raise TypeError(f"{__name__} is not in a folder; install the wheel, do not import from it")
    return (root / name).resolve()
