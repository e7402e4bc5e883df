"""Tables of any kind as rows of cells, and the field that an unknown column may have been meant for."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from .._base.arguments import whole_text
from .._base.libraries import pl
from ..errors import SceneError

_KINDS = "a table: polars, pandas, Arrow, a list of dicts or a dict of columns"

_MADE_UP = re.compile(r"(column_\d+)?")
"""Names that polars gives to columns without one."""

_OTHER_UNITS = {"rpm": ("speed", "rad/s"), "mm": (None, "m"), "c": (None, "K")}
"""Endings of names in another unit than the field: the quantity that the ending alone says, the field's unit."""


def rows_of(table: object) -> tuple[list[dict[str, Any]], list[str]]:
    """Return the rows of a table of any kind, and the names of its columns.

    Raises
    ------
    SceneError
        It is no table, or has no rows.
    MemoryLimitError
        polars, which writes a campaign, cannot start.
    """
    from .._base import polars  # noqa: F401 (before anything is written)

    if isinstance(table, Sequence) and all(isinstance(row, Mapping) for row in table):
        rows = [dict(row) for row in table]
        names = list(dict.fromkeys(name for row in rows for name in row))
    elif type(table).__module__.partition(".")[0] == "pandas" and hasattr(table, "columns"):
        rows, names = _of_pandas(table)
    else:
        frame = _frame(table)
        rows, names = frame.to_dicts(), frame.columns
    for name in names:
        if not isinstance(name, str):
            raise SceneError("cases", f"a column {name!r}", "columns with names")
        whole_text("cases", name)
        for row in rows:
            if isinstance(row.get(name), str):
                whole_text(f"cases.{name}", row[name])
    if not rows:
        raise SceneError("cases", "an empty table", "at least one row")
    return rows, names


def _of_pandas(table: Any) -> tuple[list[dict[str, Any]], list[Any]]:
    """Read a pandas table cell by cell: it says "not a number" where there is nothing, and needs no pyarrow."""
    names = list(table.columns)
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise SceneError("cases", f"two columns {twice!r}", "columns of different names")
    columns = [table[name] for name in names]
    cells = [column.astype(object).where(column.notna(), None).tolist() for column in columns]
    return [dict(zip(names, row, strict=True)) for row in zip(*cells, strict=True)], names


def _frame(table: Any) -> Any:
    if isinstance(table, str | os.PathLike):
        raise SceneError("cases", repr(str(table)), f"{_KINDS}; polars.read_csv(path) reads a file")
    if isinstance(table, pl.LazyFrame):
        return table.collect()
    try:
        frame = pl.DataFrame(table)
    except (TypeError, ValueError, pl.exceptions.PolarsError) as error:
        raise SceneError("cases", type(table).__name__, f"{_KINDS} ({error})") from error
    # Of a list of numbers or a plain array polars makes names up; of records with names it takes theirs.
    if isinstance(table, Sequence | np.ndarray) and all(map(_MADE_UP.fullmatch, frame.columns)):
        raise SceneError("cases", f"{type(table).__name__} without names of columns", _KINDS)
    return frame


def resembling(label: str, scenes: Iterable[Any], arguments: Iterable[str]) -> str | None:
    """Return the field or argument that a column may have been meant for, such as ``loads.axial.force``.

    A name resembles a field whose last word it is, or whose path has all its words (``axial_load``,
    ``radial_force``), or that it is a misspelling of. One in another unit (``speed_rpm``) is answered with the
    unit of the field.
    """
    head, _, ending = label.lower().rpartition("_")
    if ending in _OTHER_UNITS:
        quantity, unit = _OTHER_UNITS[ending]
        field = resembling(head or quantity or "", scenes, ())
        return field and f"{field} [{unit}]"
    # A load is meant by its force rather than by the ring it acts on.
    found = [pair for scene in scenes for pair in _fields(scene, "")]
    paths = [path for path, _ in sorted(found, key=lambda pair: not _is_number(pair[1]))]
    wanted = _words(label)
    for path in paths:
        last = path.rpartition(".")[2]
        if label.lower() == last or (len(wanted) > 1 and wanted <= _words(path)):
            return path
    by_name = {path.rpartition(".")[2]: path for path in reversed(paths)}
    by_name |= {name: name for name in arguments}
    near = difflib.get_close_matches(label.lower(), by_name, n=1, cutoff=0.85)
    return by_name[near[0]] if near else None


def _fields(document: Any, path: str) -> Iterator[tuple[str, Any]]:
    """Yield the dotted paths and values of the fields of a document that hold one value."""
    if isinstance(document, dict):
        for key, value in document.items():
            yield from _fields(value, f"{path}.{key}" if path else key)
    elif isinstance(document, list) and any(isinstance(value, dict) for value in document):
        for i, value in enumerate(document):
            yield from _fields(value, f"{path}[{i}]")
    elif "." in path:
        yield path, document


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _words(text: str) -> set[str]:
    """Return the words of a name or path, in the singular."""
    return {word.removesuffix("s") for word in re.findall(r"[a-z]+", text.lower())}
