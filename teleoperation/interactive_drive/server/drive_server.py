"""A drive as one thing: the simulation's process, the hub and the web server around them."""

from __future__ import annotations

from collections.abc import Callable
from socket import socket

from interactive_drive.process.simulator import Simulator
from interactive_drive.process.worker import Plan
from interactive_drive.server.access import Access
from interactive_drive.server.app import make_app
from interactive_drive.server.drive_session import DriveSession
from interactive_drive.server.hub import Hub
from interactive_drive.server.listening import Listening
from interactive_drive.server.serving import make_server


class DriveServer:
    """Serves a drive.

    Args:
        plan: what is simulated.
        session: what is driven.
        bound: socket that listens.
        announce: told the address for a further operator whenever one was used.
        listening: where the socket listens; the loopback address if None.

    Attributes:
        hub: of the drive.
        simulator: of the drive.
        access: sessions.
    """

    def __init__(
        self,
        plan: Plan,
        session: DriveSession,
        bound: socket,
        announce: Callable[[str], None],
        listening: Listening | None = None,
    ) -> None:
        self._socket = bound
        listening = listening or Listening()
        self.simulator = Simulator(plan, lambda report: self.hub.hear(report))
        self.hub = Hub(session, self.simulator)
        self.access = Access(bound.getsockname()[1], announce, listening)
        self._server = make_server(make_app(self.hub, self.access), listening.certificate, listening.key)

    @property
    def address(self) -> str:
        """The address that opens a session."""
        return self.access.address

    def serve(self) -> None:
        """Serves until a signal or ``end``; the simulation's process ends with it."""
        self.simulator.start()
        try:
            self._server.run(sockets=[self._socket])
        finally:
            self.simulator.stop()

    def end(self) -> None:
        """Lets ``serve`` return."""
        self._server.should_exit = True
