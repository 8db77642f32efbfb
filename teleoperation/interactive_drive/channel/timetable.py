"""When messages leave and arrive on a channel."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from interactive_drive.channel.conditions import Conditions


@dataclass(frozen=True)
class Transit:
    """A message's way.

    Attributes:
        left: when its last bit has left and the next message can go, s.
        arrives: when it is there, s; None if it is lost.
    """

    left: float
    arrives: float | None


class Timetable:
    """Times of one direction.

    Messages leave one after the other, each for as long as its bytes take. One that must arrive is sent again after a
    round trip for as often as it is lost, and does not overtake others of its kind. Bytes are those of the message;
    what a transport adds is left out.

    Args:
        conditions: of the channel.
        random: decides on delay and loss.
    """

    def __init__(self, conditions: Conditions, random: Random) -> None:
        self._conditions, self._random = conditions, random
        self._free = self._last = 0.0

    def send(self, now: float, size: int, reliable: bool) -> Transit:
        """The way of a message that is handed over.

        Args:
            now: time, s; never less than before.
            size: bytes.
            reliable: whether it must arrive.
        """
        conditions = self._conditions
        left = self._free = max(now, self._free) + 8 * size / conditions.bandwidth
        arrives = left + conditions.delay + self._random.uniform(-conditions.jitter, conditions.jitter)
        while self._random.random() < conditions.loss:
            if not reliable:
                return Transit(left, None)
            arrives += 2 * conditions.delay
        if reliable:
            arrives = self._last = max(arrives, self._last)
        return Transit(left, arrives)
