"""The process that serves the page: marimo behind the guard, for as long as the process that started it lives."""

from __future__ import annotations

import os
import runpy
import signal
import sys
import threading
from pathlib import Path
from typing import Any

from .guard import Guard

_PATIENCE = 5.0
"""How long the server may take to end by itself [s]."""


def serve() -> None:
    """Serve the page on loopback; arguments are the port and, if there is one, the file to begin with.

    Standard input is a pipe: its first line is the token, which stands in no file and on no command line, and its
    end is the end of who started this.
    """
    port, *file = sys.argv[1:]
    token = sys.stdin.buffer.readline().decode("ascii").strip()
    if not token:
        return  # who started this is gone
    threading.Thread(target=_end_with_parent, name="ballrace parent", daemon=True).start()
    _put_behind_guard()
    options = [
        "--headless", "--no-sandbox", "--no-check", "--token", f"--token-password={token}", "--host=127.0.0.1",
        f"--port={port}",
    ]  # fmt: skip
    notebook = str(Path(__file__).with_name("app.py"))
    given = [f"--file={file[0]}"] if file else []
    # Quiet: it would print the address without the token as well.
    sys.argv = ["marimo", "-q", "run", notebook, *options, "--", *given]
    runpy.run_module("marimo", run_name="__main__")


def _put_behind_guard() -> None:
    """Have the server put every application behind the guard; who started this checks that it did."""
    import uvicorn

    class Guarded(uvicorn.Config):
        def __init__(self, app: Any, *args: Any, **kwargs: Any) -> None:
            super().__init__(Guard(app), *args, **kwargs)

    vars(uvicorn)["Config"] = Guarded


def _end_with_parent() -> None:
    while sys.stdin.buffer.read(1):
        pass
    os.kill(os.getpid(), signal.SIGTERM)
    # What is in a library may not come to its end.
    threading.Event().wait(_PATIENCE)
    os._exit(1)
