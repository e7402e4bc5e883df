"""What a scene tells of the samples that a run of it gives."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..scene import Ramp, Sine, SpeedDrive, Table
from ..scene.defect import extent, widest
from .windows import Origin

if TYPE_CHECKING:
    from ..scene import Scene, TimeFunction

__all__ = ["origin_of", "shaft_of"]


def shaft_of(scene: Scene) -> float | None:
    """Return the rate of the shaft [Hz] where a scene keeps it constant, else None."""
    drive = scene.drive
    if not isinstance(drive, SpeedDrive) or not isinstance(drive.speed, int | float):
        return None
    return abs(drive.speed) / (2.0 * math.pi)


def origin_of(scene: Scene, version: str | None) -> Origin:
    """Return what windows of a run tell of its scene."""
    return Origin(
        speed=lambda t: _speed(scene, t),
        load=lambda t: [
            {
                "name": n,
                "ring": load.ring,
                "direction": list(load.direction),
                "force": _at(load.force, t),
            }
            for n, load in scene.loads.items()
        ],
        geometry=[
            {
                name: getattr(row, name)
                for name in ("ball_count", "ball_diameter", "pitch_diameter", "contact_angle")
            }
            for row in scene.rows
        ],
        defect=[
            {"name": n, "width": widest(d), "length": extent(d)}
            | {key: getattr(d, key) for key in ("on", "row", "ball", "angle")}
            for n, d in scene.defects.items()
            if widest(d) > 0.0
        ],
        version=version,
    )


def _speed(scene: Scene, t: float) -> float | None:
    """Return the speed [rad/s] at a time; a driving torque leaves it to the run."""
    drive = scene.drive
    return _at(drive.speed, t) if isinstance(drive, SpeedDrive) else None


def _at(value: TimeFunction, t: float) -> float:
    """Return the value of a function of time; at a jump the one after it."""
    match value:
        case Ramp(from_=before, to=after, start=start, end=end):
            share = (
                float(t >= end) if start == end else min(max((t - start) / (end - start), 0.0), 1.0)
            )
            return before + share * (after - before)
        case Sine(mean=mean, amplitude=amplitude, frequency=frequency, phase=phase):
            return mean + amplitude * math.sin(2.0 * math.pi * frequency * t + phase)
        case Table(times=times, values=values):
            return float(np.interp(t, times, values))
        case _:
            return float(value)
