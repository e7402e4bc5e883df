"""SciPy with a compiled right-hand side."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy.integrate import solve_ivp

if TYPE_CHECKING:
    from numba_bearing import Bearing
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

from .measuring import Case, timed
from .wheel import DURATION, FS, Wheel, settings

ABSOLUTE = 2.3e-14
"""SciPy's least relative tolerance."""


class Scipy:
    """SciPy's methods with the numba right-hand side."""

    def __init__(self, wheel: Wheel, bearing: Bearing) -> None:
        self.wheel, self.bearing, self.scale = wheel, bearing, wheel.scale()
        self.times = np.arange(round(DURATION * FS)) / FS

    def run(self, method: str, tolerance: float, step: float) -> tuple[float, Array]:
        """Seconds and the outer ring's acceleration."""
        seconds, found = timed(
            lambda: solve_ivp(
                self.bearing,
                (0.0, DURATION),
                self.wheel.start,
                method,
                t_eval=self.times,
                rtol=ABSOLUTE,
                atol=tolerance * self.scale,
                max_step=step,
            )
        )
        half = found.y.shape[0] // 2
        derivatives = [self.bearing(0.0, np.ascontiguousarray(y)) for y in found.y.T]
        return seconds, np.stack(derivatives)[:, half : half + 3].T

    def cases(self, tolerances: list[float]) -> list[Case]:
        """All settings."""
        return [
            Case(
                f"scipy {method}, numba, 200 slices",
                name,
                lambda m=method, r=tolerance, h=step: self.run(m, r, h),
                self.wheel.truth,
            )
            for method in ("RK45", "LSODA")
            for name, tolerance, step in settings(self.wheel, tolerances, 1.0, math.inf)
        ]
