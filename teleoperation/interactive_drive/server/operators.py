"""A connected page, as the server knows it."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Mapping
from typing import Any


class Operator:
    """A connected page.

    Attributes:
        texts: messages for it, as JSON.
        changed: set when there is something to send.
        places: of the signals that it plots.
        number: of the frame chosen for it last.
    """

    def __init__(self) -> None:
        self.texts: list[str] = []
        self.changed = asyncio.Event()
        self.places: tuple[int, ...] = ()
        self.number = 0
        self._unseen: deque[int] = deque()

    @property
    def in_flight(self) -> int:
        """Frames sent that it has not drawn yet."""
        return len(self._unseen)

    def sent(self, number: int) -> None:
        """A frame was sent."""
        self._unseen.append(number)

    def seen(self, number: float) -> None:
        """It has drawn a frame; those sent before it are gone too. Numbers begin anew with a new simulation."""
        if number in self._unseen:
            while self._unseen.popleft() != number:
                pass
        self.changed.set()

    def tell(self, message: Mapping[str, Any]) -> None:
        """Hands it a message."""
        self.texts.append(json.dumps(message, allow_nan=False))
        self.changed.set()
