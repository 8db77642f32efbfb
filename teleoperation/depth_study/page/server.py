"""The page's server: this machine alone, one study.

It listens on the loopback address. Requests for other hosts (DNS rebinding) and changes asked for by other sites' pages
(their origin) are refused; nothing but the page's own files is served.
"""

from __future__ import annotations

import errno
import json
from collections.abc import Callable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from typing import Any

from contact_foundation.errors import CmbError, InputError
from scene_viewer.bundle import bundled

from depth_study.page.session import OtherTabError, StudySessions
from depth_study.record.database import AnsweredError, StorageError

_ADDRESS = "127.0.0.1"
_MAX_BODY = 4096
_PATIENCE = 10.0
_ASSETS = {
    "/": ("study.html", "text/html; charset=utf-8"),
    "/study.css": ("study.css", "text/css; charset=utf-8"),
    "/study.js": ("study.js", "text/javascript; charset=utf-8"),
    "/goggles.js": ("goggles.js", "text/javascript; charset=utf-8"),
}
_HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class StudyServer(ThreadingHTTPServer):
    """Serves the page of a study.

    The port is taken at once; requests wait until `serve` is called.

    Args:
        port: 0 for any that is free.

    Raises:
        InputError: the port is in use or not allowed.
    """

    daemon_threads = False  # answers that are being stored are stored before the program ends

    sessions: StudySessions

    def __init__(self, port: int) -> None:
        try:
            super().__init__((_ADDRESS, port), _Handler)
        except OSError as error:
            reason = {errno.EADDRINUSE: "is in use", errno.EACCES: "is not allowed to you"}.get(error.errno or 0)
            raise InputError(
                f"port {port} {reason or error.strerror}",
                remedy="End the program that uses it, or choose another by --port (0: any that is free).",
            ) from error

    def serve(self, sessions: StudySessions) -> None:
        """Serves a study's sessions until `shutdown` is called."""
        self.sessions = sessions
        self.serve_forever()

    @property
    def address(self) -> str:
        """What a browser on this machine opens."""
        return f"http://{_ADDRESS}:{self.server_port}/"

    @property
    def hosts(self) -> tuple[str, str]:
        """The hosts by which a browser may ask."""
        return f"{_ADDRESS}:{self.server_port}", f"localhost:{self.server_port}"

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Connections that a browser breaks off are of no interest."""


class _Refused(Exception):
    def __init__(self, status: HTTPStatus, message: str) -> None:
        super().__init__(message)
        self.status = status


class _Handler(BaseHTTPRequestHandler):
    server: StudyServer
    timeout = _PATIENCE
    server_version = "ContactMultiBody"
    sys_version = ""

    def do_GET(self) -> None:
        self._carry_out(self._get)

    def do_POST(self) -> None:
        self._carry_out(self._post)

    def log_message(self, format: str, *args: Any) -> None:
        """The terminal stays quiet."""

    def _carry_out(self, action: Callable[[], None]) -> None:
        try:
            if self.headers.get("Host") not in self.server.hosts:
                raise _Refused(HTTPStatus.FORBIDDEN, f"this page is at {self.server.address} alone")
            action()
        except _Refused as refusal:
            self._send_json(refusal.status, {"error": str(refusal)})
        except (OtherTabError, AnsweredError) as error:
            kind = "tab" if isinstance(error, OtherTabError) else "answered"
            self._send_json(HTTPStatus.CONFLICT, {"error": str(error), "kind": kind})
        except StorageError as error:
            self._send_json(HTTPStatus.INSUFFICIENT_STORAGE, {"error": str(error)})
        except InputError as error:
            self._send_json(HTTPStatus.BAD_REQUEST, {"error": str(error)})
        except CmbError as error:
            self._send_json(HTTPStatus.INTERNAL_SERVER_ERROR, {"error": str(error)})

    def _get(self) -> None:
        if self.path == "/start":
            self._send_json(HTTPStatus.OK, self.server.sessions.start())
        elif self.path == "/viewer.js":
            self._send(HTTPStatus.OK, bundled("viewer.js").encode(), _ASSETS["/study.js"][1])
        elif self.path in _ASSETS:
            name, kind = _ASSETS[self.path]
            self._send(HTTPStatus.OK, files("depth_study.page").joinpath("assets", name).read_bytes(), kind)
        else:
            raise _Refused(HTTPStatus.NOT_FOUND, "there is no such page")

    def _post(self) -> None:
        if self.headers.get("Origin") not in [f"http://{host}" for host in self.server.hosts]:
            raise _Refused(HTTPStatus.FORBIDDEN, "pages of other sites cannot answer")
        if self.headers.get_content_type() != "application/json":
            raise _Refused(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, "answers are JSON")
        data = self._body()
        sessions = self.server.sessions
        if self.path == "/begin":
            state = sessions.begin(data.get("observer"), data.get("tab"))
        elif self.path == "/answer":
            state = sessions.answer(data)
        elif self.path == "/delete":
            state = sessions.delete(data.get("observer"))
        else:
            raise _Refused(HTTPStatus.NOT_FOUND, "there is no such page")
        self._send_json(HTTPStatus.OK, state)

    def _body(self) -> dict[str, Any]:
        length = self.headers.get("Content-Length", "")
        if not length.isascii() or not length.isdigit() or int(length) > _MAX_BODY:
            raise _Refused(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"answers have at most {_MAX_BODY} bytes")
        try:
            data = json.loads(self.rfile.read(int(length)), parse_constant=_no_number)
        except (ValueError, RecursionError) as error:
            raise _Refused(HTTPStatus.BAD_REQUEST, f"the answer cannot be read: {error}") from error
        if not isinstance(data, dict):
            raise _Refused(HTTPStatus.BAD_REQUEST, "the answer cannot be read: it is no object")
        return data

    def _send_json(self, status: HTTPStatus, data: dict[str, Any]) -> None:
        self._send(status, json.dumps(data, allow_nan=False).encode(), "application/json")

    def _send(self, status: HTTPStatus, body: bytes, kind: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)


def _no_number(text: str) -> float:
    raise ValueError(f"{text} is no number")
