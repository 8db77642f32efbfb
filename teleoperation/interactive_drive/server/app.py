"""The web application: the page, its scripts, the scene, and a WebSocket for each operator."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket

from interactive_drive.page.page_files import page_file
from interactive_drive.server.access import Access, Guard
from interactive_drive.server.hub import Hub
from interactive_drive.server.streaming import stream


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
        await stream(socket, hub)

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
