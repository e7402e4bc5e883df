"""Envelopes of a band of a signal, and their spectra.

A defect excites bursts: each impact rings at the frequencies of the structure, and the impacts come at the
rate of the defect. The squared envelope keeps the impacts without the ringing, and its
spectrum has lines at the rate of the impacts and its multiples (J. Antoni, R. B. Randall, *The spectral
kurtosis*, Mech. Syst. Signal Process. 20 (2006) 308, on the squared envelope in particular).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .. import _core
from .._base.interrupt import answers_ctrl_c
from .checks import checked_band, given_signal
from .lines import spectrum

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .checks import Given

_FAINT = 1e-12
"""Part of the mean squared envelope below which no logarithm is taken."""


@answers_ctrl_c
def squared_envelope(
    x: Given, fs: float | None = None, band: tuple[float, float] | None = None
) -> NDArray[np.float64]:
    """Return the squared envelope of a signal in a band: the square of its analytic signal's magnitude.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    band : tuple of two floats, optional
        Lowest and highest frequency [Hz] that count; by default all. The edges are sharp, so the first and
        the last few periods of the lower edge carry the filter's ringing.

    Returns
    -------
    ndarray, shape (n,)
        Squared envelope, in the unit of ``x`` squared.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> t = np.arange(1000) / 1000.0
    >>> burst = (1.0 + 0.5 * np.cos(2 * np.pi * 7.0 * t)) * np.sin(2 * np.pi * 200.0 * t)
    >>> found = squared_envelope(burst, 1000.0, band=(150.0, 250.0))
    >>> bool(np.allclose(found, (1.0 + 0.5 * np.cos(2 * np.pi * 7.0 * t)) ** 2))
    True
    """
    signal, fs = given_signal(x, fs)
    checked = None if band is None else checked_band(band, fs)
    return _core.squared_envelope(signal, fs, checked)


def squared_envelope_spectrum(
    x: Given, fs: float | None = None, band: tuple[float, float] | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the spectrum of the squared envelope of a signal in a band.

    Parameters
    ----------
    x, fs, band
        As for :func:`squared_envelope`.

    Returns
    -------
    f : ndarray
        Frequencies, from 0 to fs/2 [Hz].
    value : ndarray
        Amplitudes, in the unit of ``x`` squared.

    Examples
    --------
    The square of ``1 + 0.5 cos`` has a line of height 1 at its frequency, and one of 0.125 at twice that:

    >>> t = np.arange(1000) / 1000.0
    >>> burst = (1.0 + 0.5 * np.cos(2 * np.pi * 20.0 * t)) * np.sin(2 * np.pi * 200.0 * t)
    >>> f, value = squared_envelope_spectrum(burst, 1000.0)
    >>> value[[20, 40]].round(3).tolist()
    [1.0, 0.125]
    """
    signal, fs = given_signal(x, fs)
    return spectrum(squared_envelope(signal, fs, band), fs)


def log_envelope_spectrum(
    x: Given, fs: float | None = None, band: tuple[float, float] | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the spectrum of the logarithm of the squared envelope of a signal in a band.

    A few large impacts of something else fill all lines of a squared envelope; of its logarithm they are a few
    samples among many (P. Borghesani, J. Antoni, Mech. Syst. Signal Process. 90 (2017) 378).

    Parameters
    ----------
    x, fs, band
        As for :func:`squared_envelope`.

    Returns
    -------
    f : ndarray
        Frequencies, from 0 to fs/2 [Hz].
    value : ndarray
        Amplitudes of the natural logarithm, whatever the unit of ``x``; 0 of silence.

    Examples
    --------
    The logarithm of the square of exp(0.3 cos) is 0.6 cos:

    >>> t = np.arange(1000) / 1000.0
    >>> burst = np.exp(0.3 * np.cos(2 * np.pi * 20.0 * t)) * np.sin(2 * np.pi * 200.0 * t)
    >>> f, value = log_envelope_spectrum(burst, 1000.0)
    >>> value[[20, 40]].round(3).tolist()
    [0.6, 0.0]
    """
    signal, fs = given_signal(x, fs)
    power = squared_envelope(signal, fs, band)
    mean = float(power.mean())
    if mean == 0.0:
        return spectrum(power, fs)
    return spectrum(np.log(np.maximum(power / mean, _FAINT)), fs)


def envelope_spectrum(
    x: Given, fs: float | None = None, band: tuple[float, float] | None = None, squared: bool = True
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the spectrum of the envelope of a signal in a band.

    Parameters
    ----------
    x, fs, band
        As for :func:`squared_envelope`.
    squared : bool
        True takes the squared envelope, as :func:`squared_envelope_spectrum` does; False its root, as MATLAB's
        ``envspectrum`` does, whose lines are in the unit of ``x`` and which weighs single large impacts less.

    Returns
    -------
    f : ndarray
        Frequencies, from 0 to fs/2 [Hz].
    value : ndarray
        Amplitudes, in the unit of ``x``, squared if the envelope is.

    Examples
    --------
    >>> t = np.arange(1000) / 1000.0
    >>> burst = (1.0 + 0.5 * np.cos(2 * np.pi * 20.0 * t)) * np.sin(2 * np.pi * 200.0 * t)
    >>> f, value = envelope_spectrum(burst, 1000.0, squared=False)
    >>> f[np.argmax(value)].item(), round(value.max().item(), 3)
    (20.0, 0.5)
    """
    if squared:
        return squared_envelope_spectrum(x, fs, band)
    signal, fs = given_signal(x, fs)
    return spectrum(np.sqrt(squared_envelope(signal, fs, band)), fs)
