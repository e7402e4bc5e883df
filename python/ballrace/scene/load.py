"""Loads on the rings."""

from __future__ import annotations

from dataclasses import dataclass, field

from .._document import LEFT_OUT, Part
from .bearing import RingName
from .time import TimeFunction

__all__ = ["Load", "Moment", "Unbalance"]


@dataclass(frozen=True, kw_only=True)
class Load(Part):
    """A force on a ring's centre or on another point of it, in a fixed direction of the inertial frame.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The loaded ring.
    direction : tuple of three floats
        Direction along x, y, z [1]; its length does not matter.
    force : TimeFunction
        Force along the direction [N].
    at : tuple of three floats, or None
        The point in the ring's frame, which tilts but does not turn with the ring [m]; None: the ring's origin.
    """

    ring: RingName
    direction: tuple[float, float, float]
    force: TimeFunction
    at: tuple[float, float, float] | None = field(default=None, metadata=LEFT_OUT)


@dataclass(frozen=True, kw_only=True)
class Moment(Part):
    """A moment on a ring, about a direction that is fixed in the inertial frame.

    The part about the ring's axis turns the ring; the part across it tilts the ring, or is carried by what
    holds it.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The loaded ring.
    direction : tuple of three floats
        What it turns about, along x, y, z [1]; its length does not matter.
    moment : TimeFunction
        Moment about the direction [N m].
    """

    ring: RingName
    direction: tuple[float, float, float]
    moment: TimeFunction


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
    axial_position : float or None
        Axial place in the ring's frame [m], of which two make a couple; None: 0.
    """

    ring: RingName
    moment: float
    angle: float = 0.0
    axial_position: float | None = field(default=None, metadata=LEFT_OUT)
