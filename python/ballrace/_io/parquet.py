"""Parquet files with a check of their content.

The format has no mandatory checksum, and a damaged file may even end the process that reads it: a
damaged length requests exabytes. It allows a gap before the footer, which holds a hash of all the rest;
other readers of Parquet skip it::

    PAR1  columns …  [mark  hash]  footer  length of the footer  PAR1
"""

from __future__ import annotations

import errno
import hashlib
import io
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, TypeVar

from .._base.interrupt import interrupted_once
from .._base.libraries import pl

T = TypeVar("T")

_MARK = b"ballrace blake2b"
_SIZE = 16
"""Length of the hash [bytes]."""
_TAIL = 8
"""Length of what follows the footer: its own length, and the format's name [bytes]."""
_PART = 1 << 20
"""Size of what is read and hashed between two looks at Ctrl-C [bytes]."""


@contextmanager
def writing_to(path: str | os.PathLike[str]) -> Iterator[None]:
    """Have what polars cannot write, as to a full disk, be an ``OSError`` that names the file."""
    try:
        yield
    except pl.exceptions.PolarsError as error:
        raise OSError(errno.EIO, f"cannot be written ({error})", os.fspath(path)) from error


@contextmanager
def sealing(file: Path, path: str | os.PathLike[str]) -> Iterator[None]:
    """Put a hash into the Parquet file that is written within; errors are as of :func:`writing_to` ``path``."""
    with writing_to(path):
        yield
    with file.open("r+b") as written:
        _seal(written)


def _seal(file: BinaryIO) -> None:
    """Put the hash into a Parquet file that has just been written, open for reading and writing."""
    size = file.seek(0, io.SEEK_END)
    start = size - _TAIL - _footer(file, size)
    file.seek(start)
    footer = file.read()
    digest = _hash(file, start, footer)
    file.seek(start)
    file.write(_MARK + digest + footer)


def read_sealed(
    path: Path, check: Callable[[Path], None] | None = None
) -> tuple[pl.DataFrame, dict[str, str]]:
    """Read a Parquet file and its metadata; one without a hash, as written by others, is read unchecked.

    What ``check`` raises of a file whose hash is right, or that has none, keeps it from being read.

    Raises
    ------
    ValueError
        It is damaged, or not Parquet.
    OSError
        It cannot be read.
    """
    is_sealed(path)
    if check is not None:
        check(path)
    table = _unless_damaged(lambda: interrupted_once(lambda: pl.read_parquet(path, glob=False)))
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
    is_sealed(path)
    return _unless_damaged(lambda: pl.read_parquet_metadata(path))


def columns_and_rows(path: Path) -> tuple[list[str], int]:
    """Return the names of the columns of a Parquet file, and how many rows it declares.

    Raises
    ------
    ValueError
        It is damaged, or not Parquet.
    """

    def read() -> tuple[list[str], int]:
        table = pl.scan_parquet(path, glob=False)
        return table.collect_schema().names(), table.select(pl.len()).collect().item()

    return _unless_damaged(read)


def read_columns(path: Path, names: list[str]) -> pl.DataFrame:
    """Read some columns of a Parquet file whose hash is known to be right."""
    return interrupted_once(lambda: pl.read_parquet(path, columns=names, glob=False))


def read_bytes(data: bytes) -> tuple[pl.DataFrame, dict[str, str]]:
    """Read a Parquet file and its metadata from memory, whose hash is known to be right.

    Raises
    ------
    ValueError
        It is not Parquet.
    """
    table = _unless_damaged(lambda: interrupted_once(lambda: pl.read_parquet(io.BytesIO(data))))
    return table, _unless_damaged(lambda: pl.read_parquet_metadata(io.BytesIO(data)))


def collected(query: pl.LazyFrame) -> pl.DataFrame:
    """Return what a query of Parquet files gives."""
    return interrupted_once(query.collect)


def to_bytes(
    table: pl.DataFrame, *, sealed: bool = False, metadata: dict[str, str] | None = None
) -> bytes:
    """Return a table as a Parquet file, with its hash in it if wanted."""
    buffer = io.BytesIO()
    interrupted_once(lambda: table.write_parquet(buffer, metadata=metadata))
    if sealed:
        _seal(buffer)
    return buffer.getvalue()


def is_sealed(path: Path) -> bool:
    """Check a file against its hash, and say whether it has one.

    Raises
    ------
    ValueError
        It is damaged.
    """
    with path.open("rb") as file:
        size = file.seek(0, io.SEEK_END)
        start = size - _TAIL - _footer(file, size) - len(_MARK) - _SIZE
        file.seek(max(start, 0))
        if start < 0 or file.read(len(_MARK)) != _MARK:
            if _has_mark(file):
                raise ValueError("its end is not what was written")
            return False
        written, footer = file.read(_SIZE), file.read()
        if _hash(file, start, footer) != written:
            raise ValueError("its content is not what was written")
        return True


def _has_mark(file: BinaryIO) -> bool:
    file.seek(0)
    seen = b""
    while part := file.read(_PART):
        seen = seen[-len(_MARK) :] + part
        if _MARK in seen:
            return True
    return False


def _footer(file: BinaryIO, size: int) -> int:
    file.seek(max(size - _TAIL, 0))
    return int.from_bytes(file.read(4), "little")


def _hash(file: BinaryIO, start: int, footer: bytes) -> bytes:
    """Hash what stands before ``start``, and the footer."""
    file.seek(0)
    found = hashlib.blake2b(digest_size=_SIZE)
    left = start
    while left and (part := file.read(min(left, _PART))):
        found.update(part)
        left -= len(part)
    found.update(footer)
    return found.digest()


def _unless_damaged(read: Callable[[], T]) -> T:
    """Read by polars, whose errors come in several kinds; a panic is no ``Exception``."""
    try:
        return read()
    except (pl.exceptions.PolarsError, pl.exceptions.PanicException) as error:
        raise ValueError(str(error)) from error
