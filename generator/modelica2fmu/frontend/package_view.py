"""Shows the front end a package as it takes it: with arrays written out.

rumoca reads a package's files by itself. What it refuses of them (see ``concatenation``) it is therefore given in a
copy of the package.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from modelica2fmu.frontend.concatenation import with_arrays_written_out
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
        numbers: what was taken for the values of Integers; ``None`` if two files take different ones.
    """

    root: Path
    file: Path
    package: Path
    texts: dict[Path, str]
    copies: dict[Path, Path]
    numbers: dict[str, int] | None

    def register(self, source_map: SourceMap) -> None:
        """Tells a map that the front end was given this."""
        for copy, original in self.copies.items():
            source_map.add_copy(copy, original)
        for original, text in self.texts.items():
            source_map.add_text(original, text)

    def restored(self, text: str) -> str:
        """A message of the front end with the names that the user knows."""
        return text.replace(str(self.root / self.package.name), str(self.package))


def package_view(package: Path, root: Path) -> PackageView:
    """Copies a package's Modelica files with arrays written out.

    Args:
        package: the folder that holds ``package.mo``.
        root: an empty folder.
    """
    texts: dict[Path, str] = {}
    copies: dict[Path, Path] = {}
    numbers: dict[str, int] | None = {}
    for original in sorted((*package.rglob("*.mo"), *package.rglob("package.order"))):
        copy = root / package.name / original.relative_to(package)
        copy.parent.mkdir(parents=True, exist_ok=True)
        given = original.read_bytes()
        if original.suffix == ".mo":
            copies[copy] = original
            text = given.decode("utf-8", errors="surrogateescape")
            written = with_arrays_written_out(text)
            if written.text != text:
                texts[original] = written.text
                given = written.text.encode("utf-8", errors="surrogateescape")
                numbers = _joined(numbers, written.numbers)
        copy.write_bytes(given)
    return PackageView(root, root / package.name / "package.mo", package, texts, copies, numbers)


def _joined(first: dict[str, int] | None, second: dict[str, int]) -> dict[str, int] | None:
    if first is None or any(first.get(name, number) != number for name, number in second.items()):
        return None
    return {**first, **second}
