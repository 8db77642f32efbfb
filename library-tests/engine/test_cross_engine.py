"""The engine built for Windows and 64-bit ARM passes its tests under Wine and QEMU."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from contact_data import checkout

BUILDS = checkout() / "build" / "external-c"
RUNNERS = {"win64": "/usr/lib/wine/wine64", "aarch64-linux": "qemu-aarch64"}


@pytest.mark.full
@pytest.mark.parametrize("platform", RUNNERS)
def test_the_engine_passes_its_tests_on(platform: str, tmp_path: Path) -> None:
    if not (BUILDS / platform / "tests" / "CTestTestfile.cmake").is_file() or shutil.which(RUNNERS[platform]) is None:
        pytest.skip("not set up to build for other platforms and to run the results (scripts/setup cross)")
    done = subprocess.run(
        ["ctest", "--test-dir", BUILDS / platform, "--output-on-failure", "--timeout", "300"],
        capture_output=True,
        text=True,
        env={**os.environ, "WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all"},
        check=False,
    )
    assert done.returncode == 0, done.stdout[-4000:]
    passed = re.search(r"0 tests failed out of (\d+)", done.stdout)
    assert passed is not None
    assert int(passed[1]) == 6
