"""Spectra made flat, so that the strongest tone or resonance does not hide what is weak."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._base.interrupt import answers_ctrl_c
from .._base.libraries import scipy
from .._base.numbers import real
from ..errors import SceneError
from .checks import given_signal

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .checks import Given

_FAINT = 1e-12
"""Part of the largest amplitude below which a spectrum holds rounding alone: such frequencies stay silent."""


@answers_ctrl_c
def prewhitened(
    x: Given, fs: float | None = None, *, width: float | None = None
) -> NDArray[np.float64]:
    """Return a signal whose spectrum is flat, its phases as they were.

    By default prewhitening by the cepstrum with all of it but zero quefrency set to zero, so that every amplitude
    is one (P. Borghesani, P. Pennacchi, R. B. Randall, N. Sawalhi, R. Ricci, Mech. Syst. Signal Process. 36 (2013)
    370): tones of shaft and gears and resonances of the structure weigh no more than anything else, and impacts
    stand out; but impacts without any slip, as simulated ones may be, are tones as well. With a width, only
    features of the spectrum wider than it are made flat.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    width : float, optional
        Width of the running root mean square that the spectrum is divided by [Hz]; by default each amplitude is
        divided by itself.

    Returns
    -------
    ndarray, shape (n,)
        Mean 0 and variance 1; silence stays silence.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    A single impact under a tone a hundred times as high:

    >>> t = np.arange(4096) / 4096.0
    >>> x = 100.0 * np.sin(2 * np.pi * 64.0 * t)
    >>> x[1000] += 1.0
    >>> int(np.argmax(np.abs(prewhitened(x, 4096.0))))
    1000
    """
    signal, fs = given_signal(x, fs)
    if width is not None and not 0.0 < real(width) <= fs / 2.0:
        raise SceneError("width", repr(width), f"a width, up to fs/2, {fs / 2.0:g}, or None")
    bins = None if width is None else width * signal.size / fs
    flat = flattened(np.fft.rfft(signal - signal.mean()), bins)
    white = np.fft.irfft(flat, signal.size)
    deviation = float(white.std())
    return white / deviation if deviation > 0.0 else white


def flattened(
    spectrum: NDArray[np.complex128], bins: float | None = None
) -> NDArray[np.complex128]:
    """Return a spectrum over its amplitude, or over the running root mean square of some bins; nothing stays 0."""
    amplitude = np.abs(spectrum)
    largest = amplitude.max(initial=0.0)
    if bins is not None:
        amplitude = np.sqrt(
            np.abs(scipy.ndimage.uniform_filter1d(amplitude**2, max(round(bins), 1)))
        )
    present = amplitude > _FAINT * largest
    return np.divide(spectrum, amplitude, out=np.zeros_like(spectrum), where=present)
