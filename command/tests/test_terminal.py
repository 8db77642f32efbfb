"""What the terminal shows: notes in few lines, and what runs while it runs."""

from __future__ import annotations

import pytest
from cmb.notes import grouped
from cmb.terminal import progress_bars


def test_notes_that_differ_in_a_name_are_one() -> None:
    alike = [f"part 'r{number}' has no geometry: it moves" for number in range(1, 13)]
    notes = [alike[0], "other 'a' of 'b'", *alike[1:], "other 'a' of 'c'", "plain", "plain"]
    assert grouped(notes) == [
        "12 times: part 'r1', 'r2', 'r3' and 9 more has no geometry: it moves",
        "other 'a' of 'b'",
        "other 'a' of 'c'",
        "plain",
    ]
    assert grouped(alike[:2]) == ["2 times: part 'r1', 'r2' has no geometry: it moves"]
    assert grouped([]) == []


def test_a_phase_is_named_when_it_begins(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_bars() as progress:
        progress("simulate", 0.0, "t = 0 s")
        assert capsys.readouterr().err == "simulate\n"
        progress("simulate", 0.5, "t = 1 s")
        assert capsys.readouterr().err == ""
        progress("simulate", 1.0)
        progress("write", 1.0, "Robot")
    assert capsys.readouterr().err == "write: Robot\n"
