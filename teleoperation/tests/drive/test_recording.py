"""Records on disk: whatever happens, rows that were written stay and can be read."""

from __future__ import annotations

import numpy as np
import pytest
from contact_foundation.errors import SimulationError
from fmu_regression.results.result import read_csv
from interactive_drive.recording.recording import Recording


def test_rows_can_be_read_before_the_record_ends(tmp_path):
    recording = Recording(tmp_path, ["a", "b[1,2]"])
    for k in range(3):
        recording.append(0.1 * k, np.array([k, -k], dtype=float))
    result = read_csv(recording.folder / "result.csv")
    assert result["b[1,2]"] == pytest.approx([0, -1, -2])


def test_records_do_not_overwrite_each_other(tmp_path):
    folders = [Recording(tmp_path, ["a"]).folder.name for _ in range(3)]
    assert folders == ["record-1", "record-2", "record-3"]


def test_on_a_full_disk_the_rows_before_are_kept(tmp_path, monkeypatch):
    recording = Recording(tmp_path, ["a"])
    for k in range(10):
        recording.append(0.1 * k, np.array([1.0 * k]))
    whole = recording._stream

    class FullDisk:
        def write(self, text):
            whole.write(text[:3])  # half of a row still fits
            whole.flush()
            raise OSError(28, "No space left on device")

        def close(self):
            whole.close()

    monkeypatch.setattr(recording, "_stream", FullDisk())
    with pytest.raises(SimulationError, match=r"No space left on device; the 10 rows before are kept(?s:.*)--output"):
        recording.append(1.0, np.array([10.0]))
    recording.append(1.1, np.array([11.0]))  # told once
    folder = recording.finish("M", 0.1, None, {})
    assert read_csv(folder / "result.csv").time.size == 10
    assert (folder / "report.html").is_file()


def test_a_disk_that_is_full_from_the_start_is_told(tmp_path):
    (tmp_path / "out").symlink_to("/proc/none")
    with pytest.raises(SimulationError, match="the record cannot be written"):
        Recording(tmp_path / "out" / "drive", ["a"])
