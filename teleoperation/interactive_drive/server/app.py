"""The web application: the page, its scripts, the scene, and a WebSocket for each operator."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress

from contact_foundation.errors import CmbError
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from interactive_drive.page.page_files import page_file
from interactive_drive.server.access import Access, Guard
from interactive_drive.server.hub import Hub, Operator

MOST_IN_FLIGHT = 2
MOST_TEXTS = 500
LEAST_PERIOD = 1 / 60
_REFUSED_MESSAGE = 1008


def make_app(hub: Hub, access: Access, begin: Callable[[], None] | None = None) -> Starlette:
    """The application of a drive.

    Args:
        hub: of the drive.
        access: who may come in.
        begin: called when the server stands, to start the simulation.
    """

    @asynccontextmanager
    async def lifespan(_app: Starlette) -> AsyncIterator[None]:
        hub.begin()
        if begin is not None:
            begin()
        yield
        await hub.close()

    async def show_file(request: Request) -> Response:
        found = page_file(request.path_params.get("name", "drive.html"))
        if found is None:
            return Response("There is no such page.\n", 404, media_type="text/plain")
        return Response(found[0], media_type=found[1])

    async def show_scene(_request: Request) -> Response:
        return Response(await hub.scene_data(), media_type="application/json")

    async def connect(socket: WebSocket) -> None:
        await socket.accept()
        operator = hub.join()
        sender = asyncio.create_task(_send(socket, hub, operator))
        try:
            await _receive(socket, hub, operator)
        finally:
            hub.leave(operator)
            sender.cancel()
            with suppress(asyncio.CancelledError, WebSocketDisconnect, RuntimeError):
                await sender

    return Starlette(
        routes=[
            Route("/", show_file),
            Route("/scene.json", show_scene),
            Route("/{name}", show_file),
            WebSocketRoute("/drive", connect),
        ],
        middleware=[Middleware(Guard, access=access)],
        lifespan=lifespan,
    )


async def _receive(socket: WebSocket, hub: Hub, operator: Operator) -> None:
    try:
        while True:
            try:
                hub.take(operator, await socket.receive_text())
            except (CmbError, KeyError) as error:
                operator.tell({"type": "remark", "text": f"refused: {error}", "bad": True})
    except (WebSocketDisconnect, RuntimeError):
        return


async def _send(socket: WebSocket, hub: Hub, operator: Operator) -> None:
    """Sends what is new; at most two frames are under way, and of those that wait the newest is sent."""
    last = 0.0
    with suppress(WebSocketDisconnect, RuntimeError):
        while True:
            await operator.changed.wait()
            operator.changed.clear()
            if len(operator.texts) > MOST_TEXTS:
                await socket.close(_REFUSED_MESSAGE, "the page does not read")
                return
            while operator.texts:
                await socket.send_text(operator.texts.pop(0))
            if operator.in_flight >= MOST_IN_FLIGHT:
                continue
            early = last + LEAST_PERIOD - time.monotonic()
            if early > 1e-3:
                await asyncio.sleep(early)
            message = hub.newest_message(operator, time.time() * 1e3)
            if message is not None:
                last = time.monotonic()
                await socket.send_bytes(message)
