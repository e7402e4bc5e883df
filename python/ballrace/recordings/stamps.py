"""Dates and times of day as text: seconds from midnight, whatever the order of day and month."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import pl

_CLOCK = (
    r"(?:^|[T ,_-])(?P<hour>\d{1,2}):(?P<minute>\d{1,2})(?::(?P<second>\d{1,2}))?"
    r"(?:[.,:](?P<fraction>\d{1,15}))?\s*(?P<half>[AaPp])?"
)
_COMPACT = r"\dT(?P<hour>\d{2})(?P<minute>\d{2})(?P<second>\d{2})(?:[.,](?P<fraction>\d{1,15}))?(?P<half>[AaPp])?"
_DAY = 86400.0


def seconds(stamps: NDArray[Any]) -> tuple[NDArray[np.float64], float, str]:
    """Return dates and times as seconds since the midnight before the first, their last digit, and the first.

    The time of day alone counts; where it falls by hours, a day has passed. A date alone is midnight.
    """
    texts = pl.Series(stamps, dtype=pl.String)
    first = str(texts[0]) if texts.len() else ""
    pattern = _COMPACT if first[8:9] == "T" else _CLOCK
    parts = texts.str.extract_groups(pattern).struct.unnest()
    hour, minute, second = (
        parts[name].cast(pl.Float64).fill_null(0.0).to_numpy()
        for name in ("hour", "minute", "second")
    )
    digits = parts["fraction"].str.len_chars().fill_null(0).cast(pl.Float64).to_numpy()
    fraction = parts["fraction"].cast(pl.Float64).fill_null(0.0).to_numpy() * 10.0**-digits
    if parts["second"].null_count() and digits.any():
        # A spreadsheet's 59:30.1 is minutes and seconds.
        found = 60.0 * hour + minute + fraction
        around = 3600.0
    else:
        half = parts["half"].str.to_lowercase().fill_null("")
        if half.len() and half[0]:
            hour = hour % 12.0 + 12.0 * (half == "p").to_numpy()
        found = 3600.0 * hour + 60.0 * minute + second + fraction
        around = _DAY
    turns = (
        np.concatenate([[0.0], np.cumsum(np.diff(found) < -0.5 * around)]) if found.size else found
    )
    grain = 10.0 ** -float(digits.max(initial=0.0))
    if not digits.any() and not parts["second"].drop_nulls().len():
        grain = 60.0 if parts["minute"].drop_nulls().len() else _DAY
    return found + around * turns, grain, first
