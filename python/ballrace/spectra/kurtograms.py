"""The fast kurtogram: in which band a signal is most impulsive.

An impact rings for a short time at the frequencies of the structure. In a band that holds this ringing and little
else, the signal is high for short times, so that the kurtosis of its complex envelope is large: the mean of its
fourth power over the square of that of its second, less 2. Of Gaussian noise it is 0, of a tone −1. The bands are
those of a 1/3-binary tree: the frequencies from 0 to fs/2 in 1, 2, 3, 4, 6, 8, 12, … equal parts, each by filter
and decimation from what is above it (J. Antoni, *Fast computation of the kurtogram for the detection of transient
faults*, Mech. Syst. Signal Process. 21 (2007) 108).
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .._base.interrupt import answers_ctrl_c
from .._base.libraries import scipy
from .._base.numbers import real
from ..errors import SceneError
from .checks import given_signal
from .pieces import piece_length, transforms

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .checks import Given

    Complex = NDArray[np.complex128]

_TAPS = 16
"""Order of the filter that halves a band; as in the paper. One that takes a third has half as much again."""

_FEWEST = 64
"""Samples of an envelope that its kurtosis needs at least."""

_SILENT = 1e-24
"""Part of the largest power below which there is rounding alone."""

_FAINT = 1e-6
"""Density of power over the mean density below which a band is empty: what a filter or a converter leaves."""

_OWN = 0.1
"""Least share of what a band's filter lets through that is of the band itself, where it has power."""

_DRAWN = 20_000
"""Kurtoses of noise that the limit of chance is computed from, at least."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Kurtogram:
    """Kurtosis over bands; each array has an entry a band, level by level from the lowest frequency up.

    Attributes
    ----------
    level : ndarray
        Binary logarithm of the number of bands that share 0 to fs/2: 0, 1, 1.58, 2, 2.58, …
    low, high : ndarray
        Edges of the band [Hz].
    kurtosis : ndarray
        Kurtosis of the complex envelope in the band: 0 for Gaussian noise, −1 for a tone.
    has_power : ndarray of bool
        Whether the signal has power in the band: a density above −60 dB of its mean, and a tenth of what the
        filters let through. In other bands the kurtosis is that of rounding or of neighbours.
    """

    level: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    kurtosis: NDArray[np.float64]
    has_power: NDArray[np.bool_]

    @property
    def best(self) -> tuple[float, float]:
        """Edges of the band with the highest kurtosis [Hz] of those with power: the ``band`` of an envelope.

        Where none has power, it is that of all frequencies.
        """
        return float(self.low[self._at]), float(self.high[self._at])

    @property
    def highest(self) -> float:
        """The highest kurtosis, that of the best band."""
        return float(self.kurtosis[self._at])

    @property
    def _at(self) -> int:
        return int(np.argmax(np.where(self.has_power, self.kurtosis, -np.inf)))


@answers_ctrl_c
def kurtogram(x: Given, fs: float | None = None, narrowest: float | None = None) -> Kurtogram:
    """Return the fast kurtogram of a signal.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    narrowest : float, optional
        Least width of a band [Hz]. The envelope of a band holds lines up to its width, so give some
        multiples of the highest rate of interest. By default bands are halved as long as their
        envelopes have 64 samples.

    Returns
    -------
    Kurtogram
        Bands with their kurtosis; ``best`` is the one to take the envelope of.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    Impacts that ring at 3 kHz, in noise:

    >>> import ballrace as br
    >>> fs, rng = 16_000.0, np.random.default_rng(1)
    >>> t = np.arange(32_000) / fs
    >>> since = t % 0.01
    >>> impacts = np.exp(-800.0 * since) * np.sin(2 * np.pi * 3000.0 * since)
    >>> found = br.spectra.kurtogram(impacts + 0.3 * rng.normal(size=t.size), fs, narrowest=500.0)
    >>> low, high = found.best
    >>> low < 3000.0 < high
    True
    """
    signal, fs = given_signal(x, fs)
    if signal.size < 4 * _FEWEST:
        raise SceneError("x", f"{signal.size} samples", f"at least {4 * _FEWEST}")
    if narrowest is not None and not 0.0 < real(narrowest) <= fs / 2.0:
        raise SceneError("narrowest", repr(narrowest), f"above 0 and up to fs/2, {fs / 2.0:g}")
    parts = min(signal.size / 2 / _FEWEST, math.inf if narrowest is None else fs / 2 / narrowest)
    # The middle of 0 to fs/2 is moved to zero, and every other sample then holds all.
    middle = np.exp(-0.5j * math.pi * np.arange(signal.size))
    varying = signal - signal.mean()
    if not np.abs(varying).max() > math.sqrt(_SILENT) * np.abs(signal).max():
        varying = np.zeros_like(signal)
    whole = (scipy.signal.hilbert(varying) * middle)[::2]
    rows = [(1, [whole]), *_levels([whole], 1, parts)]
    return _collected(sorted(rows, key=lambda row: row[0]), fs, varying)


@answers_ctrl_c
def spectral_kurtosis(
    x: Given, fs: float | None = None, length: int | None = None, false_alarm: float = 0.01
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Return the kurtosis of a signal at each frequency, and what chance seldom exceeds.

    Over pieces of the signal under a Hann window, each half over the next one: the mean fourth power of the
    transform's magnitude over the square of that of its second, less 2 (J. Antoni, *The spectral kurtosis: a
    useful tool for characterising non-stationary signals*, Mech. Syst. Signal Process. 20 (2006) 282). Of Gaussian
    noise it is 0, of a tone −1; it scatters with a long tail above, so what chance exceeds comes from as many
    pieces of white noise and not from a normal distribution.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    length : int, optional
        Samples of a piece, at most a 16th of the signal: longer than impacts ring, shorter than their distance. By
        default a 64th.
    false_alarm : float
        Share of frequencies at which Gaussian noise exceeds the limit, 0.001 to 0.2.

    Returns
    -------
    f : ndarray, shape (m,)
        Frequencies between 0 and fs/2 [Hz].
    value : ndarray, shape (m,)
        Kurtosis; 0 where there is nothing.
    limit : float
        Kurtosis that stationary Gaussian noise exceeds at that share of frequencies.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    Impacts that ring at 3 kHz, in noise:

    >>> fs, rng = 16_000.0, np.random.default_rng(1)
    >>> since = (np.arange(64_000) / fs) % 0.03
    >>> impacts = np.exp(-800.0 * since) * np.sin(2 * np.pi * 3000.0 * since)
    >>> f, value, limit = spectral_kurtosis(impacts + 0.3 * rng.normal(size=since.size), fs, length=128)
    >>> bool(abs(f[np.argmax(value)] - 3000.0) < 200.0), bool(value.max() > limit)
    (True, True)
    """
    signal, fs = given_signal(x, fs)
    samples = piece_length(signal, length, 64, 16)
    if not 1e-3 <= real(false_alarm) <= 0.2:
        raise SceneError("false_alarm", repr(false_alarm), "a share of frequencies, 0.001 to 0.2")
    value = _by_pieces(signal - signal.mean(), samples)
    limit = float(np.quantile(_by_chance(signal.size, samples), 1.0 - real(false_alarm)))
    # At 0 and fs/2 transforms are real and their kurtosis another.
    f: NDArray[np.float64] = np.arange(1, value.size + 1, dtype=np.float64) * (fs / samples)
    return f, value, limit


@functools.lru_cache(maxsize=8)
def _by_chance(size: int, samples: int) -> NDArray[np.float64]:
    """Return kurtoses of white noise of as many samples, in the same pieces."""
    rng = np.random.default_rng(0)
    draws = -(-_DRAWN // ((samples + 1) // 2 - 1))
    return np.concatenate([_by_pieces(rng.normal(size=size), samples) for _ in range(draws)])


def _by_pieces(x: NDArray[np.float64], samples: int) -> NDArray[np.float64]:
    """Return the kurtosis at the frequencies between 0 and fs/2 of pieces of a signal."""
    power = np.abs(transforms(x, samples)[:, 1 : (samples + 1) // 2]) ** 2
    mean = power.mean(axis=0)
    least = _SILENT * float(mean.max(initial=0.0))
    square = np.mean(power**2, axis=0)
    ratio: NDArray[np.float64] = np.full_like(mean, 2.0)
    np.divide(square, mean**2, out=ratio, where=mean > least)
    return ratio - 2.0


def _levels(bands: list[Complex], count: int, most: float) -> Iterator[tuple[int, list[Complex]]]:
    """Give the levels below one of ``count`` bands: halves and their halves, and thirds of each but the last."""
    if 3 * count <= most:
        yield 3 * count, [part for band in bands for part in _split(band, 3)]
    if 2 * count <= most:
        halves = [part for band in bands for part in _split(band, 2)]
        yield 2 * count, halves
        yield from _levels(halves, 2 * count, most)


def _split(band: Complex, parts: int) -> list[Complex]:
    """Split a band around zero into equal ones, the lowest first, each moved to zero and decimated."""
    taps = _TAPS * parts // 2 + 1
    low_pass = scipy.signal.firwin(taps, 1.0 / parts)
    found = []
    for part in range(parts):
        centre = (part - (parts - 1) / 2) / parts
        moved = band * np.exp(-2j * math.pi * centre * np.arange(band.size))
        # Without the ends, where the filter reaches beyond the record.
        found.append(
            scipy.signal.upfirdn(low_pass, moved, down=parts)[taps // parts : band.size // parts]
        )
    return found


def _collected(
    rows: list[tuple[int, list[Complex]]], fs: float, signal: NDArray[np.float64]
) -> Kurtogram:
    counts = np.array([count for count, bands in rows for _ in bands])
    place = np.array([place for _, bands in rows for place in range(len(bands))])
    return Kurtogram(
        level=np.log2(counts),
        low=place / counts * (fs / 2.0),
        high=(place + 1) / counts * (fs / 2.0),
        kurtosis=np.array([_kurtosis(band) for _, bands in rows for band in bands]),
        has_power=_has_power(rows, counts, place, signal),
    )


def _has_power(
    rows: list[tuple[int, list[Complex]]],
    counts: NDArray[np.int64],
    place: NDArray[np.int64],
    signal: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Compare the power of each band in the signal's spectrum with what the filters let through."""
    # Of the largest, so that powers of faint signals do not vanish.
    largest = float(np.abs(rows[0][1][0]).max(initial=0.0)) or 1.0
    power = np.abs(np.fft.rfft(signal / largest * np.hanning(signal.size))) ** 2
    until = np.append(0.0, np.cumsum(power))
    edges = [np.rint((place + side) / counts * power.size).astype(int) for side in (0, 1)]
    own = (until[edges[1]] - until[edges[0]]) / (until[-1] or 1.0)
    passed = np.array([np.mean((np.abs(z) / largest) ** 2) for _, bands in rows for z in bands])
    found: NDArray[np.bool_] = (own > _FAINT / counts) & (own > _OWN * passed / (passed[0] or 1.0))
    return found


def _kurtosis(z: Complex) -> float:
    largest = float(np.abs(z).max(initial=0.0))
    # Silence has none: not above that of noise.
    if largest == 0.0:
        return 0.0
    # Of the largest, so that powers of faint signals do not vanish.
    power = (z.real / largest) ** 2 + (z.imag / largest) ** 2
    return float(np.mean(power**2)) / float(np.mean(power)) ** 2 - 2.0
