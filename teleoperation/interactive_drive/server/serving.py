"""Listening on this machine's loopback address."""

from __future__ import annotations

import errno
import socket

import uvicorn
from contact_foundation.errors import InputError, Place
from starlette.types import ASGIApp

LOOPBACK = "127.0.0.1"
DEFAULT_PORT = 8420
_BACKLOG = 64
_MESSAGE_BYTES = 2**16


def bind(port: int) -> socket.socket:
    """A socket bound to a port of the loopback address; 0 takes any free one.

    Raises:
        InputError: the port is in use, or not for this user.
    """
    bound = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        bound.bind((LOOPBACK, port))
        bound.listen(_BACKLOG)
    except OSError as error:
        bound.close()
        in_use = error.errno == errno.EADDRINUSE
        raise InputError(
            "is in use by another program, perhaps another cmb drive"
            if in_use
            else f"cannot be used: {error.strerror}",
            place=Place(component=f"port {port}"),
            remedy="Name another one with --port, or 0 for any that is free.",
        ) from error
    return bound


def make_server(app: ASGIApp) -> uvicorn.Server:
    """A server for an application; ``run(sockets=[...])`` serves until a signal or ``should_exit``."""
    return uvicorn.Server(
        uvicorn.Config(
            app,
            log_level="error",
            access_log=False,
            lifespan="on",
            ws_max_size=_MESSAGE_BYTES,
            ws_per_message_deflate=False,
            server_header=False,
            timeout_graceful_shutdown=2,
        )
    )
