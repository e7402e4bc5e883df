"""The fast kurtogram: in which band a signal is most impulsive.

A blow rings for a short time at the frequencies of the structure. In a band that holds this ringing and little
else, the signal is high for short times, so that the kurtosis of its complex envelope is large: the mean of its
fourth power over the square of that of its second, less 2. Of Gaussian noise it is 0, of a tone −1. The bands are
those of a 1/3-binary tree: the frequencies from 0 to fs/2 in 1, 2, 3, 4, 6, 8, 12, … equal parts, each by filter
and decimation from what is above it (J. Antoni, *Fast computation of the kurtogram for the detection of transient
faults*, Mech. Syst. Signal Process. 21 (2007) 108).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .._interrupt import answers_ctrl_c
from .._numbers import real
from ..errors import SceneError
from .checks import given_signal

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .checks import Given

    Complex = NDArray[np.complex128]

__all__ = ["Kurtogram", "kurtogram"]

_TAPS = 16
"""Order of the filter that halves a band; as in the paper. One that takes a third has half as much again."""

_FEWEST = 64
"""Samples of an envelope, at least, by which its kurtosis is told."""


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
    """

    level: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    kurtosis: NDArray[np.float64]

    @property
    def best(self) -> tuple[float, float]:
        """Edges of the band with the highest kurtosis [Hz]: the ``band`` of an envelope."""
        at = int(np.argmax(self.kurtosis))
        return float(self.low[at]), float(self.high[at])

    @property
    def highest(self) -> float:
        """The highest kurtosis, that of the best band."""
        return float(self.kurtosis.max())


@answers_ctrl_c
def kurtogram(x: Given, fs: float | None = None, narrowest: float | None = None) -> Kurtogram:
    """Return the fast kurtogram of a signal.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record ``outer.ay`` if there is one, else its first column.
    fs : float, optional
        Sampling rate of an array [Hz].
    narrowest : float, optional
        Width that no band is below [Hz]. The envelope of a band holds lines up to its width, so ask for some
        multiples of the highest rate that is looked for. By default bands are halved as long as their
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
    Blows that ring at 3 kHz, in noise:

    >>> import ballrace as br
    >>> fs, rng = 16_000.0, np.random.default_rng(1)
    >>> t = np.arange(32_000) / fs
    >>> since = t % 0.01
    >>> blows = np.exp(-800.0 * since) * np.sin(2 * np.pi * 3000.0 * since)
    >>> found = br.spectra.kurtogram(blows + 0.3 * rng.normal(size=t.size), fs, narrowest=500.0)
    >>> low, high = found.best
    >>> low < 3000.0 < high
    True
    """
    from scipy.signal import hilbert

    signal, fs = given_signal(x, fs)
    if signal.size < 4 * _FEWEST:
        raise SceneError("x", f"{signal.size} samples", f"at least {4 * _FEWEST}")
    if narrowest is not None and not 0.0 < real(narrowest) <= fs / 2.0:
        raise SceneError("narrowest", repr(narrowest), f"above 0 and up to fs/2, {fs / 2.0:g}")
    parts = min(signal.size / 2 / _FEWEST, math.inf if narrowest is None else fs / 2 / narrowest)
    # The middle of 0 to fs/2 is moved to zero, and every other sample then holds all.
    middle = np.exp(-0.5j * math.pi * np.arange(signal.size))
    whole = (hilbert(signal - signal.mean()) * middle)[::2]
    rows = [(1, [whole]), *_levels([whole], 1, parts)]
    return _collected(sorted(rows, key=lambda row: row[0]), fs)


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
    from scipy.signal import firwin, upfirdn

    taps = _TAPS * parts // 2 + 1
    low_pass = firwin(taps, 1.0 / parts)
    found = []
    for part in range(parts):
        centre = (part - (parts - 1) / 2) / parts
        moved = band * np.exp(-2j * math.pi * centre * np.arange(band.size))
        # Without the ends, where the filter reaches beyond the record.
        found.append(upfirdn(low_pass, moved, down=parts)[taps // parts : band.size // parts])
    return found


def _collected(rows: list[tuple[int, list[Complex]]], fs: float) -> Kurtogram:
    counts = np.array([count for count, bands in rows for _ in bands])
    place = np.array([place for _, bands in rows for place in range(len(bands))])
    return Kurtogram(
        level=np.log2(counts),
        low=place / counts * (fs / 2.0),
        high=(place + 1) / counts * (fs / 2.0),
        kurtosis=np.array([_kurtosis(band) for _, bands in rows for band in bands]),
    )


def _kurtosis(z: Complex) -> float:
    largest = float(np.abs(z).max(initial=0.0))
    # Silence has none: not above that of noise.
    if largest == 0.0:
        return 0.0
    # Of the largest, so that powers of faint signals do not vanish.
    power = (z.real / largest) ** 2 + (z.imag / largest) ** 2
    return float(np.mean(power**2)) / float(np.mean(power)) ** 2 - 2.0
