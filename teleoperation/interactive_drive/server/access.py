"""Who may come in: requests for this server's own names, from its own pages, with a session.

A page elsewhere can make an operator's browser send requests here. It cannot set the headers Host and Origin, which
tell what it took this server for and where it comes from (a name that was made to point here, DNS rebinding, shows in
Host). A session begins with the token in the address that the program prints; each token opens one, and who comes with
wrong ones is not heard for a while.
"""

from __future__ import annotations

import hmac
import math
import secrets
from collections.abc import Callable
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocketClose

from interactive_drive.server.listening import Listening
from interactive_drive.server.token_limit import TokenLimit

_TOKEN_BYTES = 24
_HEADERS = {
    "content-security-policy": "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}


class Access:
    """Sessions and the token that opens the next one.

    Args:
        port: that the server listens on.
        announce: told the new address whenever the old one was used.
        listening: where it does.
    """

    def __init__(self, port: int, announce: Callable[[str], None], listening: Listening | None = None) -> None:
        self._port, self._announce, self._listening = port, announce, listening or Listening()
        self._token = secrets.token_urlsafe(_TOKEN_BYTES)
        self._sessions: set[str] = set()
        self.cookie = f"cmb_drive_{port}"
        self.limit = TokenLimit()

    @property
    def address(self) -> str:
        """The address that opens one session."""
        listening = self._listening
        return f"{listening.scheme}://{listening.page_host}:{self._port}/?token={self._token}"

    @property
    def encrypted(self) -> bool:
        """Whether sessions may travel over encrypted connections alone."""
        return self._listening.scheme == "https"

    def admits_host(self, host: str) -> bool:
        """Whether a header Host names this server."""
        return self._listening.admits(host, self._port)

    def admits_origin(self, origin: str) -> bool:
        """Whether a header Origin is that of a page of this server."""
        scheme, separator, host = origin.partition("://")
        return bool(separator) and scheme.lower() == self._listening.scheme and self.admits_host(host)

    def redeem(self, token: str) -> str | None:
        """A new session for the present token, which is used up; None for any other."""
        if not hmac.compare_digest(token.encode(), self._token.encode()):
            return None
        self._token = secrets.token_urlsafe(_TOKEN_BYTES)
        session = secrets.token_urlsafe(_TOKEN_BYTES)
        self._sessions.add(session)
        self._announce(self.address)
        return session

    def knows(self, headers: Headers) -> bool:
        """Whether a request belongs to a session."""
        try:
            cookies = SimpleCookie(headers.get("cookie", ""))
        except CookieError:
            return False
        morsel = cookies.get(self.cookie)
        return morsel is not None and morsel.value in self._sessions


class Guard:
    """ASGI: lets requests through to an application as ``Access`` says.

    Args:
        app: the application.
        access: sessions.
    """

    def __init__(self, app: ASGIApp, access: Access) -> None:
        self._app, self._access = app, access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answers a request, or hands it on."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if scope["type"] == "websocket":
            answer: ASGIApp = self._app if refusal is None else WebSocketClose(code=1008, reason="refused")
            await answer(scope, receive, send)
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(_HEADERS)
            await send(message)

        await (refusal or self._app)(scope, receive, send_with_headers)

    def _refusal(self, scope: Scope) -> Response | None:
        """What answers instead of the application, if anything does."""
        headers, access = Headers(scope=scope), self._access
        hosts, origins = headers.getlist("host"), headers.getlist("origin")
        if not hosts or not all(access.admits_host(host) for host in hosts):
            return _refused("This server answers to the names alone that it listens on; see cmb drive --listen.")
        if not all(access.admits_origin(origin) for origin in origins):
            return _refused("Pages of other servers may not use this one.")
        if scope["type"] == "websocket" and not origins:
            return _refused("A connection must say which page it belongs to.")
        tokens = parse_qs(urlsplit(f"?{scope.get('query_string', b'').decode('latin-1')}").query).get("token")
        if tokens and scope["type"] == "http" and scope["path"] == "/":
            return self._open(headers, tokens[0], (scope.get("client") or ("", 0))[0])
        if not access.knows(headers):
            return _refused("Open the address that the terminal shows in which cmb drive runs.")
        return None

    def _open(self, headers: Headers, token: str, client: str) -> Response:
        """Answers who comes with a token."""
        access = self._access
        if access.knows(headers):  # the address opened once more, or the page loaded again
            return RedirectResponse("/", status_code=303)
        wait = access.limit.wait(client)
        if wait > 0:
            answer: Response = PlainTextResponse(
                "Too many wrong addresses came from there. Open the one that the terminal shows in a minute.\n", 429
            )
            answer.headers["retry-after"] = str(math.ceil(wait))
            return answer
        session = access.redeem(token)
        if session is None:
            access.limit.note(client)
            return _refused(
                "This address was used already, or is wrong. The terminal in which cmb drive runs shows one that opens."
            )
        answer = RedirectResponse("/", status_code=303)
        # "lax": the address may be followed from a message; requests of other origins are refused beside.
        answer.set_cookie(access.cookie, session, httponly=True, samesite="lax", secure=access.encrypted, path="/")
        return answer


def _refused(text: str) -> Response:
    return PlainTextResponse(text + "\n", status_code=403)
