"""A signal ends the program as Ctrl-C does: at once, and without leaving anything."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

MODEL = """model Slow "Takes the integrator's time"
  Real x[2](start={1, 0}, each fixed=true);
equation
  der(x) = {1e3 * x[2], -1e3 * x[1]};
  annotation (experiment(StopTime=1e6, Interval=0.1));
end Slow;
"""


@pytest.fixture(autouse=True)
def interruptible() -> Iterator[None]:
    """Shells make what they run in the background ignore interruptions, and children would inherit that."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def start(folder: Path, cache: Path, *words: str) -> subprocess.Popen[str]:
    temporary = folder / "tmp"
    temporary.mkdir(exist_ok=True)
    environment = {**os.environ, "TMPDIR": str(temporary), "XDG_CACHE_HOME": str(cache)}
    return subprocess.Popen(
        [sys.executable, "-m", "cmb.main", *words],
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def wait_for(folder: Path, pattern: str) -> None:
    deadline = time.monotonic() + 60
    while not any(folder.glob(pattern)):
        assert time.monotonic() < deadline, "the program has not come that far"
        time.sleep(0.02)


def descendants(parent: int) -> list[int]:
    """Processes of the session that ``parent`` leads, itself apart."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        state, session = fields[0], int(fields[3])
        if entry.name.isdigit() and session == parent and int(entry.name) != parent and state != "Z":
            found.append(int(entry.name))
    return found


def test_a_build_leaves_nothing(cache_home: Path, tmp_path: Path) -> None:
    (tmp_path / "Slow.mo").write_text(MODEL)
    program = start(tmp_path, cache_home, "fmu", "Slow", "--no-cache")
    wait_for(tmp_path, "tmp/cmb-fmu-*/linux64/*.o")
    program.send_signal(signal.SIGTERM)
    _, said = program.communicate(timeout=60)
    assert program.returncode == 128 + signal.SIGTERM, said
    assert said.endswith("cmb: interrupted; nothing half-written was left behind\n")
    assert "Traceback" not in said
    assert sorted(path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*")) == ["Slow.mo", "tmp"]


@pytest.mark.parametrize("loading", ["cmb.main", "contact_foundation.errors", "cmb.commands", "cmb.input_file"])
def test_an_interruption_while_the_program_loads_is_no_traceback(loading: str, tmp_path: Path) -> None:
    """Ctrl-C comes as the module is about to be loaded, which is in the first quarter of a second."""
    script = f"""
import signal
import sys

class Interrupts:
    def find_spec(self, name, *_):
        if name == {loading!r}:
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Interrupts())
from cmb.__main__ import start
sys.argv = ["cmb", "simulate", "missing.fmu", "--output", "out.csv"]
sys.exit(start())
"""
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert done.stderr in ("", "cmb: interrupted; nothing half-written was left behind\n")
    assert done.returncode in (-signal.SIGINT, 128 + signal.SIGINT)  # a shell's status is 130 for both
    assert not list(tmp_path.iterdir())


def test_an_interruption_while_python_starts_is_no_traceback(tmp_path: Path) -> None:
    """Ctrl-C some milliseconds after the start, when Python loads modules of its own."""
    launcher = Path(sys.executable).parent / "cmb"
    for wait in range(0, 50, 4):
        program = subprocess.Popen(
            [launcher, "simulate", "missing.fmu", "--output", "out.csv"],
            cwd=tmp_path,
            stderr=subprocess.PIPE,
            text=True,
        )
        time.sleep(wait / 1000)
        program.send_signal(signal.SIGINT)
        _, said = program.communicate(timeout=60)
        assert "Traceback" not in said, f"{wait} ms after the start: {said}"
        assert program.returncode in (-signal.SIGINT, 128 + signal.SIGINT, 2), said


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_second_signal_does_not_interrupt_the_removal(number: signal.Signals, tmp_path: Path) -> None:
    """The second comes while what the first interrupted is removed."""
    script = f"""
import signal
from cmb import main
from cmb.commands import msl

def run(_arguments):
    try:
        signal.raise_signal({int(number)})
    finally:
        signal.raise_signal({int(number)})
        print("removed")

msl.run = run
raise SystemExit(main.main(["msl"]))
"""
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert done.stdout == "removed\n", done.stderr
    assert done.stderr == "cmb: interrupted; nothing half-written was left behind\n"
    assert done.returncode == 128 + number


def test_a_simulation_in_a_process_of_its_own_ends_with_the_program(cache_home: Path, tmp_path: Path) -> None:
    (tmp_path / "Slow.mo").write_text(MODEL)
    assert start(tmp_path, cache_home, "fmu", "Slow").wait(timeout=120) == 0
    program = start(tmp_path, cache_home, "simulate", "Slow.fmu", "--output", "slow.csv", "--time-limit", "600")
    deadline = time.monotonic() + 60
    while not descendants(program.pid):
        assert time.monotonic() < deadline
        time.sleep(0.02)
    program.kill()
    program.communicate(timeout=60)
    while descendants(program.pid):
        assert time.monotonic() < deadline, "the simulation goes on"
        time.sleep(0.02)
    assert not list(tmp_path.glob("*.csv"))
