"""``ballrace explore``: a page that answers while controls are moved."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING

from ..explore.served import served
from .arguments import Commands, added

if TYPE_CHECKING:
    import argparse

__all__ = ["add_commands"]


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
    with served(options.file, options.port) as page:
        print(f"{page.url}\nCtrl-C ends it.", flush=True)
        if not options.no_browser:
            webbrowser.open(page.url)
        page.wait()
