"""A signal cut into pieces that overlap, each as its transform."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import scipy
from ..errors import SceneError
from .checks import checked_length

_SHORTEST = 8
"""Samples of a piece, at least."""


def piece_length(signal: NDArray[np.float64], length: int | None, pieces: int, fewest: int) -> int:
    """Return the samples of a piece: ``length``, or by default those of so many pieces along the signal.

    Raises
    ------
    SceneError
        The signal is too short for ``fewest`` pieces, or the length is not usable.
    """
    if signal.size < fewest * _SHORTEST:
        raise SceneError("x", f"{signal.size} samples", f"at least {fewest * _SHORTEST}")
    default = max(signal.size // pieces, _SHORTEST)
    samples = checked_length("length", length, default, signal.size // fewest)
    if samples < _SHORTEST:
        raise SceneError("length", str(samples), f"at least {_SHORTEST} samples")
    return samples


def hann(samples: int) -> NDArray[np.float64]:
    """Return the Hann window of a piece that is repeated, as :func:`scipy.signal.windows.hann` with ``sym=False``.

    The import of scipy's takes longer than a verdict.
    """
    window: NDArray[np.float64] = np.hanning(samples + 1)[:-1]
    return window


def transforms(
    x: NDArray[np.float64] | NDArray[np.complex128], samples: int
) -> NDArray[np.complex128]:
    """Return the transforms of pieces under a Hann window, each half over the next one.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Signal; of a real one only frequencies from 0 to fs/2 are returned.
    samples : int
        Samples of a piece.

    Returns
    -------
    ndarray, shape (n_pieces, n_frequencies)
        Without a scale.
    """
    cut = np.lib.stride_tricks.sliding_window_view(x, samples)[:: max(samples // 2, 1)]
    windowed = cut * hann(samples)
    found: NDArray[np.complex128] = (
        scipy.fft.fft(windowed) if np.iscomplexobj(x) else scipy.fft.rfft(windowed)
    )
    return found
