"""Files as they come out of broken downloads and disks."""

from __future__ import annotations

import random
from typing import Final


def cut(data: bytes, draw: random.Random) -> bytes:
    """The beginning of a file."""
    return data[: draw.randrange(len(data))]


def flipped(data: bytes, draw: random.Random) -> bytes:
    """A file with other bytes."""
    changed = bytearray(data)
    for _ in range(draw.randrange(1, 4)):
        changed[draw.randrange(len(changed))] = draw.randrange(256)
    return bytes(changed)


def swapped(data: bytes, draw: random.Random) -> bytes:
    """A file with two pieces in each other's place."""
    first, second, third = sorted(draw.randrange(len(data)) for _ in range(3))
    return data[:first] + data[second:third] + data[first:second] + data[third:]


CHANGES: Final = (cut, flipped, swapped)
