"""Long calls that answer Ctrl-C, and answer it once.

Python handles it between two calls, and one of numpy may take half a minute. Polars handles it itself and raises
``KeyboardInterrupt``; Python then raises a second one in the middle of what follows.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")

_LONG = 500_000
"""Samples of a signal from which its transform may take a tenth of a second."""

_ATTENTION = 0.05
"""Longest time between two looks at signals [s]."""


def answers_ctrl_c(function: Callable[P, T]) -> Callable[P, T]:
    """Let a function of a signal ``x`` work on a thread of its own where the signal is long.

    After Ctrl-C the thread goes on to the end of its call, and its result is dropped.
    """

    @functools.wraps(function)
    def called(*args: P.args, **kwargs: P.kwargs) -> T:
        x = args[0] if args else kwargs.get("x")
        if getattr(x, "size", 0) < _LONG or not _gets_signals():
            return function(*args, **kwargs)
        return _apart(lambda: function(*args, **kwargs))

    return called


def interrupted_once(work: Callable[[], T]) -> T:
    """Let polars work on a thread of its own, and wait for its end; after Ctrl-C it soon ends what it does."""
    if not _gets_signals():
        return work()
    with ThreadPoolExecutor(1) as pool:
        try:
            started = pool.submit(work)
        except RuntimeError:
            # There is no room for another thread: the work is worth more than an answer to Ctrl-C.
            return work()
        return started.result()


def _gets_signals() -> bool:
    return threading.current_thread() is threading.main_thread()


def _apart(work: Callable[[], T]) -> T:
    outcome: Future[T] = Future()

    def run() -> None:
        try:
            outcome.set_result(work())
        except BaseException as error:  # noqa: BLE001 (raised where it is waited for)
            outcome.set_exception(error)

    try:
        threading.Thread(target=run, name="ballrace", daemon=True).start()
    except RuntimeError:
        return work()  # as above
    while not wait([outcome], timeout=_ATTENTION).done:
        pass
    return outcome.result()
