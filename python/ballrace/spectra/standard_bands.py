"""Root mean square velocities in the bands of the standard by which makers judge bearings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .._base.interrupt import answers_ctrl_c
from .._base.numbers import real
from .._base.units import ACCELERATIONS, VELOCITIES
from ..channel import channel_of
from ..errors import SceneError
from .checks import checked_signal

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .checks import Given

BANDS_ISO15242 = ((50.0, 300.0), (300.0, 1800.0), (1800.0, 10_000.0))
"""Low, medium and high band at 1800 1/min [Hz] (ISO 15242-2)."""

_REFERENCE = 1e-9
"""Velocity of 0 dB [m/s] (ISO 1683)."""

_PERIODS = 5.0
"""Periods of the lowest frequency that a record lasts, at least."""


@dataclass(frozen=True, kw_only=True)
class VelocityBand:
    """Velocity in a band.

    Attributes
    ----------
    low, high : float
        Edges of the band [Hz].
    velocity : float
        Root mean square of the velocity [m/s].
    """

    low: float
    high: float
    velocity: float

    @property
    def level(self) -> float:
        """Level of the velocity over 1 nm/s, the reference of ISO 1683 [dB]."""
        if self.velocity == 0.0:
            return -math.inf
        return 20.0 * math.log10(self.velocity / _REFERENCE)

    def __str__(self) -> str:
        """Write the band on a line."""
        return f"{self.low:g} to {self.high:g} Hz: {1e6 * self.velocity:.3g} µm/s, {self.level:.1f} dB re 1 nm/s"


@answers_ctrl_c
def bands_iso15242(
    x: Given,
    fs: float | None = None,
    *,
    unit: str | None = None,
    bands: Sequence[tuple[float, float]] = BANDS_ISO15242,
) -> tuple[VelocityBand, ...]:
    """Return the velocity in the three bands in which ISO 15242-2 states a ball bearing's vibration.

    The standard measures the outer ring's radial velocity while the inner ring turns with 1800 1/min under
    thrust; :func:`ballrace.noise_test` simulates that. Here the spectrum of the whole record, without its mean, is
    divided by 2πif where it is an acceleration's, and cut off at the edges of the bands, where the standard's
    filters are less steep.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`. At least five
        periods of the lowest frequency; the standard averages over half a second and more.
    fs : float, optional
        Sampling rate of an array [Hz].
    unit : {"m/s^2", "g", "m/s", "mm/s"}, optional
        Unit of an array; by default m/s². A record knows its own.
    bands : sequence of two floats
        Edges of the bands [Hz]. At other speeds they are in proportion, where maker and customer do not agree
        on others.

    Returns
    -------
    tuple of VelocityBand
        A band each, in their order.

    Raises
    ------
    SceneError
        An argument is not usable, the unit is not that of an acceleration or velocity, or the sampling rate or the
        duration is too small for a band.

    Examples
    --------
    A velocity of 20 µm/s at 100 Hz:

    >>> import numpy as np
    >>> t = np.arange(32_000) / 32_000.0
    >>> shaken = 2 * np.pi * 100.0 * 20e-6 * np.sqrt(2) * np.cos(2 * np.pi * 100.0 * t)
    >>> low, medium, high = bands_iso15242(shaken, 32_000.0)
    >>> print(low)
    50 to 300 Hz: 20 µm/s, 86.0 dB re 1 nm/s
    """
    channel = channel_of(x, fs)
    edges = [_checked(band) for band in bands]
    signal = checked_signal(channel.x, channel.fs)
    f, power = _velocity_power(signal, channel.fs, _unit(channel.unit, unit))
    lowest, highest = min(low for low, _ in edges), max(high for _, high in edges)
    if highest > channel.fs / 2.0:
        raise SceneError("fs", f"{channel.fs:g}", f"at least {2.0 * highest:g} Hz for these bands")
    if signal.size / channel.fs < _PERIODS / lowest:
        raise SceneError("x", f"{signal.size / channel.fs:g} s", f"{_PERIODS / lowest:g} s or more")
    return tuple(
        VelocityBand(
            low=low, high=high, velocity=math.sqrt(float(power[(f >= low) & (f < high)].sum()))
        )
        for low, high in edges
    )


def _checked(band: tuple[float, float]) -> tuple[float, float]:
    low, high = map(real, band) if isinstance(band, Sequence) and len(band) == 2 else [math.nan] * 2
    if not 0.0 < low < high < math.inf:
        raise SceneError("bands", repr(band), "two rising frequencies above 0 [Hz] each")
    return low, high


def _unit(known: str, given: str | None) -> str:
    """Return the unit of a signal, which a record may know."""
    known = known.replace("²", "^2")
    if known and given is not None and given.replace("²", "^2") != known:
        raise SceneError("unit", repr(given), f"left out: the record is in {known}")
    unit = known or (given or "m/s^2").replace("²", "^2")
    if unit not in ACCELERATIONS | VELOCITIES:
        raise SceneError("unit", repr(unit), f"one of {', '.join(ACCELERATIONS | VELOCITIES)}")
    return unit


def _velocity_power(
    x: NDArray[np.float64], fs: float, unit: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return frequencies above 0 [Hz], and the velocity's mean square at each [m²/s²]."""
    f = np.asarray(np.fft.rfftfreq(x.size, 1.0 / fs)[1:], dtype=np.float64)
    spectrum = np.fft.rfft(x)[1:] * (ACCELERATIONS | VELOCITIES)[unit] / x.size
    if unit in ACCELERATIONS:
        spectrum = spectrum / (2.0 * np.pi * f)
    power = np.asarray(2.0 * np.abs(spectrum) ** 2, dtype=np.float64)
    if x.size % 2 == 0:
        power[-1] /= 2.0
    return f, power
