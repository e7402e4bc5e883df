"""The accelerometer."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._base.numbers import positive


@dataclass(frozen=True, kw_only=True)
class Sensor:
    """An accelerometer on its mount: a mass on a spring, and the lower limit of its amplifier.

    Attributes
    ----------
    resonance : float or None
        Mounted resonance [Hz]: some 5 kHz hand-held, 10 kHz on a magnet, 30 kHz screwed on; None: none.
    damping : float
        Its damping ratio.
    lower_limit : float or None
        Frequency at which a coupling capacitor attenuates by 3 dB [Hz]; None: it measures constant accelerations.
    """

    resonance: float | None = 30_000.0
    damping: float = 0.02
    lower_limit: float | None = None

    def __post_init__(self) -> None:
        positive("sensor.damping", self.damping, below=1.0)
        if self.resonance is not None:
            positive("sensor.resonance", self.resonance, "Hz")
        if self.lower_limit is not None:
            positive("sensor.lower_limit", self.lower_limit, "Hz")

    def transfer(self, f: NDArray[np.float64], fs: float) -> NDArray[np.complex128]:
        """Return the frequency response."""
        total = np.ones(f.shape, dtype=np.complex128)
        if self.resonance is not None:
            s = f / self.resonance
            total /= 1.0 - s**2 + 2.0j * self.damping * s
        if self.lower_limit is not None:
            total *= 1.0j * f / (self.lower_limit + 1.0j * f)
        return total

    def ringing(self, fs: float) -> float:
        """Time in which it dies down to a millionth [s]."""
        time = 0.0
        if self.resonance is not None:
            time += math.log(1e6) / (2.0 * math.pi * self.damping * self.resonance)
        if self.lower_limit is not None:
            time += math.log(1e6) / (2.0 * math.pi * self.lower_limit)
        return time
