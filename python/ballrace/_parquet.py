"""Parquet files that know whether they are what was written.

The format has no checksum that is always there, and a damaged file may even end the process that reads it: a
flipped length asks for exabytes. It does allow a gap before the footer, and there stands a hash of all the rest,
which other readers of Parquet pass over::

    PAR1  columns …  [mark  hash]  footer  length of the footer  PAR1
"""

from __future__ import annotations

import errno
import hashlib
import io
import mmap
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, BinaryIO, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    import polars as pl

T = TypeVar("T")

_MARK = b"ballrace blake2b"
_SIZE = 16
"""Length of the hash [bytes]."""
_TAIL = 8
"""Length of what follows the footer: its own length, and the format's name [bytes]."""


@contextmanager
def writing_to(path: str | os.PathLike[str]) -> Iterator[None]:
    """Have what polars cannot write, as to a full disk, be an ``OSError`` that names the file."""
    import polars as pl

    try:
        yield
    except pl.exceptions.PolarsError as error:
        raise OSError(errno.EIO, f"cannot be written ({error})", os.fspath(path)) from error


def seal(file: BinaryIO) -> None:
    """Put the hash into a Parquet file that has just been written, open for reading and writing."""
    size = file.seek(0, io.SEEK_END)
    start = size - _TAIL - _footer(file, size)
    file.seek(start)
    footer = file.read()
    file.seek(0)
    found = _hash()
    left = start
    while left:
        part = file.read(min(left, 1 << 20))
        found.update(part)
        left -= len(part)
    found.update(footer)
    file.seek(start)
    file.write(_MARK + found.digest() + footer)


def read_sealed(path: Path) -> tuple[pl.DataFrame, dict[str, str]]:
    """Read a Parquet file and its metadata; one without a hash, as written by others, is read unchecked.

    Raises
    ------
    ValueError
        It is damaged, or not Parquet.
    OSError
        It cannot be read.
    """
    import polars as pl

    _check_file(path)
    table = _unless_damaged(lambda: pl.read_parquet(path, glob=False))
    return table, _unless_damaged(lambda: pl.read_parquet_metadata(path))


def scan_sealed(path: Path) -> dict[str, str]:
    """Check a Parquet file as :func:`read_sealed` does, and read its metadata alone.

    Raises
    ------
    ValueError
        It is damaged, or not Parquet.
    OSError
        It cannot be read.
    """
    import polars as pl

    _check_file(path)
    return _unless_damaged(lambda: pl.read_parquet_metadata(path))


def columns_and_rows(path: Path) -> tuple[list[str], int]:
    """Return the names of the columns of a Parquet file, and how many rows it has."""
    import polars as pl

    table = pl.scan_parquet(path, glob=False)
    return table.collect_schema().names(), table.select(pl.len()).collect().item()


def read_columns(path: Path, names: list[str]) -> pl.DataFrame:
    """Read some columns of a Parquet file whose hash is known to be right."""
    import polars as pl

    return pl.read_parquet(path, columns=names, glob=False)


def read_bytes(data: bytes) -> pl.DataFrame:
    """Read a Parquet file from memory whose hash is known to be right.

    Raises
    ------
    ValueError
        It is not Parquet.
    """
    import polars as pl

    return _unless_damaged(lambda: pl.read_parquet(io.BytesIO(data)))


def _check_file(path: Path) -> None:
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        _check(data)


def _check(data: mmap.mmap) -> None:
    size = len(data)
    start = size - _TAIL - int.from_bytes(data[-_TAIL : -_TAIL + 4], "little") - len(_MARK) - _SIZE
    if start < 0 or data[start : start + len(_MARK)] != _MARK:
        if data.find(_MARK) >= 0:
            raise ValueError("its end is not what was written")
        return
    end = start + len(_MARK) + _SIZE
    with memoryview(data) as view, view[:start] as columns, view[end:] as rest:
        found = _hash()
        found.update(columns)
        found.update(rest)
    if found.digest() != data[end - _SIZE : end]:
        raise ValueError("its content is not what was written")


def _footer(file: BinaryIO, size: int) -> int:
    file.seek(size - _TAIL)
    return int.from_bytes(file.read(4), "little")


def _hash() -> hashlib.blake2b:
    return hashlib.blake2b(digest_size=_SIZE)


def _unless_damaged(read: Callable[[], T]) -> T:
    """Read by polars, whose errors come in several kinds; a panic is no ``Exception``."""
    import polars as pl

    try:
        return read()
    except (pl.exceptions.PolarsError, pl.exceptions.PanicException) as error:
        raise ValueError(str(error)) from error
