"""A progress bar for a terminal or a notebook."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import Self, TextIO

from .text import printable

_WIDTH = 30


def is_watched(stream: TextIO) -> bool:
    """Return whether somebody sees a line change: at a terminal, or in a notebook."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return stream.isatty() or hasattr(shell, "kernel")


class Bar:
    """A bar on standard error, one line that grows and goes away at the end; silent where nobody sees it."""

    def __init__(self, label: str, stream: TextIO | None = None) -> None:
        self._label = printable(label)
        self._stream = sys.stderr if stream is None else stream
        self._shown = is_watched(self._stream)
        self._length = 0
        self._began = time.monotonic()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._write("")

    def show(self, share: float) -> None:
        """Show a share from 0 to 1."""
        filled = round(_WIDTH * share)
        left = (time.monotonic() - self._began) * (1.0 - share) / share if share > 0.0 else 0.0
        rest = f"{left:4.0f} s left" if 0.0 < share < 1.0 else ""
        self._write(f"{self._label}  [{'#' * filled}{'.' * (_WIDTH - filled)}] {share:4.0%} {rest}")

    def _write(self, line: str) -> None:
        if self._shown:
            # A notebook knows no command to erase a line.
            self._stream.write(f"\r{' ' * self._length}\r{line}")
            self._length = len(line)
            self._stream.flush()
