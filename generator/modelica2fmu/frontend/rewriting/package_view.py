"""Shows the front end a package as it takes it: with arrays written out and packages named.

rumoca reads a package's files by itself. What it refuses of them (see ``concatenation`` and ``inherited_classes``) it
is therefore given in a copy of the package.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from modelica2fmu.frontend.rewriting.concatenation import Numbers, with_arrays_written_out
from modelica2fmu.frontend.rewriting.inherited_classes import Insertion, with_imports
from modelica2fmu.library.source_map import SourceMap


@dataclass(frozen=True)
class PackageView:
    """A copy of a package.

    Attributes:
        root: the folder that holds the copy and nothing else.
        file: the copy's ``package.mo``.
        package: the original's folder.
        texts: what was written out: other texts of the same lines, by original file.
        copies: the original of each Modelica file.
        numbers: what was taken for the values of Integers.
    """

    root: Path
    file: Path
    package: Path
    texts: dict[Path, str]
    copies: dict[Path, Path]
    numbers: Numbers

    def register(self, source_map: SourceMap) -> None:
        """Tells a map that the front end was given this."""
        for copy, original in self.copies.items():
            source_map.add_copy(copy, original)
        for original, text in self.texts.items():
            source_map.add_text(original, text)

    def restored(self, text: str) -> str:
        """A message of the front end with the names that the user knows."""
        return text.replace(str(self.root / self.package.name), str(self.package))


def package_view(
    model: str, package: Path, imports: Mapping[Path, Insertion], root: Path, find_file: Callable[[str], Path]
) -> PackageView:
    """Copies a package's Modelica files with arrays written out.

    Args:
        model: whose arrays they are.
        package: the folder that holds ``package.mo``.
        imports: of packages, by file.
        root: an empty folder.
        find_file: the file that a name in a model means.

    Raises:
        InputError: a file that holds a table is missing or wrong.
        UnsupportedModelError: a file that is not read.
    """
    originals = sorted(package.rglob("*.mo"))
    given = [original.read_bytes().decode("utf-8", errors="surrogateescape") for original in originals]
    named = [with_imports(text, imports.get(original)) for original, text in zip(originals, given, strict=True)]
    written = with_arrays_written_out(model, named, find_file)
    texts = {
        original: after
        for original, before, after in zip(originals, given, written.texts, strict=True)
        if after != before
    }
    return _copied(package, texts, written.numbers, root)


def package_with(texts: Mapping[Path, str], package: Path, root: Path) -> PackageView:
    """Copies a package's Modelica files, some with other texts.

    Args:
        texts: by file.
        package: the folder that holds ``package.mo``.
        root: an empty folder.
    """
    return _copied(package, dict(texts), Numbers(), root)


def _copied(package: Path, texts: dict[Path, str], numbers: Numbers, root: Path) -> PackageView:
    copies: dict[Path, Path] = {}
    for original in sorted(package.rglob("*.mo")):
        copy = root / package.name / original.relative_to(package)
        copy.parent.mkdir(parents=True, exist_ok=True)
        text = texts.get(original)
        copy.write_bytes(original.read_bytes() if text is None else text.encode("utf-8", errors="surrogateescape"))
        copies[copy] = original
    for order in package.rglob("package.order"):
        (root / package.name / order.relative_to(package)).write_bytes(order.read_bytes())
    return PackageView(root, root / package.name / "package.mo", package, texts, copies, numbers)
