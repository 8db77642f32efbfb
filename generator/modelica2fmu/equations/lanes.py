"""Derivatives in several directions at once: vectors of ``LANES`` numbers in the work array."""

from __future__ import annotations

from typing import Final

LANES: Final = 4  # FMURT_LANES of runtime/model/fmurt_model.h


def lanes_at(offset: int) -> str:
    """C lvalue of the vector at an offset of the work array."""
    return f"LANES(w, {offset})"


def lane_passes(count: int) -> int:
    """How many times ``LANES`` directions cover ``count``."""
    return -(-count // LANES)
