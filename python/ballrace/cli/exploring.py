"""``ballrace explore``: a page that answers while controls are moved."""

from __future__ import annotations

import signal
import threading
import webbrowser
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..explore.served import served
from .arguments import Commands, added

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add the subcommand."""
    page = added(
        commands, "explore", "open a page that answers while loads, speed, clearance, oil and damage are changed",
        "ballrace explore scene.toml", _explore,
    )  # fmt: skip
    page.add_argument(
        "file", type=Path, nargs="?", metavar="SCENE|FILE",
        help="scene to begin with, .toml or .json, or measured record to lay beside the run (default: a 6205)",
    )  # fmt: skip
    page.add_argument(
        "--port",
        type=int,
        help="port on this machine, not reachable from others (default: a free one)",
    )
    page.add_argument(
        "--no-browser", action="store_true", help="print the address and open no browser"
    )


def _explore(options: argparse.Namespace) -> None:
    with _ended_by_signals(), served(options.file, options.port) as page:
        print(f"{page.url}\nCtrl-C ends it.", flush=True)
        if not options.no_browser:
            webbrowser.open(page.url)
        page.wait()


@contextmanager
def _ended_by_signals() -> Iterator[None]:
    """Have the signals of a batch system and of a terminal that is closed end the block as an error does."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def end(number: int, frame: object) -> None:
        del frame
        for each in before:
            signal.signal(each, signal.SIG_IGN)
        raise SystemExit(128 + number)

    numbers = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    # What is ignored stays so, as under nohup.
    before = {n: signal.getsignal(n) for n in numbers if signal.getsignal(n) != signal.SIG_IGN}
    try:
        for number in before:
            signal.signal(number, end)
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
