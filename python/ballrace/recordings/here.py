"""A file of a record read in this process, whatever library reads its format: its samples, or one error."""

from __future__ import annotations

import errno
import os
import stat
import traceback
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import BallraceError, FileError, InternalError
from .formats import FORMATS, Format, by_contents

if TYPE_CHECKING:
    from .reading import Reading
    from .samples import Samples

_OF_THE_CONTENT = (None, errno.EINVAL, errno.EOVERFLOW)
"""Numbers of errors of the system that damaged content causes, as by a place before the file's beginning."""

_START = 512
"""Bytes that show the format."""

_PACKAGE = Path(__file__).resolve().parents[1]

_ADDRESSED = ("xlsx", "csv")
"""Formats with lines that can be skipped."""


def format_of(path: Path, name: str | None) -> Format:
    """Return the format of a file, by its name and first bytes unless it is given.

    Raises
    ------
    FileError
        It is a pipe or a device, which may never end, or of a format that is not read.
    OSError
        It cannot be read.
    """
    # A pipe without a writer would be waited for.
    descriptor = os.open(
        path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    )
    with os.fdopen(descriptor, "rb") as file:
        mode = os.fstat(file.fileno()).st_mode
        if not stat.S_ISREG(mode):
            raise FileError(str(path), "is a pipe or a device, no file: save its content as one")
        start = file.read(_START)
    return by_contents(path, start) if name is None else FORMATS[name]


def read_here(path: Path, form: Format, reading: Reading) -> Samples:
    """Read a file of one of the formats.

    Raises
    ------
    FileError
        It is damaged, or has no record: libraries end in errors of any kind.
    SceneError
        What the caller says about it does not fit.
    InternalError
        The reader has a fault.
    ImportError
        The library for this format is not installed.
    OSError
        The file cannot be read.
    """
    if form.name not in _ADDRESSED:
        reading.refuse_text_options(path, form.title)
    try:
        return form.read(path, reading)
    except (BallraceError, ImportError):
        raise
    except MemoryError as error:
        reason = "declares or needs more memory than there is; raise memory_limit if it is large"
        raise FileError(str(path), reason) from error
    except OSError as error:
        if error.errno not in _OF_THE_CONTENT:
            raise OSError(error.errno, os.strerror(error.errno or 0), str(path)) from error
        raise FileError(str(path), _damaged(form, error)) from error
    except BaseException as error:
        # A panic of polars is no Exception, and has no class that could be named before polars is imported.
        if not isinstance(error, Exception) and type(error).__name__ != "PanicException":
            raise
        if _is_ours(error):
            raise InternalError(
                f"a fault of ballrace as it read {path}, which need not be damaged; please report it",
                traceback.format_exc(),
            ) from error
        raise FileError(str(path), _damaged(form, error)) from error


def _is_ours(error: BaseException) -> bool:
    """Whether an error was raised by code of this package, and not by a library on what the file holds."""
    *_, (last, _line) = traceback.walk_tb(error.__traceback__)
    return Path(last.f_code.co_filename).resolve().is_relative_to(_PACKAGE)


def _damaged(form: Format, error: BaseException) -> str:
    return f"damaged, or no file of the format {form.name} ({error!r})"
