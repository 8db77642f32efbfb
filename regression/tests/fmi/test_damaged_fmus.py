"""Whatever is wrong with an FMU file, it is wrong input: exit status 2 and a message that names the file."""

from __future__ import annotations

import errno
import os
import zipfile
from collections.abc import Callable
from pathlib import Path

import fmpy
import pytest
from cmb.main import main

DESCRIPTION = "modelDescription.xml"
BINARY = f"binaries/{fmpy.platform}/bouncing_mass.so"
Change = Callable[[bytes], bytes | None]


def cut(content: bytes) -> bytes:
    return content[: len(content) // 2]


def without(_: bytes) -> None:
    return None


def replaced(old: bytes, new: bytes) -> Change:
    return lambda content: content.replace(old, new)


def damaged(fmu: Path, target: Path, name: str, change: Change) -> Path:
    with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(target, "w") as archive:
        for entry in source.namelist():
            content = source.read(entry)
            changed = change(content) if entry == name else content
            if changed is not None:
                archive.writestr(entry, changed)
    return target


@pytest.mark.parametrize("mode", ["me", "cs"])
@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        (DESCRIPTION, without, "not a valid FMU"),
        (DESCRIPTION, cut, "not a valid FMU"),
        (DESCRIPTION, replaced(b'start="', b'start="x'), "- and 3 more"),
        (DESCRIPTION, replaced(b'guid="{', b'guid="{1'), "cannot be instantiated"),
        (BINARY, without, "no binary for"),
        (BINARY, cut, "the FMU's binary is damaged: bouncing_mass.so has"),
        (BINARY, lambda _: b"text", "cannot load the FMU's binary"),
    ],
)
def test_it_is_wrong_input(
    bouncing_mass: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    name: str,
    change: Change,
    said: str,
    mode: str,
) -> None:
    fmu = damaged(bouncing_mass, tmp_path / "damaged.fmu", name, change)
    output, before = tmp_path / "out.csv", Path.cwd()
    assert main(["simulate", str(fmu), "--output", str(output), "--mode", mode]) == 2
    told = capsys.readouterr().err
    assert f"cmb: {fmu}: " in told
    assert said in told
    assert "cmb-fmu-" not in told
    assert len(told.splitlines()) <= 6
    assert not output.exists()
    assert Path.cwd() == before


@pytest.mark.parametrize("content", [b"", b"text", b"PK\x03\x04 and no archive"])
def test_what_is_no_archive_is_wrong_input(tmp_path: Path, capsys: pytest.CaptureFixture[str], content: bytes) -> None:
    (tmp_path / "a.fmu").write_bytes(content)
    assert main(["simulate", str(tmp_path / "a.fmu"), "--output", str(tmp_path / "a.csv")]) == 2
    assert "a.fmu: not a valid FMU" in capsys.readouterr().err


def test_a_full_disk_is_no_fault_of_the_fmu(
    bouncing_mass: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def extract(archive: str, folder: str, _: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), archive, None, f"{folder}/binaries")

    monkeypatch.setattr(fmpy, "extract", extract)
    assert main(["simulate", str(bouncing_mass), "--output", str(tmp_path / "a.csv")]) == 1
    said = capsys.readouterr().err
    assert "/binaries: No space left on device" in said
    assert "TMPDIR" in said
    assert str(bouncing_mass) not in said
    assert list(tmp_path.iterdir()) == []
