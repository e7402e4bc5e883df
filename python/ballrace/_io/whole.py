"""Files that are complete or absent, however the process that writes them ends, and whoever else writes there.

A file is written in a folder of its own beside the target, which is new, has a name that nobody can guess, and is
closed to other users; then it is synced and renamed. Of several writers of one name the last one's file is there,
whole. The folder is locked as long as its writer lives: the next writer of the name removes those of killed ones.
"""

from __future__ import annotations

import errno
import hashlib
import os
import shutil
import stat
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from .files import as_path, check_writable

if sys.platform == "win32":
    import msvcrt

    def lock(file: int) -> None:
        """Lock a file until it is closed, or raise ``OSError`` where another has it."""
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def lock(file: int) -> None:
        """Lock a file until it is closed, or raise ``OSError`` where another has it."""
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


_NO_SYNC = (errno.EINVAL, errno.ENOSYS, errno.EOPNOTSUPP, errno.EBADF)
"""Errors of a folder's sync: file systems that keep names without being asked say so, in one of these ways."""


@contextmanager
def whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a temporary name for a file, renamed to ``path`` at the end, or removed after an error.

    What else is written beside the temporary name is removed in any case. A file that was there gives its mode to
    the new one; where ``path`` is a link, what it leads to is replaced, not the link.
    """
    path = as_path(path)
    check_writable(path)
    path = path.resolve()
    with _folder_beside(path) as folder:
        temporary = folder / path.name
        yield temporary
        _sync_file(temporary)
        with suppress(FileNotFoundError):
            temporary.chmod(stat.S_IMODE(path.stat().st_mode))
        temporary.replace(path)
        sync_folder(path.parent)


@contextmanager
def _folder_beside(path: Path) -> Iterator[Path]:
    own = hashlib.blake2b(os.fsencode(path.name), digest_size=6).hexdigest()
    for left in path.parent.glob(f".ballrace-{own}-*"):
        _remove_if_left(left)
    made = Path(tempfile.mkdtemp(prefix=".ballrace-new-", dir=path.parent))
    try:
        with _locked(made):
            # Only now it has a name that others look at: what is not locked is taken for left.
            made = made.rename(made.with_name(made.name.replace("new", own, 1)))
            yield made
    finally:
        shutil.rmtree(made, ignore_errors=True)


def _remove_if_left(folder: Path) -> None:
    with suppress(OSError), _locked(folder) as is_free:
        if is_free and not folder.is_symlink():
            shutil.rmtree(folder, ignore_errors=True)


@contextmanager
def _locked(folder: Path) -> Iterator[bool]:
    """Lock a folder, and say whether that worked; on Windows folders cannot be locked."""
    if os.name == "nt":
        yield False
        return
    file = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        yield grab(file)
    finally:
        os.close(file)


def grab(file: int) -> bool:
    """Lock a file and say whether that worked; not where another has it, or the file system has no locks."""
    with suppress(OSError):
        lock(file)
        return True
    return False


def _sync_file(path: Path) -> None:
    with path.open("r+b") as file:
        os.fsync(file.fileno())


def sync_folder(folder: Path) -> None:
    """Make new names in a folder last a loss of power, where a folder can be synced."""
    if os.name == "nt":
        return
    file = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(file)
    except OSError as error:
        if error.errno not in _NO_SYNC:
            raise
    finally:
        os.close(file)
