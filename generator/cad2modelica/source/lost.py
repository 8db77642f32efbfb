"""Notes on what a source gives and the model does not have; a strict generation refuses them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from contact_foundation.errors import InputError, Place


class Lost(str):
    """A note, one line, on something of the source that is not in the model: geometry, a joint's limits, a speed."""

    __slots__ = ()


def require_nothing_lost(notes: Iterable[str], file: Path) -> None:
    """Refuses a model that lacks something of its source.

    Args:
        notes: of the whole generation.
        file: the assembly.

    Raises:
        InputError: one of the notes is ``Lost``; the message holds all that are.
    """
    lost = [note for note in dict.fromkeys(notes) if isinstance(note, Lost)]
    if not lost:
        return
    count = f"{len(lost)} things that the file gives" if len(lost) > 1 else "something that the file gives"
    raise InputError(
        "\n".join([f"the model would be without {count}:", *(f"  - {note}" for note in lost), "Nothing was written."]),
        place=Place(file=file),
        remedy="Correct the source, or generate without --strict if the model is to do without.",
    )
