"""Octave with a vectorised right-hand side."""

from __future__ import annotations

import math
import os
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.io

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from numba_bearing import Bearing

    Array = NDArray[np.float64]

from .measuring import Case
from .wheel import TIMES, Problem, settings
from .with_scipy import ABSOLUTE

HERE = Path(__file__).parents[1]


class Octave:
    """ode45 with the vectorised right-hand side; one process a setting."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.tables = octave_tables(problem.bearing) | {
            "scale": problem.converged.scale(),
            "start": problem.start,
            "times": TIMES,
            "rtol": ABSOLUTE,
        }

    def call(self, states: Array, tolerances: list[float], steps: list[float]) -> dict[str, Any]:
        """Return derivatives of states, and a run of every setting."""
        with tempfile.TemporaryDirectory() as folder:
            given, found = Path(folder, "in.mat"), Path(folder, "out.mat")
            more = {"states": states, "tolerance": tolerances, "max_step": steps}
            scipy.io.savemat(given, self.tables | more)
            subprocess.run(
                [
                    *("octave-cli", "-qf", "--path", str(HERE)),
                    *("--eval", f"octave_bearing('{given}', '{found}')"),
                ],
                check=True,
                stderr=subprocess.PIPE,
                env=os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
            )
            result: dict[str, Any] = scipy.io.loadmat(found)
        return result

    def run(self, tolerance: float, step: float) -> tuple[float, Array]:
        """Seconds and the outer ring's acceleration."""
        found = self.call(self.problem.start[None], [tolerance], [min(step, 1.0)])
        return float(found["seconds"][0, 0]), found["accelerations"].reshape(3, -1)

    def cases(self, tolerances: list[float]) -> list[Case]:
        """All settings."""
        converged = self.problem.converged
        return [
            Case(
                "Octave ode45, vectorised",
                f"{self.problem.kind}, {name}",
                lambda r=tolerance, h=step: self.run(r, h),
                converged.truth,
                once=True,
            )
            for name, tolerance, step in settings(converged.cap, tolerances, [math.inf])
        ]


def octave_tables(bearing: Bearing) -> dict[str, Any]:
    """One entry a contact, numbered from 1, as columns."""
    grooves, defects, slices, bodies, record = bearing.tables
    common = {name: float(record[0][name]) for name in record.dtype.names}
    count = int(common["count"])
    balls = np.arange(int(common["rows"]) * count)
    contacts, ring = np.repeat(balls, 2), np.tile([0, 1], balls.size)
    groove = grooves[contacts // count, ring]
    defect = np.stack([defects[name][contacts // count] for name in defects.dtype.names], axis=1)
    defect[ring == 1, 2] = -1.0
    following = balls // count * count + (balls + 1) % count

    def column(x: Any) -> Array:
        return np.asarray(x, dtype=float).reshape(-1, 1)

    return {
        **common,
        "ball": column(contacts + 3),
        "ring": column(ring + 1),
        "sigma": column(groove["sigma"]),
        **{f"groove_{name}": column(groove[name]) for name in "azr"},
        "defect": defect,
        **dict(zip(("zeta", "rho", "tan", "sin", "cos"), slices, strict=True)),
        **dict(zip(("constant", "mobility", "spring", "damper", "place"), bodies, strict=True)),
        "this": column(balls + 3),
        "next": column(following + 3),
    }
