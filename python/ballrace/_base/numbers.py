"""Checks of numeric arguments; what they refuse is a :class:`ballrace.SceneError`."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import SceneError

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


def finite(name: str, value: object, unit: str = "") -> float:
    """Return a finite number."""
    number = real(value)
    if not math.isfinite(number):
        raise SceneError(name, repr(value), f"a finite number{unit and f' [{unit}]'}")
    return number


def positive(
    name: str, value: object, unit: str = "", *, zero: bool = False, below: float = math.inf
) -> float:
    """Return a number above 0, or from 0, and below a bound."""
    number = real(value)
    if not (0.0 < number < below or (zero and number == 0.0)):
        least = "a number from 0" if zero else "a number above 0"
        bound = "" if math.isinf(below) else f", below {below:g}"
        raise SceneError(name, repr(value), f"{least}{bound}{unit and f' [{unit}]'}")
    return number


def counted(name: str, value: object, least: int, most: int | None = None) -> int:
    """Return a whole number within bounds, also one that a table had to make a float."""
    number = real(value)
    if not (number.is_integer() and least <= number and (most is None or number <= most)):
        bounds = f"at least {least}" if most is None else f"{least} to {most}"
        raise SceneError(name, repr(value), f"a whole number, {bounds}")
    return int(value)  # type: ignore[call-overload, no-any-return]


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


def read_only(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a view of an array through which it cannot be changed."""
    view = x.view()
    view.flags.writeable = False
    return view
