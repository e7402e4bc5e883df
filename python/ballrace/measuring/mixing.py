"""A simulated signal onto a measured one."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import SceneError
from .checks import finite_row


def mix_into(
    x: ArrayLike, background: ArrayLike, snr_db: float, *, seed: int | None = None
) -> NDArray[np.float64]:
    """Return a signal on top of a measured background of the same sampling rate.

    The background stays as it was measured; the signal is scaled so that its power, without its mean, is
    ``snr_db`` above that of the background.

    Parameters
    ----------
    x : array_like, shape (n,)
        Signal.
    background : array_like, shape (m,)
        Measured record of a healthy bearing, m at least n, at the same sampling rate.
    snr_db : float
        Power of the signal over that of the background [dB].
    seed : int, optional
        Seed from which the beginning within the background is drawn; by default the signal begins with it.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> mixed = mix_into(np.sin(np.arange(1000.0)), rng.normal(size=2000), snr_db=-10.0)
    >>> mixed.shape
    (1000,)
    """
    signal, record = finite_row("x", x), finite_row("background", background)
    if record.size < signal.size:
        raise SceneError(
            "background", f"{record.size} samples", f"at least {signal.size}, as the signal"
        )
    if not math.isfinite(snr_db):
        raise SceneError("snr_db", repr(snr_db), "a number [dB]")
    room = record.size - signal.size
    start = 0 if seed is None else int(np.random.default_rng(seed).integers(room + 1))
    part = record[start : start + signal.size]
    if part.std() == 0.0 or signal.std() == 0.0:
        raise SceneError("background", "constant, or the signal is", "two signals that vary")
    scale = float(part.std() / signal.std()) * 10.0 ** (snr_db / 20.0)
    return np.asarray(part + scale * (signal - signal.mean()))
