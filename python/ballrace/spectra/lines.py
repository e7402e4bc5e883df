"""Amplitude spectra, and the frequencies of lines to a fraction of a bin.

All functions take plain arrays, remove the mean, weigh with a Hann window and give amplitudes: a sine of
amplitude 2 has a line of height 2. Lines nearer to each other than four over the length of the record
[1/s] flow together.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._base.interrupt import answers_ctrl_c
from .._base.numbers import finite
from ..errors import SceneError
from .checks import given_signal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from .checks import Given


@answers_ctrl_c
def spectrum(x: Given, fs: float | None = None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the amplitude spectrum of a signal.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].

    Returns
    -------
    f : ndarray
        Frequencies, from 0 to fs/2 [Hz].
    value : ndarray
        Amplitudes, in the unit of ``x``.

    Examples
    --------
    >>> f, value = spectrum(2.0 * np.sin(2 * np.pi * 50.0 * np.arange(1000) / 1000.0), 1000.0)
    >>> at = int(np.argmax(value))
    >>> float(f[at]), round(float(value[at]), 3)
    (50.0, 2.0)
    """
    signal, fs = given_signal(x, fs)
    f = np.fft.rfftfreq(signal.size, 1.0 / fs)
    return f.astype(np.float64, copy=False), _core.amplitudes(signal, signal.size)


def line(
    x: Given, fs: float | None = None, near: float = math.nan, width: float = math.nan
) -> tuple[float, float]:
    """Find the strongest line near a frequency, between the bins.

    The maximum of the Hann-weighted Fourier transform at any frequency, not only at multiples of fs/n. For
    a lone sine in white noise it is, but for the window's loss of a factor 1.1 or so, the estimate of
    maximum likelihood (D. C. Rife, R. R. Boorstyn, IEEE Trans. Inf. Theory 20 (1974) 591).

    Parameters
    ----------
    x : array_like, shape (n,)
        Signal; to find a line of the squared envelope, the envelope itself.
    fs : float
        Sampling rate [Hz].
    near, width : float
        The line is sought from ``near - width`` to ``near + width`` [Hz]; both have to be given.

    Returns
    -------
    f : float
        Frequency [Hz].
    value : float
        Amplitude, in the unit of ``x``.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    A line between two bins, which are 1 Hz apart:

    >>> t = np.arange(1000) / 1000.0
    >>> f, value = line(3.0 * np.sin(2 * np.pi * 50.37 * t), 1000.0, near=52.0, width=5.0)
    >>> round(f, 4), round(value, 3)
    (50.37, 3.0)
    """
    f, values = comb(x, fs, near, width)
    return f, float(values[0])


@answers_ctrl_c
def comb(
    x: Given,
    fs: float | None = None,
    near: float = math.nan,
    width: float = math.nan,
    *,
    orders: Iterable[int] = (1,),
    offset: float = 0.0,
) -> tuple[float, NDArray[np.float64]]:
    """Find the frequency whose multiples are the strongest family of lines.

    All lines are fitted at once, the sum of their squared amplitudes as large as it gets, so the higher ones
    make the frequency sharper.

    Parameters
    ----------
    x, fs
        As for :func:`line`.
    near, width : float
        The frequency is sought from ``near - width`` to ``near + width`` [Hz]; both have to be given.
    orders : iterable of int
        The lines stand at these multiples.
    offset : float
        Distance of all lines from the multiples [Hz]: sidebands.

    Returns
    -------
    f : float
        The frequency [Hz].
    value : ndarray, one entry an order
        Amplitudes of the lines, in the unit of ``x``.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> t = np.arange(2000) / 1000.0
    >>> x = sum(np.cos(2 * np.pi * k * 20.123 * t) / k for k in (1, 2, 3))
    >>> f, value = comb(x, 1000.0, near=20.0, width=1.0, orders=(1, 2, 3))
    >>> round(f, 3), value.round(2).tolist()
    (20.123, [1.0, 0.5, 0.33])
    """
    signal, fs = given_signal(x, fs)
    multiples = sorted(set(orders))
    if not multiples or multiples[0] < 1:
        raise SceneError("orders", str(orders), "at least one, from 1")
    near, width = finite("near", near, "Hz"), finite("width", width, "Hz")
    low, high = near - width, near + width
    if not (width > 0.0 and multiples[0] * low + offset > 0.0):
        raise SceneError("width", str(width), "above 0, and lines at positive frequencies")
    if multiples[-1] * high + offset > fs / 2.0:
        raise SceneError("near", str(near), f"lines up to fs/2, {fs / 2.0:g}")

    padded = 4 * signal.size
    power = _core.amplitudes(signal, padded) ** 2
    table = np.fft.rfftfreq(padded, 1.0 / fs)
    step = fs / (padded * multiples[-1])
    grid = np.linspace(low, high, max(3, math.ceil((high - low) / step) + 1))
    sums = sum(np.interp(k * grid + offset, table, power) for k in multiples)
    found = float(grid[int(np.argmax(sums))])

    weighted = _core.hann_weighted(signal)
    t = (np.arange(signal.size) - signal.size / 2.0) / fs

    def amplitude(f: float) -> float:
        phase = 2.0 * np.pi * f * t
        return math.hypot(np.sum(weighted * np.cos(phase)), np.sum(weighted * np.sin(phase)))

    def strength(f: float) -> float:
        return sum(amplitude(k * f + offset) ** 2 for k in multiples)

    for span in (step, 0.1 * step, 0.01 * step):
        found = min(max(_summit(strength, found, span), low), high)
    return found, np.array([amplitude(k * found + offset) for k in multiples])


def floor(
    f: NDArray[np.float64], value: NDArray[np.float64], at: float, width: float
) -> tuple[float, float]:
    """Return what a spectrum has around a frequency besides its lines: the median.

    Parameters
    ----------
    f, value : ndarray
        A spectrum.
    at, width : float
        The frequencies from ``at - width`` to ``at + width`` count [Hz].

    Returns
    -------
    f : float
        ``at`` [Hz].
    value : float
        Median, in the unit of the spectrum.

    Raises
    ------
    SceneError
        The spectrum has nothing there.

    Examples
    --------
    >>> f = np.arange(5.0)
    >>> floor(f, np.array([1.0, 1.0, 9.0, 1.0, 1.0]), at=2.0, width=2.0)
    (2.0, 1.0)
    """
    at, width = finite("at", at, "Hz"), finite("width", width, "Hz")
    near = (f >= at - width) & (f <= at + width)
    if not near.any():
        raise SceneError("at", str(at), "within the spectrum, and width above its resolution")
    return at, float(np.median(value[near]))


def _summit(function: Callable[[float], float], middle: float, span: float) -> float:
    """Return the summit of the parabola through three values, within the span."""
    left, centre, right = (function(middle + shift) for shift in (-span, 0.0, span))
    bend = left - 2.0 * centre + right
    if bend >= 0.0:
        return middle
    return middle + span * min(max(0.5 * (left - right) / bend, -1.0), 1.0)
