"""Accelerations and velocities in the common units of vibration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .errors import SceneError

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["GRAVITY", "in_unit"]

GRAVITY = 9.80665
"""One g [m/s²], by the definition of the CGPM of 1901."""

ACCELERATIONS = {"m/s^2": 1.0, "g": GRAVITY}
VELOCITIES = {"m/s": 1.0, "mm/s": 1e-3}


def in_unit(
    x: NDArray[np.float64], fs: float, unit: str, wanted: str, band: tuple[float, float]
) -> NDArray[np.float64]:
    """Return a signal in another unit; an acceleration as a velocity by integration in the spectrum.

    Raises
    ------
    SceneError
        A unit is none of those above, or a velocity is to become an acceleration.
    """
    unit, wanted = unit.replace("²", "^2"), wanted.replace("²", "^2")
    known = ACCELERATIONS | VELOCITIES
    if wanted not in known:
        raise SceneError("unit", repr(wanted), f"one of {', '.join(known)}")
    if unit not in known:
        raise SceneError(
            "unit", repr(unit), f"a record in one of {', '.join(known)}; give its unit"
        )
    scale = known[unit] / known[wanted]
    if (unit in ACCELERATIONS) == (wanted in ACCELERATIONS):
        return x * scale
    if unit in VELOCITIES:
        raise SceneError("unit", repr(wanted), f"a velocity, as the record in {unit} is one")
    return _integrated(x, fs, band) * scale


def _integrated(
    x: NDArray[np.float64], fs: float, band: tuple[float, float]
) -> NDArray[np.float64]:
    """Integrate once: division by 2πif within the band, nothing outside."""
    low, high = band
    if not 0.0 < low < high:
        raise SceneError("band", repr(band), "two rising frequencies above 0 [Hz]")
    f = np.fft.rfftfreq(x.size, 1.0 / fs)
    inside = (f >= low) & (f <= high)
    spectrum = np.zeros(f.size, dtype=np.complex128)
    spectrum[inside] = np.fft.rfft(x)[inside] / (2j * np.pi * f[inside])
    return np.fft.irfft(spectrum, x.size)
