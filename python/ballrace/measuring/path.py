"""Paths from the seat of the outer ring to a sensor, as a linear transfer of the force on the seat."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .._base.numbers import counted, positive, real
from ..bearings.pedestal import OF_6205
from ..errors import SceneError
from ..scene import Mode, Structure
from .checks import finite_row, rising
from .linear import passed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .linear import Transfer


@dataclass(frozen=True, eq=False)
class MeasuredResponse:
    """A measured frequency response, from the force on the seat along the sensor's direction to the sensor.

    Attributes
    ----------
    f : array_like, shape (n,)
        Frequencies, rising [Hz]. Between them it is linear in real and imaginary part; below the first it is as
        there, beyond the last it is 0.
    h : array_like of complex, shape (n,)
        Acceleration over force, as a hammer on the seat finds it [m/s²/N].
    """

    f: ArrayLike
    h: ArrayLike

    def __post_init__(self) -> None:
        f, h = finite_row("path.f", self.f), np.asarray(self.h, dtype=np.complex128)
        rising("path.f", f)
        if h.shape != f.shape or not np.isfinite(h).all():
            raise SceneError(
                "path.h", f"an array of shape {h.shape}", f"{f.size} finite numbers, as f"
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
    """An impulse response at the sampling rate of the signal: the sensor shows its convolution with the force.

    Attributes
    ----------
    taps : array_like, shape (n,)
        Acceleration [m/s²] after a force of 1 N on the seat, along the sensor's direction, that lasts one sample.
    fs : float
        Sampling rate, that of the signal [Hz].
    """

    taps: ArrayLike
    fs: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "taps", finite_row("path.taps", self.taps))
        positive("path.fs", self.fs, "Hz")

    def transfer(self, f: NDArray[np.float64], fs: float) -> NDArray[np.complex128]:
        """Return the frequency response.

        Raises
        ------
        SceneError
            The signal has another sampling rate.
        """
        if not math.isclose(fs, self.fs, rel_tol=1e-9):
            raise SceneError("path.fs", f"{self.fs:g}", f"the sampling rate of the signal, {fs:g}")
        return np.fft.rfft(np.asarray(self.taps), 2 * (f.size - 1))

    def ringing(self, fs: float) -> float:
        """Length of the response [s]."""
        return np.asarray(self.taps).size / self.fs


Path = Structure | MeasuredResponse | ImpulseResponse
"""Path from the force on the seat to a sensor."""


@dataclass(frozen=True)
class _Modes:
    """Response of a structure's sensor along a direction to a force on its seat along an axis."""

    structure: Structure
    sensor: str
    direction: tuple[float, ...]
    axis: int

    def transfer(self, f: NDArray[np.float64], fs: float) -> NDArray[np.complex128]:
        """Return the frequency response, Σ -ω² Ψ Φ / (m (ω_i² - ω² + 2 i ζ_i ω_i ω))."""
        omega = 2.0 * np.pi * f
        total = np.zeros(f.shape, dtype=np.complex128)
        for mode in self.structure.modes:
            own = 2.0 * np.pi * mode.frequency
            shape = np.dot(mode.sensors.get(self.sensor, (0.0, 0.0, 0.0)), self.direction)
            share = shape * mode.seat[self.axis] / mode.mass
            total -= share * omega**2 / (own**2 - omega**2 + 2.0j * mode.damping * own * omega)
        return total

    def ringing(self, fs: float) -> float:
        """Time in which it dies down to a millionth [s]."""
        rates = (2.0 * math.pi * mode.damping * mode.frequency for mode in self.structure.modes)
        return math.log(1e6) / min(rates)


def axes(path: Path, direction: tuple[float, ...]) -> tuple[bool, ...]:
    """Return along which axes a path takes a force."""
    if isinstance(path, Structure):
        return tuple(any(mode.seat[axis] != 0.0 for mode in path.modes) for axis in range(3))
    return tuple(part != 0.0 for part in direction)


def through(
    path: Path,
    force: NDArray[np.float64],
    fs: float,
    direction: tuple[float, ...],
    sensor: str | None,
) -> NDArray[np.float64]:
    """Return the acceleration at a sensor, shape (n,), by the force on the seat, shape (n, 3).

    Raises
    ------
    SceneError
        The structure has no such sensor, or an undamped mode.
    """
    if not isinstance(path, Structure):
        return passed(force @ np.asarray(direction), fs, [path])
    for k, mode in enumerate(path.modes):
        positive(f"path.modes[{k}].damping", mode.damping, below=1.0)
    names = path.sensors
    if (sensor is None and len(names) != 1) or (sensor is not None and sensor not in names):
        allowed = f"a sensor of the path: {', '.join(names) or 'it has none'}"
        raise SceneError("body", repr(sensor), allowed)
    # At rest under the force as the record begins: a static force accelerates nothing.
    force = force - force[0]
    total = np.zeros(len(force))
    for axis, takes in enumerate(axes(path, direction)):
        if takes:
            stage: Transfer = _Modes(path, sensor or names[0], direction, axis)
            total += passed(force[:, axis], fs, [stage])
    return total


_MASS = 1.32
"""Modal mass at 1 kHz of each of a few modes [kg], which falls with the frequency, as of the pedestal's walls."""
_WALLS = 5
"""Number of modes of those walls."""
_SIZES = 1e-3, 10.0
"""Outside diameters of bearings that are taken [m]."""
_SEAT, _SENSOR = 0.005, 90.0
"""Shapes at the seat and at the sensor: so small at the seat that the modes do not act back on the ring."""


def random_housing(
    seed: int,
    *,
    modes: int = 20,
    band: tuple[float, float] = (800.0, 12_000.0),
    damping: tuple[float, float] = (0.01, 0.08),
    outside_diameter: float = OF_6205,
) -> Structure:
    """Return a path from the seat to a sensor elsewhere on a machine, by modes drawn at random, for data sets.

    Frequencies and damping ratios are uniform on a logarithmic scale. Seat and sensor move along directions of
    their own in each mode, the sensor with a normal amplitude; modal masses are as of the pedestal's walls, and
    grow with the root of the number of modes, so that many modes pass as much as few. It is driven by the force on
    the seat in a run, and acts back on nothing: the seat moves little.

    Parameters
    ----------
    seed : int
        The same seed gives the same path.
    modes : int
        Number of modes.
    band : tuple of two floats
        Lowest and highest frequency of a mode [Hz].
    damping : tuple of two floats
        Lowest and highest damping ratio.
    outside_diameter : float
        Outside diameter of the bearing [m], by default a 6205's. Walls n times as large ring at frequencies n
        times lower, with n³ times the mass; at like frequencies with n² times.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> random_housing(7) == random_housing(7), len(random_housing(7).modes)
    (True, 20)
    """
    modes = counted("modes", modes, 1)
    diameter = real(outside_diameter)
    if not _SIZES[0] <= diameter <= _SIZES[1]:
        allowed = f"a diameter, {_SIZES[0]:g} to {_SIZES[1]:g} [m]"
        raise SceneError("outside_diameter", repr(outside_diameter), allowed)
    mass = _MASS * (diameter / OF_6205) ** 2 * math.sqrt(modes / _WALLS)
    for name, pair in (("band", band), ("damping", damping)):
        if not 0.0 < pair[0] <= pair[1] < math.inf:
            raise SceneError(name, str(pair), "two rising numbers above 0")
    rng = np.random.default_rng(seed)
    frequencies = np.sort(log_uniform(rng, band, modes))
    ratios = log_uniform(rng, damping, modes)
    seats, sensors = rng.standard_normal((2, modes, 3))
    seats *= _SEAT / np.linalg.norm(seats, axis=1)[:, None]
    sensors *= _SENSOR / math.sqrt(3.0)
    drawn = zip(
        frequencies.tolist(), ratios.tolist(), seats.tolist(), sensors.tolist(), strict=True
    )
    return Structure(
        modes=tuple(
            Mode(frequency=f, damping=d, mass=mass * 1e3 / f, seat=tuple(phi), sensors={"sensor": tuple(psi)})
            for f, d, phi, psi in drawn
        )
    )  # fmt: skip


def log_uniform(rng: np.random.Generator, ends: tuple[float, float], n: int) -> NDArray[np.float64]:
    """Draw numbers whose logarithms are evenly distributed."""
    return np.exp(rng.uniform(math.log(ends[0]), math.log(ends[1]), n))
