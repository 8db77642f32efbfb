"""Replay of a record: its rows at the pace of the clock, and the machine afterwards where it was."""

from __future__ import annotations

import numpy as np
import pytest
from contact_foundation.errors import InputError
from interactive_drive.machine.recorded_machine import RecordedMachine
from interactive_drive.process.messages import (
    EndReplay,
    Frame,
    Mode,
    Pause,
    Record,
    RecordedRow,
    Refusal,
    Replay,
    Reset,
    Run,
    Save,
    SetValues,
    SingleStep,
    Status,
    Stop,
)
from interactive_drive.recording.recording import Recording, find_records
from served_drive import ServedDrive
from test_simulation_loop import STEP, drive, last_status


@pytest.fixture
def record(tmp_path):
    """x = 10, 11, ..., 15 at 7.0, 7.1, ..., 7.5 s, beside another signal."""
    made = Recording(tmp_path, ["y", "x"])
    for k in range(6):
        made.append(7 + 0.1 * k, np.array([-k, 10 + k]))
    return made.folder / "result.csv"


def replayed(reports):
    return [(round(frame.time, 6), frame.values[0]) for frame in reports.of(Frame) if frame.replayed]


class TestRecordedMachine:
    def test_it_goes_through_the_rows(self, record):
        machine = RecordedMachine(record, ["x"])
        assert machine.step_length == pytest.approx(0.1)
        rows = []
        while not machine.at_end:
            rows.append((machine.time, *machine.row()))
            machine.step()
        assert rows == [(pytest.approx(7 + 0.1 * k), 10 + k) for k in range(5)]
        machine.step()
        assert machine.row() == [15]
        machine.start_anew()
        assert machine.time == 7

    def test_what_cannot_be_replayed_is_told(self, record):
        with pytest.raises(InputError, match=r"has no z: it is of another machine"):
            RecordedMachine(record, ["x", "z"])
        text = record.read_text()
        record.write_text(text[:-3])
        record.write_text(text + "8.0,3\n")
        with pytest.raises(InputError, match=r"result\.csv.*8.*the row has 2 values, the header 3 names"):
            RecordedMachine(record, ["x"])
        record.write_text("".join(text.splitlines(keepends=True)[:2]))
        with pytest.raises(InputError, match="no time that passes"):
            RecordedMachine(record, ["x"])


class TestLoop:
    def test_a_record_is_gone_through_and_the_machine_waits(self, record):
        machine, reports = drive([Run(), 3, Replay(record), Run(), 20, EndReplay(), 1, SingleStep()])
        assert replayed(reports) == [(pytest.approx(7 + 0.1 * k), 10 + k) for k in range(6)]
        assert any(status.message == "the record ends here" for status in reports.of(Status))
        assert [status.replayed for status in reports.of(Status)][-1] == ""
        assert machine.x == 4 + 1
        frames = reports.of(Frame)
        assert [frame.number for frame in frames] == list(range(1, len(frames) + 1))
        assert (frames[-2].time, frames[-2].replayed) == (4 * STEP, False)  # shown again before it goes on

    def test_it_is_paced_by_the_records_own_steps(self, record):
        _, reports = drive([Replay(record), Run(), 4])
        factors = [frame.factor for frame in reports.of(Frame) if frame.replayed]
        assert factors[-1] == pytest.approx(1.0)

    def test_single_steps_pause_reset_and_another_run_from_the_end(self, record):
        _, reports = drive([Replay(record), SingleStep(), SingleStep(), Reset(), Run(), 10, Run(), 1, Pause()])
        values = [x for _, x in replayed(reports)]
        assert values == [10, 11, 12, 10, 11, 12, 13, 14, 15, 11, 12]
        assert not any(status.keeps_states for status in reports.of(Status) if status.replayed)

    def test_inputs_and_saved_states_are_the_machines(self, record):
        machine, reports = drive([SingleStep(), Save(), Replay(record), SetValues({"push": 9.0}), Save(), EndReplay()])
        assert replayed(reports)[-1][1] == 10
        assert machine.push == 9  # a late one, or what an operator who leaves lets go of
        assert len(last_status(reports).saved) == 1
        assert machine.saved == 2  # the start, and the one that was asked for

    def test_another_record_follows_and_one_that_runs_ends(self, record):
        _, reports = drive([Record(on=True), SingleStep(), Replay(record), Replay(record), EndReplay(), 1])
        assert len(reports.of(RecordedRow)) == 2
        assert [frame.values[0] for frame in reports.of(Frame)] == [0, 1, 10, 1, 10, 1]
        assert last_status(reports).mode is Mode.PAUSED

    def test_the_program_can_end_within_a_replay(self, record):
        machine, reports = drive([Replay(record), SingleStep(), Stop(), SingleStep()])
        assert replayed(reports)[-1][1] == 11
        assert machine.x == 0

    def test_a_failure_stays_a_failure(self, record):
        script = [SetValues({"push": 101.0}), SingleStep(), Replay(record), Run(), 2]
        machine, reports = drive([*script, EndReplay(), SingleStep()])
        assert (last_status(reports).mode, last_status(reports).message) == (Mode.FAILED, "x is too large")
        assert machine.x == 0

    def test_a_record_that_cannot_be_read_changes_nothing(self, record):
        record.write_text("time,x\n0,0\n1,oops\n")
        _, reports = drive([SingleStep(), Replay(record), Run(), 2])
        assert "'oops' is not a number" in reports.of(Refusal)[0].text
        assert not replayed(reports)
        assert last_status(reports).mode is Mode.RUNNING


def test_records_are_found_in_their_order(tmp_path):
    for name in ("record-10", "record-9", "record-x", "other"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "result.csv").touch()
    (tmp_path / "record-11").mkdir()
    assert list(find_records(tmp_path)) == ["record-9", "record-10"]
    assert find_records(tmp_path / "none") == {}


class TestServer:
    @pytest.fixture
    def page(self, session):
        Recording(session.output, session.signals)
        self.drive = ServedDrive(session)
        with self.drive.client:
            self.drive.log_in()
            with self.drive.page() as page:
                assert page.message("records")["names"] == ["record-1"]
                page.message("steering")
                yield page

    def test_a_record_is_replayed_by_its_name(self, page, session):
        page.send(type="replay", record="record-1")
        assert "does not run" in page.message("remark")["text"]
        self.drive.hub.hear(Status(Mode.PAUSED))
        page.message("status", mode="paused")
        for name in ("record-2", "../record-1", None, ["record-1"]):
            page.send(type="replay", record=name)
            assert "there is no record" in page.message("remark")["text"]
        page.send(type="replay", record="record-1")
        page.send(type="leave")
        self.drive.wait_for(EndReplay())
        assert self.drive.simulation.commands == [Replay(session.output / "record-1" / "result.csv"), EndReplay()]

    def test_sliders_follow_and_nothing_is_recorded(self, page, session):
        self.drive.hub.hear(Status(Mode.PAUSED, replayed="record-1"))
        assert page.message("status", mode="paused")["replayed"] == "record-1"
        for force in (5.0, 6.0):
            values = np.array([0.0, 0.0, force, 1.0, 0.0])
            self.drive.hub.hear(Frame(force, values, 0.0, int(force), 1.0, 1, 0, replayed=True))
            assert page.message("controls")["values"]["force"] == force
        page.send(type="record", on=True)
        assert "is not recorded" in page.message("remark")["text"]
        assert list(find_records(session.output)) == ["record-1"]
        self.drive.hub.hear(Refusal("the record is torn"))
        assert page.message("remark", bad=True)["text"] == "the record is torn"
