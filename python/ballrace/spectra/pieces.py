"""A signal cut into pieces that overlap, each as its transform."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["transforms"]


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
    from scipy.fft import fft, rfft
    from scipy.signal.windows import hann

    cut = np.lib.stride_tricks.sliding_window_view(x, samples)[:: max(samples // 2, 1)]
    windowed = cut * hann(samples, sym=False)
    found: NDArray[np.complex128] = fft(windowed) if np.iscomplexobj(x) else rfft(windowed)
    return found
