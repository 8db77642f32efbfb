"""Output appears whole or not at all."""

import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from contact_foundation.errors import InputError
from contact_foundation.output import check_file, whole_file, whole_folder


class Interrupted(Exception):
    pass


def entries(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


def test_folder_appears_when_the_block_ends(tmp_path: Path) -> None:
    target = tmp_path / "deep" / "out"
    with whole_folder(target) as staging:
        (staging / "a").write_text("1")
        assert not target.exists()
    assert (target / "a").read_text() == "1"
    assert entries(tmp_path / "deep") == ["out"]


def test_failed_block_leaves_the_old_folder_and_nothing_else(tmp_path: Path) -> None:
    target = tmp_path / "out"
    with whole_folder(target) as staging:
        (staging / "a").write_text("old")
    with pytest.raises(Interrupted), whole_folder(target) as staging:
        (staging / "a").write_text("new")
        raise Interrupted
    assert (target / "a").read_text() == "old"
    assert entries(tmp_path) == ["out"]


def test_second_run_replaces_every_file(tmp_path: Path) -> None:
    target = tmp_path / "out"
    with whole_folder(target) as staging:
        (staging / "stale").write_text("")
    with whole_folder(target) as staging:
        (staging / "fresh").write_text("")
    assert not (target / "stale").exists()
    assert (target / "fresh").exists()
    assert entries(tmp_path) == ["out"]


def test_a_foreign_folder_is_never_replaced(tmp_path: Path) -> None:
    target = tmp_path / "thesis"
    target.mkdir()
    (target / "chapter1.tex").write_text("years of work")
    with pytest.raises(InputError, match="not written by cmb"), whole_folder(target):
        pass
    assert (target / "chapter1.tex").read_text() == "years of work"


def test_failed_file_keeps_the_old_one(tmp_path: Path) -> None:
    target = tmp_path / "a.csv"
    target.write_text("old")
    with pytest.raises(Interrupted), whole_file(target) as staging:
        staging.write_text("half")
        raise Interrupted
    assert target.read_text() == "old"
    assert entries(tmp_path) == ["a.csv"]


def test_permissions_are_those_that_the_process_gives(tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    kept.touch(0o640)
    mask = os.umask(0o077)
    try:
        for target in (tmp_path / "new", kept):
            with whole_file(target) as staging:
                staging.write_text("1")
        with whole_folder(tmp_path / "folder") as staging:
            (staging / "a").touch()
    finally:
        os.umask(mask)
    modes = {entry.name: entry.stat().st_mode & 0o777 for entry in tmp_path.iterdir()}
    assert modes == {"new": 0o600, "kept": 0o640 & ~mask, "folder": 0o700}


def test_links_stay_links(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "a.csv").symlink_to("elsewhere/b.csv")
    (tmp_path / "out").symlink_to("elsewhere/folder")
    for text in ("first", "second"):
        with whole_file(tmp_path / "a.csv") as staging:
            staging.write_text(text)
        with whole_folder(tmp_path / "out") as staging:
            (staging / "c").write_text(text)
        assert (tmp_path / "elsewhere" / "b.csv").read_text() == text
        assert (tmp_path / "elsewhere" / "folder" / "c").read_text() == text
    assert (tmp_path / "a.csv").is_symlink()
    assert (tmp_path / "out").is_symlink()
    assert entries(tmp_path / "elsewhere") == ["b.csv", "folder"]


def test_a_pipe_is_written_to_and_stays_one(tmp_path: Path) -> None:
    """As /dev/null and /dev/stdout, which root could replace by a file."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_text()))
    reader.start()
    with whole_file(pipe) as staging:
        staging.write_text("all of it")
    reader.join(timeout=10)
    assert read == ["all of it"]
    assert pipe.is_fifo()
    assert entries(tmp_path) == ["pipe"]


def test_names_of_any_length(tmp_path: Path) -> None:
    target = tmp_path / ("ä" * 127)
    with whole_file(target) as staging:
        staging.write_text("1")
    assert target.read_text() == "1"


@pytest.mark.parametrize("write", [whole_file, whole_folder])
def test_where_nothing_can_be_written_the_target_is_named(write: object, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    assert callable(write)
    for target, text in (
        (tmp_path / "file" / "deep" / "a", f"{tmp_path / 'file'} is no folder"),
        (Path("/proc/a"), "nothing can be written into the folder /proc"),
    ):
        with pytest.raises(OSError, match=text) as caught, write(target):
            pass
        assert caught.value.filename == str(target)
    with pytest.raises(InputError, match=r"deep/a: .*file is no folder\n"):
        check_file(tmp_path / "file" / "deep" / "a")
    assert entries(tmp_path) == ["file"]


def test_a_folder_is_no_file(tmp_path: Path) -> None:
    with pytest.raises(IsADirectoryError, match="is a folder"), whole_file(tmp_path):
        pass
    with pytest.raises(InputError, match="is a folder"):
        check_file(tmp_path)
    check_file(tmp_path / "new" / "folder" / "a")
    assert entries(tmp_path) == []


@pytest.mark.parametrize("pipes", ["ascii", "closed", "/dev/stdout"])
def test_standard_output_of_any_kind(pipes: str, tmp_path: Path) -> None:
    """An encoding without the characters, none at all, and as the file that is written."""
    (tmp_path / "Käse.csv").write_text("time,x\n0,1\n1,2\n")
    output = "/dev/stdout" if pipes == "/dev/stdout" else "Käse.html"
    command = f"exec '{sys.executable}' -m cmb.main report Käse.csv --output {output}"
    done = subprocess.run(
        ["sh", "-c", command + (" <&- >&- 2>&-" if pipes == "closed" else "")],
        cwd=tmp_path,
        env={**os.environ, "PYTHONIOENCODING": "ascii"} if pipes == "ascii" else None,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    expected = {"ascii": b"K\\xe4se.html\n", "closed": b""}
    if pipes in expected:
        assert done.stdout == expected[pipes]
        assert (tmp_path / "Käse.html").read_bytes().endswith(b"</html>\n")
    else:
        assert b"</html>\n" in done.stdout
        assert entries(tmp_path) == ["Käse.csv"]


def test_a_full_disk_is_told_about_the_target(tmp_path: Path) -> None:
    target = tmp_path / "link"
    target.symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space left") as caught, whole_file(target) as staging:
        staging.write_text("1")
    assert caught.value.filename == str(target)
    assert entries(tmp_path) == ["link"]


# ----- what killed processes leave behind -----

KILLED = """
import os, signal, sys
from pathlib import Path
from contact_foundation.output import whole_file, whole_folder
with {block}(Path(sys.argv[1])) as staging:
    print(staging, flush=True)
    {write}
    {end}
"""


def run_until_written(block: str, target: Path, end: str) -> tuple[subprocess.Popen[str], Path]:
    write = "(staging / 'a').write_text('half')" if block == "whole_folder" else "staging.write_text('half')"
    program = KILLED.format(block=block, write=write, end=end)
    words = [sys.executable, "-c", program, str(target)]
    process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    return process, Path(process.stdout.readline().strip())


def aged(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("contact_foundation.abandoned._NEW", -1.0)


@pytest.mark.parametrize("block", ["whole_folder", "whole_file"])
def test_next_run_clears_what_a_killed_one_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, block: str) -> None:
    process, staging = run_until_written(block, tmp_path / "out", "os.kill(os.getpid(), signal.SIGKILL)")
    process.wait(timeout=60)
    assert staging.exists()
    with whole_file(tmp_path / "young"):
        assert staging.exists()  # of its age another process may be about to lock it
    aged(monkeypatch)
    with whole_file(tmp_path / "next"):
        assert not staging.exists()
    assert entries(tmp_path) == ["next", "young"]


@pytest.mark.parametrize("block", ["whole_folder", "whole_file"])
def test_what_a_running_process_writes_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, block: str) -> None:
    process, staging = run_until_written(block, tmp_path / "out", "sys.stdin.read()")
    try:
        aged(monkeypatch)
        with whole_folder(tmp_path / "next"):
            assert staging.exists()
    finally:
        process.kill()
        process.wait(timeout=60)


def test_nothing_else_is_cleared(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither what others named alike nor a whole output."""
    aged(monkeypatch)
    whole = tmp_path / ".cmb-0123456789abcdef"
    whole.mkdir()
    (whole / ".written-by-cmb").touch()
    (tmp_path / ".cmb-settings").write_text("mine")
    (tmp_path / "kept").write_text("mine")
    (tmp_path / ".cmb-0123456789abcde0").symlink_to(tmp_path / "kept")
    before = entries(tmp_path)
    with whole_folder(tmp_path / "next"):
        pass
    assert entries(tmp_path) == sorted([*before, "next"])
