"""What else shakes where the sensor sits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..errors import SceneError
from .checks import positive
from .noise import Density, checked_density, noise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .source import Source

__all__ = ["Machine"]


@dataclass(frozen=True, kw_only=True)
class Machine:
    """Vibration of the machine at the sensor that is none of the bearing's.

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
        there, as :func:`scipy.signal.welch` finds them in a healthy record; beyond the last it is 0.
    modulation : tuple of float
        How the shaft's orders 1, 2, … swell the noise: it is multiplied by ``1 + Σ m_k cos(k θ + φ_k)``, which
        gives the squared envelope lines there; phases are drawn.
    """

    shaft: tuple[float, ...] = ()
    mains: tuple[float, ...] = ()
    mains_frequency: float = 50.0
    noise_density: Density = 0.0
    modulation: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        positive("machine.mains_frequency", self.mains_frequency)
        density = checked_density("machine.noise_density", self.noise_density)
        object.__setattr__(self, "noise_density", density)
        for name in ("shaft", "mains", "modulation"):
            values = tuple(getattr(self, name))
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
        rough, swelling, shaft, mains = rng.spawn(4)
        total = np.zeros(source.x.size)
        if self.noise_density != 0.0:
            total += noise(self.noise_density, source.fs, source.x.size, rough)
        if self.modulation:
            total *= 1.0 + _orders(self.modulation, source.needed_angle(), swelling)
        if self.shaft:
            total += _orders(self.shaft, source.needed_angle(), shaft)
        turn = 2.0 * np.pi * self.mains_frequency * source.t
        return total + _orders(self.mains, turn, mains)


def _orders(
    amplitudes: tuple[float, ...], angle: NDArray[np.float64], rng: np.random.Generator
) -> NDArray[np.float64]:
    total = np.zeros(angle.size)
    for k, amplitude in enumerate(amplitudes, start=1):
        total += amplitude * np.cos(k * angle + rng.uniform(0.0, 2.0 * np.pi))
    return total
