"""How fast the rings of a scene turn, as far as it gives their speeds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .drive import SpeedDrive
from .time import values_at

if TYPE_CHECKING:
    from .scene import Scene
    from .time import TimeFunction

__all__ = ["constant_speeds", "relative_speed", "value_at"]


def constant_speeds(scene: Scene) -> tuple[float, float] | None:
    """Return the speeds of outer and inner ring [rad/s]; None where one is not given, or changes."""
    outer = 0.0 if scene.outer_speed is None else scene.outer_speed
    inner = scene.drive.speed if isinstance(scene.drive, SpeedDrive) else None
    if isinstance(outer, int | float) and isinstance(inner, int | float):
        return float(outer), float(inner)
    return None


def relative_speed(scene: Scene, t: float | None = None) -> float | None:
    """Return the speed of the inner ring relative to the outer at a time [rad/s]; None where a torque drives it.

    Fault frequencies are proportional to it; it is the speed of the shaft where the outer ring stands. Without a
    time it is also None where a speed changes.
    """
    if t is None:
        steady = constant_speeds(scene)
        return None if steady is None else steady[1] - steady[0]
    if not isinstance(scene.drive, SpeedDrive):
        return None
    outer = 0.0 if scene.outer_speed is None else value_at(scene.outer_speed, t)
    return value_at(scene.drive.speed, t) - outer


def value_at(function: TimeFunction, t: float) -> float:
    """Return the value of a function of time; at a jump the one after it."""
    return float(values_at(function, t))
