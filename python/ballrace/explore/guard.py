"""Guard before every answer of the page: who may ask for it, and what a browser lets it do.

Any page that a browser has open may send requests to loopback, and any user of the machine may serve one there. So
an answer is given only to the page's own address: a name that leads here by the DNS of another is refused by its
``Host``, another page by its ``Origin``. And whatever text comes to stand in the page, the browser runs no script
of it, asks no other host for it, and shows it in no frame: that is its Content-Security-Policy.
"""

from __future__ import annotations

import base64
import hashlib
import re
from html.parser import HTMLParser
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Iterable, MutableMapping

    Message = MutableMapping[str, Any]
    Receive = Callable[[], Awaitable[Message]]
    Send = Callable[[Message], Awaitable[None]]
    Application = Callable[[Message, Receive, Send], Awaitable[None]]
    Headers = list[tuple[bytes, bytes]]

POLICY = "content-security-policy"
"""Header by which it is known that an answer has passed the guard."""

_ALLOWED = {
    "default-src": "'none'",
    "connect-src": "'self'",
    "font-src": "'self' data:",
    "img-src": "'self' data: blob:",
    "manifest-src": "'self'",
    "media-src": "'self' data: blob:",
    # Figures and controls set the style of their elements.
    "style-src": "'self' 'unsafe-inline'",
    "worker-src": "'self' blob:",
    "base-uri": "'self'",
    "form-action": "'self'",
    "frame-ancestors": "'none'",
}
"""Sources that a page may load beside its scripts: from here alone."""

_HEADERS = {
    "x-frame-options": "DENY",
    "x-content-type-options": "nosniff",
    # The address has the token in it.
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}

_HOST = re.compile(r"(127\.0\.0\.1|localhost)(:\d{1,5})?")
"""Loopback at any port, since a tunnel may have another one at its other end."""

_LASTING = ("max-age", "expires", "samesite")
"""Attributes of a cookie's life; without it ends with the browser's session."""


class Guard:
    """An ASGI application behind the guard."""

    def __init__(self, application: Application) -> None:
        self._application = application

    async def __call__(self, scope: Message, receive: Receive, send: Send) -> None:
        """Answer a request, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self._application(scope, receive, send)
        elif not _is_own(scope["headers"]):
            await _refuse(scope["type"], send)
        else:
            await self._application(scope, receive, _Answer(send))


def _is_own(headers: Headers) -> bool:
    """Return whether a request is to this page by its address, and from no other page."""
    hosts = [value for name, value in headers if name.lower() == b"host"]
    origins = [value for name, value in headers if name.lower() == b"origin"]
    if len(hosts) != 1 or not _HOST.fullmatch(hosts[0].decode("latin-1")):
        return False
    return all(origin == b"http://" + hosts[0] for origin in origins)


async def _refuse(kind: str, send: Send) -> None:
    if kind == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": "another page"})
        return
    text = b"This page is answered at its own address alone.\n"
    headers: Headers = [(b"content-type", b"text/plain"), (b"content-length", b"%d" % len(text))]
    answer = _Answer(send)
    await answer({"type": "http.response.start", "status": 403, "headers": headers})
    await answer({"type": "http.response.body", "body": text})


class _Answer:
    """An answer on its way; a page is held until it is whole, since its own scripts are known by their hashes."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._start: Message | None = None
        self._body = b""

    async def __call__(self, message: Message) -> None:
        kind = message["type"]
        if kind in ("http.response.start", "websocket.accept"):
            message["headers"] = _kept(message.get("headers", ()))
        if kind == "http.response.start":
            if _is_html(message["headers"]):
                self._start = message
                return
            message["headers"] += _guarded(())
        elif kind == "http.response.body" and self._start is not None:
            self._body += message.get("body", b"")
            if message.get("more_body"):
                return
            scripts = _Scripts(self._body.decode("utf-8", "replace")).found
            self._start["headers"] += _guarded(scripts)
            await self._send(self._start)
            message = {"type": kind, "body": self._body}
        await self._send(message)


def _is_html(headers: Headers) -> bool:
    return any(
        name.lower() == b"content-type" and value.lower().startswith(b"text/html")
        for name, value in headers
    )


def _guarded(scripts: Iterable[str]) -> Headers:
    """Return the headers of an answer whose own scripts are known."""
    hashes = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in scripts]
    own = " ".join(["'self'", *(f"'sha256-{each}'" for each in dict.fromkeys(hashes))])
    policy = "; ".join(f"{name} {what}" for name, what in {**_ALLOWED, "script-src": own}.items())
    named = {POLICY: policy, **_HEADERS}
    return [(name.encode("ascii"), value.encode("ascii")) for name, value in named.items()]


def _kept(headers: Iterable[tuple[bytes, bytes]]) -> Headers:
    """Return headers of the application that the guard does not set itself, cookies for the session only."""
    own = {name.encode("ascii") for name in (POLICY, *_HEADERS)}
    return [
        (name, _cookie(value) if name.lower() == b"set-cookie" else value)
        for name, value in headers
        if name.lower() not in own
    ]


def _cookie(value: bytes) -> bytes:
    """Have a cookie end with the browser's session, and be sent by this page alone."""
    first, *rest = value.decode("latin-1").split(";")
    kept = [each for each in rest if each.strip().partition("=")[0].lower() not in _LASTING]
    return "; ".join([first, *map(str.strip, kept), "samesite=strict"]).encode("latin-1")


class _Scripts(HTMLParser):
    """The scripts that stand in a page, in its own lines."""

    def __init__(self, page: str) -> None:
        super().__init__(convert_charrefs=False)
        self.found: list[str] = []
        self._within: list[str] | None = None
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "script" and "src" not in dict(attrs):
            self._within = []

    def handle_data(self, data: str) -> None:
        if self._within is not None:
            self._within.append(data)

    def handle_endtag(self, tag: str) -> None:
        if tag == "script" and self._within is not None:
            self.found.append("".join(self._within))
            self._within = None
