"""Loads on the rings."""

from __future__ import annotations

from dataclasses import dataclass

from .._document import Part
from .bearing import RingName
from .time import TimeFunction

__all__ = ["Load", "Unbalance"]


@dataclass(frozen=True, kw_only=True)
class Load(Part):
    """A force on a ring's centre, in a fixed direction of the inertial frame.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The loaded ring.
    direction : tuple of three floats
        Direction along x, y, z [1]; its length does not matter.
    force : TimeFunction
        Force along the direction [N].
    """

    ring: RingName
    direction: tuple[float, float, float]
    force: TimeFunction


@dataclass(frozen=True, kw_only=True)
class Unbalance(Part):
    """A mass off the axis of a ring that turns with it.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The unbalanced ring.
    moment : float
        Mass times eccentricity [kg m].
    angle : float
        Angular place on the ring, counter-clockwise from its own x axis [rad].
    """

    ring: RingName
    moment: float
    angle: float = 0.0
