"""Sets in the layout of ``bearing-datasets``, read by polars alone."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .._base.libraries import pl
from .._base.numbers import real
from .._io.files import as_path
from .._io.parquet import collected
from ..channel import Channel
from ..errors import FileError
from .layout import SCHEMA_VERSION

_UNKNOWN = ("unknown", "counts", "normalized")
"""Units of that layout which are none."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BearingDataset:
    """A set of labelled records.

    Made by :func:`ballrace.read_bearing_dataset`.

    Attributes
    ----------
    path : Path
        Its folder.
    metadata : polars.DataFrame
        A row a signal: ``signal_id``, ``fs`` [Hz], ``unit``, ``fault_type`` (``normal``, ``outer``, ``inner``,
        ``rolling_element``, …), ``bearing_id`` and so on. What a value does not apply to is ``none``, and what is
        not known ``unknown``.
    card : dict
        Its ``title``, ``license``, ``citation``, and under ``columns`` what each column means.
    """

    path: Path
    metadata: pl.DataFrame
    card: dict[str, Any]

    def __len__(self) -> int:
        return self.metadata.height

    def __repr__(self) -> str:
        licence = self.card.get("license", "unknown")
        return f"<BearingDataset {self.path.name}: {len(self)} signals, licence {licence}>"

    def channel(self, signal_id: str) -> Channel:
        """Return one signal, for functions that take a record.

        Raises
        ------
        KeyError
            There is no such signal.
        FileError
            The file that holds it is missing or damaged.

        Examples
        --------
        ``br.diagnose(dataset.channel(row["signal_id"]), row["bearing_model"])`` judges a row of the table.
        """
        rows = self.metadata.filter(signal_id=signal_id)
        if rows.is_empty():
            raise KeyError(f"no signal {signal_id!r}; metadata has them as signal_id")
        row = rows.row(0, named=True)
        unit = row.get("unit", "unknown")
        return Channel(
            x=self._samples(row), fs=float(row["fs"]), name=str(row["channel"]),
            unit="" if unit in _UNKNOWN else unit, shaft=_shaft(row),
        )  # fmt: skip

    def _samples(self, row: dict[str, Any]) -> np.ndarray[Any, np.dtype[np.float64]]:
        file = self.path / "signals" / Path(row["signal_file"]).name
        try:
            of_row = pl.scan_parquet(file, glob=False).filter(signal_id=row["signal_id"])
            (found,) = collected(of_row.select("signal"))["signal"]
        except (OSError, ValueError, pl.exceptions.PolarsError) as error:
            raise FileError(str(file), f"damaged, or lacks {row['signal_id']} ({error})") from error
        return np.array(found, dtype=np.float64)


def read_bearing_dataset(path: str | os.PathLike[str]) -> BearingDataset:
    """Read a set that ``bearing-datasets`` has built, or :meth:`ballrace.campaigns.Campaign.to_bearing_datasets`.

    Samples are read when they are asked for.

    Parameters
    ----------
    path : path
        Folder of the set, with ``manifest.json``, ``metadata.parquet`` and ``signals``.

    Returns
    -------
    BearingDataset
        Table, card, and signals by their ids.

    Raises
    ------
    FileError
        The folder holds no such set, one of ``bearing-datasets`` before 0.2, or is damaged.
    """
    path = as_path(path)
    try:
        card = json.loads((path / "manifest.json").read_text(encoding="utf-8"))
        version = real(card.get("schema_version", 1))
        table = pl.read_parquet(path / "metadata.parquet", glob=False)
    except (OSError, ValueError, AttributeError, pl.exceptions.PolarsError) as error:
        reason = f"not a set of bearing-datasets, or damaged ({error})"
        raise FileError(str(path), reason) from error
    if version != SCHEMA_VERSION:
        reason = f"schema version {version:g}, not {SCHEMA_VERSION}; build it with bearing-datasets 0.2 or newer"
        raise FileError(str(path), reason)
    wanted = {"signal_id", "channel", "fs", "signal_file"} - set(table.columns)
    if wanted:
        raise FileError(str(path), f"damaged: metadata.parquet has no {', '.join(sorted(wanted))}")
    return BearingDataset(path=path, metadata=table, card=card)


def _shaft(row: dict[str, Any]) -> float | None:
    """Return the rate of the shaft [Hz] where it is known and constant."""
    rpm = real(row.get("speed_rpm"))
    constant = row.get("speed_profile", "constant") == "constant"
    return abs(rpm) / 60.0 if constant and np.isfinite(rpm) and rpm else None
