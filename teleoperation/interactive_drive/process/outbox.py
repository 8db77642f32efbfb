"""Messages that leave by a thread of their own, so that who hands them in never waits for who reads them."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class Outbox(Generic[T]):
    """Sends messages in order, and of one kind, the newest alone.

    Args:
        send: sends one message; may block. When it raises OSError, what is left is dropped.
        merge: makes one of an older and a newer message of ``show`` that both wait, and nothing overtakes them;
            if None, the newer one takes the place of the older, and all messages of ``post`` go first.
    """

    def __init__(self, send: Callable[[T], None], merge: Callable[[T, T], T] | None = None) -> None:
        self._send, self._merge = send, merge
        self._ordered: deque[T] = deque()
        self._newest: T | None = None
        self._closed = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def post(self, message: T) -> None:
        """Every one of these messages arrives, in order."""
        with self._changed:
            if not self._closed:
                if self._merge is not None and self._newest is not None:
                    self._ordered.append(self._newest)
                    self._newest = None
                self._ordered.append(message)
                self._changed.notify()

    def show(self, message: T) -> None:
        """Of these messages the newest arrives, after those of ``post`` so far."""
        with self._changed:
            if not self._closed:
                merge = self._merge is not None and self._newest is not None
                self._newest = self._merge(self._newest, message) if merge else message  # type: ignore[misc,arg-type]
                self._changed.notify()

    def close(self, timeout: float = 2.0) -> None:
        """Sends what is left, for at most ``timeout`` s, and ends the thread."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        self._thread.join(timeout)

    def _work(self) -> None:
        while True:
            with self._changed:
                while not self._ordered and self._newest is None and not self._closed:
                    self._changed.wait()
                if not self._ordered and self._newest is None:
                    return
                if self._ordered:
                    message = self._ordered.popleft()
                else:
                    message, self._newest = self._newest, None  # type: ignore[assignment]
            try:
                self._send(message)
            except OSError:
                with self._changed:
                    self._closed = True
                    self._ordered.clear()
                    self._newest = None
                return
