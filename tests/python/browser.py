"""A real browser, without a window and without a network, for pages that are to work in one."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

_NAMES = ("chromium", "chromium-browser", "google-chrome")


@dataclass
class Seen:
    """What a page did: messages of its console, errors, and what it asked the network for."""

    console: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)


class Browser:
    """Opens pages at a width."""

    def __init__(self, chromium: Any) -> None:
        self._chromium = chromium

    @contextmanager
    def blank(
        self, width: int, *, height: int = 900, offline: bool = True
    ) -> Iterator[tuple[Any, Seen]]:
        """Give an empty page, and what it will have done."""
        size = {"width": width, "height": height}
        context = self._chromium.new_context(viewport=size, offline=offline)
        page, seen = context.new_page(), Seen()
        page.on("console", lambda message: seen.console.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: seen.console.append(f"error: {error}"))
        page.on("request", lambda request: seen.requests.append(request.url[:100]))
        try:
            yield page, seen
        finally:
            context.close()

    @contextmanager
    def page(self, path: Path, width: int) -> Iterator[tuple[Any, Seen]]:
        """Give a loaded page, and what it did so far."""
        with self.blank(width) as (page, seen):
            self._load(page, path)
            yield page, seen

    def _load(self, page: Any, path: Path) -> None:
        page.goto(path.as_uri())
        page.wait_for_function(
            "[...document.querySelectorAll('.plotly-graph-div')].every(d => d.querySelector('.main-svg'))"
        )
        page.wait_for_timeout(200)


@contextmanager
def opened() -> Iterator[Browser]:
    """Start the browser; skip where there is none, and say which part is missing."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    program = next(filter(None, map(shutil.which, _NAMES)), None)
    if program is None:
        pytest.skip(f"there is no browser: none of {', '.join(_NAMES)}")
    # Chromium refuses its sandbox to root, as in a container.
    arguments = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    with sync_api.sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=arguments)
        try:
            yield Browser(chromium)
        finally:
            chromium.close()
