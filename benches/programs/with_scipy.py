"""SciPy with a compiled right-hand side."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from scipy.integrate import solve_ivp

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

from .measuring import Case, timed
from .wheel import DURATION, TIMES, Problem, settings

ABSOLUTE = 2.3e-14
"""SciPy's least relative tolerance."""


class Scipy:
    """SciPy's methods with a numba right-hand side."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.scale = problem, problem.converged.scale()

    def run(self, method: str, tolerance: float, step: float) -> tuple[float, Array]:
        """Seconds and the outer ring's acceleration."""
        seconds, found = timed(
            lambda: solve_ivp(
                self.problem.bearing,
                (0.0, DURATION),
                self.problem.start,
                method,
                t_eval=TIMES,
                rtol=ABSOLUTE,
                atol=tolerance * self.scale,
                max_step=step,
            )
        )
        return seconds, self.problem.acceleration(found.y.T)

    def cases(self, tolerances: list[float]) -> list[Case]:
        """All settings."""
        converged = self.problem.converged
        return [
            Case(
                f"SciPy {method}",
                f"{self.problem.kind}, {name}",
                lambda m=method, r=tolerance, h=step: self.run(m, r, h),
                converged.truth,
            )
            for method in ("RK45", "LSODA")
            for name, tolerance, step in settings(
                converged.cap, tolerances, (1.0, 2.0, 3.0, math.inf)
            )
        ]
