"""The server with a simulation that only notes what it is told: who may come in, who steers, what is sent."""

from __future__ import annotations

import socket
import struct
import threading
import time

import numpy as np
import pytest
from contact_foundation.errors import InputError
from fmu_regression.results.result import read_csv
from interactive_drive.process.messages import (
    Frame,
    Mode,
    Pause,
    Record,
    RecordedRow,
    Reset,
    Restore,
    Run,
    Save,
    SavedState,
    SetSpeed,
    SetValues,
    SingleStep,
    Status,
)
from interactive_drive.server.listening import Listening
from interactive_drive.server.streaming import MOST_IN_FLIGHT
from interactive_drive.server.token_limit import MOST_WRONG
from served_drive import BASE, ORIGIN, SOCKET, ServedDrive
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect


@pytest.fixture
def drive(session):
    drive = ServedDrive(session)
    with drive.client:
        yield drive


@pytest.fixture
def page(drive):
    drive.log_in()
    with drive.page() as page:
        page.message("steering")
        yield page


class TestAccess:
    def test_the_page_and_its_scripts_need_a_session(self, drive):
        for path in ("/", "/drive.js", "/viewer.js", "/scene.json"):
            answer = drive.client.get(path)
            assert answer.status_code == 403, path
            assert "Open the address that the terminal shows" in answer.text
        drive.log_in()
        assert "<canvas" in drive.client.get("/").text
        for name in ("drive.js", "drive_link.js", "drive_controls.js"):
            assert "use strict" in drive.client.get(f"/{name}").text
        assert drive.client.get("/report.css").headers["content-type"].startswith("text/css")
        for name in ("report.js", "..%2fserver%2fapp.py", "py.typed"):
            assert drive.client.get(f"/{name}").status_code == 404

    def test_an_address_opens_once(self, drive):
        first = drive.access.address.removeprefix(BASE)
        drive.log_in()
        assert drive.announced == [drive.access.address]
        assert drive.client.get(first).status_code == 200  # the same browser may load it again
        other = TestClient(drive.client.app, base_url=BASE)
        answer = other.get(first)
        assert answer.status_code == 403
        assert "used already" in answer.text
        drive.log_in(other)  # the next address opens

    def test_wrong_tokens_are_limited(self, drive):
        for _ in range(MOST_WRONG):
            assert drive.client.get("/?token=wrong").status_code == 403
        answer = drive.client.get(drive.access.address.removeprefix(BASE))
        assert answer.status_code == 429
        assert 1 <= int(answer.headers["retry-after"]) <= 60
        assert not drive.announced
        other = TestClient(drive.client.app, base_url=BASE, client=("10.0.0.7", 5000))
        drive.log_in(other)  # who comes from elsewhere is not kept out

    def test_a_wrong_token_opens_nothing(self, drive):
        assert drive.client.get("/?token=wrong").status_code == 403
        assert drive.client.get("/?token=%ff%fe").status_code == 403
        assert not drive.announced

    @pytest.mark.parametrize(
        "host", ["evil.example:8420", "127.0.0.1:80", "127.0.0.1", "", "127.0.0.1:8420.evil.example"]
    )
    def test_other_names_of_this_machine_are_refused(self, drive, host):
        drive.log_in()
        assert drive.client.get("/", headers={"host": host}).status_code == 403
        with (
            pytest.raises(WebSocketDisconnect),
            drive.client.websocket_connect(SOCKET, headers={**ORIGIN, "host": host}),
        ):
            pass

    @pytest.mark.parametrize(
        "origin", ["http://evil.example", "null", "http://127.0.0.1:8421", "https://127.0.0.1:8420", None]
    )
    def test_other_origins_cannot_connect(self, drive, origin):
        drive.log_in()
        headers = {} if origin is None else {"origin": origin}
        with pytest.raises(WebSocketDisconnect), drive.client.websocket_connect(SOCKET, headers=headers):
            pass
        if origin is not None:
            assert drive.client.get("/", headers=headers).status_code == 403

    def test_a_connection_needs_a_session(self, drive):
        with pytest.raises(WebSocketDisconnect), drive.client.websocket_connect(SOCKET, headers=ORIGIN):
            pass
        drive.client.cookies.set(drive.access.cookie, "guessed")
        with pytest.raises(WebSocketDisconnect), drive.client.websocket_connect(SOCKET, headers=ORIGIN):
            pass

    def test_nothing_from_elsewhere_is_loaded(self, drive):
        drive.log_in()
        answer = drive.client.get("/")
        assert answer.headers["content-security-policy"].startswith("default-src 'none'")
        assert "http://" not in answer.text
        assert "https://" not in answer.text


class TestSteering:
    def test_the_page_learns_what_it_drives(self, drive):
        drive.log_in()
        with drive.page() as page:
            hello = page.message("hello")
            assert hello["model"] == "PushedMass"
            assert [control["name"] for control in hello["controls"]] == ["force", "damping", "pause"]
            assert hello["plots"] == ["x"]
            assert page.message("status")["mode"] == "starting"
            assert page.message("steering") == {"type": "steering", "you": True, "free": False, "operators": 1}

    def test_buttons_become_commands(self, drive, page):
        for message in (
            {"type": "run"},
            {"type": "pause"},
            {"type": "step"},
            {"type": "reset"},
            {"type": "save"},
            {"type": "restore", "number": 3},
            {"type": "speed", "value": 0.25},
        ):
            page.send(**message)
        page.send(type="values", values={"force": 1e9, "damping": 2}, stamp=12.5)
        drive.wait_for(SetValues({"force": 100.0, "damping": 2.0}, 12.5))
        assert drive.simulation.commands[:-1] == [
            Run(), Pause(), SingleStep(), Reset(), Save(), Restore(3), SetSpeed(0.25),
        ]  # fmt: skip

    @pytest.mark.parametrize(
        ("text", "told"),
        [
            ("{", "no JSON"),
            ("[1]", "no table"),
            ('{"type": "fly"}', "unknown type 'fly'"),
            ('{"type": "values", "values": {"x": 1}}', "'x' cannot be set"),
            ('{"type": "values", "values": {"force": NaN}}', "no JSON"),
            ('{"type": "values", "values": {"force": 1e999}}', "is not a number"),
            ('{"type": "values", "values": {"force": "1"}}', "cannot be set"),
            ('{"type": "speed", "value": "fast"}', "value is no number"),
        ],
    )
    def test_wrong_messages_are_refused_and_the_page_stays(self, drive, page, text, told):
        page.connection.send_text(text)
        assert told in page.message("remark")["text"]
        assert drive.simulation.commands == []
        page.send(type="run")
        drive.wait_for(Run())

    def test_a_second_operator_watches(self, drive, page):
        with drive.page() as second:
            assert second.message("steering")["you"] is False
            assert page.message("steering", operators=2)["you"] is True
            for message in ({"type": "run"}, {"type": "values", "values": {"force": 1.0}}, {"type": "steer"}):
                second.send(**message)
                assert "another operator steers" in second.message("remark")["text"]
            assert drive.simulation.commands == []
            drive.frame(x=3.0)
            assert second.frame()

    def test_who_closes_the_page_lets_go_and_another_may_take_over(self, drive):
        drive.log_in()
        with drive.page() as second_place:
            second_place.message("steering")
            with drive.page() as watching:
                assert watching.message("steering")["you"] is False
                second_place.connection.close()
                assert watching.message("steering", free=True)["you"] is False
                drive.wait_for(SetValues({"force": 0.0}))
                watching.send(type="steer")
                assert watching.message("steering", you=True)
                watching.send(type="run")
                drive.wait_for(Run())

    def test_a_failure_and_the_states_to_go_back_to_are_told(self, drive, page):
        saved = (SavedState(4, 2.0, automatic=True),)
        drive.hub.hear(Status(Mode.FAILED, message="the rope is torn", saved=saved, keeps_states=True))
        status = page.message("status", mode="failed")
        assert status["message"] == "the rope is torn"
        assert status["saved"] == [{"number": 4, "time": 2.0, "automatic": True}]

    def test_a_process_that_ended_is_started_again(self, drive, page):
        drive.hub.hear(Status(Mode.ENDED, message="signal SIGSEGV in the FMU"))
        page.message("status", mode="ended")
        page.send(type="restart")
        until = time.monotonic() + 5
        while not drive.simulation.restarts and time.monotonic() < until:
            time.sleep(0.01)
        assert drive.simulation.restarts == 1


class TestFrames:
    def test_a_frame_has_its_header_and_the_chosen_signals(self, drive, page):
        page.send(type="signals", names=["force", "x", "nonsense"])
        assert page.message("plots")["names"] == ["force", "x"]
        drive.frame(x=2.5, stamp=9.0)
        data = page.frame()
        time_, stamp, sent, factor, number, steps, missed, *counts = struct.unpack_from("<dddfIIIHHHH", data)
        assert (time_, stamp, factor, number, steps, missed) == (0.01, 9.0, 1.0, 1, 1, 0)
        assert abs(sent / 1e3 - time.time()) < 10
        assert counts == [0, 0, 2, 1]
        assert struct.unpack_from("<3f", data, 48) == (0.0, 0.0, 2.5)

    def test_frames_of_a_new_simulation_are_counted_anew(self, drive, page):
        for number in (500, 501):  # drawn never: the page had newer ones before
            drive.numbers = number - 1
            drive.frame()
            assert page.connection.receive_bytes()
        drive.numbers = 0
        page.send(type="seen", number=500)
        for _ in range(5):
            drive.frame()
            assert page.frame()

    def test_a_page_that_sees_nothing_gets_few_frames_and_then_the_newest(self, drive, page):
        for _ in range(MOST_IN_FLIGHT):
            drive.frame()
            assert page.connection.receive_bytes()  # not acknowledged
        for k in range(50):
            drive.frame(x=float(k))
            time.sleep(0.002)  # each is heard
        time.sleep(0.1)
        page.send(type="seen", number=MOST_IN_FLIGHT)
        data = page.connection.receive_bytes()
        assert struct.unpack_from("<I", data, 28)[0] == MOST_IN_FLIGHT + 50
        samples = np.frombuffer(data, "<f4", offset=48).reshape(-1, 2)
        assert samples[-1] == pytest.approx([0, 49])  # the plot misses nothing that the server heard
        assert len(samples) > 10
        assert (np.diff(samples[:, 1]) > 0).all()

    def test_where_time_goes_back_the_sliders_follow(self, drive, page):
        drive.frame()
        page.frame()
        drive.hub.hear(Frame(0.0, np.array([0.0, 0.0, 25.0, 3.0, 0.0]), 0.0, 9, 1.0, 1, 0))
        assert page.message("controls")["values"] == {"force": 25.0, "damping": 3.0, "pause": 0.0}

    def test_frames_before_the_server_stands_are_not_lost(self, session):
        drive = ServedDrive(session)
        drive.frame(x=1.0)
        with drive.client:
            drive.log_in()
            with drive.page() as page:
                page.message("steering")
                assert page.frame()

    def test_without_a_scene_there_is_nothing_to_draw(self, drive):
        drive.log_in()
        drive.frame()
        assert drive.client.get("/scene.json").json() is None


class TestRecord:
    def record(self, drive, page, rows):
        drive.hub.hear(Status(Mode.RUNNING))
        page.message("status", mode="running")
        page.send(type="record", on=True)
        drive.wait_for(Record(on=True))
        drive.hub.hear(Status(Mode.RUNNING, recording=True))
        for k in range(rows):
            drive.hub.hear(RecordedRow(0.01 * k, np.array([0.1 * k, 0.0, 0.0, 1.0, 0.0])))
        page.send(type="record", on=False)
        drive.wait_for(Record(on=False))
        drive.hub.hear(Status(Mode.RUNNING, recording=False))

    def test_a_record_becomes_a_result_and_a_report(self, drive, page, session):
        for number in (1, 2):
            drive.simulation.commands.clear()
            self.record(drive, page, 30)
            while not (told := page.message("remark"))["text"].startswith("recorded"):
                assert not told["bad"]
            folder = session.output / f"record-{number}"
            assert str(folder) in told["text"]
            result = read_csv(folder / "result.csv")
            assert result.time.size == 30
            assert result["x"][-1] == pytest.approx(2.9)
            assert "PushedMass" in (folder / "report.html").read_text()

    def test_a_record_of_nothing_is_told(self, drive, page):
        self.record(drive, page, 1)
        while not (told := page.message("remark"))["bad"]:
            pass
        assert "fewer than two steps" in told["text"]

    def test_a_record_that_runs_when_the_server_ends_gets_its_report(self, session):
        drive = ServedDrive(session)
        with drive.client:
            drive.log_in()
            drive.hub.hear(Status(Mode.PAUSED))
            with drive.page() as page:
                page.message("status", mode="paused")
                page.send(type="record", on=True)
                drive.wait_for(Record(on=True))
                drive.hub.hear(Status(Mode.RUNNING, recording=True))
                for k in range(5):
                    drive.hub.hear(RecordedRow(0.01 * k, np.zeros(5)))
        assert (session.output / "record-1" / "report.html").is_file()

    def test_a_process_that_ends_before_it_records_ends_the_record(self, drive, page):
        drive.hub.hear(Status(Mode.PAUSED))
        page.message("status", mode="paused")
        page.send(type="record", on=True)
        drive.wait_for(Record(on=True))
        drive.hub.hear(Status(Mode.ENDED, message="signal SIGSEGV in the FMU"))
        while not (told := page.message("remark"))["bad"]:
            pass
        assert "fewer than two steps" in told["text"]
        drive.simulation.commands.clear()
        self.record(drive, page, 10)  # the next one is another one
        while not (told := page.message("remark"))["text"].startswith("recorded"):
            assert not told["bad"]
        assert "record-2" in told["text"]

    def test_a_machine_that_failed_is_not_recorded(self, drive, page, session):
        drive.hub.hear(Status(Mode.FAILED, message="the rope is torn"))
        page.message("status", mode="failed")
        page.send(type="record", on=True)
        assert "cannot be recorded" in page.message("remark")["text"]
        assert not session.output.exists()

    def test_a_folder_that_cannot_be_written_is_told(self, drive, page, session):
        session.output.write_text("a file is in the way")
        drive.hub.hear(Status(Mode.PAUSED))
        page.message("status", mode="paused")
        page.send(type="record", on=True)
        told = page.message("remark")
        assert told["bad"]
        assert "the record cannot be written" in told["text"]
        assert drive.simulation.commands == []


def test_a_port_in_use_is_told():
    with Listening().bind(0) as bound:
        port = bound.getsockname()[1]
        with pytest.raises(InputError, match=rf"port {port}: is in use by another program(?s:.*)--port"):
            Listening().bind(port)
        assert bound.getsockname()[0] == "127.0.0.1"
        assert isinstance(bound, socket.socket)


def test_rows_of_a_record_are_written_in_the_simulations_thread(session):
    drive = ServedDrive(session)
    with drive.client:
        drive.log_in()
        drive.hub.hear(Status(Mode.PAUSED))
        with drive.page() as page:
            page.message("status", mode="paused")
            page.send(type="record", on=True)
            drive.wait_for(Record(on=True))
            thread = threading.Thread(target=lambda: drive.hub.hear(RecordedRow(0.0, np.zeros(5))))
            thread.start()
            thread.join()
            assert len((session.output / "record-1" / "result.csv").read_text().splitlines()) == 2
