"""The web server of an application."""

from __future__ import annotations

from pathlib import Path

import uvicorn
from starlette.types import ASGIApp

_MESSAGE_BYTES = 2**16


def make_server(app: ASGIApp, certificate: Path | None = None, key: Path | None = None) -> uvicorn.Server:
    """A server for an application; ``run(sockets=[...])`` serves until a signal or ``should_exit``.

    Args:
        app: the application.
        certificate: PEM file; None: connections are not encrypted.
        key: PEM file of its key; None: it is in the certificate's file.
    """
    return uvicorn.Server(
        uvicorn.Config(
            app,
            log_level="error",
            access_log=False,
            lifespan="on",
            proxy_headers=False,
            ssl_certfile=certificate,
            ssl_keyfile=key,
            ws_max_size=_MESSAGE_BYTES,
            ws_per_message_deflate=False,
            server_header=False,
            timeout_graceful_shutdown=2,
        )
    )
