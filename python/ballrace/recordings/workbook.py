"""Excel workbooks, by polars and fastexcel: the table of the first sheet that has one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._base.libraries import needed, pl
from ..errors import FileError
from .layout import layout_of
from .limits import check_declared
from .preamble import described
from .sampled import sampled
from .text import columns_of

if TYPE_CHECKING:
    from pathlib import Path

    from .reading import Reading
    from .samples import Samples

_SHOWN = 200
"""Rows in which the table of a sheet is looked for."""


def read(path: Path, reading: Reading) -> Samples:
    """Read the first sheet that holds a table of numbers, wherever it begins.

    Raises
    ------
    FileError
        It is damaged, or has no such sheet.
    """
    fastexcel = needed("fastexcel", path.name)
    try:
        sheets = len(fastexcel.read_excel(path).sheet_names)
    except Exception as error:
        raise FileError(str(path), f"not an Excel workbook, or damaged ({error})") from error
    reason = "has no sheet with a table of numbers"
    for number in range(1, sheets + 1):
        head = _cells(path, number, n_rows=_SHOWN + (reading.skip or 0))
        lines = ["\t".join(text or "" for text in row) for row in head.rows()]
        skip = reading.skip or 0
        try:
            shown = [""] * skip + lines[skip:]
            layout = layout_of(path, shown, ".", "\t", skipped=reading.skip is not None)
        except FileError as error:
            reason = error.reason
            continue
        table = _cells(path, number, kinds=layout.kinds, skip_rows=layout.first)
        check_declared(path, float(table.height * table.width))
        arrays = [table.get_column(name).to_numpy() for name in table.columns[: len(layout.kinds)]]
        said = described(layout.preamble)
        if any(
            kind in "nd" and table[name].null_count()
            for kind, name in zip(layout.kinds, table.columns, strict=False)
        ):
            raise FileError(str(path), "has empty cells or text among the numbers of its table")
        return sampled(path, columns_of(layout, arrays, said.metadata), reading, said)
    raise FileError(str(path), reason)


def _cells(path: Path, sheet: int, *, kinds: str = "", **options: int) -> pl.DataFrame:
    """Return cells as text, or those of a table as what they are: as text, numbers have nine digits."""
    schema: dict[str, Any] = {
        f"column_{place}": pl.Float64 if kind == "n" else pl.String
        for place, kind in enumerate(kinds)
    }
    try:
        return pl.read_excel(
            path, sheet_id=sheet, engine="calamine", has_header=False, drop_empty_rows=False,
            drop_empty_cols=False, raise_if_empty=False, schema_overrides=schema or None,
            infer_schema_length=None if kinds else 0, read_options=options,
        )  # fmt: skip
    except Exception as error:
        raise FileError(str(path), f"not an Excel workbook, or damaged ({error})") from error
