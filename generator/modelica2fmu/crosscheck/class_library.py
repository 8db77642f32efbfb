"""Finds classes by name in files and folders, which are read when they are first asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path

from modelica2fmu.crosscheck.class_parser import parse
from modelica2fmu.crosscheck.class_syntax import ClassDefinition, Extent
from modelica2fmu.crosscheck.class_tokens import Token, UnreadableError, call_arguments, tokens_of
from modelica2fmu.library.source_map import source_number
from modelica2fmu.library.standard_library import STANDARD_PARTS


class ClassLibrary:
    """Classes of the highest level, and those that lie in folders of packages.

    Args:
        file: holds the model: a file by itself or a package's ``package.mo``.
        text: of the file, which need not exist under its name.
        roots: folders that contain packages or files, and folders of packages.
        others: other texts of files in these.
    """

    def __init__(
        self, file: Path, text: bytes, roots: Sequence[Path], others: Mapping[Path, bytes] | None = None
    ) -> None:
        self._file = file
        self._text = text
        self._roots = tuple(roots)
        self._others = others or {}
        self._found: dict[str, ClassDefinition | None] = {}
        self._missing: set[tuple[Path, str]] = set()
        self._texts: dict[Path, bytes] = {}
        self._parsed: dict[Path, dict[str, ClassDefinition]] = {}
        self._files: dict[int, Path] = {}

    def with_texts(self, texts: Mapping[Path, str]) -> ClassLibrary:
        """The same with other texts of some files."""
        others = {file: text.encode() for file, text in texts.items()}
        return ClassLibrary(self._file, others.get(self._file, self._text), self._roots, others)

    def file(self, source: int) -> Path | None:
        """The file that has a number of the front end, if a class of it was read."""
        return self._files.get(source)

    @property
    def own(self) -> Path | None:
        """The user's own file or package; the Standard Library is nobody's, also where its example is the model."""
        package = self._file.parent if self._file.name == "package.mo" else self._file
        return None if package.name in STANDARD_PARTS else package

    def is_own(self, extent: Extent) -> bool:
        """Whether an extent lies in the user's own file or package, not in another library."""
        return self.own is not None and extent.file.is_relative_to(self.own)

    @property
    def own_text(self) -> bytes:
        """Of the user's own file, or of all files of the package."""
        if self._file.name != "package.mo" or self.own is None:
            return self._text
        files = sorted(self._file.parent.rglob("*.mo"))
        return b"\n".join(self._others[file] if file in self._others else file.read_bytes() for file in files)

    def texts(self) -> Iterator[bytes]:
        """The user's own text, and those of all libraries but the Standard Library."""
        yield self._text
        for folder in self._folders():
            for file in sorted(folder.rglob("*.mo")) if folder.is_dir() else (folder,):
                if file != self._file:
                    yield file.read_bytes()

    def _folders(self) -> Iterator[Path]:
        if self._file.name == "package.mo" and self.own is not None:
            yield self._file.parent
        for root in self._roots:
            parts = (root,) if root.is_file() or (root / "package.mo").is_file() else sorted(root.iterdir())
            yield from (each for each in parts if each.stem not in STANDARD_PARTS)

    def whole(self, file: Path) -> Extent:
        """The range of a whole file that was read."""
        return Extent(file, 0, len(self._texts[file]))

    def text(self, extent: Extent) -> str:
        """What is written in a range of a file that was read."""
        return self._written(extent).decode("utf-8", errors="replace")

    def tokens(self, extent: Extent) -> list[Token]:
        """The words in a range of a file that was read; their places count from its start."""
        return list(tokens_of(self._written(extent).decode("latin-1")))

    def arguments(self, call: Extent) -> list[tuple[str, Extent]]:
        """The arguments of a call that is written in a range, with their names; see ``call_arguments``."""
        return [
            (name, Extent(call.file, call.start + start, call.start + end))
            for name, start, end in call_arguments(self._written(call))
        ]

    def _written(self, extent: Extent) -> bytes:
        return self._texts[extent.file][extent.start : extent.end]

    def top(self, name: str) -> ClassDefinition | None:
        """A class of the highest level; raises UnreadableError."""
        if name not in self._found:
            self._found[name] = self._own.get(name) or self._search(name)
        return self._found[name]

    def classes_of(self, file: Path) -> list[ClassDefinition]:
        """The classes of the highest level of a file that was read, in their order."""
        return list(self._parsed[file].values())

    def member(self, definition: ClassDefinition, name: str) -> ClassDefinition | None:
        """A class that is declared in another one, or lies in its folder; raises UnreadableError."""
        found = definition.classes.get(name)
        if found is None and definition.folder is not None and (definition.folder, name) not in self._missing:
            found = self._in_folder(definition.folder, name)
            if found is None:
                self._missing.add((definition.folder, name))
            else:
                definition.classes[name] = found
        return found

    def members(self, definition: ClassDefinition) -> set[str]:
        """Names of the classes that are declared in another one, or lie in its folder."""
        names = set(definition.classes)
        if definition.folder is not None:
            names |= {path.stem for path in definition.folder.glob("*.mo")} - {"package"}
            names |= {path.parent.name for path in definition.folder.glob("*/package.mo")}
        return names

    def read_members(self, definition: ClassDefinition) -> None:
        """Reads all classes that lie in the folder of a package; raises UnreadableError."""
        if definition.folder is not None:
            for name in sorted(self.members(definition)):
                self.member(definition, name)
        for each in definition.classes.values():
            self.read_members(each)

    @cached_property
    def _own(self) -> dict[str, ClassDefinition]:
        classes = self._parse(self._text, self._file)
        if self._file.name == "package.mo":
            for package in classes.values():
                package.folder = self._file.parent
        return classes

    def _search(self, name: str) -> ClassDefinition | None:
        for root in self._roots:
            if (root / "package.mo").is_file():
                if root.name == name:
                    return self._package(root)
                continue
            found = self._in_folder(root, name)
            if found is None and not (root / name).exists():
                files = sorted(root.glob("*.mo"))
                found = self._read(files[0]).get(name) if len(files) == 1 else None
            if found is not None:
                return found
        return None

    def _in_folder(self, folder: Path, name: str) -> ClassDefinition | None:
        if (folder / name / "package.mo").is_file():
            return self._package(folder / name)
        file = folder / f"{name}.mo"
        return self._read(file).get(name) if file.is_file() else None

    def _package(self, folder: Path) -> ClassDefinition | None:
        definition = self._read(folder / "package.mo").get(folder.name)
        if definition is not None:
            definition.folder = folder
        return definition

    def _read(self, file: Path) -> dict[str, ClassDefinition]:
        try:
            given = self._others.get(file)
            return self._parse(file.read_bytes() if given is None else given, file)
        except OSError as error:
            raise UnreadableError(f"{file}: {error.strerror}") from error

    def _parse(self, text: bytes, file: Path) -> dict[str, ClassDefinition]:
        self._texts[file] = text
        self._files[source_number(str(file))] = file
        self._parsed[file] = parse(text, file)
        return self._parsed[file]
