"""Messages that take their time: one direction of a simulated channel in an event loop."""

from __future__ import annotations

import asyncio
import heapq
from collections.abc import Awaitable, Callable
from itertools import count
from random import Random
from typing import Generic, TypeVar

from interactive_drive.channel.conditions import Conditions
from interactive_drive.channel.timetable import Timetable

T = TypeVar("T")


class Direction(Generic[T]):
    """Carries messages in one direction; ``carry`` must run beside ``send``.

    Args:
        conditions: of the channel.
        random: decides on delay and loss.
        deliver: hands a message over that has arrived.
    """

    def __init__(self, conditions: Conditions, random: Random, deliver: Callable[[T], Awaitable[None]]) -> None:
        self._timetable = Timetable(conditions, random)
        self._deliver = deliver
        self._under_way: list[tuple[float, int, T]] = []
        self._order = count()
        self._changed = asyncio.Event()

    async def send(self, message: T, size: int, *, reliable: bool) -> None:
        """Sends a message of so many bytes; returns when it has left, so that no queue forms before the channel."""
        loop = asyncio.get_running_loop()
        transit = self._timetable.send(loop.time(), size, reliable)
        if transit.arrives is not None:
            heapq.heappush(self._under_way, (transit.arrives, next(self._order), message))
            self._changed.set()
        await asyncio.sleep(transit.left - loop.time())

    async def carry(self) -> None:
        """Delivers messages when they arrive, until it is cancelled."""
        loop = asyncio.get_running_loop()
        while True:
            self._changed.clear()
            wait = self._under_way[0][0] - loop.time() if self._under_way else None
            if wait is not None and wait <= 0:
                await self._deliver(heapq.heappop(self._under_way)[2])
                continue
            try:
                await asyncio.wait_for(self._changed.wait(), wait)
            except TimeoutError:
                continue
