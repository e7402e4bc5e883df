"""Tones and what is not a tone, taken apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._base.interrupt import answers_ctrl_c
from .._base.libraries import scipy
from .checks import given_signal
from .pieces import piece_length

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .checks import Given

_PIECES = 32
"""Pieces that a signal is cut into by default."""


@answers_ctrl_c
def separated(
    x: Given, fs: float | None = None, *, length: int | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the tones of a signal and the rest, by discrete/random separation.

    Tones of shaft, gears or mains can be predicted from an earlier piece of the signal; impacts with random slip
    and noise cannot. Over pieces with one between them, the transfer function from the earlier one to the later is
    near 1 at tones and near 0 elsewhere, and its magnitude is the filter (J. Antoni, R. B. Randall, *Unsupervised
    noise cancellation for vibration signals: part II*, Mech. Syst. Signal Process. 18 (2004) 103). Impacts without
    slip, as simulated ones may be, are tones as well.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    length : int, optional
        Samples of a piece: it has to be longer than impacts ring, and resolves tones some fs/length apart. By
        default a 32nd of the signal.

    Returns
    -------
    tones, rest : ndarray, shape (n,)
        Their sum is the signal. In the tones remains a share of the noise: its power over the root of the number
        of pieces.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> t = np.arange(64_000) / 1000.0
    >>> tone, noise = np.sin(2 * np.pi * 60.0 * t), np.random.default_rng(1).normal(size=t.size)
    >>> tones, rest = separated(tone + noise, 1000.0, length=1000)
    >>> bool(np.std(tones - tone) < 0.2), bool(np.allclose(tones + rest, tone + noise))
    (True, True)
    """
    signal, fs = given_signal(x, fs)
    samples = piece_length(signal, length, _PIECES, 4)
    window = scipy.signal.windows.hann(samples, sym=False)
    step = max(samples // 4, 1)
    cut = np.lib.stride_tricks.sliding_window_view(signal, samples)[::step]
    pieces = np.fft.rfft(cut * window)
    # One piece lies between the two whose transfer function is asked for.
    apart = 2 * samples // step
    earlier, later = pieces[:-apart], pieces[apart:]
    power = np.mean(np.abs(earlier) ** 2, axis=0)
    cross = np.abs(np.mean(later * earlier.conj(), axis=0))
    gain = np.divide(cross, power, out=np.zeros_like(power), where=power > 0.0)
    transform = scipy.signal.ShortTimeFFT(window, step, fs)
    spectra = transform.stft(signal) * np.minimum(gain, 1.0)[:, np.newaxis]
    tones: NDArray[np.float64] = transform.istft(spectra, k1=signal.size)
    return tones, signal - tones
