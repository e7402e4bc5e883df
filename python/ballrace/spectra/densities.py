"""Power spectral densities, over the whole record and in time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._base.interrupt import answers_ctrl_c
from .._base.libraries import scipy
from ..errors import SceneError
from .checks import checked_length, given_signal

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .checks import Given


@answers_ctrl_c
def psd(
    x: Given, fs: float | None = None, length: int | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the one-sided power spectral density after Welch, by :func:`scipy.signal.welch`.

    Hann windows that overlap by half, each without its mean. Its integral over the frequencies is the variance
    of the signal.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    length : int, optional
        Samples of a window; by default that of eight windows along the record. The resolution is fs/length.

    Returns
    -------
    f : ndarray
        Frequencies, from 0 to fs/2 [Hz].
    value : ndarray
        Density, in the unit of ``x`` squared by hertz.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    White noise of variance 4 spreads it over 0 to 500 Hz:

    >>> import numpy as np
    >>> noise = 2.0 * np.random.default_rng(1).normal(size=50_000)
    >>> f, value = psd(noise, 1000.0)
    >>> round(float(np.mean(value)), 3)
    0.008
    """
    signal, fs = given_signal(x, fs)
    samples = checked_length("length", length, max(2 * signal.size // 9, 2), signal.size)
    return scipy.signal.welch(signal, fs, nperseg=samples)  # type: ignore[no-any-return]


@answers_ctrl_c
def spectrogram(
    x: Given, fs: float | None = None, length: int | None = None, hop: int | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return the power spectral density in time, by :class:`scipy.signal.ShortTimeFFT`.

    Hann windows, none of which reaches beyond the record. Of a signal over the shaft's angle (:func:`by_order`),
    with its samples a turn as ``fs``, it is an order map: orders over turns.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    length : int, optional
        Samples of a window; by default the root of 4 n, which resolves times and frequencies alike.
    hop : int, optional
        Samples from one window to the next; by default a quarter of ``length``.

    Returns
    -------
    f : ndarray, shape (m,)
        Frequencies, from 0 to fs/2 [Hz].
    t : ndarray, shape (k,)
        Times of the windows' middles, from the first sample [s].
    value : ndarray, shape (m, k)
        Density, in the unit of ``x`` squared by hertz.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    A tone that rises from 100 to 300 Hz in 4 s:

    >>> import numpy as np
    >>> t = np.arange(4000) / 1000.0
    >>> f, t, value = spectrogram(np.sin(2 * np.pi * (100.0 + 25.0 * t) * t), 1000.0)
    >>> highest = f[np.argmax(value, axis=0)]
    >>> bool(np.all(np.abs(highest - (100.0 + 50.0 * t)) < f[1]))
    True
    """
    signal, fs = given_signal(x, fs)
    samples = checked_length("length", length, round((4 * signal.size) ** 0.5), signal.size)
    if samples < 4:
        raise SceneError("length", str(samples), "at least 4 samples")
    step = checked_length("hop", hop, max(samples // 4, 1), samples)
    transform = scipy.signal.ShortTimeFFT(
        scipy.signal.windows.hann(samples, sym=False),
        step,
        fs,
        fft_mode="onesided2X",
        scale_to="psd",
    )
    span = transform.lower_border_end[1], transform.upper_border_begin(signal.size)[1]
    if not span[0] < span[1]:
        text = f"less: no window of {samples} samples lies within the record's {signal.size}"
        raise SceneError("hop", str(step), text)
    value = transform.spectrogram(signal, p0=span[0], p1=span[1], detr="constant")
    return transform.f, transform.t(signal.size, *span), value
