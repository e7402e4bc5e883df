"""Checks of numeric arguments; what they refuse is a :class:`ballrace.SceneError`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .errors import SceneError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["LARGEST", "RATES", "checked_seed", "per_pitch", "real", "real_row", "sampling_rate"]

LARGEST = 1e60
"""Magnitude of a signal: sums of its fourth powers, which a kurtosis takes, are still numbers."""


RATES = 1e-9, 1e15
"""Sampling rates that are taken [Hz]."""


def real(value: object) -> float:
    """Return a number as a float, and NaN for what is none: no range holds it, so that one check refuses both.

    >>> real(np.int64(3)), real("3"), real(None), real(True)
    (3.0, nan, nan, nan)
    >>> real(-(10**400))
    -inf
    """
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def per_pitch(positions: object) -> int:
    """Return how many positions of the cage there are to be per ball pitch."""
    if isinstance(positions, bool) or not isinstance(positions, int) or positions < 1:
        raise SceneError("positions", repr(positions), "a whole number, at least 1 per ball pitch")
    return positions


def checked_seed(seed: object) -> int:
    """Return a seed as numpy takes it."""
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or seed < 0:
        raise SceneError("seed", repr(seed), "a whole number from 0")
    return int(seed)


def sampling_rate(fs: object) -> float:
    """Return a sampling rate [Hz]."""
    rate = real(fs)
    if not RATES[0] <= rate <= RATES[1]:
        raise SceneError("fs", repr(fs), f"a rate [Hz], {RATES[0]:g} to {RATES[1]:g}")
    return rate


def real_row(name: str, x: ArrayLike) -> NDArray[np.float64]:
    """Return real numbers as an array, of any shape.

    Raises
    ------
    SceneError
        They are something else, or some of them are masked; ``name`` is the argument's.
    """
    try:
        given = np.asanyarray(x)
        # Objects may be numbers; text that reads as one is none, nor has a complex number only a real part.
        row = np.asarray(given, dtype=np.float64) if given.dtype.kind in "biufO" else None
    except (TypeError, ValueError, OverflowError):
        row = None
    if row is None:
        raise SceneError(name, type(x).__name__, "an array of real numbers")
    if np.ma.is_masked(given):
        raise SceneError(name, "an array with masked places", "an array without; fill them")
    return row
