"""Spectra made flat, so that the loudest tone or resonance does not hide what is faint."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._interrupt import answers_ctrl_c
from .checks import given_signal

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .checks import Given

__all__ = ["prewhitened"]

_FAINT = 1e-12
"""Part of the largest amplitude below which a spectrum holds rounding alone: such frequencies stay silent."""


@answers_ctrl_c
def prewhitened(x: Given, fs: float | None = None) -> NDArray[np.float64]:
    """Return a signal whose spectrum has one amplitude everywhere, its phases as they were.

    Prewhitening by the cepstrum with all of it but zero quefrency set to zero (P. Borghesani, P. Pennacchi, R. B.
    Randall, N. Sawalhi, R. Ricci, Mech. Syst. Signal Process. 36 (2013) 370): tones of shaft and gears and
    resonances of the structure weigh no more than anything else, and blows stand out.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal.
    fs : float, optional
        Sampling rate of an array [Hz]; it has no influence here.

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
    A single blow under a tone a hundred times as high:

    >>> t = np.arange(4096) / 4096.0
    >>> x = 100.0 * np.sin(2 * np.pi * 64.0 * t)
    >>> x[1000] += 1.0
    >>> int(np.argmax(np.abs(prewhitened(x, 4096.0))))
    1000
    """
    signal, _ = given_signal(x, 1.0 if fs is None and not hasattr(x, "fs") else fs)
    flat = flattened(np.fft.rfft(signal - signal.mean()))
    white = np.fft.irfft(flat, signal.size)
    deviation = float(white.std())
    return white / deviation if deviation > 0.0 else white


def flattened(spectrum: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return a spectrum of amplitude 1 with the phases of another; what it does not hold stays 0."""
    amplitude = np.abs(spectrum)
    heard = amplitude > _FAINT * amplitude.max(initial=0.0)
    return np.divide(spectrum, amplitude, out=np.zeros_like(spectrum), where=heard)
