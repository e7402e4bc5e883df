"""Drives of the inner ring."""

from __future__ import annotations

from dataclasses import dataclass

from .._base.document import Variant
from .time import TimeFunction

__all__ = ["Drive", "SpeedDrive", "TorqueDrive"]


@dataclass(frozen=True)
class SpeedDrive(Variant, tag="speed", wraps=True):
    """The inner ring turns at a given speed.

    Attributes
    ----------
    speed : TimeFunction
        Speed [rad/s]; must not jump.
    """

    speed: TimeFunction


@dataclass(frozen=True, kw_only=True)
class TorqueDrive(Variant, tag="torque"):
    """A given torque about z turns the inner ring.

    Attributes
    ----------
    value : TimeFunction
        Torque [N m].
    initial_speed : float
        Speed at t = 0 [rad/s].
    """

    value: TimeFunction
    initial_speed: float = 0.0


Drive = SpeedDrive | TorqueDrive
"""Drive of the inner ring."""
