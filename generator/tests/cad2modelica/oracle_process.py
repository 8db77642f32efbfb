"""Runs an importer in a process of its own, because importers crash on some files."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np


def imported(script: str, file: Path, result: Path) -> np.ndarray | None:
    """What a script saves of a file; None if it fails, crashes, or takes more than two minutes.

    Args:
        script: Python that reads the file its first argument names and saves an array in the one its second names.
        file: the file to read.
        result: where the script saves, ending in ``.npy``.
    """
    try:
        run = subprocess.run([sys.executable, "-c", script, str(file), str(result)], capture_output=True, timeout=120)
    except subprocess.TimeoutExpired:
        return None
    return np.load(result) if run.returncode == 0 else None
