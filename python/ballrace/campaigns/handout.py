"""Groups of cases that are submitted together, so that one that ends its worker is found and none is lost."""

from __future__ import annotations

from collections import Counter, deque
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from itertools import islice
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Container, Iterator

    from .work import Document


class Handout:
    """Cases in chunks; those of a chunk whose worker died one by one; and those that did so again alone.

    A pool that breaks loses the cases of all its workers. Which one broke it is known only if it ran alone.
    """

    def __init__(self, cases: Iterator[Document], count: int, retries: int) -> None:
        self._cases = cases
        self._retries = retries
        self._single: deque[Document] = deque()
        self._alone: deque[Document] = deque()
        self._out_alone: str | None = None
        self._tried: Counter[str] = Counter()
        self.left = count

    def next(self, size: int, is_idle: bool) -> list[Document]:
        """Return what goes out now, at most ``size`` cases: nothing while one is out alone, or waits to be."""
        if self._alone or self._out_alone is not None:
            if not (is_idle and self._alone):
                return []
            self._out_alone = self._alone[0][0]
            return [self._alone.popleft()]
        if self._single:
            return [self._single.popleft()]
        chunk = list(islice(self._cases, size))
        self.left -= len(chunk)
        return chunk

    def back(self, chunk: list[Document]) -> None:
        """Take note that a chunk has come back."""
        if chunk[0][0] == self._out_alone:
            self._out_alone = None

    def lost(self, chunks: list[list[Document]], finished: Container[str]) -> list[Document]:
        """Take note of chunks whose workers died, and return the case that is given up, if one is."""
        blamed = []
        for chunk in chunks:
            for case in chunk:
                if case[0] in finished:
                    continue
                if case[0] == self._out_alone:
                    self._tried[case[0]] += 1
                    if self._tried[case[0]] >= self._retries:
                        blamed.append(case)
                        continue
                # Of many it may have been any; of single ones those that were out at once.
                (self._single if len(chunk) > 1 else self._alone).append(case)
            self.back(chunk)
        return blamed


def has_died(error: BaseException) -> bool:
    """Return whether this error of an executor means that a worker died: its pool is broken, or Dask gave up."""
    return isinstance(error, BrokenExecutor) or type(error).__name__ == "KilledWorker"


def pool_like(executor: Any) -> ProcessPoolExecutor | None:
    """Return a pool as one that has broken was, or None where it is of another kind."""
    if not isinstance(executor, ProcessPoolExecutor):
        return None
    broken: Any = executor
    return ProcessPoolExecutor(
        broken._max_workers,
        mp_context=broken._mp_context,
        initializer=broken._initializer,
        initargs=broken._initargs,
    )
