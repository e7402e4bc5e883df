"""Locks that end with their process, however it ends."""

from __future__ import annotations

import errno
import os
import re
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from .._io.whole import lock
from ..errors import CampaignError, CampaignWarning
from .disk import refuse_link

if sys.platform == "win32":
    import msvcrt

    def _await(file: int) -> None:
        msvcrt.locking(file, msvcrt.LK_LOCK, 1)

else:
    import fcntl

    def _await(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX)


_NO_FOLLOW = getattr(os, "O_NOFOLLOW", 0)

_PART = re.compile(r"\d+-of-\d+")
_WITHOUT_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP)
"""Errors of parallel file systems that are mounted without locks."""


@contextmanager
def hold(folder: Path, part: int, parts: int) -> Iterator[None]:
    """Hold the lock of one part of a campaign; parts of the same division go side by side.

    Raises
    ------
    CampaignError
        Another process runs that part, or another division of the campaign.
    """
    own = f"{part}-of-{parts}"
    file = _open(folder / own)
    try:
        if not _try(file):
            raise CampaignError(_busy(folder, own))
        for other in sorted(folder.iterdir()):
            own_division = other.name.endswith(f"-of-{parts}")
            if _PART.fullmatch(other.name) and not own_division and _is_held(other):
                raise CampaignError(_busy(folder, other.name))
        yield
    finally:
        os.close(file)


@contextmanager
def in_turn(folder: Path, name: str) -> Iterator[None]:
    """Work on what all parts share, one after the other; without turns where the file system has no locks."""
    file = _open(folder / name)
    try:
        with suppress(OSError):
            _await(file)
        yield
    finally:
        os.close(file)


def _open(path: Path) -> int:
    refuse_link(path)
    return os.open(path, os.O_RDWR | os.O_CREAT | _NO_FOLLOW, 0o666)


def _try(file: int) -> bool:
    try:
        lock(file)
    except (BlockingIOError, PermissionError):
        return False
    except OSError as error:
        if error.errno not in _WITHOUT_LOCKS:
            raise
        text = "this file system has no locks; see to it that no two campaigns run in one folder"
        warnings.warn(text, CampaignWarning, stacklevel=7)
    return True


def _is_held(path: Path) -> bool:
    refuse_link(path)
    with suppress(FileNotFoundError):
        file = os.open(path, os.O_RDWR | _NO_FOLLOW)
        try:
            return not _try(file)
        finally:
            os.close(file)
    return False


def _busy(folder: Path, name: str) -> str:
    what = "another campaign" if name == "0-of-1" else f"shard {name.replace('-of-', '/')}"
    return f"{what} is running in {folder.parent}; wait for its end, or give another folder"
