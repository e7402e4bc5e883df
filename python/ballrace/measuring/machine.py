"""Vibration of the machine at the sensor beside the bearing's."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .._base.numbers import positive
from ..errors import SceneError
from .noise import Density, checked_density, noise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .source import Source

MEASURED_FLOOR = (
    (50.0, 150.0, 300.0, 550.0, 850.0, 1200.0, 1700.0, 2400.0, 3400.0, 4800.0, 6800.0, 9600.0, 13_600.0, 19_200.0,
     24_000.0),
    (2e-7, 1.6e-5, 1.1e-5, 3.5e-5, 1e-5, 3.3e-6, 3.5e-6, 9.4e-6, 1.3e-5, 5.5e-6, 5.6e-7, 1.3e-7, 3.4e-8, 3.5e-8,
     2e-9),
)  # fmt: skip
"""Floor of a healthy motor: frequencies [Hz] and densities [(m/s²)²/Hz].

Medians over half an octave of the density of record 97 of the Case Western Reserve University bearing data
(drive end, 1797 rpm, no load; Welch, 16384 samples), which leave its lines out. The record is sampled at 48 kHz:
only then its lines at 147.7, 161.7, 191.6 and 360 Hz are those of record 105 of the same machine.
"""

_SWELLING = (0.1, 0.05)
"""Modulation of that record at the shaft's frequency and twice that.

Its squared envelope has lines of 0.15 to 0.28 of its mean at the shaft's frequency and 0.06 to 0.24 at twice that,
in bands from 0.5 to 16 kHz but 4 to 5 kHz, where a line of the motor stands; a modulation m gives 2 m."""

_SLOW, _WAVES = (0.1, 3.0), 8
"""Frequencies of the slow modulation of the noise [Hz], and the number of its waves."""


@dataclass(frozen=True, kw_only=True)
class Machine:
    """Vibration of the machine at the sensor that does not come from the bearing.

    Attributes
    ----------
    shaft : tuple of float
        Amplitudes of the shaft's orders 1, 2, … [m/s²]; phases are drawn.
    mains : tuple of float
        Amplitudes of the multiples 1, 2, … of the mains [m/s²]; phases are drawn.
    mains_frequency : float
        Frequency of the mains [Hz].
    noise_density : float, or tuple of two array_like
        Noise, its one-sided power spectral density [(m/s²)²/Hz]: white, or frequencies [Hz] and the densities
        there, as :func:`scipy.signal.welch` finds them in a healthy record; beyond the last it is 0. By default
        the floor of a measured motor: some 1e-5 between 0.1 and 5 kHz, a hundredth of that above 8 kHz.
    modulation : tuple of float, or None
        Modulation of the noise by the shaft's orders 1, 2, …: it is multiplied by ``1 + Σ m_k cos(k θ + φ_k)``,
        which gives the squared envelope lines there; phases are drawn. None: as measured on that motor, 0.1 and
        0.05, if the shaft's angle is known.
    wander : float
        Slow random modulation of the noise from 0.1 to 3 Hz, standard deviation of the logarithm of its amplitude,
        as from changing load, temperature and mounts.
    """

    shaft: tuple[float, ...] = ()
    mains: tuple[float, ...] = ()
    mains_frequency: float = 50.0
    noise_density: Density = MEASURED_FLOOR
    modulation: tuple[float, ...] | None = None
    wander: float = 0.0

    def __post_init__(self) -> None:
        positive("machine.mains_frequency", self.mains_frequency, "Hz")
        positive("machine.wander", self.wander, zero=True)
        density = checked_density("machine.noise_density", self.noise_density)
        object.__setattr__(self, "noise_density", density)
        for name in ("shaft", "mains", "modulation"):
            if (given := getattr(self, name)) is None and name == "modulation":
                continue
            values = tuple(given)
            object.__setattr__(self, name, values)
            if not np.isfinite(np.asarray(values, dtype=np.float64)).all():
                raise SceneError(f"machine.{name}", repr(values), "numbers")

    def added(self, source: Source, rng: np.random.Generator) -> NDArray[np.float64]:
        """Return what it adds to a signal [m/s²].

        Raises
        ------
        SceneError
            The angle of the shaft is needed, and not known.
        """
        # A stream for each, so that one does not change the numbers of another.
        rough, swelling, shaft, mains, slow = rng.spawn(5)
        total = np.zeros(source.x.size)
        if self.noise_density != 0.0:
            total += noise(self.noise_density, source.fs, source.x.size, rough)
        orders = self.modulation
        if orders is None:
            orders = () if source.angle is None else _SWELLING
        if orders:
            total *= 1.0 + _orders(orders, source.needed_angle(), swelling)
        if self.wander:
            total *= np.exp(self.wander * _slow(source.t, slow))
        if self.shaft:
            total += _orders(self.shaft, source.needed_angle(), shaft)
        turn = 2.0 * np.pi * self.mains_frequency * source.t
        return total + _orders(self.mains, turn, mains)


def _slow(t: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    """Return slow waves at some times [s], of mean 0 and variance 1 over many seeds."""
    total = np.zeros(t.size)
    for f in np.geomspace(*_SLOW, _WAVES):
        total += math.sqrt(2.0 / _WAVES) * np.cos(2.0 * np.pi * (f * t + rng.random()))
    return total


def _orders(
    amplitudes: tuple[float, ...], angle: NDArray[np.float64], rng: np.random.Generator
) -> NDArray[np.float64]:
    total = np.zeros(angle.size)
    for k, amplitude in enumerate(amplitudes, start=1):
        total += amplitude * np.cos(k * angle + rng.uniform(0.0, 2.0 * np.pi))
    return total
