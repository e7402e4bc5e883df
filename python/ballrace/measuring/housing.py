"""Housings between the ring and the sensor, as a linear transfer of its acceleration."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .._base.numbers import counted, finite, positive
from ..errors import SceneError
from .checks import finite_row, rising

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Housing", "ImpulseResponse", "MeasuredResponse", "Mode", "random_housing"]


@dataclass(frozen=True, kw_only=True)
class Mode:
    """A mode of the housing.

    Attributes
    ----------
    frequency : float
        Undamped natural frequency f_k [Hz].
    damping : float
        Damping ratio ζ_k, above 0 and below 1.
    residue : float
        Its share r_k of the sensor's acceleration over the ring's at low frequency; negative where they move in
        opposite directions. At resonance the ratio is ``residue / (2 damping)``.
    """

    frequency: float
    damping: float
    residue: float = 1.0

    def __post_init__(self) -> None:
        positive("mode.frequency", self.frequency, "Hz")
        positive("mode.damping", self.damping, below=1.0)
        finite("mode.residue", self.residue)

    def transfer(self, f: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Return the frequency response, ``r / (1 - s² + 2 i ζ s)`` with s = f/f_k."""
        s = f / self.frequency
        response = self.residue / (1.0 - s**2 + 2.0j * self.damping * s)
        return np.asarray(response, dtype=np.complex128)

    @property
    def ringing(self) -> float:
        """Time in which it dies down to a millionth [s]."""
        return math.log(1e6) / (2.0 * math.pi * self.damping * self.frequency)


@dataclass(frozen=True, kw_only=True)
class Housing:
    """A housing by its modes, whose transfer is ``direct + Σ r_k / (1 - s_k² + 2 i ζ_k s_k)`` with s_k = f/f_k.

    It is the path from the ring to the sensor, applied to a signal. The mass in which the ring sits, which takes
    part in a run, is a :class:`ballrace.Pedestal` of the scene; modes of its mount do not belong here.

    Attributes
    ----------
    modes : tuple of Mode
        The modes.
    direct : float
        Direct part, from modes far above the band. With ``direct`` and the residues summing to 1, the sensor moves
        with the ring at low frequency.
    """

    modes: tuple[Mode, ...]
    direct: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", tuple(self.modes))
        if not all(isinstance(mode, Mode) for mode in self.modes):
            raise SceneError("housing.modes", repr(self.modes), "modes")
        finite("housing.direct", self.direct)

    def transfer(self, f: NDArray[np.float64], fs: float) -> NDArray[np.complex128]:
        """Return the frequency response."""
        total = np.full(f.shape, self.direct, dtype=np.complex128)
        for mode in self.modes:
            total += mode.transfer(f)
        return total

    def ringing(self, fs: float) -> float:
        """Time in which it dies down to a millionth [s]."""
        return max((mode.ringing for mode in self.modes), default=0.0)


@dataclass(frozen=True, eq=False)
class MeasuredResponse:
    """A measured frequency response, from the acceleration of the ring (or where it was struck) to the sensor's.

    Attributes
    ----------
    f : array_like, shape (n,)
        Frequencies, rising [Hz]. Between them it is linear in real and imaginary part; below the first it is as
        there, beyond the last it is 0.
    h : array_like of complex, shape (n,)
        Sensor's over ring's acceleration.
    """

    f: ArrayLike
    h: ArrayLike

    def __post_init__(self) -> None:
        f, h = finite_row("housing.f", self.f), np.asarray(self.h, dtype=np.complex128)
        rising("housing.f", f)
        if h.shape != f.shape or not np.isfinite(h).all():
            raise SceneError(
                "housing.h", f"an array of shape {h.shape}", f"{f.size} finite numbers, as f"
            )
        object.__setattr__(self, "f", f)
        object.__setattr__(self, "h", h)

    def transfer(self, f: NDArray[np.float64], fs: float) -> NDArray[np.complex128]:
        """Return the frequency response."""
        at, h = np.asarray(self.f), np.asarray(self.h)
        real, imaginary = (np.interp(f, at, part, right=0.0) for part in (h.real, h.imag))
        return np.asarray(real + 1.0j * imaginary, dtype=np.complex128)

    def ringing(self, fs: float) -> float:
        """Length of the response, one over its frequency resolution [s]."""
        at = np.asarray(self.f)
        return float(1.0 / np.diff(at).min()) if at.size > 1 else 0.0


@dataclass(frozen=True, eq=False)
class ImpulseResponse:
    """An impulse response at the sampling rate of the signal: what the sensor shows is their convolution.

    Attributes
    ----------
    taps : array_like, shape (n,)
        The response to a sample of 1; of one measured per second, that times the sampling interval.
    fs : float
        Sampling rate, that of the signal [Hz].
    """

    taps: ArrayLike
    fs: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "taps", finite_row("housing.taps", self.taps))
        positive("housing.fs", self.fs, "Hz")

    def transfer(self, f: NDArray[np.float64], fs: float) -> NDArray[np.complex128]:
        """Return the frequency response.

        Raises
        ------
        SceneError
            The signal has another sampling rate.
        """
        if not math.isclose(fs, self.fs, rel_tol=1e-9):
            raise SceneError(
                "housing.fs", f"{self.fs:g}", f"the sampling rate of the signal, {fs:g}"
            )
        return np.fft.rfft(np.asarray(self.taps), 2 * (f.size - 1))

    def ringing(self, fs: float) -> float:
        """Length of the response [s]."""
        return np.asarray(self.taps).size / self.fs


def random_housing(
    seed: int,
    *,
    modes: int = 5,
    band: tuple[float, float] = (400.0, 12_000.0),
    damping: tuple[float, float] = (0.01, 0.05),
) -> Housing:
    """Return a housing with random modes, for data sets.

    Frequencies and damping ratios are uniform on a logarithmic scale, residues normal with mean 0 and scaled so
    that the root of the sum of their squares is 1/2; the direct part is 1/2.

    Parameters
    ----------
    seed : int
        The same seed gives the same housing.
    modes : int
        Number of modes.
    band : tuple of two floats
        Lowest and highest frequency of a mode [Hz]. A scene of :func:`ballrace.bearing` already has the mount of
        its housing near 1 kHz: begin above it, at some 3 kHz, or give the scene ``housing=None``.
    damping : tuple of two floats
        Lowest and highest damping ratio.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> random_housing(7) == random_housing(7), len(random_housing(7).modes)
    (True, 5)
    """
    modes = counted("modes", modes, 1)
    for name, pair in (("band", band), ("damping", damping)):
        if not 0.0 < pair[0] <= pair[1] < math.inf:
            raise SceneError(name, str(pair), "two rising numbers above 0")
    rng = np.random.default_rng(seed)
    frequencies = np.sort(log_uniform(rng, band, modes))
    ratios = log_uniform(rng, damping, modes)
    residues = rng.standard_normal(modes)
    residues *= 0.5 / np.linalg.norm(residues)
    drawn = zip(frequencies.tolist(), ratios.tolist(), residues.tolist(), strict=True)
    return Housing(
        modes=tuple(Mode(frequency=f, damping=d, residue=r) for f, d, r in drawn), direct=0.5
    )


def log_uniform(rng: np.random.Generator, ends: tuple[float, float], n: int) -> NDArray[np.float64]:
    """Draw numbers whose logarithms are evenly distributed."""
    return np.exp(rng.uniform(math.log(ends[0]), math.log(ends[1]), n))


AnyHousing = Housing | MeasuredResponse | ImpulseResponse
"""Housing of any kind."""
