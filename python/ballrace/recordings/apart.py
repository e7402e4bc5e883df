"""Files of records read in a child process, so that a damaged file can crash, fill or block only that process.

The libraries that read these formats are written in C, C++ and Rust; one changed byte of a file can end the
process. So one child, kept for the files that follow, reads them within limits. A request is a line of JSON, and
so is the answer, which has the columns and their lengths; the samples follow as they are in memory. Nothing is
unpickled: the process that reads a malicious file may be under its control.
"""

from __future__ import annotations

import atexit
import importlib
import json
import os
import signal
import subprocess
import sys
import threading
from contextlib import contextmanager, suppress
from multiprocessing import spawn
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from .. import _memory
from ..errors import BallraceError, FileError, from_record
from . import limits
from .here import read_here
from .samples import Samples

if TYPE_CHECKING:
    from collections.abc import Iterator

_PROGRAM = (
    "import sys; sys.path[:] = sys.argv[1:]; from ballrace.recordings.apart import serve; serve()"
)

_LIBRARIES = {
    "csv": "ballrace._polars", "wav": "scipy.io.wavfile", "mat": "scipy.io", "uff": "pyuff", "hdf5": "h5py",
    "parquet": "ballrace._polars",
}  # fmt: skip
"""What a format needs, imported before memory is limited: libraries reserve address space that they never use."""

_ALARM = getattr(signal, "ITIMER_REAL", None)
"""The clock by which the system ends a process, whatever library it is in; Windows has none."""

_WATCHED = 0.01
"""How often the child looks at its memory where the system does not limit it [s]."""

_WORN = 1 << 28
"""Growth of such a child after which it reads no further file [bytes]: of its memory only the peak is known."""

_LONGEST = 1 << 26
"""Most bytes of an answer's line."""


_PACKAGE = Path(__file__).resolve().parents[1]


def _search_path() -> list[str]:
    """Return where the child looks for modules: as this process, but in no folder of this package.

    A program that is started from a file has its folder first, as the page of ``explore``; modules there would be
    taken for those of the standard library.
    """
    folders = map(os.path.abspath, sys.path)
    return [one for one in folders if not Path(one).resolve().is_relative_to(_PACKAGE)]


class _Child:
    """The process, and the two pipes to it."""

    def __init__(self) -> None:
        if getattr(sys, "frozen", False):
            raise OSError("a frozen program has no Python for a child; read with trusted=True")
        self.timed_out = self.worn = False
        self._process = subprocess.Popen(
            [spawn.get_executable(), "-P", "-c", _PROGRAM, *_search_path()],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # It starts faster without threads for sums that it does not have.
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        )

    def is_alive(self) -> bool:
        return self._process.poll() is None

    def read(self, request: dict[str, Any]) -> Samples | Exception:
        """Return samples, or the error there; raise EOFError if the process has ended instead."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        with suppress(BrokenPipeError):
            self._process.stdin.write(json.dumps(request).encode() + b"\n")
            self._process.stdin.flush()
        line = self._process.stdout.readline(_LONGEST)
        if not line.endswith(b"\n"):
            raise EOFError
        answer: dict[str, Any] = json.loads(line)
        self.worn = "worn" in answer and bool(answer["worn"])
        if "groups" in answer:
            return _received(answer["groups"], self._process.stdout, request["memory_limit"])
        return _error(answer["error"], answer["arguments"], answer.get("name"))

    def time_out(self) -> None:
        self.timed_out = True
        self._process.kill()

    def leave(self) -> None:
        """Close the pipes; once nobody has them, the child ends."""
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                with suppress(OSError):
                    pipe.close()

    def end(self) -> str:
        """End it if it has not, and say how it did."""
        self.leave()
        self._process.kill()
        code = self._process.wait()
        self.timed_out |= code == -getattr(signal, "SIGALRM", 0) != 0
        return signal.Signals(-code).name if code < 0 else f"status {code}"


class _Own:
    """What this process has: a forked one must not share it."""

    lock = threading.Lock()
    child: _Child | None = None


def read_apart(path: Path, format: str, time_limit: float, memory_limit: float) -> Samples:  # noqa: A002
    """Read a file as :func:`.here.read_here` does, in the child.

    Raises
    ------
    FileError
        As there; or the child ended over it, or took more time or memory than it may.
    ImportError
        The library for this format is not installed.
    OSError
        The file cannot be read, or no child can be started.
    """
    request = {"path": str(path.absolute()), "format": format}
    limited = {"time_limit": time_limit, "memory_limit": memory_limit}
    with _Own.lock:
        if _Own.child is None or _Own.child.worn or not _Own.child.is_alive():
            end_child()
            _Own.child = _Child()
        child = _Own.child
        try:
            with _limited(child, time_limit):
                found = child.read(request | limited)
        except BaseException as error:
            # After Ctrl-C, too: what the child sends next would be of this file.
            how = child.end()
            if not isinstance(error, EOFError | ValueError | LookupError | TypeError):
                raise
            why = _ended(how, child.timed_out, limited)
            raise FileError(str(path), why) from None
    match found:
        case Samples():
            return found
        case FileError(reason=reason):
            raise FileError(str(path), reason)
        case OSError(errno=number, strerror=text):
            raise OSError(number, text, str(path))
    raise found


@contextmanager
def _limited(child: _Child, seconds: float) -> Iterator[None]:
    """End the child from here where it has no clock that does."""
    if _ALARM is not None or seconds > threading.TIMEOUT_MAX:
        yield
        return
    timer = threading.Timer(seconds, child.time_out)
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


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
        case "FileError" | "SceneError" | "MemoryLimitError":
            return from_record({"class": name, "arguments": arguments})
    raise ValueError(name)


def _received(groups: list[dict[str, Any]], pipe: IO[bytes], memory_limit: float) -> Samples:
    """Return the samples of an answer, with other columns of the file as others of the first."""
    if sum(8.0 * size for group in groups for size in group["sizes"].values()) > memory_limit:
        raise ValueError("more than it may have read")
    found = []
    for group in groups:
        columns = {name: _filled(size, pipe) for name, size in group.pop("sizes").items()}
        found.append(Samples(columns=columns, **group))
    found[0].others = found[1:]
    return found[0]


def _filled(size: int, pipe: IO[bytes]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    column = np.empty(size)
    rest = column.data.cast("B")
    while rest:
        count = pipe.readinto(rest)  # type: ignore[attr-defined]
        if not count:
            raise EOFError
        rest = rest[count:]
    return column


def end_child() -> None:
    """End the child of this process if there is one."""
    if _Own.child is not None:
        _Own.child.end()
    _Own.child = None


def _leave_to_parent() -> None:
    """Have a forked process start a child of its own."""
    if _Own.child is not None:
        _Own.child.leave()
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
    for line in sys.stdin.buffer:
        request = json.loads(line)
        _alarm(request["time_limit"])
        for part in _answer(request):
            answers.write(part)
        answers.flush()
        _alarm(0.0)


def _alarm(seconds: float) -> None:
    if _ALARM is not None and seconds < threading.TIMEOUT_MAX:
        signal.setitimer(_ALARM, seconds)


def _answer(request: dict[str, Any]) -> Iterator[bytes | memoryview]:
    """Yield the line of an answer, then its samples."""
    path, form = Path(request["path"]), request["format"]
    with suppress(ImportError):
        importlib.import_module(_LIBRARIES[form])  # what is missing is reported by what needs it
    limits.most = request["memory_limit"]
    before = _memory.peak() or 0
    try:
        with _memory_limited(before):
            samples = read_here(path, form)
        groups = [samples, *samples.others]
        answer: dict[str, Any] = {"groups": [_described(group) for group in groups]}
        columns = [x for group in groups for x in group.columns.values()]
    except (BallraceError, ImportError, OSError) as error:
        answer, columns = _described_error(error), []
    answer["worn"] = _memory.used() is None and (_memory.peak() or 0) > before + _WORN
    yield json.dumps(answer).encode() + b"\n"
    for x in columns:
        yield np.ascontiguousarray(x, dtype=np.float64).data.cast("B")


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
    rest = {name: getattr(samples, name) for name in ("fs", "units", "shaft", "metadata")}
    return {"sizes": {name: x.size for name, x in samples.columns.items()}, **rest}


def _described_error(error: Exception) -> dict[str, Any]:
    match error:
        case ImportError():
            return {"error": "ImportError", "arguments": [str(error)], "name": error.name}
        case OSError():
            return {"error": "OSError", "arguments": [error.errno, error.strerror]}
    return {"error": type(error).__name__, "arguments": list(error.args)}
