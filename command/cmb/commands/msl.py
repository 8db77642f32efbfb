"""`cmb msl`: which Modelica Standard Library is used."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from modelica2fmu.standard_library import find_standard_library

NAME = "msl"
SUMMARY = "say which Modelica Standard Library is used, and from where"
DESCRIPTION = (
    "Looks for the Modelica Standard Library in this order: --msl, MODELICAPATH, OpenModelica's usual folders, the "
    "user's cache, and last the MultiBody core subset that this project brings along."
)
EXAMPLES = """examples:
  cmb msl
  MODELICAPATH=/opt/msl cmb msl
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("--msl", type=Path, metavar="FOLDER", help="folder that holds the Modelica Standard Library")


def run(arguments: Namespace) -> int:
    """Prints name, version, folder and where it was found."""
    library = find_standard_library(arguments.msl)
    version = library.version or "of unknown version"
    print(f"Modelica {version} from {library.folder} ({library.origin})")
    return 0
