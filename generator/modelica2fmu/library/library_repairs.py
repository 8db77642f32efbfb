"""The Standard Library as the front end takes it.

A few classes of the library use what the front end (rumoca 0.10) translates wrongly or not at all. It therefore sees
the library through links, with the files of these classes replaced by versions in which such places are written
differently and mean the same. Nothing of the library is kept in this project: the replaced files are made from the
user's own, line by line, so that places in messages stay right.

The folder is kept in the user's cache under a name that depends on what it shows, since the front end keeps its own
cache of parsed libraries by their paths.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from contact_foundation.cache import user_cache

from modelica2fmu.library.cache_pruning import mark_used
from modelica2fmu.library.source_map import SourceMap


@dataclass(frozen=True)
class Repair:
    """A place of the library that is written differently.

    Attributes:
        files: relative to the folder that contains the package Modelica.
        pattern: what is replaced, wherever it is found in these files.
        replacement: of no more and no fewer lines.
    """

    files: tuple[str, ...]
    pattern: re.Pattern[str]
    replacement: str


_ROTATIONAL: Final = "Modelica/Mechanics/Rotational/Components"
_TRANSLATIONAL: Final = "Modelica/Mechanics/Translational/Components"

REPAIRS: Final = (
    # What a modelica:// name means is left to the tool (geometry_files); the library's own function has two bases.
    Repair(
        ("Modelica/Utilities/Files.mo",),
        re.compile(
            r"(\bfunction\s+loadResource\b(?:(?!\bend\s+loadResource\b).)*?)"
            r"extends(\s+)[\w.]+\.PartialLoadResource(\s*;\s*)extends(\s+)ModelicaServices\.ExternalReferences\."
            r"loadResource(\s*);",
            re.DOTALL,
        ),
        r"\1input String uri; output String fileReference\2\3\4\5algorithm fileReference := uri;",
    ),
    # A binding that is nothing but a call with an external object gets the size of the object's table.
    Repair(
        (
            f"{_ROTATIONAL}/Brake.mo", f"{_ROTATIONAL}/Clutch.mo", f"{_ROTATIONAL}/OneWayClutch.mo",
            f"{_ROTATIONAL}/LossyGear.mo", f"{_TRANSLATIONAL}/Brake.mo",
        ),
        re.compile(r"(\bparameter\s+Real\s+\w+(?:\([^()]*\))?\s*=)(\s*if\s+smoothness\b[^;\"]*?)(\s*(?:\"[^\"]*\")?;)"),
        r"\1 1*(\2)\3",
    ),
    Repair(
        ("Modelica/Blocks/Sources.mo", "Modelica/Blocks/Tables.mo"),
        re.compile(r"(\bparameter\s+Real\s+\w+\s*=)((?:Internal\.)?getT\w+\(tableID\))"),
        r"\1 1*\2",
    ),
    # A function whose loops end by their conditions. What is a file of comma-separated values is seen where it is read.
    Repair(
        ("Modelica/Blocks/Sources.mo", "Modelica/Blocks/Tables.mo"),
        re.compile(
            r"(\bBoolean\s+isCsvExt\s*=\s*if\s+tableOnFile\s+then\s)\s*Modelica\.Utilities\.Strings\.findLast\(fileName[^;]*?"
            r"==\s*Modelica\.Utilities\.Strings\.length\(fileName\)"
        ),
        r'\1tableName == "NoName"',
    ),
    Repair(
        ("Modelica/Blocks/Sources.mo", "Modelica/Blocks/Tables.mo"),
        re.compile(
            r'(\bif\s+tableOnFile)\s+and\s+fileName\s*<>\s*"NoName"\s+and\s+not\s+'
            r"Modelica\.Utilities\.Strings\.isEmpty\(fileName\)(\s+then\s+fileName\b)"
        ),
        r"\1\2",
    ),
    # The external object of tables of two inputs: that of tables of one, without columns, is known to the front end.
    Repair(
        ("Modelica/Blocks/Tables.mo",),
        re.compile(r"\bModelica\.Blocks\.Types\.ExternalCombiTable2D(\s+tableID\b)"),
        r"Modelica.Blocks.Types.ExternalCombiTable1D\1",
    ),
    Repair(
        ("Modelica/Blocks/Tables.mo",),
        re.compile(r"\bModelica\.Blocks\.Types\.ExternalCombiTable2D(\([^;]*?\btable,)"),
        r"Modelica.Blocks.Types.ExternalCombiTable1D\1 fill(0, 0),",
    ),
    # A base class that is declared in the class itself and has bases of its own.
    Repair(
        (f"{_TRANSLATIONAL}/MassWithStopAndFriction.mo",),
        re.compile(
            r"\bextends\s+PartialFrictionWithStop\s*;(.*?)\bencapsulated\s+partial\s+model\s+PartialFrictionWithStop"
            r"(\s*\"[^\"]*\")(.*?)(\bannotation\s*\(\s*Documentation\(info=\"<html>.*?\bend\s+PartialFrictionWithStop\s*;)",
            re.DOTALL,
        ),
        r"\1/*\2*/\3/*\4*/",
    ),
    # A condition of a component that depends on another modifier than a number. A ball without extent is not seen.
    Repair(
        ("Modelica/Mechanics/MultiBody/Parts/Body.mo",),
        re.compile(r"(\bif\s+world\.enableAnimation\s+and\s+animation\s+and\s+)sphereDiameter(\s*)>(\s*)0(\s*;)"),
        r"\1true\2\3\4",
    ),
    # A loop in a when-equation that sets a Real which is declared without discrete; the index alone changes it.
    Repair(
        ("Modelica/Blocks/Routing.mo",),
        re.compile(
            r"\bwhen\s*\{\s*initial\(\)\s*,\s*change\(index\)\s*\}\s*then(\s.*?\bend\s+for\s*;\s*)end\s+when\s*;",
            re.DOTALL,
        ),
        r"\1",
    ),
    # A return in a loop under a condition.
    Repair(
        ("Modelica/Math/BooleanVectors.mo",),
        re.compile(
            r"(\bfunction\s+firstTrueIndex\b(?:(?!\bend\s+firstTrueIndex\b).)*?if\s+b\[i\])(\s+then\s+index\s*:=\s*i;\s*)"
            r"return;",
            re.DOTALL,
        ),
        r"\1 and index == 0\2",
    ),
)  # fmt: skip


def views_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Where views of libraries are kept; who uses them holds it (:func:`cache_pruning.pruned_after_use`)."""
    return user_cache("library", environment)


def repaired_library(library: Path, source_map: SourceMap, environment: Mapping[str, str] = os.environ) -> Path:
    """A folder that shows the library with its repairs, ``library`` itself where there is nothing to repair.

    Args:
        library: folder that contains the package Modelica.
        source_map: is told what the front end gets for the library's files.
        environment: for the place of the user's cache.
    """
    replaced = _replaced_files(library)
    return library_with(replaced, library, source_map, environment) if replaced else library


def library_with(
    replaced: Mapping[Path, str], library: Path, source_map: SourceMap, environment: Mapping[str, str] = os.environ
) -> Path:
    """A folder that shows the library with other texts of some files.

    Args:
        replaced: the texts, of the same lines, by paths in the library.
        library: folder that contains the package Modelica, or shows it.
        source_map: is told what the front end gets for the library's files.
        environment: for the place of the user's cache.
    """
    folder = views_folder(environment) / _digest(library, replaced)
    if not folder.is_dir():
        _write(folder, library, replaced)
    mark_used(folder)
    source_map.add_view(folder, library)
    return folder


def _replaced_files(library: Path) -> dict[Path, str]:
    """New texts of the files that are repaired, by their paths in the library."""
    result: dict[Path, str] = {}
    for repair in REPAIRS:
        for name in repair.files:
            path = Path(name)
            if path not in result and not (library / path).is_file():
                continue
            text = result[path] if path in result else (library / path).read_text(encoding="utf-8")
            changed, count = repair.pattern.subn(repair.replacement, text)
            if count:
                result[path] = changed
    return result


def _digest(library: Path, replaced: Mapping[Path, str]) -> str:
    """A name for the view: the same for the same texts in place of files of the same folders."""
    digest = hashlib.sha256()
    for path, text in sorted(replaced.items()):
        digest.update(f"{path}\0{text}\0".encode())
    for folder in sorted(_folders(replaced)):
        for entry in sorted((library / folder).iterdir()):
            digest.update(f"{entry.resolve()}\0".encode())
    return digest.hexdigest()[:32]


def _folders(paths: Iterable[Path]) -> set[Path]:
    """Folders on the way to the paths."""
    return {parent for path in paths for parent in path.parents}


def _write(folder: Path, library: Path, replaced: Mapping[Path, str]) -> None:
    """Writes the view whole or not at all; another process may write the same at the same time."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    staging = Path(tempfile.mkdtemp(prefix=".new-", dir=folder.parent))
    try:
        inner = _folders(replaced)
        for part in sorted(inner):
            (staging / part).mkdir(exist_ok=True)
            for entry in (library / part).iterdir():
                path = part / entry.name
                if path not in inner and path not in replaced:
                    (staging / path).symlink_to(entry.resolve())
        for path, text in replaced.items():
            (staging / path).write_text(text, encoding="utf-8")
        try:
            staging.rename(folder)
        except OSError:
            if not folder.is_dir():
                raise
    finally:
        shutil.rmtree(staging, ignore_errors=True)
