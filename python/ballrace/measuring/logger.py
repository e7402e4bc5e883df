"""The data logger."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import scipy
from .._base.numbers import counted, positive
from ..errors import SceneError
from .noise import noise

_STOP = 80.0
"""Attenuation of the anti-aliasing filter [dB]."""

_LEAST = 1e-9
"""Range for a signal that is not there [m/s²]."""

_FASTER = 100
"""A logger's rate over that of the signal, at most: above it there is nothing new, only memory spent."""


@dataclass(frozen=True, kw_only=True)
class Logger:
    """A data logger: anti-aliasing filter, sampling, noise of its electronics, range and resolution.

    Attributes
    ----------
    fs : float or None
        Sampling rate [Hz]; None: that of the signal.
    bandwidth : float or None
        Frequency up to which it is flat [Hz], below half the sampling rate; from 1.25 times that on, or from half
        the rate, it is 80 dB down. None: 0.4 ``fs`` where the rate changes, and no filter where it does not.
    noise_density : float
        White noise of the electronics, its one-sided power spectral density [(m/s²)²/Hz].
    range : float or None
        Samples beyond ± this are clipped [m/s²]. None: the least of 1, 2, 5, 10, 20, … m/s² that holds all
        samples, which is then :attr:`Measurement.range`.
    bits : int or None
        Resolution, 2 to 32 bits over the range; None: not quantised.
    """

    fs: float | None = None
    bandwidth: float | None = None
    noise_density: float = 0.0
    range: float | None = None
    bits: int | None = None

    def __post_init__(self) -> None:
        positive("logger.noise_density", self.noise_density, zero=True)
        if self.fs is not None:
            positive("logger.fs", self.fs, "Hz")
        if self.bandwidth is not None:
            positive("logger.bandwidth", self.bandwidth, "Hz")
        if self.range is not None:
            positive("logger.range", self.range, "m/s²")
        if self.bits is not None:
            counted("logger.bits", self.bits, 2, 32)

    @property
    def step(self) -> float | None:
        """Step of the quantisation [m/s²]; None without one, or where the range is the signal's."""
        return None if self.range is None else self._step(self.range)

    def _step(self, reach: float) -> float | None:
        return None if self.bits is None else 2.0 * reach / 2**self.bits

    def sampled(self, x: NDArray[np.float64], fs: float) -> tuple[NDArray[np.float64], float]:
        """Return the signal behind the anti-aliasing filter at the logger's rate, and that rate [Hz].

        Linear phase, no delay; the record is taken as 0 beyond its ends.

        Raises
        ------
        SceneError
            Rate or bandwidth do not fit the signal.
        """
        rate = self.fs or fs
        if self.bandwidth is None and rate == fs:
            return x, fs
        if rate > _FASTER * fs:
            raise SceneError(
                "logger.fs", f"{rate:g}", f"at most {_FASTER} times {fs:g}, the signal's rate"
            )
        ratio = Fraction(rate / fs).limit_denominator(2000)
        if abs(float(ratio) * fs / rate - 1.0) > 1e-9:
            raise SceneError("logger.fs", f"{rate:g}", f"a ratio of small whole numbers to {fs:g}")
        up, down = ratio.numerator, ratio.denominator
        flat = self._flat(rate, fs)
        taps = _lowpass(flat, min(1.25 * flat, 0.5 * rate, 0.5 * fs), up * fs)
        if up == down:  # of which resample_poly makes a copy, unfiltered
            return np.asarray(scipy.signal.oaconvolve(x, taps, mode="same")), rate
        return np.asarray(scipy.signal.resample_poly(x, up, down, window=taps)), rate

    def _flat(self, rate: float, fs: float) -> float:
        lower = min(rate, fs)
        flat = 0.4 * lower if self.bandwidth is None else self.bandwidth
        if not flat < 0.499 * lower:
            raise SceneError(
                "logger.bandwidth", f"{flat:g}", f"below half the rate, {0.5 * lower:g}"
            )
        return flat

    def digitised(
        self, x: NDArray[np.float64], fs: float, rng: np.random.Generator
    ) -> tuple[NDArray[np.float64], float, float]:
        """Return it with noise, clipped and quantised; the share of clipped samples; and the range [m/s²]."""
        if self.noise_density > 0.0:
            x = x + noise(self.noise_density, fs, x.size, rng)
        reach = self._fitting(x) if self.range is None else self.range
        clipped = float(np.mean(np.abs(x) > reach))
        step = self._step(reach)
        if step is None:
            return np.clip(x, -reach, reach), clipped, reach
        # A converter has one code more below zero than above.
        codes = np.clip(np.rint(x / step), -reach / step, reach / step - 1.0)
        return step * codes, clipped, reach

    def _fitting(self, x: NDArray[np.float64]) -> float:
        """Return the least of 1, 2, 5, 10, 20, … that holds a signal, its highest sample in the highest code."""
        above = 0.0 if self.bits is None else 2.0 ** (1 - self.bits)
        needed = max(float(np.abs(x).max()) / (1.0 - above), _LEAST)
        decade = math.floor(math.log10(needed))
        steps = (float(f"{first}e{decade + i}") for i in (0, 1) for first in (1, 2, 5))
        return next(reach for reach in steps if reach >= needed)


def _lowpass(flat: float, stop: float, fs: float) -> NDArray[np.float64]:
    """Return a linear-phase filter, flat to a frequency and down by 80 dB from another on."""
    nyquist = 0.5 * fs
    count, beta = scipy.signal.kaiserord(_STOP, (stop - flat) / nyquist)
    taps = scipy.signal.firwin(
        2 * math.ceil(count / 2) + 1, 0.5 * (flat + stop) / nyquist, window=("kaiser", beta)
    )
    return np.asarray(taps)
