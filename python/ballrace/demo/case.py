"""A load case of the demonstration."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import presets
from .._results.features import features
from ..frequencies.kinematic import of_row
from ..paper import Zone, zone
from ..paper.simulations import healthy_at_bottom, slices_of
from ..run import simulate
from ..scene import Scene, SpeedDrive
from ..signals import Signals
from ..statics import LoadDistribution, load_distribution

COLUMN = "outer.ay"
_FS = 50_000.0


@dataclass(frozen=True)
class Case:
    """A load case, run and looked at at rest.

    Attributes
    ----------
    axial_load : float
        Axial load [N].
    out : Signals
        The run.
    loads : LoadDistribution
        Loads of the healthy bearing.
    slices : dict of str to ndarray
        Slices of the ball of row 0 at -90°, on the outer race of the healthy bearing: ``z``, ``width`` [m] and the
        radial ``force`` [N].
    zone : Zone
        The contact zone that they make.
    seconds : float
        Wall time of the run [s].
    """

    axial_load: float
    out: Signals
    loads: LoadDistribution
    slices: dict[str, NDArray[np.float64]]
    zone: Zone
    seconds: float

    @property
    def spall(self) -> tuple[float, float]:
        """Axial beginning and end of the spall on the outer ring [m]."""
        (name,) = self.out.scene.defects
        defect, row = self.out.scene.defects[name], self.out.scene.rows[0]
        middle = self.out.defects[name].axial_offset + row.axial_position
        return middle - 0.5 * defect.length, middle + 0.5 * defect.length

    @property
    def within(self) -> float:
        """Radial force of the slices within the spall's length [N]."""
        low, high = self.spall
        z, force = self.slices["z"], self.slices["force"]
        return float(force[(z >= low) & (z <= high)].sum())

    @property
    def numbers(self) -> tuple[float, float, float | None, float]:
        """Root mean square, peak, kurtosis and mean impact of the column [m/s²]."""
        x = self.out[COLUMN]
        found = features(x, self.out.fs)
        impact = _mean_impact(x, self.out.fs / passing(self.out.scene))
        return float(found["rms"] or 0.0), float(found["peak"] or 0.0), found["kurtosis"], impact


def run_case(
    axial_load: float, duration: float, progress: Callable[[float], object] | None = None
) -> Case:
    """Run the wheel bearing under an axial load [N]."""
    scene = presets.wheel_bearing(axial_load)
    began = time.perf_counter()
    out = simulate(scene, duration=duration, fs=_FS, progress=progress)
    seconds = time.perf_counter() - began
    slices = slices_of(healthy_at_bottom(scene), "equilibrium", 0)
    found = zone(slices["z"], slices["width"], slices["force"])
    return Case(
        axial_load, out, load_distribution(scene.replace({"defects": {}})), slices, found, seconds
    )


def passing(scene: Scene) -> float:
    """Return the frequency of the balls of row 0 passing a place of the outer race [Hz]."""
    assert isinstance(scene.drive, SpeedDrive)
    assert isinstance(scene.drive.speed, float)
    return of_row(scene.rows[0]).at(scene.drive.speed / (2.0 * math.pi)).bpfo


def _mean_impact(signal: NDArray[np.float64], passage: float) -> float:
    """Mean, over the passages of balls (in samples), of the largest magnitude in each."""
    parts = max(int(signal.size / passage), 1)
    edges = (np.arange(parts) * passage).astype(int)
    return float(np.mean(np.maximum.reduceat(np.abs(signal), edges)))
