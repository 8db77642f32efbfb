"""The page's server: sessions that go on where they stopped, two tabs, and requests that are refused."""

from __future__ import annotations

import base64
import http.client
import json
import socket
import threading

import numpy as np
import pytest
from cmb.main import main
from contact_foundation.errors import InputError
from depth_study.page.scene import scene_data, view_of
from depth_study.page.server import StudyServer
from depth_study.page.session import StudySessions
from depth_study.page.viewing import Viewing
from depth_study.record.answers import SAME
from depth_study.record.database import create_database, open_database
from small_designs import DESIGN_FILE, thesis

TEXT = DESIGN_FILE.read_text()


class RunningStudy:
    """A study that is served in a thread of its own."""

    def __init__(self, path, port=0):
        self.database = open_database(path) if path.exists() else create_database(path, TEXT, seed=1)
        self.server = StudyServer(port)
        self._thread = threading.Thread(target=self.server.serve, args=(StudySessions(self.database, Viewing()),))
        self._thread.start()

    def stop(self):
        self.server.shutdown()
        self._thread.join()
        self.server.server_close()
        self.database.close()

    def ask(self, path, data=None, *, raw=None, headers=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.server.server_port, timeout=10)
        own = {"Origin": f"http://127.0.0.1:{self.server.server_port}", "Content-Type": "application/json"}
        body = raw if raw is not None else json.dumps(data)
        if data is None and raw is None:
            connection.request("GET", path, headers=headers or {})
        else:
            connection.request("POST", path, body=body, headers={**own, **(headers or {})})
        reply = connection.getresponse()
        content = reply.read()
        connection.close()
        return reply.status, json.loads(content) if reply.headers["Content-Type"] == "application/json" else content


@pytest.fixture
def study(tmp_path):
    running = RunningStudy(tmp_path / "study.db")
    yield running
    running.stop()


def answer(position, absolute=4, **others):
    relative = None if position == 0 else SAME
    return {"observer": 1, "tab": "a", "position": position, "absolute": absolute, "relative": relative, **others}


def test_a_session_runs_to_its_end(study):
    status, state = study.ask("/begin", {"observer": 1, "tab": "a"})
    assert status == 200
    seen = []
    while not state["finished"]:
        seen.append("/".join(state["levels"].values()))
        status, state = study.ask("/answer", answer(state["position"]))
        assert status == 200
    assert sorted(seen) == sorted(thesis().names)
    answers = study.database.answers()
    assert (answers.absolute == 4).all()
    assert [answers.design.names[k] for k in answers.sequences[0]] == seen


def test_every_answer_is_in_the_file_before_it_is_acknowledged(study):
    study.ask("/begin", {"observer": 1, "tab": "a"})
    study.ask("/answer", answer(0))
    other = open_database(study.database.path)
    assert other.observers() == {1: 1}
    other.close()


def test_a_broken_session_goes_on_where_it_stopped(tmp_path):
    first = RunningStudy(tmp_path / "study.db")
    first.ask("/begin", {"observer": 1, "tab": "a"})
    _, before = first.ask("/answer", answer(0))
    first.stop()
    second = RunningStudy(tmp_path / "study.db")
    try:
        # The page that is still open answers without beginning again, and a new one begins where it stopped.
        status, state = second.ask("/answer", answer(1))
        assert (status, state["position"]) == (200, 2)
        assert before["position"] == 1
        _, state = second.ask("/begin", {"observer": 1, "tab": "b"})
        assert state["position"] == 2
        assert second.ask("/start")[1]["unfinished"] == [1]
    finally:
        second.stop()


def test_the_last_tab_has_the_session(study):
    study.ask("/begin", {"observer": 1, "tab": "a"})
    study.ask("/answer", answer(0))
    study.ask("/begin", {"observer": 1, "tab": "b"})
    status, reply = study.ask("/answer", answer(1))
    assert (status, reply["kind"]) == (409, "tab")
    assert "goes on in another tab" in reply["error"]
    assert study.ask("/answer", answer(1, tab="b"))[0] == 200
    assert study.database.observers() == {1: 2}


def test_an_answer_that_is_sent_twice_counts_once(study):
    study.ask("/begin", {"observer": 1, "tab": "a"})
    assert study.ask("/answer", answer(0, 4))[0] == 200
    status, reply = study.ask("/answer", answer(0, 8))
    assert (status, reply["kind"]) == (409, "answered")
    assert study.database.answers_of(1)[0].absolute == 4


def test_a_full_disk_is_told_and_the_answer_can_be_given_again(study):
    study.ask("/begin", {"observer": 1, "tab": "a"})
    connection = study.database._connection
    (pages,) = connection.execute("PRAGMA page_count").fetchone()
    connection.execute(f"PRAGMA max_page_count = {pages}")
    for observer in range(2, 60):  # until the file's last page is full
        status, reply = study.ask("/begin", {"observer": observer, "tab": "a"})
        if status != 200:
            break
    assert status == 507
    assert "the disk is full" in reply["error"]
    connection.execute("PRAGMA max_page_count = 100000")
    assert study.ask("/answer", answer(0))[0] == 200


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"absolute": 0}, "the absolute answer is '0'"),
        ({"absolute": 4.5}, "the absolute answer is '4.5'"),
        ({"absolute": True}, "the absolute answer is 'True'"),
        ({"absolute": None}, "the absolute answer is 'None'"),
        ({"position": "x"}, "which constellation"),
        ({"observer": -1}, "observers are numbers from 1"),
        ({"observer": 7}, "there is no observer 7"),
        ({"tab": ""}, "which tab"),
    ],
)
def test_wrong_answers_are_refused(study, change, told):
    study.ask("/begin", {"observer": 1, "tab": "a"})
    status, reply = study.ask("/answer", {**answer(0), **change})
    assert status == 400
    assert told in reply["error"]
    assert study.database.observers() == {1: 0}


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity"])
def test_what_is_no_number_is_refused(study, number):
    study.ask("/begin", {"observer": 1, "tab": "a"})
    raw = json.dumps(answer(0)).replace("4", number)
    status, reply = study.ask("/answer", raw=raw)
    assert status == 400
    assert f"{number} is no number" in reply["error"]


def test_a_missing_relative_answer_is_refused(study):
    study.ask("/begin", {"observer": 1, "tab": "a"})
    study.ask("/answer", answer(0))
    status, reply = study.ask("/answer", {**answer(1), "relative": None})
    assert status == 400
    assert "relative" in reply["error"]


@pytest.mark.parametrize(
    ("raw", "status"), [("{", 400), ("[]", 400), ("[" * 4000, 400), ('"' + "x" * 5000 + '"', 413), ("\xff", 400)]
)
def test_bodies_that_cannot_be_read_are_refused(study, raw, status):
    assert study.ask("/answer", raw=raw.encode("latin-1"))[0] == status


def test_other_hosts_and_origins_are_refused(study):
    port = study.server.server_port
    assert study.ask("/start", headers={"Host": f"example.org:{port}"})[0] == 403
    assert study.ask("/start", headers={"Host": f"localhost:{port}"})[0] == 200
    begin = {"observer": 1, "tab": "a"}
    for origin in ("http://example.org", "null", f"http://127.0.0.1:{port + 1}", f"https://127.0.0.1:{port}"):
        assert study.ask("/begin", begin, headers={"Origin": origin})[0] == 403
    assert study.ask("/begin", begin, headers={"Content-Type": "text/plain"})[0] == 415
    assert study.database.observers() == {}
    assert study.ask("/begin", begin, headers={"Origin": f"http://localhost:{port}"})[0] == 200


@pytest.mark.parametrize("path", ["/study.db", "/../study.db", "/assets/study.js", "/page/session.py"])
def test_nothing_but_the_page_is_served(study, path):
    assert study.ask(path)[0] == 404
    assert study.ask(path, {})[0] == 404


def test_the_page_loads_nothing_from_elsewhere(study):
    status, page = study.ask("/")
    assert status == 200
    assert b"//" not in page.replace(b"<!doctype html>", b"")


def test_a_port_in_use_is_told():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(InputError, match=f"port {port} is in use"):
            StudyServer(port)


def test_connections_that_say_nothing_hold_nothing_up(study):
    with socket.create_connection(("127.0.0.1", study.server.server_port)) as idle:
        idle.send(b"POST /answer HTTP/1.1\r\n")
        assert study.ask("/start")[0] == 200
        idle.shutdown(socket.SHUT_RDWR)


def test_deleting_an_observer_frees_the_number(study):
    study.ask("/begin", {"observer": 1, "tab": "a"})
    study.ask("/answer", answer(0))
    assert study.ask("/delete", {"observer": 1})[1]["free"] == 1
    assert study.database.observers() == {}
    status, reply = study.ask("/answer", answer(1))
    assert status == 400
    assert "there is no observer 1" in reply["error"]


def test_constellations_of_other_designs_are_named_and_not_drawn():
    viewing = Viewing()
    assert view_of({"technique": "plain", "camera": "central", "scene": "still"}, viewing) is not None
    assert view_of({"technique": "smell", "camera": "central", "scene": "still"}, viewing) is None
    assert view_of({"technique": "plain", "camera": "fisheye", "scene": "still"}, viewing) is None
    assert view_of({"display": "screen"}, viewing) is None


def test_the_machine_stands_at_the_convergence_distance():
    scene = scene_data(Viewing(convergence_distance=3.0))
    assert scene["viewer"]["stand"] == {"eye": [0, 0, 0], "target": [0, 0, -3]}
    assert scene["swing"]["depth"] == -3.0
    corners = np.frombuffer(base64.b64decode(scene["viewer"]["bodies"][0]["meshes"][0]["vertices"]), "<f4")
    assert corners.reshape(-1, 3).mean(axis=0)[[0, 2]] == pytest.approx(0)  # in the axis of the swing


def test_without_the_viewers_scripts_it_is_refused_and_no_study_is_made(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("scene_viewer.bundle._file", lambda name: tmp_path / "gone" / name)
    assert main(["depth-study", "run", str(tmp_path / "study.db"), "--no-browser", "--port", "0"]) == 2
    assert "scripts/setup" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
