"""What stands between the page of `ballrace explore` and strangers: no text of theirs is markup, no other page is
answered, the browser gets a policy with every answer, and nothing stays when the command ends."""

from __future__ import annotations

import ast
import asyncio
import base64
import hashlib
import http.client
import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import ballrace as br
from ballrace.explore import guard
from ballrace.explore.served import Page, _answers, served

posix = pytest.mark.skipif(sys.platform == "win32", reason="signals are sent in another way there")

APP = Path(guard.__file__).with_name("app.py")

MARKED_UP = {
    "md",
    "Html",
    "as_html",
    "iframe",
    "left",
    "center",
    "callout",
    "accordion",
    "tabs",
    "image",
    "outline",
}
"""Functions of marimo that take markup or Markdown, or addresses."""


def calls(name: str) -> Iterator[ast.Call]:
    for node in ast.walk(ast.parse(APP.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] == name:
            yield node


def is_escaped(node: ast.expr) -> bool:
    """Whether what comes of an expression has no markup but that which the program itself has written."""
    match node:
        case ast.Constant():
            return True
        case ast.JoinedStr(values=values):
            return all(
                is_escaped(value.value) or value.format_spec is not None
                if isinstance(value, ast.FormattedValue)
                else True
                for value in values
            )
    return ast.unparse(node) in {
        "escape(printable(text))", "escape(printable(str(error)))", "escape(text)", "tick.text",
        "picture.pictures(solution)", "at_rest.page(solution)", "found._repr_html_()",
    }  # fmt: skip


def test_no_text_of_others_is_markup_in_the_source() -> None:
    """A variable comes into the page escaped, by functions that escape (tested by themselves), or not at all."""
    for call in calls("md"):
        assert isinstance(call.args[0], ast.Constant), ast.unparse(call)
    found = list(calls("Html"))
    assert len(found) >= 5
    for call in found:
        assert is_escaped(call.args[0]), ast.unparse(call)
    used = {ast.unparse(node.func).removeprefix("mo.") for node in ast.walk(ast.parse(APP.read_text()))
            if isinstance(node, ast.Call) and ast.unparse(node.func).startswith("mo.")}  # fmt: skip
    assert used & MARKED_UP == {"md", "Html"}


def test_labels_are_those_of_the_program() -> None:
    """Marimo takes them for Markdown."""
    tree = ast.parse(APP.read_text(encoding="utf-8"))
    labels: list[Any] = [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.keyword) and node.arg == "label"
    ]
    assert len(labels) > 15
    for label in labels:
        assert isinstance(label, ast.Constant) or ast.unparse(label) in ("label", "each.label"), (
            ast.unparse(label)
        )


class Site:
    """A site behind the guard, that is asked and answers without a network."""

    def __init__(self, body: bytes = b"", **headers: str) -> None:
        self.body, self.asked = body, 0
        self.headers = [
            (name.replace("_", "-").encode(), each.encode()) for name, each in headers.items()
        ]

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        del receive
        self.asked += 1
        if scope["type"] == "websocket":
            await send({"type": "websocket.accept", "headers": []})
        elif scope["type"] == "http":
            await send({"type": "http.response.start", "status": 200, "headers": self.headers})
            half = len(self.body) // 2
            await send({"type": "http.response.body", "body": self.body[:half], "more_body": True})
            await send({"type": "http.response.body", "body": self.body[half:]})

    def answer(self, *headers: tuple[str, str], kind: str = "http") -> list[Any]:
        sent: list[Any] = []

        async def send(message: Any) -> None:
            sent.append(message)

        scope = {
            "type": kind,
            "headers": [(a.encode("latin-1"), b.encode("latin-1")) for a, b in headers],
        }
        asyncio.run(guard.Guard(self)(scope, None, send))  # type: ignore[arg-type]
        return sent


def headers_of(sent: list[Any]) -> dict[str, str]:
    pairs = [(name.decode(), value.decode()) for name, value in sent[0]["headers"]]
    assert len({name for name, _ in pairs}) == len(pairs)
    return dict(pairs)


OWN = ("host", "127.0.0.1:2718")
STRANGERS = [
    [], [("host", "evil.example:2718")], [("host", "127.0.0.1.evil.example")], [("host", "")], [OWN, OWN],
    [("host", "evil@127.0.0.1:2718")], [("host", "127.0.0.1:2718.evil.example")], [("host", "[::1]:2718")],
    [("host", "127.0.0.1:2718\n")], [("host", "0.0.0.0:2718")],
    [OWN, ("origin", "http://evil.example")], [OWN, ("origin", "null")], [OWN, ("origin", "http://127.0.0.1:8888")],
    [OWN, ("origin", "http://localhost:2718")], [OWN, ("origin", "https://127.0.0.1:2718")],
    [OWN, ("origin", "http://127.0.0.1:2718"), ("origin", "http://evil.example")],
]  # fmt: skip


@pytest.mark.parametrize("kind", ["http", "websocket"])
@pytest.mark.parametrize("headers", STRANGERS, ids=str)
def test_strangers_are_not_answered(headers: list[tuple[str, str]], kind: str) -> None:
    site = Site(b"secret")
    sent = site.answer(*headers, kind=kind)
    assert site.asked == 0
    if kind == "websocket":
        assert [message["type"] for message in sent] == ["websocket.close"]
    else:
        assert sent[0]["status"] == 403
        assert headers_of(sent)["x-frame-options"] == "DENY"


@pytest.mark.parametrize("kind", ["http", "websocket"])
@pytest.mark.parametrize(
    "headers",
    [[OWN], [("Host", "localhost")], [("host", "localhost:8080")], [OWN, ("Origin", "http://127.0.0.1:2718")]],
    ids=str,
)  # fmt: skip
def test_the_page_itself_is_answered(headers: list[tuple[str, str]], kind: str) -> None:
    site = Site(b"{}", content_type="application/json")
    sent = site.answer(*headers, kind=kind)
    assert site.asked == 1
    assert sent[0]["type"] == {"http": "http.response.start", "websocket": "websocket.accept"}[kind]


def test_what_is_no_request_goes_through() -> None:
    site = Site()
    assert site.answer(kind="lifespan") == []
    assert site.asked == 1


def test_the_policy_runs_no_script_but_those_of_the_page() -> None:
    own = "\nlet a = '<b>&amp;';\n"
    page = f'<!doctype html><script data-x="1">{own}</script><script src="./a.js"></script><p>text'
    site = Site(
        page.encode(), content_type="text/html; charset=utf-8", content_length=str(len(page.encode())),
        content_security_policy="script-src *", x_frame_options="SAMEORIGIN",
    )  # fmt: skip
    sent = site.answer(OWN)
    assert b"".join(message.get("body", b"") for message in sent[1:]) == page.encode()
    found = headers_of(sent)
    policy = dict(part.split(" ", 1) for part in found["content-security-policy"].split("; "))
    digest = base64.b64encode(hashlib.sha256(own.encode()).digest()).decode()
    assert policy["script-src"] == f"'self' 'sha256-{digest}'"
    assert policy["default-src"] == "'none'"
    assert policy["frame-ancestors"] == "'none'"
    assert "unsafe" not in "".join(value for name, value in policy.items() if name != "style-src")
    for name, value in policy.items():
        assert set(value.split()) <= {
            "'self'", "'none'", "'unsafe-inline'", "data:", "blob:", f"'sha256-{digest}'",
        }, (name, value)  # fmt: skip
    assert found["x-frame-options"] == "DENY"
    assert found["referrer-policy"] == "no-referrer"
    plain = headers_of(Site(b"{}", content_type="application/json").answer(OWN))
    assert "script-src 'self';" in plain["content-security-policy"] + ";"


def test_cookies_end_with_the_session() -> None:
    given = "session_2718=abc=; path=/; Max-Age=1209600; httponly; Expires=Thu, 01 Jan 2030; samesite=lax"
    (cookie,) = (
        value
        for name, value in headers_of(Site(set_cookie=given).answer(OWN)).items()
        if name == "set-cookie"
    )
    assert cookie == "session_2718=abc=; path=/; httponly; samesite=strict"


# As it is served.


@pytest.fixture(scope="module")
def page() -> Iterator[Page]:
    """Served where the environment names a proxy, which does not lead there."""
    pytest.importorskip("marimo", reason="marimo is not installed")
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("http_proxy", "http://127.0.0.1:9")
        patched.delenv("no_proxy", raising=False)
        with served() as at:
            yield at


def address(at: Page) -> tuple[str, int]:
    host, _, port = at.url.split("/")[2].partition(":")
    return host, int(port)


def asked(
    at: Page, path: str = "/", method: str = "GET", **headers: str
) -> tuple[int, http.client.HTTPMessage]:
    with closing(http.client.HTTPConnection(*address(at), timeout=60.0)) as connection:
        named = {name.replace("_", "-"): value for name, value in headers.items()}
        connection.request(method, path, headers=named)
        with connection.getresponse() as answer:
            return answer.status, answer.headers


@pytest.mark.parametrize(
    ("path", "method"),
    [("/", "GET"), ("/auth/login", "GET"), ("/health", "GET"), ("/nothing", "GET"), ("/health", "POST"),
     ("/api/kernel/run", "POST"), ("/", "OPTIONS"), ("/favicon.ico", "HEAD")],
)  # fmt: skip
def test_every_answer_has_the_policy(page: Page, path: str, method: str) -> None:
    token = page.url.partition("?")[2]
    for query in ("", f"?{token}"):
        _, headers = asked(page, path + query, method)
        assert headers.get_all("X-Frame-Options") == ["DENY"]
        (policy,) = headers.get_all("Content-Security-Policy") or [""]
        assert "frame-ancestors 'none'" in policy


def test_the_page_is_for_its_own_address(page: Page) -> None:
    path = f"/?{page.url.partition('?')[2]}"
    status, headers = asked(page, path)
    # To the same address without the token.
    assert (status, headers["Location"]) == (303, "/")
    cookie = headers["Set-Cookie"]
    assert not re.search("max-age|expires", cookie, re.IGNORECASE)
    assert "samesite=strict" in cookie.lower()
    assert asked(page, path, Host="evil.example")[0] == 403
    assert asked(page, path, Origin="http://evil.example")[0] == 403
    own = cookie.partition(";")[0]
    assert asked(page, "/", Cookie=own)[0] == 200
    kernel = {"Cookie": own, "Upgrade": "websocket", "Connection": "Upgrade",
              "Sec_WebSocket_Version": "13", "Sec_WebSocket_Key": "AAAAAAAAAAAAAAAAAAAAAA=="}  # fmt: skip
    socket_path = "/ws?session_id=s_abcdef"
    assert asked(page, socket_path, **kernel, Origin="http://127.0.0.1:8888")[0] == 403
    host, port = address(page)
    assert asked(page, socket_path, **kernel, Origin=f"http://{host}:{port}")[0] == 101


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_the_token_stands_on_no_command_line(page: Page) -> None:
    token = page.url.partition("access_token=")[2].encode()
    for process in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            assert token not in (process / "cmdline").read_bytes()


@contextmanager
def command(folder: Path, *arguments: str) -> Iterator[tuple[subprocess.Popen[str], int]]:
    """Start the command with a folder for temporary files, and give it with its port once the page answers."""
    pytest.importorskip("marimo", reason="marimo is not installed")
    program = [sys.executable, "-m", "ballrace", "explore", "--no-browser", *arguments]
    with subprocess.Popen(
        program, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder,
        env={**os.environ, "TMPDIR": str(folder)},
    ) as process:  # fmt: skip
        assert process.stdout is not None
        url = process.stdout.readline()
        try:
            found = re.match(r"http://127\.0\.0\.1:(\d+)/\?access_token=", url)
            assert found is not None, (url, process.stderr and process.stderr.read())
            yield process, int(found[1])
        finally:
            process.kill()


def answers(port: int) -> bool:
    try:
        socket.create_connection(("127.0.0.1", port), timeout=5.0).close()
    except OSError:
        return False
    return True


def ends(port: int) -> bool:
    """Wait until nobody listens there."""
    until = time.monotonic() + 30.0
    while answers(port):
        if time.monotonic() > until:
            return False
        time.sleep(0.05)
    return True


@posix
@pytest.mark.parametrize(
    "name",
    [
        "SIGTERM",
        "SIGKILL",
        *(pytest.param(name, marks=pytest.mark.long) for name in ("SIGHUP", "SIGINT")),
    ],
)
def test_nothing_stays_when_the_command_ends(name: str, tmp_path: Path) -> None:
    with command(tmp_path) as (process, port):
        assert answers(port)
        number = signal.Signals[name]
        process.send_signal(number)
        status = {"SIGKILL": -9, "SIGINT": 130}.get(name, 128 + number)
        assert process.wait(60.0) == status
        assert ends(port)
        assert list(tmp_path.iterdir()) == []


@posix
def test_a_page_of_nohup_stays() -> None:
    """What was ignored as the command began is still ignored."""
    from ballrace.cli.exploring import _ended_by_signals

    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with _ended_by_signals():
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
            assert signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL
        assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.mark.long
def test_a_module_of_the_working_folder_is_not_run(tmp_path: Path) -> None:
    """Folders of records are those of strangers; only the command's own path is searched."""
    pytest.importorskip("marimo", reason="marimo is not installed")
    for name in ("marimo", "uvicorn", "signal"):
        (tmp_path / f"{name}.py").write_text(
            f"open({str(tmp_path / 'ran')!r}, 'w')", encoding="utf-8"
        )
    program = (
        "import sys; sys.path[:] = [each for each in sys.path if each]\n"
        "from ballrace.explore.served import served\n"
        "with served() as page: print(page.url)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, timeout=120.0, check=False
    )  # fmt: skip
    assert not (tmp_path / "ran").exists()
    assert done.stdout.startswith("http://127.0.0.1:"), done.stderr


def test_a_server_without_the_guard_is_not_used() -> None:
    """As if marimo no longer served by uvicorn's configuration."""

    class Plain(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.end_headers()

        def log_message(self, *args: object) -> None:
            del args

    pytest.importorskip("marimo", reason="marimo is not installed")
    running: Any = SimpleNamespace(poll=lambda: None)
    with ThreadingHTTPServer(("127.0.0.1", 0), Plain) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            with pytest.raises(br.BallraceError, match="without its Content-Security-Policy"):
                _answers(running, server.server_port)
        finally:
            server.shutdown()
            thread.join()
