"""Names of files, and whether they can be written."""

from __future__ import annotations

import errno
import os
from pathlib import Path

from ..errors import SceneError

PARQUET = (".parquet", ".pq", "")
"""Endings that the name of a Parquet file may have."""


def as_path(
    path: object, name: str = "path", allowed: str = "the name of a file or folder"
) -> Path:
    """Take what was given as the argument ``name`` as a path.

    Raises
    ------
    SceneError
        It is no text and no path, or has a character that no file's name can have.
    """
    if not isinstance(path, (str, os.PathLike)) or isinstance(os.fspath(path), bytes):
        raise SceneError(name, type(path).__name__, allowed)
    try:
        storable = b"\0" not in os.fsencode(path)
    except UnicodeEncodeError:
        storable = False
    if not storable:
        raise SceneError(name, str(path), f"{allowed}; NUL and lone surrogates are in none")
    return Path(path)


def check_writable(path: Path) -> None:
    """Raise the ``OSError`` that writing a file to ``path`` would meet, as far as it can be known before.

    What is there and no regular file, such as ``/dev/null`` or a pipe, is refused: it would be replaced.
    """
    folder = path.parent
    if folder.exists() and not folder.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, "is a file, not a folder", str(folder))
    if not folder.is_dir():
        raise FileNotFoundError(errno.ENOENT, "no such folder", str(folder))
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, "is a folder, not a file", str(path))
    if path.exists() and not path.is_file():
        raise OSError(
            errno.EINVAL, "is a device or a pipe, not a file; give the name of a file", str(path)
        )
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, "folder is not writable", str(folder))


def check_output(path: Path, *, name: str = "output", read: Path | None = None) -> None:
    """Refuse a place for signals that cannot be meant: the file they come from, or one of another format.

    Raises
    ------
    SceneError
        It is standard output, the file ``read``, or ends as files of another format do; ``name`` is what it was
        given as.
    OSError
        It cannot be written.
    """
    if str(path) == "-":
        raise SceneError(name, "-", "the name of a file; Parquet is no text to stream")
    if path.suffix.lower() not in PARQUET:
        raise SceneError(name, str(path), "a file that ends in .parquet, which is what is written")
    check_writable(path)
    if read is not None and path.exists() and read.exists() and path.samefile(read):
        raise SceneError(name, str(path), "another file than the scene, which it would replace")
