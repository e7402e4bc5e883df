"""What the functions of signals refuse."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..errors import SceneError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["checked_band", "checked_length", "checked_signal"]


def checked_signal(x: ArrayLike, fs: float) -> NDArray[np.float64]:
    """Return a signal as the core reads it.

    Raises
    ------
    SceneError
        It is no row of finite numbers, or too short, or its sampling rate is not usable.
    """
    try:
        signal = np.asarray(x, dtype=np.float64)
    except (TypeError, ValueError):
        raise SceneError("x", type(x).__name__, "an array of numbers") from None
    if signal.ndim != 1 or signal.size < 8:
        raise SceneError(
            "x", f"an array of shape {signal.shape}", "an array of shape (n,), n at least 8"
        )
    if not np.isfinite(signal).all():
        raise SceneError("x", "not a number, or infinite, at places", "finite everywhere")
    if not 0.0 < fs < math.inf:
        raise SceneError("fs", str(fs), "above 0")
    return signal


def checked_band(band: tuple[float, float], fs: float) -> tuple[float, float]:
    """Return a band within the frequencies that a sampling rate holds [Hz].

    Raises
    ------
    SceneError
        It is no such band.
    """
    low, high = band
    if not 0.0 <= low < high <= fs / 2.0:
        raise SceneError("band", str(band), f"two rising frequencies from 0 to fs/2, {fs / 2.0:g}")
    return low, high


def checked_length(name: str, given: int | None, default: int, longest: int) -> int:
    """Return a number of samples, or the default where none is given.

    Raises
    ------
    SceneError
        It is none from 1 to ``longest``; ``name`` is the argument's.
    """
    if given is None:
        return default
    if (
        isinstance(given, bool)
        or not isinstance(given, int | np.integer)
        or not 1 <= given <= longest
    ):
        raise SceneError(name, repr(given), f"a whole number of samples from 1 to {longest}")
    return int(given)
