"""Noise of a given power spectral density."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._base.numbers import positive
from ..errors import SceneError
from .checks import finite_row

Density = float | tuple["ArrayLike", "ArrayLike"]
"""Power spectral density, one-sided: that of white noise, or frequencies [Hz] and the densities there."""


def checked_density(name: str, density: Density) -> Density:
    """Return a density whose frequencies rise, checked."""
    if not isinstance(density, tuple):
        positive(name, density, zero=True)
        return density
    if len(density) != 2:
        raise SceneError(name, f"a tuple of {len(density)}", "frequencies [Hz] and densities")
    f, values = (finite_row(name, part) for part in density)
    if f.shape != values.shape or values.min() < 0.0 or f[0] < 0.0 or (np.diff(f) <= 0.0).any():
        raise SceneError(name, "a table", "rising frequencies from 0, and as many densities from 0")
    return tuple(f.tolist()), tuple(values.tolist())


def noise(density: Density, fs: float, size: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return normal noise of a one-sided power spectral density, linear in amplitude between its frequencies."""
    if not isinstance(density, tuple):
        return math.sqrt(0.5 * density * fs) * rng.standard_normal(size)
    # Filtered as if it went round and round, it is as strong at its ends as elsewhere.
    spectrum = np.fft.rfft(noise(1.0, fs, size, rng))
    f = np.arange(spectrum.size, dtype=np.float64) * (fs / size)
    shape = np.interp(f, np.asarray(density[0]), np.sqrt(np.asarray(density[1])), right=0.0)
    return np.fft.irfft(spectrum * shape, size)
