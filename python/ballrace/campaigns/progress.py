"""Progress of a campaign: a bar, a line, or a callback."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TextIO

from .._base.progress import is_watched
from .._base.text import printable

_WIDTH = 30
_OFTEN = 0.2
"""The bar is drawn no more often than this [s]."""


class Counts(NamedTuple):
    """How many cases have come to their end."""

    done: int = 0
    failed: int = 0
    warned: int = 0

    def plus(self, other: Counts) -> Counts:
        """Return the sums."""
        return Counts(*(a + b for a, b in zip(self, other, strict=True)))


@dataclass(frozen=True, slots=True)
class Progress:
    """Progress of a campaign.

    Attributes
    ----------
    total : int
        Cases of the table, or of this shard of it.
    before : int
        Of these, finished by earlier calls.
    done : int
        Finished by this call, failed ones included.
    failed : int
        Failed in this call.
    elapsed : float
        Time since this call began [s].
    warned : int
        Finished by this call with warnings, which are in the column ``warnings`` of the manifest.
    """

    total: int
    before: int
    done: int
    failed: int
    elapsed: float
    warned: int = 0

    @property
    def rate(self) -> float:
        """Cases a second."""
        return self.done / self.elapsed if self.elapsed > 0.0 else 0.0

    @property
    def left(self) -> float | None:
        """Time left at this rate [s]; None before the first case has finished."""
        rest = self.total - self.before - self.done
        return rest / self.rate if self.done else None

    def line(self) -> str:
        """Return the whole in one line."""
        failed = f", {self.failed} failed" if self.failed else ""
        warned = f", {self.warned} with warnings" if self.warned else ""
        before = f", {self.before} from before" if self.before else ""
        rate = f" ({self.rate:.3g} cases/s)" if self.done else ""
        return (
            f"campaign: {self.before + self.done} of {self.total} cases{before}{failed}{warned}, "
            f"{duration(self.elapsed)}{rate}"
        )


def duration(seconds: float) -> str:
    """Return a time as people say it."""
    if seconds < 100.0:
        return f"{seconds:.1f} s"
    minutes = round(seconds / 60.0)
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60:02d} min"


class ProgressDisplay:
    """Shows progress: a bar in a terminal or notebook, else one line at the end; or a callback."""

    def __init__(
        self,
        progress: bool | Callable[[Progress], object],
        total: int,
        before: int,
        stream: TextIO | None = None,
        labels: Sequence[str] = (),
    ) -> None:
        self._callback = progress if callable(progress) else None
        self._stream = None if progress is False or self._callback else stream or sys.stderr
        self._bar = self._stream is not None and is_watched(self._stream)
        self._total, self._before = total, before
        self._began = time.monotonic()
        self._drawn = 0.0
        self.now = Progress(total, before, 0, 0, 0.0)
        if labels:
            names = printable(", ".join(labels))
            self._write(f"campaign: columns that are labels and change nothing: {names}\n")

    def update(self, counts: Counts) -> None:
        """Take note of how many cases have come to their end, and show it."""
        done, failed, warned = counts
        elapsed = time.monotonic() - self._began
        news = done != self.now.done
        self.now = Progress(self._total, self._before, done, failed, elapsed, warned)
        if self._callback is not None and (news or done == 0):
            self._callback(self.now)
        if self._bar and time.monotonic() - self._drawn >= _OFTEN:
            self._drawn = time.monotonic()
            self._write(f"\r{self._draw():<{_WIDTH + 60}}")

    def end(self) -> None:
        """Say one last line, in place of the bar."""
        line = self.now.line()
        self._write(f"\r{line:<{_WIDTH + 60}}\n" if self._bar else f"{line}\n")

    def _draw(self) -> str:
        now = self.now
        share = (now.before + now.done) / now.total
        filled = int(_WIDTH * share)
        failed = f", {now.failed} failed" if now.failed else ""
        left = f", {duration(now.left)} left" if now.left is not None else ""
        bar = "#" * filled + "." * (_WIDTH - filled)
        return f"[{bar}] {now.before + now.done}/{now.total}{failed}, {now.rate:.3g}/s{left}"

    def _write(self, text: str) -> None:
        if self._stream is not None:
            self._stream.write(text)
            self._stream.flush()
