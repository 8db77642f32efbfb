"""The modeller's own files in a generated package, which every generation hands on."""

from __future__ import annotations

import re
import shutil
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import InputError, Place
from contact_foundation.output import MARKER

SCENE = "scene.json"
GRAPH = "graph.svg"
REPORT = "generation.html"
ORDER = "package.order"


@dataclass(frozen=True)
class OwnFiles:
    """What an earlier package holds beside what the generator writes.

    Attributes:
        root: the earlier package's folder.
        files: paths relative to it.
        folders: those in which nothing is, likewise.
        order: the earlier package's order of classes.
    """

    root: Path
    files: tuple[Path, ...] = ()
    folders: tuple[Path, ...] = ()
    order: tuple[str, ...] = ()

    def copy_to(self, root: Path) -> None:
        """Copies the files byte for byte, and makes the empty folders."""
        for file in self.files:
            (root / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(self.root / file, root / file, follow_symlinks=False)
        for folder in self.folders:
            (root / folder).mkdir(parents=True, exist_ok=True)

    def require_free(self, paths: Collection[str]) -> None:
        """Raises InputError if one of these paths, relative to the package, is taken by a file of the modeller's.

        Also if it is that of a folder which holds such files, or nothing.
        """
        folders = {folder: folder for folder in self.folders}
        folders |= {folder: file for file in self.files for folder in file.parents}
        for path in map(Path, sorted(paths)):
            taken = next((place for place in (path, *path.parents) if place in self.files), folders.get(path))
            if taken is not None:
                raise InputError(
                    "is no file of the generator's, which would write over it",
                    place=Place(file=self.root / taken),
                    remedy="Move it away, or give it another name.",
                )

    def package_order(self, generated: tuple[str, ...]) -> tuple[str, ...]:
        """Classes of the package: the earlier order, then what is new."""
        own = {file.stem if len(file.parts) == 1 else file.parts[0] for file in self.files if file.suffix == ".mo"}
        known = dict.fromkeys((*generated, *sorted(own)))
        kept = (name for name in self.order if name in known)
        return tuple(dict.fromkeys((*kept, *known)))

    def references_to(self, names: Mapping[str, str | None], replaced: Collection[Path] = ()) -> list[str]:
        """Places in the modeller's Modelica files that name one of ``names``, one line of text each.

        Args:
            names: of components that are gone; with each the name it seems to have now, if there is one.
            replaced: files that are written anew in any case.
        """
        now = {name: f", which seems to be {new!r} now" if new is not None else "" for name, new in names.items()}
        found = []
        for file in self.files:
            if file.suffix != ".mo" or file in replaced or not (self.root / file).is_file():
                continue
            lines = (self.root / file).read_text(encoding="utf-8", errors="replace").splitlines()
            found += [
                f"{file}:{number} uses {name!r}{now[name]}"
                for number, line in enumerate(lines, start=1)
                for name in sorted(names)
                if re.search(rf"\b{re.escape(name)}\b", line)
            ]
        return found


def declared_names(text: str) -> frozenset[str]:
    """Names of the components that a class declares, as the generator lays declarations out: one begins a line."""
    return frozenset(re.findall(r"^  (?!extends )[A-Z][\w.]* (\w+)[(;]", text, flags=re.MULTILINE))


def find_own_files(output: Path, package: str, generated: Collection[str]) -> OwnFiles:
    """Looks for the modeller's files in what an earlier generation wrote.

    Args:
        output: the folder an earlier generation may have written.
        package: the package's name now.
        generated: file names the generator writes anew.

    Raises:
        InputError: the folder holds a package of another name, other files, or a folder in place of a file or the
            other way round, which would be lost.
    """
    root = output / package
    others = sorted(path.name for path in output.glob("*") if path.name not in {package, SCENE, GRAPH, REPORT, MARKER})
    if others and (output / others[0] / "package.mo").is_file():
        raise InputError(
            f"holds the package {others[0]!r}, but the assembly now gives {package!r}",
            place=Place(file=output),
            remedy="Name another output, or move the old package away; its own classes would be lost.",
        )
    if others:
        raise InputError(
            f"holds {others[0]!r}, which no generation wrote and the next one would lose",
            place=Place(file=output),
            remedy="Move it away, or into the package's folder, whose files are kept.",
        )
    for path in (root, *(output / name for name in (SCENE, GRAPH, REPORT))):
        if path.exists() and path.is_dir() != (path == root):
            raise InputError(
                f"is {'a folder' if path.is_dir() else 'no folder'}, and no generation made it so",
                place=Place(file=path),
                remedy="Move it away.",
            )
    if not root.is_dir():
        return OwnFiles(root)
    paths = sorted(root.rglob("*"))
    found = (path.relative_to(root) for path in paths if path.is_file() or path.is_symlink())
    files = tuple(path for path in found if str(path) not in generated)
    empty = (path for path in paths if path.is_dir() and not path.is_symlink() and not any(path.iterdir()))
    folders = tuple(path.relative_to(root) for path in empty)
    order_file = root / ORDER
    order = tuple(order_file.read_text(encoding="utf-8", errors="replace").split()) if order_file.is_file() else ()
    return OwnFiles(root, files, folders, order)
