"""A page without a browser: opens a session, connects and reads frames as drive_link.js does."""

from __future__ import annotations

import http.client
import json
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from time import time as now
from typing import Any
from urllib.parse import urlsplit

from contact_foundation.errors import SimulationError
from websockets.exceptions import WebSocketException
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from interactive_drive.picture.frame_encoder import HEADER, POSE_BYTES

_TIMEOUT = 10.0


@dataclass(frozen=True)
class ReceivedFrame:
    """What a benchmark needs of a frame; see ``picture.frame_encoder``.

    Attributes:
        time: simulated, s.
        stamp: of the newest input that counts in it.
        number: of the frame.
        size: bytes.
        poses: bytes of them without forces and signals.
        age: since the server heard of it, s.
    """

    time: float
    stamp: float
    number: int
    size: int
    poses: int
    age: float


class PageClient:
    """A connected page.

    Args:
        socket: the connection.
    """

    def __init__(self, socket: ClientConnection) -> None:
        self._socket = socket

    def send(self, message: Mapping[str, Any]) -> None:
        """Sends a message as the page does."""
        self._socket.send(json.dumps(message))

    def receive(self, timeout: float) -> ReceivedFrame | Mapping[str, Any] | None:
        """The next frame or message, None if none comes within ``timeout`` s; frames are acknowledged.

        Raises:
            SimulationError: the connection is lost.
        """
        try:
            data = self._socket.recv(timeout=timeout)
        except TimeoutError:
            return None
        except WebSocketException as error:
            raise SimulationError(f"the connection to the drive is lost: {error}") from error
        if isinstance(data, str):
            message: Mapping[str, Any] = json.loads(data)
            return message
        time, stamp, heard, _, number, _, _, bodies, *_ = HEADER.unpack_from(data)
        self.send({"type": "seen", "number": number})
        poses = HEADER.size + POSE_BYTES * bodies
        return ReceivedFrame(time, stamp, number, len(data), poses, now() - heard / 1e3)


@contextmanager
def open_page(address: str) -> Iterator[PageClient]:
    """Opens the address of a drive and connects.

    Raises:
        SimulationError: the server refuses, or does not answer.
    """
    parts = urlsplit(address)
    request = http.client.HTTPConnection(parts.netloc, timeout=_TIMEOUT)
    try:
        request.request("GET", f"/?{parts.query}")
        answer = request.getresponse()
        cookie = (answer.getheader("set-cookie") or "").partition(";")[0]
    except OSError as error:
        raise SimulationError(f"the drive does not answer: {error}") from error
    finally:
        request.close()
    if not cookie:
        raise SimulationError(f"the drive refuses its own address: status {answer.status}")
    with ExitStack() as stack:
        try:
            socket = stack.enter_context(
                connect(
                    f"ws://{parts.netloc}/drive",
                    origin=Origin(f"http://{parts.netloc}"),
                    additional_headers={"Cookie": cookie},
                    compression=None,
                    open_timeout=_TIMEOUT,
                )
            )
        except (OSError, WebSocketException) as error:
            raise SimulationError(f"the drive refuses the connection: {error}") from error
        yield PageClient(socket)
