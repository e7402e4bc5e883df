"""Cases given to an executor, chunk by chunk, with a bounded number in progress."""

from __future__ import annotations

import json
import math
import time
import uuid
from collections import Counter
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import suppress
from dataclasses import asdict
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol
from urllib.parse import urlsplit

from .._core import available_threads
from ..errors import BallraceError, CampaignError, from_record
from .progress import Counts
from .store import Store
from .work import Job, check_process, run_here, version

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from .work import Document

_CHUNK = 20.0
"""Time a chunk should take [s]."""

_MOST = 1000
"""Cases of a chunk at most: some megabytes of JSON."""


class Executor(Protocol):
    """What :mod:`concurrent.futures` calls an executor."""

    def submit(self, fn: Callable[[str], str], /, text: str) -> Future[str]:
        """Have ``fn(text)`` called somewhere."""


def executor_of(given: Any) -> tuple[Executor, int | None]:
    """Return an executor, and how many tasks it runs at once, if it says so.

    Raises
    ------
    TypeError
        It is none, and gives none.
    """
    workers = None
    if hasattr(given, "get_executor"):
        # Dask: a task handed out again must run again.
        if hasattr(given, "nthreads"):
            workers = sum(given.nthreads().values())
        return given.get_executor(pure=False), workers
    if not hasattr(given, "submit"):
        raise TypeError(
            f"executor: {type(given).__name__} has neither submit nor get_executor; give a "
            "concurrent.futures.Executor or a Dask Client"
        )
    for name in ("num_workers", "_max_workers"):
        workers = workers or getattr(given, name, None)
    return given, workers


def tasks_on_a_machine(given: Any) -> int:
    """Return how many tasks an executor runs at once on one machine, as far as that can be known; else 1.

    Those of Dask stand in the addresses of its workers; a pool of :mod:`concurrent.futures` is on this machine.
    """
    if hasattr(given, "nthreads"):
        tasks: Counter[str] = Counter()
        for address, threads in given.nthreads().items():
            tasks[urlsplit(address).hostname or ""] += threads
        return max(tasks.values(), default=1)
    return getattr(given, "_max_workers", None) or 1


def run_spread(
    store: Store,
    cases: Iterator[Document],
    count: int,
    job: Job,
    *,
    executor: Executor,
    in_flight: int,
    told: Callable[[Counts], object],
) -> None:
    """Run ``count`` cases on an executor; workers write into the store and return counts.

    The first tasks have one case each; later ones as many as fit into twenty seconds, and fewer towards the end,
    so that all workers end together.
    """
    stop = uuid.uuid4().hex
    common = {
        "root": str(store.root), "key": store.key, "version": version(), "job": asdict(job),
        "stop": stop,
    }  # fmt: skip
    pending: set[Future[str]] = set()
    counts, handed = Counts(), 0
    seconds = 0.0
    try:
        while True:
            while len(pending) < in_flight and handed < count:
                mean = seconds / counts.done if counts.done else None
                size = _size(mean, job.threads, count - handed, in_flight)
                chunk = list(islice(cases, size))
                handed += len(chunk)
                pending.add(executor.submit(run_task, json.dumps({**common, "cases": chunk})))
            if not pending:
                return
            ended, pending = wait(pending, timeout=0.1, return_when=FIRST_COMPLETED)
            _check_scheduler(executor)
            for future in ended:
                result = _result(future)
                counts = counts.plus(Counts(*result["counts"]))
                seconds += result["wall_time"]
                told(counts)
                if result["error"]:
                    raise from_record(result["error"])
            told(counts)
    finally:
        for future in pending:
            future.cancel()
        if pending:
            # What a worker has taken cannot be cancelled; it looks for this file, which the next call sweeps.
            with suppress(OSError):
                _stopped(store, stop).touch()


def _check_scheduler(executor: Any) -> None:
    """Refuse to wait for a scheduler of Dask that is gone: its client drops what it was asked for.

    Raises
    ------
    CampaignError
        The client has lost its scheduler.
    """
    # The executor of a Dask client has it; other executors have it in their futures.
    status = getattr(getattr(executor, "_client", None), "status", "running")
    if status in ("connecting", "closing", "closed"):
        raise CampaignError(f"Dask's scheduler was lost (its client is {status}); start it again")


def _stopped(store: Store, stop: str) -> Path:
    """Return the file that is there once a campaign has been stopped."""
    return store.root / "tmp" / stop


def _size(mean: float | None, threads: int, left: int, in_flight: int) -> int:
    """Return the number of cases of the next chunk, from the mean time of a case so far [s]."""
    if mean is None:
        return 1
    fitting = int(_CHUNK * threads / max(mean, 1e-6))
    return max(1, min(fitting, _MOST, math.ceil(left / in_flight)))


def _result(future: Future[str]) -> dict[str, Any]:
    try:
        result: dict[str, Any] = json.loads(future.result())
    except BallraceError:
        raise
    except Exception as error:
        # Broken pools, killed workers, full disks: every engine has its own.
        raise CampaignError(f"a worker failed: {type(error).__name__}: {error}") from error
    return result


def run_task(text: str) -> str:
    """Run a chunk of cases where the executor has put it; JSON in, JSON out."""
    check_process()
    task = json.loads(text)
    if task["version"] != version():
        raise CampaignError(
            f"this worker has ballrace {version()}, the campaign {task['version']}; install the same"
        )
    store = Store(Path(task["root"]))
    if store.key != task["key"]:
        raise CampaignError(f"{task['root']} is not the same folder for this worker; share it")
    job = Job(**task["job"])
    result: dict[str, Any] = {"counts": Counts(), "error": None, "wall_time": 0.0}

    stop = _stopped(store, task["stop"])

    def told(counts: Counts) -> None:
        result["counts"] = counts
        if stop.exists():
            raise CampaignError("the campaign was stopped")

    began = time.monotonic()
    try:
        run_here(store, task["cases"], job, told)
    except BallraceError as error:
        arguments = {"class": type(error).__name__, "arguments": list(error.args)}
        return json.dumps({**result, "error": arguments})
    result["wall_time"] = (time.monotonic() - began) * (job.threads or available_threads())
    return json.dumps(result)
