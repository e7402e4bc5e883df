"""The bearing all charts are measured on, from a settled start, and how a run is judged.

The wheel bearing under 7 kN and +3 kN runs 8 ms from its equilibrium; its last state is the start of every run
of a chart. In the 6 ms that follow a ball crosses the spall (impact at 3.5 ms). The error is that of the outer
ring's vertical acceleration, relative, L2, at 100 kHz, and in the band that a record of 50 kHz keeps. Wall
times are taken in runs of their own that record three samples, one thread, all cases in turn, several rounds;
the median counts.
"""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.signal import firwin

import ballrace as br
from ballrace.scene import FittedSlices, FixedSlices, MotionProbe

if TYPE_CHECKING:
    from collections.abc import Iterable

COLUMN = "outer.ay"
DURATION = 6e-3
SETTLING = 8e-3
IMPACT_OVER = 4e-3  # the blow itself has come and gone
FS = 100e3
MOST_NODES = 64


def slices(name: str) -> FittedSlices | FixedSlices:
    """Return the slices of a name such as ``fitted 6``."""
    kind, count = name.split()
    return FittedSlices(int(count)) if kind == "fitted" else FixedSlices(int(count))


def bearing(slip_speed: float = 0.1, cut: str = "fitted 6") -> br.Scene:
    """Return the wheel bearing at +3 kN."""
    return br.presets.wheel_bearing(axial_load=3000.0).replace(
        {"friction.coulomb.slip_speed": slip_speed, "contact.slices": slices(cut)}
    )


@dataclass(frozen=True)
class Effort:
    """How to integrate: method, relative tolerance, step cap over one period of the fastest contact (1/ω)."""

    method: str = "dormand-prince"
    rtol: float = 1e-6
    cap: float = 1.0


#: What a run that resolves all frequencies does by default.
DEFAULT = Effort("adams", 1e-7, 0.9)
#: What a run does by default whose record is filtered to 20 kHz.
IN_BAND = Effort("adams", 1e-4, 1.2 * 0.9)


def integrated(scene: br.Scene, effort: Effort) -> br.Scene:
    """Return the scene with that effort."""
    capped = math.isfinite(effort.cap)
    return scene.replace(
        {
            "solver.method": effort.method,
            "solver.rtol": effort.rtol,
            "solver.frequency_cap": False,
            "solver.max_step": effort.cap * largest_step() if capped else None,
        }
    )


@cache
def largest_step() -> float:
    """Return Dormand–Prince's step cap for the bearing [s]."""
    out = br.simulate(bearing(), duration=2e-5, fs=FS, bandwidth=None, method="dormand-prince")
    return float(out.provenance.max_step)


@cache
def settled(slip_speed: float, cut: str) -> NDArray[np.float64]:
    """Return the state after the settling."""
    scene = integrated(bearing(slip_speed, cut), Effort("dormand-prince", 1e-8, 0.5))
    return states(scene, duration=SETTLING, fs=20e3)[-1]


def states(
    scene: br.Scene,
    *,
    duration: float,
    fs: float,
    start: Literal["equilibrium"] | NDArray[np.float64] = "equilibrium",
) -> NDArray[np.float64]:
    """Return the states along a run, shape (samples, states)."""
    model = br.Model(scene)
    probes = {body.replace(".", "_"): MotionProbe(body=body) for body in model.bodies}
    watched = scene.replace({"probes": probes})
    out = br.simulate(watched, duration=duration, fs=fs, start=start, threads=1, bandwidth=None)
    columns = (name.replace(".", "_", name.count(".") - 1) for name in model.names)
    return np.column_stack([out[column] for column in columns])


@dataclass(frozen=True)
class Truth:
    """The solution, and how far a second method is from it."""

    signal: NDArray[np.float64]
    agreement: float


@cache
def truth(slip_speed: float, cut: str) -> Truth:
    """Solve by two methods at a tight tolerance."""
    scene, start = bearing(slip_speed, cut), settled(slip_speed, cut)
    if slip_speed > 0.01:
        efforts = Effort("dormand-prince", 1e-12, 0.03), Effort("verner", 1e-12, 0.03)
    else:
        efforts = Effort("dormand-prince", 1e-11, 0.1), Effort("verner", 1e-11, 0.1)
    one, other = (
        br.simulate(
            integrated(scene, e), duration=DURATION, fs=FS, start=start, threads=1, bandwidth=None
        )[COLUMN]
        for e in efforts
    )
    return Truth(one, error(other, one))


def error(found: NDArray[np.float64], true: NDArray[np.float64]) -> float:
    """Return the relative L2 error."""
    return float(np.linalg.norm(found - true) / np.linalg.norm(true))


def in_band(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a signal below 20 kHz, without its ends, which the filter does not reach."""
    taps = firwin(81, 22.5e3, fs=FS, window=("kaiser", 7.0))
    return np.convolve(x, taps, "valid")


@dataclass(frozen=True)
class Case:
    """A run to be judged, and what its row of the table begins with."""

    labels: dict[str, Any]
    scene: br.Scene
    start: NDArray[np.float64]
    true: NDArray[np.float64]
    walls: list[float] = field(default_factory=list)

    def run(self, fs: float = FS) -> br.Signals:
        """Run it."""
        out = br.simulate(
            self.scene, duration=DURATION, fs=fs, start=self.start, threads=1, bandwidth=None
        )
        if fs < FS:
            self.walls.append(float(out.stats.wall_time))
        return out

    def judge(self) -> dict[str, Any]:
        """Run it and compare."""
        out = self.run()
        early = out.t < IMPACT_OVER
        return {
            **self.labels,
            "error": error(out[COLUMN], self.true),
            "error_to_4ms": error(out[COLUMN][early], self.true[early]),
            "error_in_band": error(in_band(out[COLUMN]), in_band(self.true)),
            "evaluations": int(out.stats.nfev),
            "warned": int(bool(out.warnings)),
        }


def survey(cases: Iterable[Case], rounds: int) -> list[dict[str, Any]]:
    """Judge all cases, then time them in turn; a case that ends with an error is left out."""
    rows, timed = [], []
    for case in cases:
        try:
            rows.append(case.judge())
        except br.IntegrationError:
            continue
        timed.append(case)
    for _ in range(rounds):
        for case in timed:
            case.run(fs=3.0 / DURATION)
    for row, case in zip(rows, timed, strict=True):
        row["wall_ms"] = 1e3 * statistics.median(case.walls)
    return rows


def best(rows: list[dict[str, Any]], cost: str) -> list[dict[str, Any]]:
    """Return the rows that no cheaper one beats, from cheap to dear."""
    front: list[dict[str, Any]] = []
    for row in sorted(rows, key=lambda row: (row[cost], row["error"])):
        if math.isfinite(row["error"]) and (not front or row["error"] < front[-1]["error"]):
            front.append(row)
    return front
