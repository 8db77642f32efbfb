"""FMUs that were built before, kept by the digest of what they are made from."""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from contact_foundation.output import whole_file

from modelica2fmu.report import BuildReport
from modelica2fmu.source_places import SourcePlaces

_LIMIT: Final = 2 * 1024**3
_NOWHERE: Final = SourcePlaces()


class FmuCache:
    """A folder of FMUs, each with the report of its build.

    Entries are written whole, so several processes can use one folder. What cannot be read counts as missing; what
    was not used for the longest time is removed when the folder grows beyond its limit.

    Args:
        folder: need not exist.
        limit: bytes of all FMUs together.
    """

    def __init__(self, folder: Path, limit: int = _LIMIT) -> None:
        self._folder = folder
        self._limit = limit

    def fetch(self, key: str, output: Path, places: SourcePlaces = _NOWHERE) -> BuildReport | None:
        """Copies the FMU of a key to ``output``.

        Args:
            key: digest of what it is made from.
            output: the file to write.
            places: where the sources stand.

        Returns:
            Its report; None if there is none, it is damaged or names other places, or if a file that the model names
            holds something else now.
        """
        fmu, record = self._paths(key)
        try:
            values: dict[str, Any] = json.loads(record.read_text(encoding="utf-8"))
            content = fmu.read_bytes()
            if hashlib.sha256(content).hexdigest() != values.pop("digest"):
                return None
            files = places.unchanged(values.pop("files"))
            if files is None or not places.names.issuperset(values.pop("places")):
                return None
            report = replace(BuildReport.from_json(values, output), files=files)
            os.utime(fmu)
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            return None
        with whole_file(output) as staging:
            staging.write_bytes(content)
        return report

    def store(self, key: str, report: BuildReport, places: SourcePlaces = _NOWHERE) -> None:
        """Keeps the FMU of a report, in place of one that names other places or is made of other files.

        A folder that cannot be written to is no failure of the build.
        """
        fmu, record = self._paths(key)
        try:
            content = report.fmu.read_bytes()
            values = {
                **report.as_json(),
                "digest": hashlib.sha256(content).hexdigest(),
                "places": places.named(report.fmu, report.warnings),
                "files": places.digests(report.files),
            }
            with whole_file(fmu) as staging:
                staging.write_bytes(content)
            with whole_file(record) as staging:
                staging.write_text(json.dumps(values, indent=1), encoding="utf-8")
            self._prune(keep=fmu)
        except OSError:
            return

    def _paths(self, key: str) -> tuple[Path, Path]:
        return self._folder / f"{key}.fmu", self._folder / f"{key}.json"

    def _prune(self, keep: Path) -> None:
        entries = []
        for fmu in self._folder.glob("*.fmu"):
            status = fmu.stat()
            entries.append((status.st_mtime_ns, status.st_size, fmu))
        total = sum(size for _, size, _ in entries)
        for _, size, fmu in sorted(entries):
            if total <= self._limit:
                break
            if fmu != keep:
                fmu.with_suffix(".json").unlink(missing_ok=True)
                fmu.unlink(missing_ok=True)
                total -= size
