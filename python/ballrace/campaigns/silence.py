"""Messages while an executor gives nothing back, and when a campaign no longer waits for it."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from typing import Any

from .._base.text import printable
from ..errors import CampaignError, CampaignWarning

_FIRST = 300.0
"""Silence after which it is told first; then after twice as long each time [s]."""

_SHARE = 10.0
"""Silence that is told at the earliest, over the longest time from one task to the next so far."""

_DESERTED = 60.0
"""Time that an executor may have no worker left, for each try of a case [s]."""

_LOOK = 1.0
"""How often workers are counted [s]."""


class Silence:
    """How long no task has come back, and no worker has been there.

    Parameters
    ----------
    executor : Executor
        Where tasks are.
    tries : int
        How often a case is tried.
    safe : callable
        Returns what is safe, in words.
    """

    def __init__(self, executor: Any, tries: int, safe: Callable[[], str]) -> None:
        self._executor, self._tries, self._safe = executor, tries, safe
        self._since = self._seen = self._looked = time.monotonic()
        self._longest = 0.0
        self._told = _FIRST
        self._had_workers = bool(_workers(executor))

    def over(self) -> None:
        """Take note that a task has come back."""
        now = time.monotonic()
        self._longest = max(self._longest, now - self._since)
        self._since, self._told = now, _FIRST

    def look(self, out: int) -> None:
        """Say how long it has lasted, if it is time, with so many tasks out.

        Raises
        ------
        CampaignError
            Workers were there, and have been gone for too long.
        """
        now = time.monotonic()
        if now - self._looked < _LOOK:
            return
        self._looked = now
        workers = _workers(self._executor)
        if workers or workers is None:
            self._had_workers |= bool(workers)
            self._seen = now
        gone = now - self._seen
        longest = _DESERTED * self._tries
        if self._had_workers and gone >= longest:
            text = f"Dask has had no worker for {gone:.0f} s, the limit is {longest:g} s"
            raise CampaignError(f"{text} with retries = {self._tries - 1}; start workers again")
        silent = now - self._since
        if silent >= max(self._told, _SHARE * self._longest):
            self._told = 2.0 * silent
            why = (
                "no worker is there" if workers == 0 else "cases take as long, or it has lost tasks"
            )
            text = f"the executor has given nothing back for {silent:.0f} s, with {out} tasks out: {why}"
            text += f"; {self._safe()}, and after Ctrl-C the same call goes on"
            warnings.warn(printable(text), CampaignWarning, stacklevel=2)


def _workers(executor: Any) -> int | None:
    """Return how many workers Dask has, as its client was last told, some seconds ago; None of other executors."""
    # The executor of a Dask client has it.
    known = getattr(getattr(executor, "_client", None), "_scheduler_identity", None) or {}
    count = known.get("n_workers")
    return len(known["workers"]) if count is None and "workers" in known else count
