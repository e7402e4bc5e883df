"""Files of records read in a child process, so that a damaged file can crash, fill or block only that process.

The libraries that read these formats are written in C, C++ and Rust; one changed byte of a file can end the
process. So one child, kept for the files that follow, reads them within limits. This process does not even open
the file, which a pipe or a network mount could delay without end: it waits for the child by a clock of its own.

A request is a line of JSON, and so is the answer, which has the columns and their lengths; the samples follow as
they are in memory. Nothing is unpickled: the process that reads a malicious file may be under its control.
"""

from __future__ import annotations

import atexit
import importlib
import json
import math
import os
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing import spawn
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._base import memory as _memory
from ..errors import BallraceError, FileError, from_record
from . import limits
from .here import format_of, read_here
from .reading import Reading
from .samples import Samples

_PROGRAM = (
    "import sys; sys.path[:] = sys.argv[1:]; from ballrace.recordings.apart import serve; serve()"
)

_ALARM = getattr(signal, "ITIMER_REAL", None)
"""The clock by which the system ends a child whose parent is gone; Windows has none."""

_ORPHANED = 10.0
"""How long after the time limit that is [s]."""

_STARTED = 60.0
"""How long a child may take to start, the first time after an installation, for example [s]."""

_PATIENCE = 2.0
"""How long an ended child is waited for [s]: the system may not let it go while it waits for a dead disk."""

_WATCHED = 0.01
"""How often the child looks at its memory where the system does not limit it [s]."""

_WORN = 1 << 28
"""Growth of such a child after which it reads no further file [bytes]: of its memory only the peak is known."""

_LONGEST = 1 << 26
"""Most bytes of an answer's line."""

_PART = 1 << 20
"""Numbers that are sent together."""

_TELLING = 0.1
"""Seconds between two lines about progress."""

_PACKAGE = Path(__file__).resolve().parents[1]


class _TimedOutError(Exception):
    """The time is up."""


def _search_path() -> list[str]:
    """Return where the child looks for modules: as this process, but in no folder of this package.

    A program that is started from a file has its folder first, as the page of ``explore``; modules there would be
    taken for those of the standard library.
    """
    folders = map(os.path.abspath, sys.path)
    return [one for one in folders if not Path(one).resolve().is_relative_to(_PACKAGE)]


class _Child:
    """The process, and the descriptors of two pipes to it.

    They are no files of Python's, whose locks another thread may hold while this process is forked.
    """

    def __init__(self) -> None:
        if getattr(sys, "frozen", False):
            raise OSError("a frozen program has no Python for a child; read with trusted=True")
        self.timed_out = self.worn = False
        self._rest = bytearray()
        theirs, self._requests = os.pipe()
        self._answers, ours = os.pipe()
        try:
            self._process = subprocess.Popen(
                [spawn.get_executable(), "-P", "-c", _PROGRAM, *_search_path()],
                stdin=theirs,
                stdout=ours,
                stderr=subprocess.DEVNULL,
                # It starts faster without threads for sums that it does not have.
                env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
            )
        except BaseException:
            self.leave()
            raise
        finally:
            os.close(theirs)
            os.close(ours)

    def is_alive(self) -> bool:
        return self._process.poll() is None

    def wait_until_started(self) -> None:
        """Wait for its first line."""
        try:
            with self._ended_after(_STARTED) as deadline:
                self._line(deadline)
        except _TimedOutError:
            raise OSError(
                f"the process that reads files did not start within {_STARTED:g} s"
            ) from None

    def read(self, request: dict[str, Any], tell: Callable[[float], object]) -> Samples | Exception:
        """Return samples, or the error there; raise EOFError if the process has ended instead."""
        with self._ended_after(request["time_limit"]) as deadline:
            with suppress(BrokenPipeError):
                os.write(self._requests, json.dumps(request).encode() + b"\n")
            answer: dict[str, Any] = json.loads(self._line(deadline))
            while "done" in answer:
                tell(min(max(float(answer["done"]), 0.0), 1.0))
                answer = json.loads(self._line(deadline))
            self.worn = "worn" in answer and bool(answer["worn"])
            if "groups" in answer:
                return self._samples(answer["groups"], request["memory_limit"], deadline)
            return _error(answer["error"], answer["arguments"], answer.get("name"))

    @contextmanager
    def _ended_after(self, seconds: float) -> Iterator[float]:
        """Give the time when waiting ends; where waiting for a pipe cannot be limited, end the child then."""
        deadline = time.monotonic() + seconds
        if hasattr(select, "poll") or seconds > threading.TIMEOUT_MAX:
            yield deadline
            return
        timer = threading.Timer(seconds, self.time_out)
        timer.start()
        try:
            yield math.inf
        finally:
            timer.cancel()

    def _received(self, deadline: float) -> bytes:
        """Return what the pipe holds, at least one byte."""
        if hasattr(select, "poll") and deadline < math.inf:
            waiting = select.poll()
            waiting.register(self._answers, select.POLLIN)
            left = deadline - time.monotonic()
            while left > 0.0 and not waiting.poll(min(1e3 * left + 1.0, 1e6)):
                left = deadline - time.monotonic()
            if left <= 0.0 and not waiting.poll(0):
                self.timed_out = True
                raise _TimedOutError
        data = os.read(self._answers, 1 << 20)
        if not data:
            raise EOFError
        return data

    def _line(self, deadline: float) -> bytes:
        looked = 0
        while (end := self._rest.find(b"\n", looked)) < 0:
            looked = len(self._rest)
            if looked > _LONGEST:
                raise EOFError
            self._rest += self._received(deadline)
        line = bytes(self._rest[:end])
        del self._rest[: end + 1]
        return line

    def _samples(
        self, groups: list[dict[str, Any]], memory_limit: float, deadline: float
    ) -> Samples:
        """Return the samples of an answer, with other columns of the file as others of the first."""
        if sum(8.0 * size for group in groups for size in group["sizes"].values()) > memory_limit:
            raise ValueError("more than it may have read")
        found = []
        for group in groups:
            columns = {
                name: self._filled(size, deadline) for name, size in group.pop("sizes").items()
            }
            found.append(Samples(columns=columns, **group))
        found[0].others = found[1:]
        return found[0]

    def _filled(self, size: int, deadline: float) -> NDArray[np.float64]:
        column = np.empty(size)
        rest = column.data.cast("B")
        while rest:
            data = self._rest or self._received(deadline)
            count = min(len(data), len(rest))
            rest[:count] = data[:count]
            rest = rest[count:]
            self._rest = bytearray(data[count:])
        return column

    def time_out(self) -> None:
        self.timed_out = True
        self._process.kill()

    def leave(self) -> None:
        """Close the pipes; once nobody has them, the child ends."""
        for descriptor in (self._requests, self._answers):
            with suppress(OSError):
                os.close(descriptor)

    def disown(self) -> None:
        """Leave it to the process that this one was forked from: it is not this one's to wait for."""
        self.leave()
        self._process.returncode = 0

    def end(self) -> str:
        """End it if it has not, and say how it did."""
        self.leave()
        self._process.kill()
        try:
            code = self._process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            return "still there"
        return signal.Signals(-code).name if code < 0 else f"status {code}"


class _Own:
    """State of this process: a forked one must not share it."""

    lock = threading.Lock()
    child: _Child | None = None


def read_apart(
    path: Path,
    format: str | None,  # noqa: A002
    reading: Reading,
    time_limit: float,
    memory_limit: float,
) -> Samples:
    """Read a file as :func:`.here.read_here` does, in the child.

    Raises
    ------
    FileError, SceneError, InternalError
        As there; or the child ended over it, or took more time or memory than it may.
    ImportError
        The library for this format is not installed.
    OSError
        The file cannot be read, or no child can be started.
    """
    request = {"path": str(path.absolute()), "format": format, "reading": reading.to_json()}
    limited = {"time_limit": time_limit, "memory_limit": memory_limit}
    with _Own.lock:
        try:
            if _Own.child is None or _Own.child.worn or not _Own.child.is_alive():
                end_child()
                _Own.child = _Child()
                _Own.child.wait_until_started()
            found = _Own.child.read(request | limited, reading.tell)
        except BaseException as error:
            # After Ctrl-C, too: what the child sends next would be of this file.
            how, timed_out = end_child()
            if not isinstance(
                error, EOFError | ValueError | LookupError | TypeError | _TimedOutError
            ):
                raise
            raise FileError(str(path), _ended(how, timed_out, limited)) from None
    match found:
        case Samples():
            return found
        case FileError(reason=reason):
            raise FileError(str(path), reason)
        case OSError(errno=number, strerror=text):
            raise OSError(number, text, str(path))
    raise found


def _ended(how: str, timed_out: bool, limited: dict[str, float]) -> str:
    if timed_out:
        seconds = limited["time_limit"]
        return f"took longer than {seconds:g} s to read; raise time_limit if it is a record"
    memory = f"memory_limit ({limited['memory_limit'] / 1e9:.3g} GB)"
    return f"ended the process that read it ({how}): damaged, or it needs more than {memory} allows"


def _error(name: str, arguments: list[Any], module: str | None) -> Exception:
    """Return an error of the child; of other classes than readers raise there is none."""
    match name:
        case "ImportError":
            return ImportError(*arguments, name=module)
        case "OSError":
            return OSError(*arguments)
        case "FileError" | "SceneError" | "MemoryLimitError" | "InternalError":
            return from_record({"class": name, "arguments": arguments})
    raise ValueError(name)


def end_child() -> tuple[str, bool]:
    """End the child of this process if there is one; return how it did, and whether its time was up."""
    child, _Own.child = _Own.child, None
    return ("not started", False) if child is None else (child.end(), child.timed_out)


def _leave_to_parent() -> None:
    """Have a forked process start a child of its own."""
    if _Own.child is not None:
        _Own.child.disown()
    _Own.child, _Own.lock = None, threading.Lock()


atexit.register(end_child)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_leave_to_parent)


def serve() -> None:
    """Answer requests until there are no more: what the child does."""
    with suppress(ValueError):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the parent, which ends this
    # What libraries print is no answer.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)

    def send(part: bytes | memoryview) -> None:
        answers.write(part)
        answers.flush()

    send(b"\n")
    for line in sys.stdin.buffer:
        request = json.loads(line)
        _alarm(request["time_limit"] + _ORPHANED)
        for part in _answer(request, send):
            send(part)
        _alarm(0.0)


def _alarm(seconds: float) -> None:
    if _ALARM is not None and seconds < threading.TIMEOUT_MAX:
        signal.setitimer(_ALARM, seconds)


def _answer(
    request: dict[str, Any], send: Callable[[bytes], object]
) -> Iterator[bytes | memoryview]:
    """Yield the line of an answer, then its samples; ``send`` lines about progress before."""
    path = Path(request["path"])
    reading = Reading(**request["reading"], tell=_Telling(send).tell)
    limits.most = request["memory_limit"]
    before = _memory.peak() or 0
    try:
        form = format_of(path, request["format"])
        _memory.let(math.inf)
        with suppress(ImportError):
            importlib.import_module(form.library)  # what is missing is reported by what needs it
        before = _memory.peak() or 0
        with _memory_limited(before):
            samples = read_here(path, form, reading)
        groups = [samples, *samples.others]
        answer: dict[str, Any] = {"groups": [_described(group) for group in groups]}
        columns = [x for group in groups for x in group.columns.values()]
    except (BallraceError, ImportError, OSError) as error:
        answer, columns = _described_error(error), []
    answer["worn"] = _memory.used() is None and (_memory.peak() or 0) > before + _WORN
    yield json.dumps(answer).encode() + b"\n"
    for x in columns:
        for start in range(0, x.size, _PART):
            yield np.ascontiguousarray(x[start : start + _PART], dtype=np.float64).data.cast("B")


class _Telling:
    """Lines about progress, not too many."""

    def __init__(self, send: Callable[[bytes], object]) -> None:
        self._send, self._last = send, time.monotonic()

    def tell(self, share: float) -> None:
        if time.monotonic() >= self._last + _TELLING:
            self._last = time.monotonic()
            self._send(json.dumps({"done": share}).encode() + b"\n")


@contextmanager
def _memory_limited(before: int) -> Iterator[None]:
    """Have the system limit what reading takes, or else watch it from a thread, which ends this process."""
    if _memory.let(limits.most):
        yield
        return
    done = threading.Event()

    def watch() -> None:
        while not done.wait(_WATCHED):
            if (_memory.peak() or 0) > before + limits.most:
                os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
    try:
        yield
    finally:
        done.set()


def _described(samples: Samples) -> dict[str, Any]:
    rest = {name: getattr(samples, name) for name in ("fs", "units", "shaft", "metadata", "notes")}
    return {"sizes": {name: x.size for name, x in samples.columns.items()}, **rest}


def _described_error(error: Exception) -> dict[str, Any]:
    match error:
        case ImportError():
            return {"error": "ImportError", "arguments": [str(error)], "name": error.name}
        case OSError():
            return {"error": "OSError", "arguments": [error.errno, error.strerror]}
    return {"error": type(error).__name__, "arguments": list(error.args)}
