"""Parquet: tables with a column a signal, from us (runs and recordings) or from others."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from .._base.interrupt import interrupted_once
from .._base.libraries import pl
from .._io.parquet import columns_and_rows, read_sealed, sealing
from .._results.file import described, unless_damaged
from .._results.file import samples as column_of
from ..errors import FileError
from ..scene import Scene
from .limits import check_declared
from .sampled import cut, sampled
from .samples import Said, Samples, from_header
from .scenes import shaft_of
from .times import Column
from .titles import named

if TYPE_CHECKING:
    from pathlib import Path

    from .reading import Reading

_HEADER = "ballrace.recording"
"""Entry of the metadata with those of the columns."""


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write times and columns, their metadata, and a hash of everything."""
    table = pl.DataFrame({"t": samples.t, **samples.columns})
    entries = {_HEADER: samples.header()}
    with sealing(temporary, path):
        interrupted_once(lambda: table.write_parquet(temporary, metadata=entries))


def read(path: Path, reading: Reading) -> Samples:
    """Read a table with its metadata where they are ours.

    Raises
    ------
    FileError
        It is damaged, or no Parquet.
    """
    table, entries = unless_damaged(path, lambda: read_sealed(path, _check_size))
    if _HEADER in entries:
        columns = {name: column_of(path, table, name) for name in table.columns}
        return cut(path, from_header(path, entries[_HEADER], columns), reading)
    if "ballrace" not in entries:
        return sampled(
            path, [_column(path, table[name]) for name in table.columns], reading, Said()
        )
    fields = described(path, entries, table.columns)
    samples = Samples(
        columns={name: column_of(path, table, name) for name in fields["units"]},
        fs=fields["fs"],
        units=fields["units"],
        shaft=shaft_of(Scene.from_json(fields["scene"])),
        metadata={"scene": json.loads(fields["scene"]), "provenance": fields["provenance"]},
    )
    return cut(path, samples, reading)


def _column(path: Path, series: pl.Series) -> Column:
    """Return a column as numbers; dates and times as seconds."""
    name, unit = named(series.name)
    kind = series.dtype
    if kind.is_temporal() and not series.null_count():
        if kind == pl.Date:
            series = series.cast(pl.Datetime("us"))
        scale = {"ms": 1e-3, "us": 1e-6, "ns": 1e-9}[
            getattr(series.dtype, "time_unit", None) or "ns"
        ]
        whole = series.to_physical().to_numpy()
        values = (whole - (whole[0] if whole.size else 0)) * scale
        return Column(name=name, values=values, unit=unit, stamped=True, grain=scale)
    if kind == pl.String:
        # Spaces stand beside the numbers; or it is something else.
        series = series.str.strip_chars().cast(pl.Float64, strict=False)
    if not series.dtype.is_numeric() or series.null_count():
        raise FileError(str(path), f"the column {name} has other entries than numbers")
    return Column(name=name, values=series.to_numpy(), unit=unit)


def _check_size(path: Path) -> None:
    names, rows = columns_and_rows(path)
    check_declared(path, float(len(names) * rows))
