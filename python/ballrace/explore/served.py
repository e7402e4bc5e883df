"""The page on loopback: a process of its own, behind a token, that ends with this one."""

from __future__ import annotations

import importlib.metadata
import os
import secrets
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from urllib.error import URLError
from urllib.request import ProxyHandler, build_opener

from .._base.libraries import needed
from ..errors import BallraceError, SceneError
from .chosen import read_file
from .guard import POLICY

HOST = "127.0.0.1"
"""Address of loopback, which no other machine reaches."""

_PROGRAM = """
import sys
count = int(sys.argv[1])
sys.path[:], sys.argv[1:] = sys.argv[2 : 2 + count], sys.argv[2 + count :]
from ballrace.explore.serving import serve
serve()
"""

_PATIENCE = 60.0
"""How long a page may take to answer first [s]."""


class Page:
    """A page that is served.

    Attributes
    ----------
    url : str
        Its address, with its token.
    """

    def __init__(self, url: str, process: subprocess.Popen[bytes]) -> None:
        self.url = url
        self._process = process

    def wait(self) -> int:
        """Wait for the end of the process and return its status."""
        return self._process.wait()


@contextmanager
def served(file: Path | None = None, port: int | None = None) -> Iterator[Page]:
    """Serve the page as long as the block lasts.

    Parameters
    ----------
    file : Path, optional
        A scene to begin with, or a measured record to lay beside the run.
    port : int, optional
        Port on loopback; by default a free one.

    Raises
    ------
    SceneError
        The scene or the port is not usable.
    ImportError
        marimo or plotly is not installed (extra ``app``).
    OSError
        The file cannot be read.
    BallraceError
        The page does not answer.
    """
    needed("marimo", "ballrace explore", extra="app")
    needed("plotly", "ballrace explore", extra="app")
    if file is not None and read_file(file) is None:
        file.open("rb").close()
    port = _free(port)
    token = secrets.token_urlsafe(24)
    process = subprocess.Popen(_command(port, file), stdin=subprocess.PIPE, env=_environment())
    try:
        _send(process, token)
        _answers(process, port)
        yield Page(f"http://{HOST}:{port}/?access_token={token}", process)
    finally:
        _end(process)


def _command(port: int, file: Path | None) -> list[str]:
    """Return the command of the server: it finds modules as this process does, but not in the working folder."""
    path = [os.path.abspath(each) for each in sys.path if each]  # noqa: PTH100 (resolves no links)
    given = [] if file is None else [str(file.absolute())]
    return [sys.executable, "-P", "-c", _PROGRAM, str(len(path)), *path, str(port), *given]


def _send(process: subprocess.Popen[bytes], token: str) -> None:
    """Send the token by the pipe: others of this machine could read it on the command line."""
    assert process.stdin is not None
    with suppress(BrokenPipeError):
        process.stdin.write(f"{token}\n".encode("ascii"))
        process.stdin.flush()


def _end(process: subprocess.Popen[bytes]) -> None:
    process.terminate()
    assert process.stdin is not None
    process.stdin.close()
    try:
        process.wait(5.0)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _environment() -> dict[str, str]:
    """Return the environment, in which marimo asks nobody for newer versions."""
    return {**os.environ, "MARIMO_SKIP_UPDATE_CHECK": "1"}


def _free(port: int | None) -> int:
    """Return a port that nobody listens at."""
    if port is not None and not 1 <= port <= 65535:
        raise SceneError("port", str(port), "a port, 1 to 65535")
    with socket.socket() as probe:
        if os.name == "posix":
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((HOST, port or 0))
        except OSError as error:
            raise SceneError("port", str(port), f"one that is free ({error.strerror})") from error
        return int(probe.getsockname()[1])


def _answers(process: subprocess.Popen[bytes], port: int) -> None:
    """Wait until the page answers."""
    # The environment may name a proxy, which does not lead here.
    directly = build_opener(ProxyHandler({}))
    version = importlib.metadata.version("marimo")
    until = time.monotonic() + _PATIENCE
    while time.monotonic() < until:
        if process.poll() is not None:
            raise BallraceError(f"marimo {version} ended with status {process.returncode}")
        try:
            with directly.open(f"http://{HOST}:{port}/health", timeout=1.0) as answer:
                if answer.headers[POLICY] is None:
                    text = f"marimo {version} serves the page without its Content-Security-Policy"
                    raise BallraceError(f"{text}; install another version")
                return
        except (URLError, OSError):
            time.sleep(0.05)
    raise BallraceError(f"the page did not answer within {_PATIENCE:g} s")
