"""Tables with a column a signal, and perhaps one of times."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..errors import FileError
from .samples import Samples

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    import polars as pl
    from numpy.typing import NDArray

_TIMES = ("t", "time", "times", "timestamp", "zeit")
_SECONDS = {"": 1.0, "s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "μs": 1e-6}

_OFF = 0.1
"""How far a time may lie off equal steps, in steps: they are rounded, or one is missing."""


def sampled(path: Path, columns: Mapping[str, pl.Series], units: Mapping[str, str]) -> Samples:
    """Return the columns of a table, the rate from that of the times if there is one.

    Raises
    ------
    FileError
        A column holds other entries than numbers, or times are not at equal steps.
    """
    arrays = {name: _numbers(path, name, column) for name, column in columns.items()}
    fs = None
    for name in [name for name in arrays if name.lower() in _TIMES][:1]:
        unit = units.get(name, "")
        if unit not in _SECONDS:
            raise FileError(str(path), f"times in {unit!r}, not in {', '.join(_SECONDS)}"[:200])
        fs = _rate(path, name, arrays.pop(name) * _SECONDS[unit])
    if not arrays or not next(iter(arrays.values())).size:
        raise FileError(str(path), "has no column of numbers")
    return Samples(columns=arrays, fs=fs, units={n: u for n, u in units.items() if n in arrays})


def _numbers(path: Path, name: str, column: pl.Series) -> NDArray[np.float64]:
    from .._polars import pl

    if column.dtype == pl.String:
        # Spaces stand beside the numbers; or it is something else.
        column = column.str.strip_chars().cast(pl.Float64, strict=False)
    if not column.dtype.is_numeric() or column.null_count():
        raise FileError(str(path), f"the column {name} has other entries than numbers")
    return column.to_numpy().astype(np.float64)


def _rate(path: Path, name: str, t: NDArray[np.float64]) -> float:
    """Return the rate of equally spaced times, to the twelve digits that a difference of them has."""
    steps = t.size - 1
    if steps < 1 or not np.isfinite(t).all() or t[-1] <= t[0]:
        raise FileError(str(path), f"the times {name} do not rise")
    step = (t[-1] - t[0]) / steps
    off = np.abs(t - t[0] - step * np.arange(t.size)).max() / step
    if off > _OFF:
        raise FileError(str(path), f"the times {name} are not at equal steps: {off:.1f} steps off")
    return float(f"{1.0 / step:.12g}")
