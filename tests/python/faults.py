"""Failures of the system at a chosen call: each call that reads, writes or names a file counts, of any kind."""

from __future__ import annotations

import errno
import io
import os
import tempfile
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Self

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

READING = ("open", "read")
WRITING = ("open", "write", "flush", "fsync", "replace", "rename", "link", "mkdtemp")


class Faults:
    """Counts calls, and has the n-th one fail."""

    def __init__(self, fail_at: int, number: int) -> None:
        self.calls = 0
        self.fail_at = fail_at
        self.number = number

    def __call__(self, what: str) -> None:
        """Count a call, and fail if it is the one."""
        self.calls += 1
        if self.calls == self.fail_at:
            raise OSError(self.number, os.strerror(self.number), what)


class _File:
    """A file whose reading and writing may fail."""

    def __init__(self, file: Any, faults: Faults, kinds: tuple[str, ...]) -> None:
        self._file, self._faults, self._kinds = file, faults, kinds

    def __getattr__(self, name: str) -> Any:
        found = getattr(self._file, name)
        return _counted(found, name, self._faults) if name in self._kinds else found

    def __enter__(self) -> Self:
        self._file.__enter__()
        return self

    def __exit__(self, *exception: object) -> Any:
        return self._file.__exit__(*exception)


def _counted(call: Callable[..., Any], name: str, faults: Faults) -> Callable[..., Any]:
    def called(*args: Any, **kwargs: Any) -> Any:
        faults(name)
        return call(*args, **kwargs)

    return called


@contextmanager
def failing(
    fail_at: int, kinds: tuple[str, ...], number: int = errno.EIO, within: str = ""
) -> Iterator[Faults]:
    """Have the n-th call of some kinds on files whose names contain ``within`` fail; 0: none, for counting."""
    faults = Faults(fail_at, number)
    real = io.open

    def opened(file: Any, *args: Any, **kwargs: Any) -> Any:
        if within not in str(file):
            return real(file, *args, **kwargs)
        if "open" in kinds:
            faults(str(file))
        return _File(real(file, *args, **kwargs), faults, kinds)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(io, "open", opened)
        for name in {"fsync", "replace", "rename", "link"}.intersection(kinds):
            patched.setattr(os, name, _counted(getattr(os, name), name, faults))
        if "mkdtemp" in kinds:
            patched.setattr(tempfile, "mkdtemp", _counted(tempfile.mkdtemp, "mkdtemp", faults))
        yield faults
