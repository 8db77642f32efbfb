"""What passes between the server and a connected page: messages both ways, and frames, the newest first."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Awaitable, Callable
from contextlib import suppress
from dataclasses import dataclass
from itertools import count
from random import Random
from typing import Protocol

from contact_foundation.errors import CmbError
from starlette.websockets import WebSocket, WebSocketDisconnect

from interactive_drive.channel.conditions import Conditions
from interactive_drive.channel.direction import Direction
from interactive_drive.server.hub import Hub
from interactive_drive.server.operators import Operator

MOST_IN_FLIGHT = 2
MOST_TEXTS = 500
LEAST_PERIOD = 1 / 120
_REFUSED_MESSAGE = 1008
_SEED = 1
_pages = count()


@dataclass(frozen=True)
class _FrameMessage:
    """A frame's bytes; ``order`` counts those that the page is sent, ``number`` is the simulation's."""

    order: int
    number: int
    data: bytes


_Message = str | _FrameMessage


class _Way(Protocol):
    """How messages for a page travel."""

    async def send(self, message: _Message, size: int, *, reliable: bool) -> None:
        """Sends a message; returns when the next one can go."""


class _Straight:
    """No channel between."""

    def __init__(self, deliver: Callable[[_Message], Awaitable[None]]) -> None:
        self._deliver = deliver

    async def send(self, message: _Message, size: int, *, reliable: bool) -> None:  # noqa: ARG002
        await self._deliver(message)


async def stream(socket: WebSocket, hub: Hub) -> None:
    """Serves a connected page until it is gone."""
    operator = hub.join()
    deliver = _delivery(socket, operator)
    conditions = hub.session.channel
    tasks: list[asyncio.Task[None]] = []
    down: _Way
    up: Direction[str] | None = None
    if conditions is None:
        down = _Straight(deliver)
    else:
        random = Random(f"{_SEED}/{next(_pages)}")
        down, up = _poor_channel(conditions, random, deliver, hub, operator, tasks)
    tasks.append(asyncio.create_task(_send(socket, hub, operator, down)))
    try:
        await _receive(socket, hub, operator, up)
    finally:
        hub.leave(operator)
        for task in tasks:
            task.cancel()
        for task in tasks:
            with suppress(asyncio.CancelledError, WebSocketDisconnect, RuntimeError):
                await task


def _poor_channel(
    conditions: Conditions,
    random: Random,
    deliver: Callable[[_Message], Awaitable[None]],
    hub: Hub,
    operator: Operator,
    tasks: list[asyncio.Task[None]],
) -> tuple[Direction[_Message], Direction[str]]:
    """Both directions of a simulated channel, which run as tasks."""

    async def take(text: str) -> None:
        _take(hub, operator, text)

    down: Direction[_Message] = Direction(conditions, random, deliver)
    up: Direction[str] = Direction(conditions, random, take)
    tasks += [asyncio.create_task(down.carry()), asyncio.create_task(up.carry())]
    return down, up


def _delivery(socket: WebSocket, operator: Operator) -> Callable[[_Message], Awaitable[None]]:
    """What hands messages to the page; a frame that arrives after a newer one is of no use and dropped."""
    newest = 0

    async def deliver(message: _Message) -> None:
        nonlocal newest
        with suppress(WebSocketDisconnect, RuntimeError):
            if isinstance(message, str):
                await socket.send_text(message)
                return
            if message.order > newest:
                newest = message.order
                operator.sent(message.number)
                await socket.send_bytes(message.data)

    return deliver


async def _receive(socket: WebSocket, hub: Hub, operator: Operator, up: Direction[str] | None) -> None:
    with suppress(WebSocketDisconnect, RuntimeError):
        while True:
            text = await socket.receive_text()
            # What was drawn is the business of the connection beneath, not of the channel that is simulated on it.
            if up is None or _is_acknowledgement(text):
                _take(hub, operator, text)
            else:
                await up.send(text, len(text.encode()), reliable=True)


def _take(hub: Hub, operator: Operator, text: str) -> None:
    try:
        hub.take(operator, text)
    except (CmbError, KeyError) as error:
        operator.tell({"type": "remark", "text": f"refused: {error}", "bad": True})


def _is_acknowledgement(text: str) -> bool:
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        return False
    return isinstance(message, dict) and message.get("type") == "seen"


async def _send(socket: WebSocket, hub: Hub, operator: Operator, way: _Way) -> None:
    """Sends what is new; at most two frames wait for being drawn, and of those not sent yet the newest is."""
    last, order = 0.0, count(1)
    with suppress(WebSocketDisconnect, RuntimeError):
        while True:
            await operator.changed.wait()
            operator.changed.clear()
            if len(operator.texts) > MOST_TEXTS:
                await socket.close(_REFUSED_MESSAGE, "the page does not read")
                return
            while operator.texts:
                text = operator.texts.pop(0)
                await way.send(text, len(text.encode()), reliable=True)
            if operator.in_flight >= MOST_IN_FLIGHT:
                continue
            early = last + LEAST_PERIOD - time.monotonic()
            if early > 1e-3:
                await asyncio.sleep(early)
            found = hub.newest_message(operator)
            if found is not None:
                last = time.monotonic()
                message = _FrameMessage(next(order), *found)
                await way.send(message, len(message.data), reliable=False)
