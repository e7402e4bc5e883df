"""Parquet: tables with a column a signal, from us (runs and recordings) or from others."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from .._interrupt import interrupted_once
from .._io.parquet import columns_and_rows, read_sealed, sealing
from .._io.record import described, unless_damaged
from .._io.record import samples as column_of
from ..scene import Scene
from .limits import check_declared
from .sampled import sampled
from .samples import Samples, from_header
from .scenes import shaft_of

if TYPE_CHECKING:
    from pathlib import Path

_HEADER = "ballrace.recording"
"""Entry of the metadata with those of the columns."""


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write times and columns, their metadata, and a hash of everything."""
    from .._polars import pl

    table = pl.DataFrame({"t": samples.t, **samples.columns})
    entries = {_HEADER: samples.header()}
    with sealing(temporary, path):
        interrupted_once(lambda: table.write_parquet(temporary, metadata=entries))


def read(path: Path) -> Samples:
    """Read a table with its metadata where they are ours.

    Raises
    ------
    FileError
        It is damaged, or no Parquet.
    """
    table, entries = unless_damaged(path, lambda: read_sealed(path, _check_size))
    if _HEADER in entries:
        columns = {name: column_of(path, table, name) for name in table.columns}
        return from_header(path, entries[_HEADER], columns)
    if "ballrace" not in entries:
        return sampled(path, {name: table[name] for name in table.columns}, {})
    fields = described(path, entries, table.columns)
    return Samples(
        columns={name: column_of(path, table, name) for name in fields["units"]},
        fs=fields["fs"],
        units=fields["units"],
        shaft=shaft_of(Scene.from_json(fields["scene"])),
        metadata={"scene": json.loads(fields["scene"]), "provenance": fields["provenance"]},
    )


def _check_size(path: Path) -> None:
    names, rows = columns_and_rows(path)
    check_declared(path, float(len(names) * rows))
