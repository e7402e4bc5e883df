"""A run at a time, in memory or in a file, from where it goes on."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np

from .._base.interrupt import interrupted_once
from .._base.libraries import pl
from .._io.files import as_path
from .._io.parquet import read_sealed, sealing
from .._io.whole import whole
from ..errors import FileError
from .file import samples, unless_damaged

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    Piece = dict[str, NDArray[np.float64]]

_FORMAT = "1"
_ENTRY = "ballrace_snapshot"
"""Key of a snapshot in the metadata of a file: the number of its form, and what the core needs."""


class Snapshot:
    """A :class:`ballrace.Simulation` at a time: what it needs to go on from there, and its record until there.

    Made by :meth:`ballrace.Simulation.snapshot` or :meth:`read`; :meth:`ballrace.Simulation.restore` goes on
    from it.
    """

    def __init__(self, document: str, pieces: tuple[Piece, ...]) -> None:
        self._document = document
        self._pieces = pieces

    @property
    def time(self) -> float:
        """The time [s]."""
        return float(json.loads(self._document)["time"])

    def __repr__(self) -> str:
        return f"<Snapshot at {self.time:g} s>"

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write a Parquet file with the record, and in its metadata what the run needs to go on.

        The file appears at once when it is whole, with a hash of all of it, as those of
        :meth:`ballrace.Signals.write_parquet`.

        Raises
        ------
        OSError
            The folder does not exist or is not writable, or the disk is full.
        """
        entries = {"ballrace": f"snapshot {_FORMAT}", _ENTRY: self._document}
        with whole(path) as temporary, sealing(temporary, path):
            table = pl.DataFrame(joined(self._pieces))
            interrupted_once(lambda: table.write_parquet(temporary, metadata=entries))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Snapshot:
        """Read a file that :meth:`write` wrote.

        Raises
        ------
        FileError
            The file is not such a file, or damaged.
        OSError
            The file cannot be read.
        """
        path = as_path(path)
        table, entries = unless_damaged(path, lambda: read_sealed(path))
        if entries.get("ballrace") != f"snapshot {_FORMAT}" or _ENTRY not in entries:
            raise FileError(
                str(path), "a Parquet file, but no snapshot of this version of ballrace"
            )
        piece = {name: samples(path, table, name) for name in table.columns}
        return cls(entries[_ENTRY], (piece,) if piece else ())


def joined(pieces: list[Piece] | tuple[Piece, ...]) -> Piece:
    """Return the columns of pieces, one behind the other."""
    names = pieces[0] if pieces else ()
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in names}
