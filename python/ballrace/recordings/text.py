"""Text tables: a column a signal, with or without a header and times."""

from __future__ import annotations

import csv
import re
from typing import TYPE_CHECKING

import numpy as np

from .._io.parquet import writing_to
from ..errors import FileError
from .sampled import sampled

if TYPE_CHECKING:
    from pathlib import Path

    import polars as pl

    from .samples import Samples

_HEADER = re.compile(r"^(?P<name>.*?)\s*[\[(](?P<unit>[^\])]*)[\])]$")
"""A name with its unit: ``ay [m/s^2]``, ``Time (ms)``."""

_FORMULA = re.compile(r"^'*[=+@\t\r-]")
"""How a cell begins that a spreadsheet takes for a formula, which may do anything; a quote makes it text."""

_NUMBER = re.compile(r"^[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?$|^[+-]?(nan|inf)$", re.IGNORECASE)


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write times and columns with commas between them, all digits, and units in the header."""
    from .._polars import pl

    columns = {"t [s]": samples.t}
    for name, x in samples.columns.items():
        unit = samples.units.get(name)
        title = f"{name} [{unit}]" if unit else name
        columns[f"'{title}" if _FORMULA.match(title) else title] = x
    with writing_to(path):
        pl.DataFrame(columns).write_csv(temporary)


def read(path: Path) -> Samples:
    """Read such a table, or one with semicolons, tabs or spaces, decimal commas, or ``#`` before remarks.

    Raises
    ------
    FileError
        It is no such table.
    """
    content = _decoded(path)
    lines = (line for line in _lines(content) if _counts(line))
    first, second = (next(lines, "").strip() for _ in range(2))
    separator = _separator(second or first)
    comma = separator != "," and "," in (second or first)
    names = [name.strip() for name in _fields(first, separator)]
    headed = not all(_NUMBER.match(name) for name in names)
    table = _table(path, content, separator, headed, comma)
    if headed and len(names) != table.width:
        raise FileError(str(path), f"its header names {len(names)} columns of {table.width}")
    units = {}
    columns = {}
    for place, column in enumerate(table.get_columns()):
        name = names[place] if headed else f"column_{place + 1}"
        name = name[1:] if name.startswith("'") and _FORMULA.match(name) else name
        if found := _HEADER.match(name):
            name, units[found["name"]] = found["name"], found["unit"]
        columns[name] = column
    if len(columns) < table.width:
        raise FileError(str(path), "two of its columns have one name")
    return sampled(path, columns, units)


def _lines(content: str) -> list[str]:
    """Cut at ends of lines, and not at what ``splitlines`` cuts at beside them: it may stand in a name."""
    return content.replace("\r\n", "\n").split("\n")


def _separator(line: str) -> str:
    """Return what separates the numbers of a line; commas do only where nothing else does."""
    return next((mark for mark in (";", "\t", ",", " ") if mark in line), ",")


def _fields(line: str, separator: str) -> list[str]:
    return line.split() if separator == " " else next(csv.reader([line], delimiter=separator), [])


def _counts(line: str) -> bool:
    """Whether a line is none of remarks, nor empty."""
    return bool(line.strip()) and not line.startswith("#")


def _decoded(path: Path) -> str:
    """Return the text of a file: UTF-8, or else what Western European instruments write."""
    content = path.read_bytes()
    if b"\0" in content:
        raise FileError(str(path), "neither text nor a record of a known format")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def _table(path: Path, content: str, separator: str, headed: bool, comma: bool) -> pl.DataFrame:
    from .._polars import pl

    try:
        if separator == " ":
            lines = [line for line in _lines(content) if _counts(line)][headed:]
            rows = np.loadtxt(lines, ndmin=2)
            return pl.DataFrame({f"column_{place}": x for place, x in enumerate(rows.T)})
        return pl.read_csv(
            content.encode(), separator=separator, has_header=headed, comment_prefix="#",
            decimal_comma=comma, infer_schema_length=None,
        )  # fmt: skip
    except (ValueError, pl.exceptions.PolarsError, pl.exceptions.PanicException) as error:
        raise FileError(str(path), f"not a table of numbers, or damaged ({error})") from error
