"""The record of a run as a Parquet file: its metadata, and columns that are written and read in parts.

A record that is written during a run comes in blocks. The end of a Parquet file, its metadata, is known
when the run is over; so each block is written to its own file beside, and at the end polars copies
these, some blocks at a time, into one. The run itself takes memory for a few blocks; of copying 5 GB polars held
0.2 GB more than of 0.7 GB. The disk holds the samples twice for that while.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .._base.interrupt import interrupted_once
from .._base.libraries import pl
from .._io.parquet import columns_and_rows, read_bytes, read_columns, sealing, to_bytes, writing_to
from .._io.whole import whole
from ..errors import BallraceError, FileError, SceneError
from ..scene import Scene

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from .entries import Record


_FORMAT = "1"


class Writer:
    """Takes the blocks of a record, and makes one file of them."""

    def __init__(self, target: str | os.PathLike[str], path: Path) -> None:
        self._target = target
        self._path = path
        self._blocks: list[Path] = []
        self._rows = 0

    def take(self, columns: Mapping[str, NDArray[np.float64]]) -> None:
        """Write a block: columns of one length, the same names in each block."""
        table = pl.DataFrame(dict(columns))
        block = self._path.with_name(f"{self._path.name}.{len(self._blocks):08}")
        with writing_to(self._target):
            table.write_parquet(block, compression="uncompressed", statistics=False)
        self._blocks.append(block)
        self._rows = max(self._rows, table.height)

    def finish(self, metadata: dict[str, str]) -> None:
        """Write the one file, sealed."""
        with sealing(self._path, self._target):
            interrupted_once(lambda: self._join(metadata))

    def _join(self, metadata: dict[str, str]) -> None:
        table = pl.scan_parquet(self._blocks, glob=False)
        table.sink_parquet(self._path, metadata=metadata, row_group_size=self._rows)


@contextmanager
def writing(path: str | os.PathLike[str]) -> Iterator[Writer]:
    """Give what takes the blocks of a file; after an error nothing of it is left."""
    with whole(path) as temporary:
        yield Writer(path, temporary)


class Scanned(Mapping[str, NDArray[np.float64]]):
    """The columns of a file, each read when it is asked for."""

    def __init__(self, path: Path) -> None:
        self._path = path.resolve()
        self._all, self.rows = columns_and_rows(self._path)
        self._names = tuple(name for name in self._all if name != "t")
        self._stamp = self._stamped()

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in self._names:
            raise KeyError(name)
        return self.read(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def read(self, name: str) -> NDArray[np.float64]:
        """Read a column, or the times ``t``."""
        if self._stamped() != self._stamp:
            raise FileError(str(self._path), "has changed since it was opened; open it again")
        table = read_columns(self._path, [name] if name in self._all else [])
        return samples(self._path, table, name)

    def _stamped(self) -> tuple[int, int]:
        found = self._path.stat()
        return found.st_size, found.st_mtime_ns


class Run(Protocol):
    """Facts of a run that a file keeps beside its samples; see :class:`ballrace.Signals`."""

    @property
    def fs(self) -> float: ...
    @property
    def units(self) -> Mapping[str, str]: ...
    @property
    def scene(self) -> Scene: ...
    @property
    def stats(self) -> Record: ...
    @property
    def provenance(self) -> Record: ...
    @property
    def warnings(self) -> tuple[str, ...]: ...
    @property
    def end_state(self) -> NDArray[np.float64] | None: ...
    @property
    def slices(self) -> pl.DataFrame | None: ...


def metadata(signals: Run) -> dict[str, str]:
    """Return what stands in a file beside the samples."""
    entries = {
        "ballrace": _FORMAT,
        "sampling_rate": repr(float(signals.fs)),
        "units": json.dumps({"t": "s", **signals.units}),
        "scene": signals.scene.to_json(),
        "stats": json.dumps(signals.stats.to_dict()),
        "provenance": json.dumps(signals.provenance.to_dict()),
        "warnings": json.dumps(signals.warnings),
    }
    if signals.end_state is not None:
        entries["end_state"] = json.dumps(signals.end_state.tolist())
    if signals.slices is not None:
        entries["slices"] = base64.b64encode(to_bytes(signals.slices)).decode()
    return entries


def unless_damaged(path: Path, read: Callable[[], Any]) -> Any:
    """Read a file; an error names the file and why it is not one of ours."""
    try:
        return read()
    except ValueError as error:
        raise FileError(str(path), f"not a Parquet file, or damaged ({error})") from error


def samples(path: Path, table: pl.DataFrame, name: str) -> NDArray[np.float64]:
    """Return a column of a file, which has to hold numbers."""
    if name not in table.columns:
        raise FileError(str(path), f"damaged: the column {name} is missing")
    column = table[name]
    if column.dtype != pl.Float64 or column.null_count():
        raise FileError(str(path), f"damaged: the column {name} has other entries than numbers")
    return column.to_numpy()


def described(path: Path, metadata: Mapping[str, str], columns: Sequence[str]) -> dict[str, Any]:
    """Return what the metadata of a file says beside its samples, as :class:`Signals` takes it."""
    form = metadata.get("ballrace")
    if form is None:
        raise FileError(str(path), "a Parquet file, but not written by this version of ballrace")
    if form != _FORMAT:
        reason = f"of format {form}, this version of ballrace reads {_FORMAT}"
        raise FileError(str(path), f"{reason}; read it with the one that wrote it, or a newer one")
    readers: dict[str, Callable[[str], Any]] = {
        "sampling_rate": _rate, "units": _mapping, "scene": _scene, "stats": _mapping,
        "provenance": _mapping, "warnings": _texts, "slices": _table, "end_state": _state,
    }  # fmt: skip
    absent = {"warnings": "[]", "slices": "", "end_state": ""}
    found = {}
    for entry, read in readers.items():
        text = metadata.get(entry, absent.get(entry))
        if text is None:
            raise FileError(str(path), f"damaged: its metadata has no {entry}")
        try:
            found[entry] = read(text)
        except (ValueError, TypeError, BallraceError) as error:
            if isinstance(error, SceneError) and error.path == "schema":
                raise FileError(str(path), f"its scene has {error}") from error
            reason = f"damaged: the entry {entry} of its metadata cannot be read ({error})"
            raise FileError(str(path), reason) from error
    units = found.pop("units")
    missing = [name for name in columns if name not in units and name != "t"]
    if missing:
        raise FileError(str(path), f"damaged: its metadata has no unit of {missing[0]}")
    found["units"] = {name: str(units[name]) for name in columns if name != "t"}
    found["fs"] = found.pop("sampling_rate")
    return found


def _rate(text: str) -> float:
    fs = float(text)
    if not 0.0 < fs < float("inf"):
        raise ValueError(f"{text} is no rate")
    return fs


def _mapping(text: str) -> dict[str, Any]:
    document = json.loads(text)
    if not isinstance(document, dict):
        raise TypeError("it is no mapping")
    return document


def _scene(text: str) -> str:
    return Scene.from_json(text).to_json()


def _texts(text: str) -> list[str]:
    return [str(warning) for warning in json.loads(text)]


def _state(text: str) -> NDArray[np.float64] | None:
    return np.array(json.loads(text), dtype=np.float64) if text else None


def _table(text: str) -> pl.DataFrame | None:
    return read_bytes(base64.b64decode(text))[0] if text else None
