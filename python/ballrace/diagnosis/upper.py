"""End of a record's band, by its spectrum: above, impacts leave nothing, whatever the sampling rate."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..spectra.pieces import transforms

_BELOW = 30.0
"""How far below the median of what is lower a third of an octave does not count [dB]."""

_NEEDED = 117.0
"""Upper edge times pitch diameter below which a record clears nothing [m/s]: 3 kHz of a 6205."""

_LOWEST = 24
"""Thirds of an octave below half of the sampling rate that are looked at."""


def needed_edge(diameter: float | None) -> float:
    """Return how far a record has to reach to clear a bearing of a pitch diameter [m], by default a 6205 [Hz]."""
    return _NEEDED / (0.039 if diameter is None else diameter)


def upper_edge(x: NDArray[np.float64], fs: float) -> float:
    """Return the upper edge of what a record holds [Hz].

    That of the highest third of an octave whose spectral density, by its median, is at most 30 dB below the
    median of all thirds below it: tones do not count, a resonance does not hide what is beside it, and what a
    filter or a sensor has taken away does not count.

    Examples
    --------
    >>> from scipy.signal import butter, sosfilt
    >>> noise = np.random.default_rng(1).normal(size=100_000)
    >>> low = sosfilt(butter(8, 1000.0, fs=12_000.0, output="sos"), noise)
    >>> round(upper_edge(noise, 12_000.0)), 1000.0 < upper_edge(low, 12_000.0) < 2000.0
    (6000, True)
    """
    samples = max(min(x.size // 8, int(fs / 5.0)), 16)
    density = np.mean(np.abs(transforms(x - x.mean(), samples)) ** 2, axis=0)
    f = np.arange(density.size) * (fs / samples)
    edges = 0.5 * fs * 2.0 ** (-np.arange(_LOWEST + 1) / 3.0)
    thirds = [density[(f > low) & (f <= high)] for high, low in pairwise(edges)]
    # From the highest down, as far as the spectrum has lines there.
    level = [float(np.median(third)) for third in thirds if third.size >= 2]
    for number in range(len(level) - 2):
        if level[number] > 10.0 ** (-_BELOW / 10.0) * float(np.median(level[number + 1 :])):
            return float(edges[number])
    return float(edges[max(len(level) - 2, 0)])
