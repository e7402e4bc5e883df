"""Linear stages, applied to the spectrum of the whole record."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import SceneError

_LONGEST = 2**26
"""Samples of ringing that are taken up behind a record, at most."""


class Transfer(Protocol):
    """A linear stage."""

    def transfer(self, f: NDArray[np.float64], fs: float) -> NDArray[np.complex128]:
        """Return the frequency response at evenly spaced frequencies from 0 to fs/2."""
        ...

    def ringing(self, fs: float) -> float:
        """Return how long its response to an impulse lasts [s]."""
        ...


def passed(x: NDArray[np.float64], fs: float, stages: Sequence[Transfer]) -> NDArray[np.float64]:
    """Return what linear stages make of a signal; they are at rest as it begins.

    Zeros behind the record take up the ringing, which would else come round to its beginning.

    Raises
    ------
    SceneError
        They ring too long for that.
    """
    if not stages:
        return x
    ringing = sum(stage.ringing(fs) for stage in stages)
    if fs * ringing > _LONGEST:
        allowed = f"a rate at which {ringing:.3g} s of ringing are at most {_LONGEST} samples"
        raise SceneError("fs", f"{fs:g}", allowed)
    tail = math.ceil(fs * ringing)
    length = 1 << (x.size + tail - 1).bit_length()
    f = np.arange(length // 2 + 1, dtype=np.float64) * (fs / length)
    spectrum = np.fft.rfft(x, length)
    for stage in stages:
        spectrum *= stage.transfer(f, fs)
    return np.fft.irfft(spectrum, length)[: x.size]
