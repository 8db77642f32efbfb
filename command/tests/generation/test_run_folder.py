"""What `cmb run` does with the files of the modeller's in the folder of an earlier run; no FMU is built for it."""

from __future__ import annotations

from pathlib import Path

import pytest
from cmb import pipeline
from cmb.main import main
from contact_foundation.output import MARKER

ROBOT = """<robot name="r"><link name="a"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""


@pytest.fixture
def earlier(tmp_path: Path) -> Path:
    """The folder of an earlier run, with a package in it."""
    (tmp_path / "r.urdf").write_text(ROBOT)
    assert main(["generate", str(tmp_path / "r.urdf"), "--output", str(tmp_path / "out" / "model")]) == 0
    (tmp_path / "out" / MARKER).touch()
    return tmp_path / "out"


def test_own_files_beside_the_results_are_not_lost(earlier: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (earlier / "thesis.txt").write_text("years of work")
    assert main(["run", str(earlier.parent / "r.urdf"), "--output", str(earlier)]) == 2
    assert "'thesis.txt', which no run of 'r' wrote" in capsys.readouterr().err
    assert (earlier / "thesis.txt").read_text() == "years of work"


def test_errors_name_the_output(earlier: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Not the folder beside it that holds the results until they are whole."""
    (earlier / "model" / "thesis.txt").write_text("years of work")
    assert main(["run", str(earlier.parent / "r.urdf"), "--output", str(earlier)]) == 2
    assert f"cmb: {earlier / 'model'}: holds 'thesis.txt'" in capsys.readouterr().err


def test_links_of_the_modellers_stay_links(
    earlier: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """One that leads nowhere was an error once."""
    (earlier / "model" / "R" / "data").symlink_to("nowhere")
    kept: list[bool] = []

    def stop(_model: str, sources: tuple[Path, ...], *_rest: object) -> None:
        kept.append(any((source / "data").is_symlink() for source in sources))
        raise KeyboardInterrupt

    monkeypatch.setattr(pipeline, "build_fmu", stop)
    assert main(["run", str(earlier.parent / "r.urdf"), "--output", str(earlier)]) == 130
    assert kept == [True]
    assert (earlier / "model" / "R" / "data").is_symlink()
    assert "nothing half-written" in capsys.readouterr().err
