"""A headless Chromium that is told what to do through its debugging pipe; needs no network and no package."""

from __future__ import annotations

import base64
import json
import os
import select
import shutil
import subprocess
import time
from pathlib import Path
from typing import Any

import pytest
from scene_viewer.bundle import MISSING, is_installed

_NAMES = ("chromium", "chromium-browser", "google-chrome")
_FLAGS = (
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-gpu",
    "--disable-sync",
    "--remote-debugging-pipe",
)
_PATIENCE = 120.0


def find_browser() -> str | None:
    """Path of a Chromium on this machine, or None."""
    return next((path for name in _NAMES if (path := shutil.which(name))), None)


needs_bundle = pytest.mark.skipif(not is_installed(), reason=MISSING)
"""Marks tests that need the viewer's scripts."""
needs_pages = pytest.mark.skipif(
    find_browser() is None or not is_installed(),
    reason=MISSING if find_browser() else "No Chromium is installed (Debian package chromium).",
)
"""Marks tests of pages with the viewer or plots in a real browser."""


class Browser:
    """A running Chromium; `tab` opens pages in it."""

    def __init__(self, program: str, folder: Path) -> None:
        to_browser, self._write = os.pipe()
        self._read, from_browser = os.pipe()

        def connect() -> None:  # the browser reads from descriptor 3 and writes to 4
            for descriptor, number in ((os.dup(to_browser), 3), (os.dup(from_browser), 4)):
                os.dup2(descriptor, number, inheritable=True)

        self._process = subprocess.Popen(
            [program, *_FLAGS, f"--user-data-dir={folder}", "about:blank"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            close_fds=False,
            preexec_fn=connect,
        )
        os.close(to_browser)
        os.close(from_browser)
        self._number = 0
        self._buffer = b""

    def close(self) -> None:
        """Ends the browser."""
        self._process.kill()
        self._process.wait()
        os.close(self._write)
        os.close(self._read)

    def tab(self, address: str) -> Tab:
        """Opens a page."""
        target = self.command("Target.createTarget", url="about:blank")["targetId"]
        session = self.command("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = Tab(self, session)
        page.command("Page.enable")
        page.go(address)
        return page

    def command(self, method: str, session: str | None = None, **parameters: Any) -> dict[str, Any]:
        """A command of the DevTools protocol and its result."""
        self._number += 1
        message: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if session is not None:
            message["sessionId"] = session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        while True:
            reply = self._next()
            if reply.get("id") == self._number:
                assert "error" not in reply, reply["error"]
                result: dict[str, Any] = reply["result"]
                return result

    def _next(self) -> dict[str, Any]:
        end = time.monotonic() + _PATIENCE
        while b"\0" not in self._buffer:
            ready, _, _ = select.select([self._read], [], [], max(0.0, end - time.monotonic()))
            assert ready, "the browser does not answer"
            part = os.read(self._read, 1 << 20)
            assert part, "the browser ended"
            self._buffer += part
        text, _, self._buffer = self._buffer.partition(b"\0")
        message: dict[str, Any] = json.loads(text)
        return message


class Tab:
    """A page in a browser."""

    def __init__(self, browser: Browser, session: str) -> None:
        self._browser = browser
        self._session = session

    def command(self, method: str, **parameters: Any) -> dict[str, Any]:
        """A command of the DevTools protocol about this page."""
        return self._browser.command(method, self._session, **parameters)

    def go(self, address: str) -> None:
        """Opens an address."""
        self.command("Page.navigate", url=address)
        self.until("document.readyState === 'complete'")

    def value(self, expression: str) -> Any:
        """The value of a JavaScript expression; promises are awaited."""
        reply = self.command(
            "Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True, userGesture=True
        )
        assert "exceptionDetails" not in reply, reply["exceptionDetails"]
        return reply["result"].get("value")

    def until(self, expression: str) -> None:
        """Waits until an expression is true."""
        end = time.monotonic() + _PATIENCE
        while not self.value(expression):
            assert time.monotonic() < end, f"still not true: {expression}"
            time.sleep(0.02)

    def note_errors(self) -> None:
        """From the next page on, keeps what it complains about for ``errors``."""
        source = (
            "window.complaints = []; addEventListener('error', event => complaints.push(event.message));"
            "for (const kind of ['error', 'warn']) console[kind] = (...words) => complaints.push(words.join(' '));"
        )
        self.command("Page.addScriptToEvaluateOnNewDocument", source=source)

    def errors(self) -> list[str]:
        """Errors and warnings of the page."""
        found: list[str] = self.value("complaints")
        return found

    def picture(self) -> bytes:
        """What the page looks like, as PNG."""
        return base64.b64decode(self.command("Page.captureScreenshot")["data"])
