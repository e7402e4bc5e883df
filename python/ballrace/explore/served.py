"""The page on loopback: marimo in a process of its own, behind a token."""

from __future__ import annotations

import importlib.metadata
import os
import secrets
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.error import URLError
from urllib.request import urlopen

from .._libraries import needed
from ..errors import BallraceError, SceneError
from .chosen import read_file

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["HOST", "Page", "served"]

HOST = "127.0.0.1"
"""No other machine reaches it."""

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
    with tempfile.TemporaryDirectory() as folder:
        # On the command line others of this machine could read it.
        secret = Path(folder) / "token"
        secret.touch(mode=0o600)
        secret.write_text(token, encoding="ascii")
        process = subprocess.Popen(_command(port, secret, file), env=_environment())
        try:
            _answers(process, port)
            yield Page(f"http://{HOST}:{port}/?access_token={token}", process)
        finally:
            process.terminate()
            try:
                process.wait(5.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def _command(port: int, secret: Path, file: Path | None) -> list[str]:
    notebook = Path(__file__).with_name("app.py")
    options = [
        "--headless", "--no-sandbox", "--no-check", "--token", f"--token-password-file={secret}", f"--host={HOST}",
        f"--port={port}",
    ]  # fmt: skip
    # Quiet: it would print the address without the token as well.
    begin = [sys.executable, "-m", "marimo", "-q", "run", str(notebook), *options]
    return begin if file is None else [*begin, "--", "--file", str(file.absolute())]


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
    until = time.monotonic() + _PATIENCE
    while time.monotonic() < until:
        if process.poll() is not None:
            version = importlib.metadata.version("marimo")
            raise BallraceError(f"marimo {version} ended with status {process.returncode}")
        try:
            with urlopen(f"http://{HOST}:{port}/health", timeout=1.0):
                return
        except (URLError, OSError):
            time.sleep(0.05)
    raise BallraceError(f"the page did not answer within {_PATIENCE:g} s")
