"""An assembly argument means a file, or the only XML file of a folder."""

from pathlib import Path

import pytest
from cmb.assembly_file import find_assembly
from contact_foundation.errors import InputError


def test_folder_with_one_file(tmp_path: Path) -> None:
    (tmp_path / "a.xml").touch()
    (tmp_path / "a.wrl").touch()
    assert find_assembly(tmp_path) == tmp_path / "a.xml"
    assert find_assembly(tmp_path / "a.xml") == tmp_path / "a.xml"


def test_folder_without_or_with_several(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no assembly file"):
        find_assembly(tmp_path)
    (tmp_path / "a.xml").touch()
    (tmp_path / "b.xml").touch()
    with pytest.raises(InputError, match=r"a\.xml, b\.xml"):
        find_assembly(tmp_path)
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf" / "robot.urdf").touch()
    assert find_assembly(tmp_path / "urdf") == tmp_path / "urdf" / "robot.urdf"
    with pytest.raises(InputError, match="does not exist"):
        find_assembly(tmp_path / "c")


def test_endings_in_capitals_count(tmp_path: Path) -> None:
    (tmp_path / "ROBOT.XML").touch()
    assert find_assembly(tmp_path) == tmp_path / "ROBOT.XML"
