"""Arguments of the stages, checked as they are made; what is refused is a :class:`ballrace.SceneError`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._base.numbers import real_row
from ..errors import SceneError


def finite_row(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return numbers, all finite, as an array of one dimension."""
    row = real_row(name, values)
    if row.ndim != 1 or row.size == 0 or not np.isfinite(row).all():
        raise SceneError(name, f"an array of shape {row.shape}", "finite numbers, shape (n,)")
    return row


def rising(name: str, values: Sequence[float] | NDArray[np.float64]) -> None:
    """Refuse numbers that do not rise from 0 or above."""
    if values[0] < 0.0 or not (np.diff(values) > 0.0).all():
        raise SceneError(name, "numbers that do not rise", "strictly rising, from 0")
