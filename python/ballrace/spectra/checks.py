"""Checks of the arguments of functions of signals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

from .. import _core
from .._base.numbers import counted, real, real_row, sampling_rate
from ..channel import channel_of
from ..errors import SceneError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ..channel import Recorded

Given: TypeAlias = "Recorded | ArrayLike"
"""A run, a measurement, a recording or a channel of one, or an array."""


def given_signal(x: Given, fs: float | None) -> tuple[NDArray[np.float64], float]:
    """Return a signal and its sampling rate [Hz], of a record or of an array.

    Raises
    ------
    SceneError
        As of :func:`checked_signal`; or the rate of an array is missing, or that of a record another.
    """
    channel = channel_of(x, fs)
    return checked_signal(channel.x, channel.fs), channel.fs


def checked_signal(x: ArrayLike, fs: float, name: str = "x") -> NDArray[np.float64]:
    """Return a signal as the core reads it; ``name`` is what it is called as an argument.

    Raises
    ------
    SceneError
        It is no row of finite numbers, or too short, or its sampling rate is not usable.
    """
    signal = real_row(name, x)
    if signal.ndim != 1 or signal.size < 8:
        raise SceneError(
            name, f"an array of shape {signal.shape}", "an array of shape (n,), n at least 8"
        )
    _core.check_samples(name, signal)
    sampling_rate(fs)
    return signal


def checked_band(band: tuple[float, float], fs: float) -> tuple[float, float]:
    """Return a band, which has to be within the frequencies that a sampling rate holds [Hz]."""
    low, high = map(real, band) if isinstance(band, Sequence) and len(band) == 2 else [math.nan] * 2
    if not 0.0 <= low < high <= fs / 2.0:
        raise SceneError("band", repr(band), f"two rising frequencies from 0 to fs/2, {fs / 2.0:g}")
    return low, high


def checked_length(name: str, given: int | None, default: int, longest: int) -> int:
    """Return a number of samples, or the default where none is given.

    Raises
    ------
    SceneError
        It is none from 1 to ``longest``; ``name`` is the argument's.
    """
    return default if given is None else counted(name, given, 1, longest)
