"""Contents of a file of a record, before they are checked; and their metadata as text."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FileError, SceneError


@dataclass(kw_only=True)
class Samples:
    """Columns of one length at one sampling rate, and their metadata.

    Attributes
    ----------
    columns : dict of str to ndarray
        Columns, each of shape (n,), of any numeric type.
    fs : float or None
        Sampling rate [Hz]; None where the file does not have it.
    units : dict of str to str
        Unit of a column; absent or empty where the file does not have it.
    shaft : float or None
        Mean rate of the shaft [Hz]; None where it is not known.
    metadata : dict
        Further metadata that JSON can hold.
    others : list of Samples
        Columns of other lengths or rates.
    notes : list of str
        What the caller is to be warned of.
    """

    columns: dict[str, NDArray[Any]]
    fs: float | None = None
    units: dict[str, str] = field(default_factory=dict)
    shaft: float | None = None
    metadata: dict[str, Any] = field(default_factory=dict)
    others: list[Samples] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    @property
    def n_samples(self) -> int:
        """Number of samples of each column."""
        return next(iter(self.columns.values())).size

    @property
    def t(self) -> NDArray[np.float64]:
        """Times from the first sample [s]; numbers of samples where the rate is not known."""
        return np.arange(self.n_samples) / (self.fs or 1.0)

    def header(self) -> str:
        """Return as JSON all but the samples: ``columns`` in their order with their units, ``fs`` and so on."""
        units = {name: self.units.get(name, "") for name in self.columns}
        entries = {"columns": units, "fs": self.fs, "shaft": self.shaft, "metadata": self.metadata}
        try:
            return json.dumps(entries)
        except (TypeError, ValueError) as error:
            raise SceneError("metadata", f"({error})", "what JSON can hold") from None


@dataclass(kw_only=True)
class Said:
    """Facts that a file says beside its numbers.

    Attributes
    ----------
    rate : float or None
        Sampling rate [Hz].
    units : list of str
        Units of signals that have none at their names: one for all, or one each.
    metadata : dict
        The rest, as JSON can hold it.
    """

    rate: float | None = None
    units: list[str] = field(default_factory=list)
    metadata: dict[str, Any] = field(default_factory=dict)


def from_header(path: Path, text: str, columns: Mapping[str, NDArray[Any]]) -> Samples:
    """Return columns with the metadata of :meth:`Samples.header`.

    Raises
    ------
    FileError
        The text says nothing of the kind, or not of these columns.
    """
    try:
        entries = json.loads(text)
        units = {str(name): str(unit) for name, unit in entries["columns"].items()}
        return Samples(
            columns={name: columns[name] for name in units},
            fs=float(entries["fs"]),
            units=units,
            shaft=None if entries["shaft"] is None else float(entries["shaft"]),
            metadata=dict(entries["metadata"]),
        )
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        reason = f"damaged: the metadata of its columns cannot be read ({error!r})"
        raise FileError(str(path), reason) from error
