"""A file of a record read in this process, whatever library reads its format: its samples, or one error."""

from __future__ import annotations

import errno
import os
from typing import TYPE_CHECKING

from ..errors import BallraceError, FileError
from . import hierarchical, matlab, parquet, sound, text, universal

if TYPE_CHECKING:
    from pathlib import Path

    from .samples import Samples

READERS = {
    "csv": text.read, "wav": sound.read, "mat": matlab.read, "uff": universal.read,
    "hdf5": hierarchical.read, "parquet": parquet.read,
}  # fmt: skip
"""What reads a format."""

_OF_THE_CONTENT = (None, errno.EINVAL, errno.EOVERFLOW)
"""Numbers of errors of the system that damaged content causes, as by a place before the file's beginning."""


def read_here(path: Path, format: str) -> Samples:  # noqa: A002
    """Read a file of one of the formats of :data:`READERS`.

    Raises
    ------
    FileError
        It is damaged, or has no record: libraries end in errors of any kind.
    ImportError
        The library for this format is not installed.
    OSError
        The file cannot be read.
    """
    try:
        return READERS[format](path)
    except (BallraceError, ImportError):
        raise
    except MemoryError as error:
        reason = "declares or needs more memory than there is; raise memory_limit if it is large"
        raise FileError(str(path), reason) from error
    except OSError as error:
        if error.errno not in _OF_THE_CONTENT:
            raise OSError(error.errno, os.strerror(error.errno or 0), str(path)) from error
        raise FileError(str(path), _damaged(format, error)) from error
    except BaseException as error:
        # A panic of polars is no Exception, and has no class that could be named before polars is imported.
        if isinstance(error, Exception) or type(error).__name__ == "PanicException":
            raise FileError(str(path), _damaged(format, error)) from error
        raise


def _damaged(format: str, error: BaseException) -> str:  # noqa: A002
    return f"damaged, or no file of the format {format} ({error!r})"
