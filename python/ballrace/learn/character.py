"""Properties of records besides fault lines, by which simulated and measured ones may differ.

===================  ==========================================================================================
``spectrum <k>``     level of the k-th of six equal bands up to half the sampling rate over that of the record [dB]
``floor lines``      narrow lines that stand 12 dB above the median beside them, a kilohertz
``line share``       share of the power that these lines have
``repeats``          correlation of the record with itself a turn of the shaft later, as surfaces come round
``swell <k>``        line of the squared envelope at shaft order k over its mean, k = 1, 2, 3 [dB]
``wander``           standard deviation of the level of eighths of the record [dB]
``plain kurtosis``   kurtosis of the whole record
``least kurtosis``   smallest kurtosis of six bands
===================  ==========================================================================================

``spectrum`` depends on the path to the sensor: housing, machine and sensor.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from .._base.libraries import scipy

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..channel import Channel

_BANDS = 6
_LINE = 10.0 ** (12.0 / 20.0)
_BESIDE = 31
"""Bins that the median beside a line is of."""

PATH = "spectrum"
"""Beginning of the names of features that the path decides."""

NAMES = (
    *(f"{PATH} {k}" for k in range(1, _BANDS + 1)),
    "floor lines", "line share", "repeats", "swell 1", "swell 2", "swell 3", "wander", "plain kurtosis",
    "least kurtosis",
)  # fmt: skip
"""Names of the features."""


def character_of(channel: Channel) -> NDArray[np.float64]:
    """Return the features of a record whose speed is known; 0 of a silent one."""
    x = np.asarray(channel.x, dtype=np.float64)
    x = x - x.mean()
    if not x.std() > 0.0:
        return np.zeros(len(NAMES))
    spectrum = np.fft.rfft(x * np.hanning(x.size))
    lines = _lines(np.abs(spectrum))
    power = np.abs(spectrum) ** 2
    per_kilohertz = np.count_nonzero(lines[1:] & ~lines[:-1]) / (channel.fs / 2000.0)
    shaft = abs(channel.shaft or 0.0)
    return np.array([
        *_levels(power), per_kilohertz, power[lines].sum() / power.sum(), _repeats(x, channel.fs / shaft),
        *_swelling(x, channel.fs, shaft), _wander(x), _kurtosis(x), min(_kurtosis(part) for part in _parts(x)),
    ])  # fmt: skip


def _lines(amplitude: NDArray[np.float64]) -> NDArray[np.bool_]:
    floor = scipy.ndimage.median_filter(amplitude, _BESIDE)
    return np.asarray(amplitude > _LINE * np.maximum(floor, 1e-12 * amplitude.max()))


def _levels(power: NDArray[np.float64]) -> list[float]:
    """Return the levels of bands over that of the whole [dB]."""
    parts = [part.sum() for part in np.array_split(power, _BANDS)]
    return [float(10.0 * np.log10(max(part / power.sum(), 1e-12))) for part in parts]


def _repeats(x: NDArray[np.float64], turn: float) -> float:
    """Return the largest correlation of a record with itself a turn later, within half a percent of it."""
    power = np.abs(np.fft.rfft(x, 2 * x.size)) ** 2
    correlation = np.fft.irfft(power)[: x.size] / np.arange(x.size, 0, -1)
    reach, at = int(0.005 * turn) + 1, round(turn)
    return float(correlation[max(at - reach, 0) : at + reach + 1].max(initial=0.0) / correlation[0])


def _swelling(x: NDArray[np.float64], fs: float, shaft: float) -> list[float]:
    square = x**2
    spectrum = 4.0 / x.size * np.abs(np.fft.rfft((square - square.mean()) * np.hanning(x.size)))
    at = [round(k * shaft * x.size / fs) for k in (1, 2, 3)]
    found = [spectrum[max(k - 1, 0) : k + 2].max(initial=0.0) / square.mean() for k in at]
    return [float(20.0 * np.log10(max(value, 1e-6))) for value in found]


def _wander(x: NDArray[np.float64]) -> float:
    levels = [20.0 * np.log10(max(part.std(), 1e-12)) for part in np.array_split(x, 8)]
    return float(np.std(levels))


def _parts(x: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Return the record in equal bands."""
    spectrum = np.fft.rfft(x)
    edges = np.linspace(0, spectrum.size, _BANDS + 1).astype(int)
    found = []
    for low, high in pairwise(edges):
        part = np.zeros_like(spectrum)
        part[low:high] = spectrum[low:high]
        found.append(np.fft.irfft(part, x.size))
    return found


def _kurtosis(x: NDArray[np.float64]) -> float:
    variance = float(np.mean((x - x.mean()) ** 2))
    return float(np.mean((x - x.mean()) ** 4)) / variance**2 if variance > 0.0 else 3.0
