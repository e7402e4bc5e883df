"""Dormand and Prince's pair written out for one right-hand side and compiled with it, as a careful user would.

Stages in preallocated memory, one pass over the states each, the last stage kept for the next step; the error as a
root mean square; steps by Hairer's controller with memory. Samples from the continuous extension of order four.

Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., section II.5 for the pair,
and the program DOPRI5 there for the controller; Shampine (1986), Math. Comp. 46, 135-150, for the extension, in
the form of SciPy's ``RK45``.
"""

# ruff: noqa: PLR0917  compiled functions take what they need one by one

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numba
import numpy as np
from scipy.integrate import RK45

from numba_bearing import rhs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

from .measuring import Case, Row, relative, row, timed
from .wheel import COUNTS, TIMES, Problem, Wheel, acceleration, settings

EXTENSION = np.ascontiguousarray(RK45.P)
"""Weights of the stages in a share θ of the step, as powers of θ from the first."""


@numba.njit(error_model="numpy")
def integrate(
    y: Any,
    times: Any,
    samples: Any,
    per_scale: Any,
    max_step: float,
    extension: Any,
    grooves: Any,
    defects: Any,
    slices: Any,
    bodies: Any,
    record: Any,
) -> int:
    """Fill the samples of all states, shape (times, dim); the number of evaluations."""
    n = y.size
    k, new = np.empty((7, n)), np.empty(n)
    weights = np.empty(7)
    k1, k2, k3, k4, k5, k6, k7 = k[0], k[1], k[2], k[3], k[4], k[5], k[6]
    rhs(y, k1, grooves, defects, slices, bodies, record)
    count, sample, t = 1, 0, 0.0
    h, before, rejected = min(max_step, 1e-8), 1e-4, False
    while sample < times.size:
        h = min(h, max_step)
        for i in range(n):
            new[i] = y[i] + h * (1 / 5 * k1[i])
        rhs(new, k2, grooves, defects, slices, bodies, record)
        for i in range(n):
            new[i] = y[i] + h * (3 / 40 * k1[i] + 9 / 40 * k2[i])
        rhs(new, k3, grooves, defects, slices, bodies, record)
        for i in range(n):
            new[i] = y[i] + h * (44 / 45 * k1[i] - 56 / 15 * k2[i] + 32 / 9 * k3[i])
        rhs(new, k4, grooves, defects, slices, bodies, record)
        for i in range(n):
            new[i] = y[i] + h * (
                19372 / 6561 * k1[i]
                - 25360 / 2187 * k2[i]
                + 64448 / 6561 * k3[i]
                - 212 / 729 * k4[i]
            )
        rhs(new, k5, grooves, defects, slices, bodies, record)
        for i in range(n):
            new[i] = y[i] + h * (
                9017 / 3168 * k1[i]
                - 355 / 33 * k2[i]
                + 46732 / 5247 * k3[i]
                + 49 / 176 * k4[i]
                - 5103 / 18656 * k5[i]
            )
        rhs(new, k6, grooves, defects, slices, bodies, record)
        for i in range(n):
            new[i] = y[i] + h * (
                35 / 384 * k1[i]
                + 500 / 1113 * k3[i]
                + 125 / 192 * k4[i]
                - 2187 / 6784 * k5[i]
                + 11 / 84 * k6[i]
            )
        rhs(new, k7, grooves, defects, slices, bodies, record)
        count += 6
        total = 0.0
        for i in range(n):
            e = h * (
                71 / 57600 * k1[i]
                - 71 / 16695 * k3[i]
                + 71 / 1920 * k4[i]
                - 17253 / 339200 * k5[i]
                + 22 / 525 * k6[i]
                - 1 / 40 * k7[i]
            )
            total += (e * per_scale[i]) ** 2
        error = math.sqrt(total / n)
        if not error <= 1.0:
            shrink = 0.9 * error**-0.2 if error < math.inf else 0.2
            h *= max(0.2, shrink)
            rejected = True
            continue
        while sample < times.size and times[sample] <= t + h:
            theta = (times[sample] - t) / h
            for j in range(7):
                p = extension[j]
                weights[j] = h * theta * (p[0] + theta * (p[1] + theta * (p[2] + theta * p[3])))
            for i in range(n):
                samples[sample, i] = (
                    y[i]
                    + weights[0] * k1[i]
                    + weights[2] * k3[i]
                    + weights[3] * k4[i]
                    + weights[4] * k5[i]
                    + weights[5] * k6[i]
                    + weights[6] * k7[i]
                )
            sample += 1
        t += h
        y[:] = new
        k1[:] = k7
        factor = 0.9 * max(error, 1e-10) ** -0.17 * before**0.04
        h *= min(1.0 if rejected else 5.0, max(0.2, factor))
        before, rejected = max(error, 1e-4), False
    return count


class DormandPrince:
    """The compiled pair on a numba right-hand side."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.scale = problem.converged.scale()
        self.samples(1e-3, problem.converged.cap, TIMES[:2])  # compiles

    def run(self, tolerance: float, step: float) -> tuple[float, Array]:
        """Seconds and the outer ring's acceleration."""
        seconds, samples = timed(lambda: self.samples(tolerance, step, TIMES))
        return seconds, self.problem.acceleration(samples)

    def samples(self, tolerance: float, step: float, times: Array) -> Array:
        """States at the sample times, shape (times, dim)."""
        y = self.problem.start.copy()
        samples = np.empty((times.size, y.size))
        per_scale = 1.0 / (tolerance * self.scale)
        integrate(y, times, samples, per_scale, step, EXTENSION, *self.problem.bearing.tables)
        return samples

    def cases(self, tolerances: list[float]) -> list[Case]:
        """All settings."""
        converged = self.problem.converged
        return [
            Case(
                "Dormand-Prince in numba",
                f"{self.problem.kind}, {name}",
                lambda r=tolerance, h=step: self.run(r, h),
                converged.truth,
            )
            for name, tolerance, step in settings(
                converged.cap, tolerances, (1.0, 1.5, 2.0, 3.0, math.inf)
            )
        ]


def slice_errors(others: list[Problem], truth: Array, rounds: int) -> list[Row]:
    """Cost and error of each number of slices and nodes, ours and numba's."""
    wheels = [Wheel(slices) for slices in COUNTS]
    states = np.concatenate([wheels[0].states(10)] * 10)
    for problem in others:
        problem.bearing.repeat(states[:1])  # compiles
    seconds: dict[str, list[float]] = {}
    for _ in range(rounds):
        for wheel in wheels:
            seconds.setdefault(f"ballrace, {wheel.kind}", []).append(wheel.evaluation())
        for problem in others:
            used, _ = timed(lambda p=problem: p.bearing.repeat(states))
            seconds.setdefault(f"numba, {problem.kind}", []).append(used / len(states))
    errors = [relative(acceleration(wheel.signals(1e-8)), truth) for wheel in wheels]
    for problem in others:
        pair = DormandPrince(problem)
        errors.append(relative(pair.run(1e-8, problem.converged.cap / 2)[1], truth))
    return [
        row(name, "an evaluation", "µs", [1e6 * x for x in costs], error)
        for (name, costs), error in zip(seconds.items(), errors, strict=True)
    ]
