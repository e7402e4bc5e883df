"""Metadata of a run's samples from its scene."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..scene.defect import extent, widest
from ..scene.turning import relative_speed, value_at
from .windows import Origin

if TYPE_CHECKING:
    from ..scene import Scene


def shaft_of(scene: Scene) -> float | None:
    """Return the rate of the inner ring against the outer [Hz] where a scene keeps it constant, else None."""
    speed = relative_speed(scene)
    return None if speed is None else abs(speed) / (2.0 * math.pi)


def origin_of(scene: Scene, version: str | None) -> Origin:
    """Return the origin of windows of a run, from its scene."""
    return Origin(
        speed=lambda t: relative_speed(scene, t),
        load=lambda t: [
            {
                "name": n,
                "ring": load.ring,
                "direction": list(load.direction),
                "force": value_at(load.force, t),
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
