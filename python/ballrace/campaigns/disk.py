"""Files of a campaign's folder: complete or absent, however the process that writes them ends."""

from __future__ import annotations

import errno
import hashlib
import os
import re
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import BufferedWriter
from pathlib import Path

from .._io.whole import grab, lock, sync_folder
from ..errors import CampaignError

_NAME = re.compile(r"[0-9a-f]{32}")
"""A file that is being written, or was when its process was killed."""

_NO_LINKS = (errno.EPERM, errno.ENOSYS, errno.EOPNOTSUPP, errno.EMLINK, errno.EXDEV)


def hash_of(data: bytes) -> str:
    """Return the hash by which files, campaigns and cases are known."""
    return hashlib.blake2b(data, digest_size=16).hexdigest()


def refuse_link(path: Path) -> None:
    """Refuse a link: through one, a campaign's folder would lead to files that are not its own."""
    if path.is_symlink():
        raise CampaignError(
            f"{path}: a link, and nothing in the folder of a campaign is followed; put there what it leads to"
        )


@contextmanager
def reading(path: Path) -> Iterator[None]:
    """Raise a CampaignError for a file that cannot be read, but not for one that is damaged or absent."""
    try:
        yield
    except FileNotFoundError:
        raise
    except OSError as error:
        why = error.strerror or str(error)
        text = "it may be whole, and is left as it is: make it readable, and call again"
        raise CampaignError(f"{path}: cannot be read ({why}); {text}") from error


def put(root: Path, name: str, data: bytes, *, new: bool = False) -> bool:
    """Write a file within ``root`` that is there whole or not at all, also after a loss of power.

    With ``new`` it is written only where there is none, in one step: of several processes one succeeds.

    Returns
    -------
    bool
        Whether it was written.

    Raises
    ------
    CampaignError
        It cannot be written.
    """
    try:
        with _temporary(root / "tmp") as (temporary, file):
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
            if os.name == "nt":
                # A file that is open cannot be renamed there.
                file.close()
            written = True
            if new:
                written = _link(temporary, root / name)
            else:
                temporary.replace(root / name)
            sync_folder((root / name).parent)
            return written
    except OSError as error:
        raise CampaignError(f"cannot write to {root}: {error.strerror or error}") from error


@contextmanager
def _temporary(folder: Path) -> Iterator[tuple[Path, BufferedWriter]]:
    """Give a new file that is locked as long as it is written, so that :func:`sweep` knows it from a leftover."""
    while True:
        path = folder / uuid.uuid4().hex
        try:
            with path.open("xb") as file:
                # Unless it was, or is just being, swept away between its creation and its lock.
                if not _is_taken(file.fileno()) and path.exists():
                    yield path, file
                    return
        finally:
            path.unlink(missing_ok=True)


def _is_taken(file: int) -> bool:
    """Lock a new file, and say whether another process has done so; nobody does where there are no locks."""
    try:
        lock(file)
    except (BlockingIOError, PermissionError):
        return True
    except OSError:
        pass
    return False


def _link(temporary: Path, path: Path) -> bool:
    """Give a file its name unless there is one of that name already."""
    try:
        os.link(temporary, path)
    except FileExistsError:
        return False
    except OSError as error:
        if error.errno not in _NO_LINKS:
            raise
        if path.exists():
            return False
        temporary.replace(path)
    return True


def sweep(folder: Path) -> None:
    """Remove what killed processes have left half written; what is being written is locked, and stays."""
    if os.name == "nt":
        # Whether a file is still being written cannot be known there.
        return
    for path in folder.iterdir():
        if _NAME.fullmatch(path.name) and path.is_file() and not path.is_symlink():
            with suppress(OSError), path.open("r+b") as file:
                if grab(file.fileno()):
                    path.unlink()
