"""A drive on disk: rows are written as they come, so that nothing recorded is lost; then result.csv and the report."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TextIO

from contact_foundation.errors import Place, SimulationError
from fmu_regression.report.simulation_report import write_report
from fmu_regression.results.result import FloatArray, format_number, read_csv

RESULT, REPORT = "result.csv", "report.html"
_PREFIX = "record-"


class Recording:
    """A record in the making.

    Attributes:
        folder: it has its own, record-1, record-2, ...
        rows: written so far.
    """

    def __init__(self, output: Path, signals: Sequence[str]) -> None:
        """Makes the folder and begins result.csv.

        Args:
            output: folder of all records.
            signals: names of the rows' values.

        Raises:
            SimulationError: nothing can be written there.
        """
        self.rows = 0
        self._failed = False
        try:
            self.folder = _new_folder(output)
            self._file = self.folder / RESULT
            self._stream: TextIO = self._file.open("w", encoding="utf-8", newline="")
            csv.writer(self._stream, lineterminator="\n").writerow(["time", *signals])
        except OSError as error:
            raise _lost(output, error, 0) from error

    def append(self, time: float, values: FloatArray) -> None:
        """Writes a row; values of shape (len(signals),).

        Raises:
            SimulationError: the disk is full or gone; what was written before stays, and later rows are refused.
        """
        if self._failed:
            return
        try:
            self._stream.write(",".join(map(format_number, (time, *values.tolist()))) + "\n")
            self._stream.flush()
        except OSError as error:
            self._failed = True
            raise _lost(self.folder, error, self.rows) from error
        self.rows += 1

    def finish(self, model: str, step: float, scene_file: Path | None, units: Mapping[str, str]) -> Path:
        """Closes result.csv and writes the report beside it.

        Args:
            model: name of the model.
            step: of communication, s.
            scene_file: what the report animates.
            units: of the signals.

        Returns:
            the record's folder.

        Raises:
            SimulationError: nothing was recorded, or the report cannot be written; result.csv stays.
        """
        try:
            self._stream.close()
        except OSError as error:
            _drop_torn_row(self._file)
            raise _lost(self.folder, error, self.rows) from error
        if self._failed:
            _drop_torn_row(self._file)
        if self.rows < 2:
            raise SimulationError(
                "fewer than two steps were recorded: there is no report", place=Place(file=self._file)
            )
        result = read_csv(self._file)
        try:
            write_report(
                replace(result, model=model, mode="cs", interval=step, units=units), scene_file, self.folder / REPORT
            )
        except OSError as error:
            raise _lost(self.folder / REPORT, error, self.rows) from error
        return self.folder


def find_records(output: Path) -> dict[str, Path]:
    """Records in a folder, by name, oldest first."""
    files = {file.parent.name: file for file in output.glob(f"{_PREFIX}*/{RESULT}")}
    numbered = {name for name in files if name.removeprefix(_PREFIX).isdecimal()}
    return {name: files[name] for name in sorted(numbered, key=lambda name: int(name.removeprefix(_PREFIX)))}


def _new_folder(output: Path) -> Path:
    output.mkdir(parents=True, exist_ok=True)
    number = 1
    while True:
        folder = output / f"{_PREFIX}{number}"
        try:
            folder.mkdir()
        except FileExistsError:
            number += 1
            continue
        return folder


def _drop_torn_row(file: Path) -> None:
    """Cuts a result after its last whole line."""
    with file.open("rb+") as stream:
        content = stream.read()
        stream.truncate(content.rfind(b"\n") + 1)


def _lost(path: Path, error: OSError, rows: int) -> SimulationError:
    kept = f"; the {rows} rows before are kept" if rows else ""
    return SimulationError(
        f"the record cannot be written: {error.strerror}{kept}",
        place=Place(file=path),
        remedy="Make room or name another folder with --output.",
    )
