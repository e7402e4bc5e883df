"""Cases given to an executor, chunk by chunk, with a bounded number in progress."""

from __future__ import annotations

import json
import math
import time
import uuid
import warnings
from collections import Counter
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol
from urllib.parse import urlsplit

from .._base.text import printable
from .._core import available_threads
from ..errors import BallraceError, CampaignError, CampaignWarning, from_record, record_of
from .handout import Handout, has_died, pool_like
from .progress import Counts
from .silence import Silence
from .store import Store
from .work import Job, check_process, record_failed, run_here, version

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from concurrent.futures import ProcessPoolExecutor

    from .work import Document

_CHUNK = 20.0
"""Time a chunk should take [s]."""

_MOST = 1000
"""Cases of a chunk at most: some megabytes of JSON."""


class Executor(Protocol):
    """Executor as :mod:`concurrent.futures` has it."""

    def submit(self, fn: Callable[[str], str], text: str, /) -> Future[str]:
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


class Spread:
    """Cases on an executor; workers write into the store and return counts.

    The first tasks have one case each; later ones as many as fit into twenty seconds, and fewer towards the end,
    so that all workers end together.
    """

    def __init__(
        self,
        store: Store,
        handout: Handout,
        job: Job,
        *,
        executor: Executor,
        in_flight: int,
        on_progress: Callable[[Counts], object],
    ) -> None:
        self._store, self._handout, self._job = store, handout, job
        self._executor, self._in_flight, self._on_progress = executor, in_flight, on_progress
        self._own: ProcessPoolExecutor | None = None
        self._stop = uuid.uuid4().hex
        self._pending: dict[Future[str], list[Document]] = {}
        self._counts = Counts()
        self._seconds = 0.0

    def run(self) -> None:
        """Run all cases."""
        silence = Silence(self._executor, 1 + self._job.retries, self._safe)
        try:
            while self._hand_out():
                ended = wait(self._pending, timeout=0.1, return_when=FIRST_COMPLETED).done
                _check_scheduler(self._executor)
                self._take(ended)
                if ended:
                    silence.over()
                silence.look(len(self._pending))
                self._on_progress(self._counts)
        finally:
            self._end()

    def _safe(self) -> str:
        return f"{self._counts.done} cases of this call are safe in {self._store.root}"

    def _hand_out(self) -> bool:
        """Hand out as much as may be in progress, and say whether anything is."""
        while len(self._pending) < self._in_flight:
            mean = self._seconds / self._counts.done if self._counts.done else None
            size = _size(mean, self._job.threads, self._handout.left, self._in_flight)
            chunk = self._handout.next(size, is_idle=not self._pending)
            if not chunk:
                break
            self._pending[self._submitted(chunk)] = chunk
        return bool(self._pending)

    def _submitted(self, chunk: list[Document]) -> Future[str]:
        task = {
            "root": str(self._store.root), "key": self._store.key, "version": version(),
            "job": asdict(self._job), "stop": self._stop, "cases": chunk,
        }  # fmt: skip
        try:
            future: object = self._executor.submit(run_task, json.dumps(task))
        except BrokenExecutor as error:
            # It broke since the last look: this chunk is lost as those are that it had.
            failed: Future[str] = Future()
            failed.set_exception(error)
            return failed
        except Exception as error:
            text = f"the executor took no task: {type(error).__name__}: {error}"
            raise CampaignError(text) from error
        if not isinstance(future, Future):
            text = f"executor: its submit returned a {type(future).__name__}, no Future"
            raise CampaignError(f"{text} of concurrent.futures")
        return future

    def _take(self, ended: Iterable[Future[str]]) -> None:
        """Take what ended tasks return, and give what dead workers had to others."""
        lost: list[list[Document]] = []
        why: BaseException | None = None
        for future in ended:
            chunk = self._pending.pop(future)
            error = _error_of(future)
            if error is not None and has_died(error):
                why = error
                lost.append(chunk)
            else:
                self._account(_result(future))
                self._handout.back(chunk)
        if why is not None:
            self._recover(lost, why)

    def _account(self, result: dict[str, Any]) -> None:
        self._counts = self._counts.plus(Counts(*result["counts"]))
        self._seconds += result["wall_time"]
        self._on_progress(self._counts)
        if result["error"]:
            raise from_record(result["error"])

    def _recover(self, lost: list[list[Document]], why: BaseException) -> None:
        """Go on without a worker that has died, in a new pool if it took its own with it."""
        text = f"a worker failed: {type(why).__name__}: {why}"
        if isinstance(why, BrokenExecutor):
            # All that it had ends so, or has ended well.
            others = wait(self._pending).done
            fresh = pool_like(self._executor) if self._job.retries else None
            if fresh is None:
                raise CampaignError(text) from why
            if self._own is not None:
                self._own.shutdown(wait=False)
            self._executor = self._own = fresh
            lost += [self._pending[future] for future in others if future.exception() is not None]
            for future in others:
                chunk = self._pending.pop(future)
                if future.exception() is None:
                    self._account(_result(future))
                    self._handout.back(chunk)
        elif not self._job.retries:
            raise CampaignError(text) from why
        self._give_again(lost, text)

    def _give_again(self, lost: list[list[Document]], text: str) -> None:
        ids = {case[0] for chunk in lost for case in chunk}
        there = self._store.results([])
        rows = there.filter(there["case_id"].is_in(list(ids)))
        blamed = self._handout.lost(lost, set(rows["case_id"]))
        failed = int((rows["status"] == "failed").sum())
        warned = rows.height - rows["warnings"].null_count()
        self._counts = self._counts.plus(Counts(rows.height, failed, warned))
        left = len(ids) - rows.height - len(blamed)
        if left:
            warnings.warn(
                printable(f"{text}; {left} cases that it may have had are tried again"),
                CampaignWarning,
                stacklevel=2,
            )
        if blamed:
            error = CampaignError(f"{text}; so it did whenever it ran this case")
            if self._job.raise_errors:
                raise error
            record_failed(self._store, [(case[0], error) for case in blamed])
            self._counts = self._counts.plus(Counts(len(blamed), len(blamed)))

    def _end(self) -> None:
        for future in self._pending:
            future.cancel()
        if self._pending:
            # What a worker has taken cannot be cancelled; it looks for this file, which the next call sweeps.
            with suppress(OSError):
                _stopped(self._store, self._stop).touch()
        if self._own is not None:
            self._own.shutdown(cancel_futures=True)


def _check_scheduler(executor: Any) -> None:
    """Refuse to wait for a scheduler of Dask that is gone: its client drops what it was asked for."""
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


def _error_of(future: Future[str]) -> BaseException | None:
    """Return the error of a task that has ended; of one that somebody else cancelled, that."""
    try:
        return future.exception()
    except CancelledError as error:
        return error


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

    def on_progress(counts: Counts) -> None:
        result["counts"] = counts
        if stop.exists():
            raise CampaignError("the campaign was stopped")

    began = time.monotonic()
    try:
        run_here(store, task["cases"], job, on_progress)
    except BallraceError as error:
        return json.dumps({**result, "error": record_of(error)})
    result["wall_time"] = (time.monotonic() - began) * (job.threads or available_threads())
    return json.dumps(result)
