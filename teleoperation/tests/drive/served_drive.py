"""A server with a simulation that only notes what it is told, and pages connected to it."""

from __future__ import annotations

import json
import struct
import time
from contextlib import contextmanager

import numpy as np
from interactive_drive.process.messages import Frame
from interactive_drive.server.access import Access
from interactive_drive.server.app import make_app
from interactive_drive.server.hub import Hub
from starlette.testclient import TestClient

PORT = 8420
BASE = f"http://127.0.0.1:{PORT}"
SOCKET = f"ws://127.0.0.1:{PORT}/drive"
ORIGIN = {"origin": BASE}


class NotingSimulation:
    """Notes commands."""

    def __init__(self) -> None:
        self.commands = []
        self.restarts = 0

    def send(self, command) -> None:
        self.commands.append(command)

    def restart(self) -> None:
        self.restarts += 1


class ServedDrive:
    """A served drive."""

    def __init__(self, session) -> None:
        self.simulation = NotingSimulation()
        self.announced = []
        self.hub = Hub(session, self.simulation)
        self.access = Access(PORT, self.announced.append)
        self.client = TestClient(make_app(self.hub, self.access), base_url=BASE)
        self.numbers = 0

    def log_in(self, client=None) -> None:
        client = client or self.client
        answer = client.get(self.access.address.removeprefix(BASE))
        assert answer.status_code == 200

    def wait_for_count(self, count, limit=5.0) -> None:
        until = time.monotonic() + limit
        while len(self.simulation.commands) < count:
            assert time.monotonic() < until, self.simulation.commands
            time.sleep(0.005)

    def frame(self, x=0.0, stamp=0.0) -> None:
        self.numbers += 1
        values = np.array([x, 0.0, 0.0, 1.0, 0.0])
        self.hub.hear(Frame(0.01 * self.numbers, values, stamp, self.numbers, 1.0, self.numbers, 0))

    @contextmanager
    def page(self):
        with self.client.websocket_connect(SOCKET, headers=ORIGIN) as page:
            yield Page(page)

    def wait_for(self, command, limit=5.0) -> None:
        until = time.monotonic() + limit
        while command not in self.simulation.commands:
            assert time.monotonic() < until, self.simulation.commands
            time.sleep(0.005)


class Page:
    """A connected page."""

    def __init__(self, connection) -> None:
        self.connection = connection

    def send(self, **message) -> None:
        self.connection.send_text(json.dumps(message))

    def message(self, kind, **wanted):
        while True:
            received = self.connection.receive()
            if "text" in received and received["text"] is not None:
                message = json.loads(received["text"])
                if message["type"] == kind and all(message[k] == v for k, v in wanted.items()):
                    return message

    def frame(self):
        while True:
            data = self.connection.receive().get("bytes")
            if data:
                self.send(type="seen", number=struct.unpack_from("<I", data, 28)[0])
                return data
