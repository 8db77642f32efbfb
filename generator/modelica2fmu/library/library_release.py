"""Fetches, checks and installs an official release of the Modelica Standard Library."""

from __future__ import annotations

import re
import shutil
import stat
import tempfile
import urllib.error
import urllib.request
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import IO, Final

from contact_foundation.errors import BuildError, InputError, Place
from contact_foundation.output import whole_folder
from contact_foundation.progress import Progress, silent

from modelica2fmu.library.releases import ADDRESS, LATEST, RELEASES, content_digest
from modelica2fmu.library.standard_library import StandardLibrary, cache_folder

_WANTED: Final = re.compile(r"(Modelica|ModelicaServices)( [^/]*)?/.*|Complex( [^/]*)?\.mo|LICENSE")

_TIMEOUT: Final = 60.0
_BLOCK: Final = 1 << 16
_MAXIMUM_ARCHIVE: Final = 500 * 1024**2
_MAXIMUM_CONTENT: Final = 2 * 1024**3
_MAXIMUM_FILES: Final = 50_000


def install_release(
    version: str = LATEST,
    origin: str | Path | None = None,
    *,
    folder: Path | None = None,
    releases: Mapping[str, str] = RELEASES,
    progress: Progress = silent,
) -> StandardLibrary:
    """Installs a release of the Modelica Standard Library, whole or not at all.

    Args:
        version: of the release, one of ``releases``.
        origin: address of its archive, or a zip file; None for the official address.
        folder: where to install it, in a folder named by the version; the user's cache if None.
        releases: content digest by version.
        progress: told about the phases.

    Returns:
        The installed library.

    Raises:
        InputError: the version is unknown, or the file is no archive of that release.
        BuildError: the archive cannot be fetched.
    """
    if version not in releases:
        raise InputError(
            f"release {version} of the Modelica Standard Library is not known", remedy=f"known: {', '.join(releases)}"
        )
    target = (folder if folder is not None else cache_folder()) / version
    source = origin if origin is not None else ADDRESS.format(version=version)
    with _archive(source, version, progress) as archive, whole_folder(target) as staging:
        progress("unpack", 0.0)
        _unpack(archive, staging, str(source))
        library = StandardLibrary(staging, version, "cache")
        if content_digest(library) != releases[version]:
            raise InputError(
                f"this is not the release {version} of the Modelica Standard Library: its content has another digest",
                place=Place(file=Path(source)) if isinstance(source, Path) else Place(component=source),
            )
        progress("unpack", 1.0)
    return StandardLibrary(target, version, "cache")


@contextmanager
def _archive(source: str | Path, version: str, progress: Progress) -> Iterator[IO[bytes]]:
    """Yields the opened archive, fetched into a temporary file if it is not one already."""
    if isinstance(source, Path):
        if not source.is_file():
            raise InputError("there is no such file", place=Place(file=source))
        with source.open("rb") as file:
            yield file
        return
    with tempfile.TemporaryFile(prefix="cmb-msl-") as file:
        try:
            with urllib.request.urlopen(source, timeout=_TIMEOUT) as answer:
                _copy(answer, file, int(answer.headers.get("Content-Length") or 0), source, progress)
        except (OSError, ValueError) as error:  # URLError and time-outs are among them
            reason = getattr(error, "reason", None) or error
            raise BuildError(
                f"{source} cannot be fetched: {reason}",
                remedy="if this machine is offline, fetch it on another one and run "
                f"`cmb msl install {version} --from FILE`; models of this project build without it too",
            ) from error
        file.seek(0)
        yield file


def _copy(answer: IO[bytes], file: IO[bytes], expected: int, source: str, progress: Progress) -> None:
    done = 0
    progress("fetch", 0.0, source)
    while block := answer.read(_BLOCK):
        done += len(block)
        if done > _MAXIMUM_ARCHIVE:
            raise ValueError(f"it is larger than {_MAXIMUM_ARCHIVE >> 20} MiB")
        file.write(block)
        # The size of archives made on demand is not known beforehand.
        progress("fetch", min(done / expected, 0.99) if expected else 0.5, f"{done >> 20} MiB")
    if expected and done != expected:
        raise ValueError(f"it ended after {done} of {expected} bytes")
    progress("fetch", 1.0)


def _unpack(archive: IO[bytes], folder: Path, source: str) -> None:
    """Unpacks the wanted packages; nothing else of an archive is written.

    Raises:
        InputError: it is damaged, too large, or has names that leave the folder.
    """
    place = Place(component=source)
    try:
        with zipfile.ZipFile(archive) as opened:
            entries = opened.infolist()
            if len(entries) > _MAXIMUM_FILES or sum(entry.file_size for entry in entries) > _MAXIMUM_CONTENT:
                raise InputError("this archive is too large for a Modelica Standard Library", place=place)
            inner = _inner_folder([entry.filename for entry in entries])
            for entry in entries:
                name = entry.filename.removeprefix(inner)
                if not entry.filename.startswith(inner) or entry.is_dir() or not _WANTED.fullmatch(name):
                    continue
                parts = PurePosixPath(name)
                if (
                    parts.is_absolute()
                    or ".." in parts.parts
                    or "\\" in name
                    or stat.S_ISLNK(entry.external_attr >> 16)
                ):
                    raise InputError(f"the name {entry.filename!r} leaves the archive's folder", place=place)
                target = folder / _without_version(parts)
                target.parent.mkdir(parents=True, exist_ok=True)
                with opened.open(entry) as packed, target.open("wb") as unpacked:
                    shutil.copyfileobj(packed, unpacked)
    except (zipfile.BadZipFile, EOFError, NotImplementedError, RuntimeError) as error:
        raise InputError(f"this is no archive that can be read: {error}", place=place) from error
    if not (folder / "Modelica" / "package.mo").is_file():
        raise InputError("there is no Modelica Standard Library in this archive", place=place)


def _inner_folder(names: list[str]) -> str:
    """The folder inside the archive in which the packages lie, "" or "ModelicaStandardLibrary-4.1.0/"."""
    inner = [match[1] for name in names if (match := re.fullmatch(r"([^/]*/)?Modelica( [^/]*)?/package\.mo", name))]
    return (inner[0] or "") if inner else ""


def _without_version(path: PurePosixPath) -> PurePosixPath:
    first, *rest = path.parts
    if " " in first:
        first = first.split(" ", 1)[0] + (".mo" if first.endswith(".mo") else "")
    return PurePosixPath(first, *rest)
