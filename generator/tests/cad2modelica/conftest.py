"""Folders with the small pendulum assembly."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from contact_data import checkout

FIXTURES = Path(__file__).parent / "fixtures"


@pytest.fixture
def pendulum(tmp_path: Path) -> Path:
    """The XML file of the pendulum in a folder of its own, free to be changed."""
    folder = tmp_path / "assembly"
    folder.mkdir()
    for name in ("pendulum.xml", "pendulum.wrl"):
        shutil.copy(FIXTURES / name, folder / name)
    return folder / "pendulum.xml"


@pytest.fixture(scope="session")
def hammer() -> Path:
    """The XML file of the CAD sample."""
    return checkout() / "Resources" / "cad" / "hammer" / "hammer.xml"
