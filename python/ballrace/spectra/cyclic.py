"""Cyclic coherence: what repeats at a rate without being a tone, in every band by itself.

Noise whose power varies at a rate α, as that of impacts with random slip, has correlated components f + α/2 and f
− α/2. Over many pieces of the signal their coherence measures it independently of the level in the band, so that
neither resonances nor a sloping spectrum matter (J. Antoni, *Cyclic spectral analysis in practice*, Mech. Syst.
Signal Process. 21 (2007) 597). Its mean over a band is the improved envelope spectrum (D. Abboud, M. Elbadaoui, W.
A. Smith, R. B. Randall, Mech. Syst. Signal Process. 114 (2019) 604).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._base.interrupt import answers_ctrl_c
from .._base.numbers import real_row
from ..errors import SceneError
from .checks import checked_band, given_signal
from .pieces import piece_length, transforms

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .checks import Given

_PIECES = 64
"""Pieces, each half over the next one, that a signal is cut into by default."""


@answers_ctrl_c
def cyclic_coherence(
    x: Given, rates: ArrayLike, fs: float | None = None, length: int | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the squared magnitude of the cyclic coherence of a signal at some rates.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    rates : array_like, shape (k,)
        Cyclic frequencies, above 0 and below fs/2 [Hz]; a record of ``T`` seconds resolves those 1/T apart.
    fs : float, optional
        Sampling rate of an array [Hz].
    length : int, optional
        Samples of a piece; its frequencies are fs/length apart, which should be above the rates. By default a
        64th of the signal.

    Returns
    -------
    f : ndarray, shape (m,)
        Frequencies, from 0 to fs/2 [Hz]: the higher one of each pair, the other being a rate below it.
    value : ndarray, shape (k, m)
        From 0 to 1; for noise without modulation on average one over the number of pieces.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    White noise times 1 + cos: its power has lines of 2/3 and 1/6 of its mean, and its coherence is their square.

    >>> t = np.arange(100_000) / 1000.0
    >>> x = (1.0 + np.cos(2 * np.pi * 7.0 * t)) * np.random.default_rng(1).normal(size=t.size)
    >>> f, value = cyclic_coherence(x, [7.0, 14.0, 9.0], 1000.0, length=128)
    >>> value[:, 5:60].mean(axis=1).round(2).tolist()
    [0.44, 0.03, 0.0]
    """
    signal, fs = given_signal(x, fs)
    wanted = _checked_rates(rates, fs)
    samples = piece_length(signal, length, _PIECES, 4)
    signal = signal - signal.mean()
    here = transforms(signal, samples)
    power = np.mean(np.abs(here) ** 2, axis=0)
    turns = np.arange(signal.size) / fs
    value = np.empty((wanted.size, power.size))
    for row, rate in zip(value, wanted, strict=True):
        below = transforms(signal * np.exp(2j * np.pi * rate * turns), samples)[:, : power.size]
        both = np.abs(np.mean(here * below.conj(), axis=0)) ** 2
        least = power * np.mean(np.abs(below) ** 2, axis=0)
        row[:] = np.divide(both, least, out=np.zeros_like(both), where=least > 0.0)
    f: NDArray[np.float64] = np.arange(power.size) * (fs / samples)
    return f, value


def improved_envelope_spectrum(
    x: Given,
    rates: ArrayLike,
    fs: float | None = None,
    band: tuple[float, float] | None = None,
    length: int | None = None,
) -> NDArray[np.float64]:
    """Return the improved envelope spectrum at some rates: the cyclic coherence, squared, over a band.

    Parameters
    ----------
    x, rates, fs, length
        As for :func:`cyclic_coherence`.
    band : tuple of two floats, optional
        Lowest and highest frequency [Hz] that count; by default all from the highest rate on.

    Returns
    -------
    ndarray, shape (k,)
        Mean over the band, from 0 to 1.

    Raises
    ------
    SceneError
        An argument is not usable, or no frequency lies in the band.

    Examples
    --------
    >>> t = np.arange(100_000) / 1000.0
    >>> x = (1.0 + np.cos(2 * np.pi * 7.0 * t)) * np.random.default_rng(1).normal(size=t.size)
    >>> improved_envelope_spectrum(x, [7.0, 9.0], 1000.0, length=128).round(2).tolist()
    [0.44, 0.0]
    """
    signal, fs = given_signal(x, fs)
    low, high = (
        (_checked_rates(rates, fs).max(), fs / 2.0) if band is None else checked_band(band, fs)
    )
    f, value = cyclic_coherence(signal, rates, fs, length)
    inside = (f >= low) & (f <= high)
    if not inside.any():
        raise SceneError("band", repr(band), f"wide enough for frequencies {f[1]:g} Hz apart")
    mean: NDArray[np.float64] = value[:, inside].mean(axis=1)
    return mean


def _checked_rates(rates: ArrayLike, fs: float) -> NDArray[np.float64]:
    wanted = np.atleast_1d(real_row("rates", rates))
    if wanted.ndim != 1 or not wanted.size or not ((wanted > 0.0) & (wanted < fs / 2.0)).all():
        raise SceneError("rates", repr(rates), f"rates above 0 and below fs/2, {fs / 2.0:g}")
    return wanted
