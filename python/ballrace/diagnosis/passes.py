"""How far apart the two events of a pass are: a ball that crosses a spall falls in, and hits the far edge.

Through any housing the second event follows the first by the same arc of the race, so it stands out in the
autocorrelation of the squared envelope of a prewhitened record, at short lags: the width of the spall, less what
the contact bridges. A lag times the speed of the balls along the race is an arc.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import scipy
from ..spectra.whitening import flattened
from .envelopes import band_envelope, half_spectrum

if TYPE_CHECKING:
    from collections.abc import Sequence

    Band = tuple[float, float]

_BANDS = (
    (1e3, 3e3), (2e3, 5e3), (4e3, 8e3), (6e3, 12e3), (10e3, 20e3), (1.5e3, 6e3), (3e3, 12e3), (5e3, 20e3),
)  # fmt: skip
"""Band in which impacts ring [Hz]."""

_FINEST = 0.05
"""Most that balls may go on within the time that a band resolves, the inverse of its width [ball diameters]."""

_WHITENED = 400.0
"""Width over which the spectrum is made flat [Hz]."""

_CLIPPED = 0.995
"""Quantile of an envelope above which it is cut, so that a few impacts do not decide."""

_STEP, _SMOOTHED, _AROUND = 0.002, 0.012, 0.12
"""Step of arcs; widths of the running means that smooth the correlation and are taken off [ball diameters]."""

_ARCS = 0.045, 0.55
"""Arcs among which the second event is looked for [ball diameters]: below, the first still rings."""

_AGREE = 0.02
"""How far apart bands may place it [ball diameters]."""

_COARSE, _BEFORE, _AFTER = 0.004, 0.15, 0.25
"""Step of the averaged pass; how far it reaches before the first event and behind the second [ball diameters]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Passes:
    """The correlation of a record's impacts with what follows them.

    Attributes
    ----------
    spacing : float
        The arc where it is highest, of those that are looked at [ball diameters].
    height : float
        How high it is there, the mean of the bands over its running mean.
    above : float
        That height over the highest elsewhere.
    bands : int
        Bands that resolve a pass.
    agreeing : int
        How many of them have their highest value at that arc.
    """

    spacing: float
    height: float
    above: float
    bands: int
    agreeing: int


@dataclass(frozen=True, kw_only=True, eq=False)
class AveragedPass:
    """The squared envelope around the first event of a pass, averaged over the clearest passes.

    Attributes
    ----------
    arc : ndarray, shape (m,)
        Arc along the race since the first event [ball diameters].
    envelope : ndarray, shape (m,)
        Squared envelope over its mean.
    count : int
        Passes that were averaged.
    """

    arc: NDArray[np.float64]
    envelope: NDArray[np.float64]
    count: int


class _White:
    """A prewhitened record, and how fast balls go along a race in it [ball diameters a second]."""

    def __init__(self, x: NDArray[np.float64], fs: float, speed: float) -> None:
        self.spectrum = flattened(half_spectrum(x), _WHITENED * x.size / fs)
        self.size, self.fs, self.speed = x.size, fs, speed
        self.length = x.size / fs * speed

    def power(self, band: Band) -> NDArray[np.float64]:
        """Return the squared envelope in a band, its highest values cut off."""
        found = band_envelope(self.spectrum, *band, self.size, self.fs)
        cut: NDArray[np.float64] = np.minimum(found, np.quantile(found, _CLIPPED))
        return cut

    def over(self, arc: NDArray[np.float64], band: Band) -> NDArray[np.float64]:
        """Return the squared envelope over its mean, at arcs since the record began [ball diameters]."""
        power = self.power(band)
        at = np.arange(power.size) * (self.length / power.size)
        found: NDArray[np.float64] = np.interp(arc, at, power / _positive(power.mean()))
        return found

    def correlation(self, arc: NDArray[np.float64], band: Band) -> NDArray[np.float64]:
        """Return the autocorrelation of the squared envelope, at arcs [ball diameters]."""
        power = self.power(band)
        step = self.length / power.size
        # Finer lags than the envelope is sampled at; and zeros, so that its end does not meet its begin.
        finer = math.ceil(step / _STEP)
        size = scipy.fft.next_fast_len(power.size + math.ceil(arc[-1] / step) + 1, real=True)
        density = np.abs(scipy.fft.rfft(power - power.mean(), size)) ** 2
        found = scipy.fft.irfft(density, finer * size)[: math.ceil(arc[-1] / step * finer) + 1]
        at = np.arange(found.size) * (step / finer)
        over: NDArray[np.float64] = np.interp(arc, at, found / _positive(found[0]))
        return over


def _positive(x: float) -> float:
    """Return a number to divide by: a band may be silent."""
    return max(float(x), np.finfo(float).tiny)


def passes_of(x: NDArray[np.float64], fs: float, speed: float) -> Passes | None:
    """Return the passes of a record, for a speed of the balls along the race [ball diameters a second].

    None where no band of the record resolves a pass.
    """
    bands = _bands_for(fs, speed)
    if not bands:
        return None
    white = _White(x, fs, speed)
    arc = np.arange(0.0, _ARCS[1] + 0.5 * _AROUND, _STEP)
    rows = np.array([white.correlation(arc, band) for band in bands])
    return _highest(arc, _over_running_mean(rows))


def _bands_for(fs: float, speed: float) -> Sequence[Band]:
    return [
        (low, high) for low, high in _BANDS if high < 0.48 * fs and speed < _FINEST * (high - low)
    ]


def _over_running_mean(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    smooth = scipy.ndimage.uniform_filter1d(
        rows, round(_SMOOTHED / _STEP) | 1, axis=1, mode="nearest"
    )
    around = scipy.ndimage.uniform_filter1d(
        smooth, round(_AROUND / _STEP) | 1, axis=1, mode="nearest"
    )
    found: NDArray[np.float64] = smooth - around
    return found


def _highest(arc: NDArray[np.float64], rows: NDArray[np.float64]) -> Passes:
    mean = rows.mean(axis=0)
    asked = (arc >= _ARCS[0]) & (arc <= _ARCS[1])
    at = _summit(mean, asked)
    elsewhere = _summit(mean, asked & (np.abs(arc - arc[at]) > 0.5 * _AROUND))
    of_bands = arc[[_summit(row, asked) for row in rows]]
    return Passes(
        spacing=float(arc[at]),
        height=float(mean[at]),
        above=float(mean[at] / max(float(mean[elsewhere]), 1e-4)),
        bands=len(rows),
        agreeing=int(np.count_nonzero(np.abs(of_bands - arc[at]) <= _AGREE)),
    )


def _summit(row: NDArray[np.float64], asked: NDArray[np.bool_]) -> int:
    """Return where the highest local maximum is that is asked for; the flank of the first event is none."""
    inner = (row[1:-1] > row[:-2]) & (row[1:-1] >= row[2:]) & asked[1:-1]
    found = np.flatnonzero(inner) + 1
    return int(found[np.argmax(row[found])]) if found.size else int(np.argmax(asked))


def averaged(
    x: NDArray[np.float64], fs: float, speed: float, spacing: float, pitch: float
) -> AveragedPass:
    """Return the averaged pass: of every ``pitch`` the place where two events are most alike a pair.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Signal.
    fs : float
        Sampling rate [Hz].
    speed : float
        Of the balls along the race [ball diameters a second].
    spacing, pitch : float
        Arcs between the two events, and from ball to ball [ball diameters].
    """
    white = _White(x, fs, speed)
    arc = np.arange(0.0, white.length, _COARSE)
    power = np.mean([white.over(arc, band) for band in _bands_for(fs, speed)], axis=0)
    shift = round(spacing / _COARSE)
    around = np.arange(
        -round(_BEFORE / _COARSE), round((spacing + _AFTER) / _COARSE), dtype=np.intp
    )
    first = _clearest(power[:-shift] * power[shift:], round(pitch / _COARSE))
    first = first[(first + around[0] >= 0) & (first + around[-1] < power.size)]
    passes = power[first[:, np.newaxis] + around]
    over = np.asarray(around * _COARSE, dtype=np.float64)
    return AveragedPass(arc=over, envelope=passes.mean(axis=0), count=len(first))


def _clearest(pair: NDArray[np.float64], each: int) -> NDArray[np.intp]:
    """Return where the highest value of each piece is, of the better half of the pieces."""
    rows = pair[: pair.size // each * each].reshape(-1, each)
    highest = rows.max(axis=1)
    first = np.argmax(rows, axis=1) + each * np.arange(len(rows))
    found: NDArray[np.intp] = first[highest >= np.median(highest)]
    return found
