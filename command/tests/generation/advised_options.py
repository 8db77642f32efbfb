"""What a user adds to the command after reading why a robot description is refused."""

from __future__ import annotations

import re
from pathlib import Path

LEVELS_OF_PACKAGES = 6  # folders above the description that are searched for a package
LEVELS_OF_FILES = 2  # the same for a file of a common name: other robots have such files too
DENSITY = ["--density", "2700"]

_PACKAGE = re.compile(r"names the package '([^']+)'")
_FILE = re.compile(r"names the file '([^']+)'")
_LEAVES = re.compile(r"'([^']+)' leaves the assembly's folder")


def advised_options(error: str, description: Path, given: list[str]) -> list[str]:
    """Options that an error message names and that were not given: folders first, as far as they are found.

    Args:
        error: the message, all lines.
        description: the file.
        given: options so far.

    Returns:
        More options; none if the message names none that could still help.
    """
    more = [] if "--density" not in error or "--density" in given else list(DENSITY)
    if "--package-path" in error:
        folders = dict.fromkeys(folder for folder in _folders(error, description) if str(folder) not in given)
        more += [word for folder in folders for word in ("--package-path", str(folder))]
    if not more and "--allow-missing" in error and "--allow-missing" not in given:
        more = ["--allow-missing"]
    return more


def _folders(error: str, description: Path) -> list[Path]:
    found = []
    for reference in _LEAVES.findall(error):
        target = (description.parent / reference).resolve()
        found += [target.parent] if target.is_file() else []
    for package in _PACKAGE.findall(error):
        found += _search(description, package, "")
    for name in _FILE.findall(error):
        found += _search(description, "", name)
    return found


def _search(description: Path, package: str, file: str) -> list[Path]:
    """The folder nearest above the description that holds a package, or a file by its path, anywhere below it."""
    for ancestor in description.parents[: LEVELS_OF_FILES if file else LEVELS_OF_PACKAGES]:
        held = [path for path in sorted(ancestor.glob("**/" + (file or package))) if path.is_dir() != bool(file)]
        if held:
            return [Path(str(held[0]).removesuffix(file))] if file else held[:1]
    return []
