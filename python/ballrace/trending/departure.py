"""Departure of a quantity from its baseline."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import scipy

_DEVIATIONS = 3.0

_ROUNDING = 1e-9
"""Part of the mean that a deviation is at least, so that rounding is none."""


def limit_of(first: NDArray[np.float64], independent: float | None = None) -> float:
    """Return what a quantity exceeds by chance as seldom as a normal one exceeds three deviations.

    A baseline of few values knows neither its mean nor its deviation well: the distance is that of Student's
    distribution with one value more, 7.2 of its deviations after five records, 4.3 after ten, 3.5 after twenty
    and 3 after many (W. A. Shewhart's limits for single values; G. J. Hahn, J. Qual. Technol. 1 (1969) 168).

    Parameters
    ----------
    first : ndarray, shape (n,)
        The quantity of the baseline, three values and more.
    independent : float, optional
        How many independent values they are worth, more than one; by default all are.

    Examples
    --------
    >>> round(limit_of(np.array([1.0, 2.0, 3.0, 2.0, 2.0])), 2)
    7.13
    """
    count = first.size if independent is None else independent
    distance = scipy.stats.t.ppf(scipy.stats.norm.cdf(_DEVIATIONS), count - 1.0) * np.sqrt(
        1.0 + 1.0 / count
    )
    mean = float(first.mean())
    return mean + float(distance) * max(float(first.std(ddof=1)), _ROUNDING * abs(mean))


def departure_of(
    value: NDArray[np.float64], baseline: int, limit: float, row: int = 2
) -> int | None:
    """Return the first value behind the baseline that exceeds a limit, as those that follow do; None without.

    Parameters
    ----------
    value : ndarray, shape (n,)
        The quantity.
    baseline : int
        Values of the baseline.
    limit : float
        What they exceed.
    row : int
        How many in a row.

    Examples
    --------
    >>> departure_of(np.array([1.0, 1.0, 1.0, 9.0, 1.0, 9.0, 8.0]), 3, 5.0)
    5
    """
    above = value > limit
    above[:baseline] = False
    if above.size < row:
        return None
    together = np.lib.stride_tricks.sliding_window_view(above, row).all(axis=1)
    return int(np.argmax(together)) if together.any() else None
