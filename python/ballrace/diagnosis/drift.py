"""Drifts of a record, as of temperature or a charge amplifier, steps and decays: no vibration of the bearing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import scipy

_SMOOTHED = 0.25
"""Turns over which the median is smoothed twice, so that it adds nothing to bands that are empty."""

_STEP = 30.0
"""How many of its typical distances from the smoothed median a median has at a step, where it is left as it is."""

_LEAST = 0.2
"""Standard deviation of a drift over that of what is left, from which on it is taken out."""


def without_drift(x: NDArray[np.float64], fs: float, shaft: float) -> NDArray[np.float64]:
    """Return a signal less its running median over a turn of the shaft, or less its mean where it hardly drifts.

    A median follows ramps, decays and waves that are slower than the shaft, and steps without rounding them; of
    the shaft's own orders it is nothing.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Signal.
    fs, shaft : float
        Sampling rate, rate of the shaft [Hz].

    Examples
    --------
    >>> step = np.repeat([0.0, 5.0], 500)
    >>> wave = np.sin(2 * np.pi * np.arange(1000) / 50.0)
    >>> bool(np.abs(without_drift(wave + step, 50.0, 1.0) - wave)[60:440].max() < 0.1)
    True
    """
    samples = min(fs / shaft, float(x.size))
    turn = min(max(round(samples), 3), x.size - 1) | 1
    # Beyond its ends a record goes on as it came.
    longer = np.pad(x, turn, mode="reflect", reflect_type="odd")
    drift = scipy.ndimage.median_filter(longer, turn, mode="nearest")
    width = max(round(_SMOOTHED * samples), 1)
    smooth = scipy.ndimage.uniform_filter1d(
        scipy.ndimage.uniform_filter1d(drift, width, mode="nearest"), width, mode="nearest"
    )
    apart = np.abs(drift - smooth)
    at_step = apart > _STEP * float(np.median(apart))
    slow = np.where(at_step, drift, smooth)[turn:-turn]
    left: NDArray[np.float64] = x - slow
    return left if slow.std() > _LEAST * left.std() else x - x.mean()
