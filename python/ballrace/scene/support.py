"""Supports of bodies on the inertial frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from .._document import LEFT_OUT, Part, Variant
from .time import TimeFunction

__all__ = ["CoupledSupport", "Given", "Mount", "Spring", "Support"]


@dataclass(frozen=True, kw_only=True)
class Spring(Variant, tag="spring"):
    """A spring and a damper to the inertial frame, relaxed at the body's nominal place.

    Attributes
    ----------
    stiffness : float
        Stiffness [N/m], of rotations [N m/rad].
    damping : float
        Damping [N s/m], of rotations [N m s/rad].
    """

    stiffness: float = 0.0
    damping: float = 0.0


@dataclass(frozen=True)
class Given(Variant, tag="given", wraps=True):
    """A ring follows a given motion, in a direction along an axis or a tilt; about z a speed prescribes it.

    Attributes
    ----------
    motion : TimeFunction
        Its place in time [m], of tilts [rad]: a number, a sine or a spline.
    """

    motion: TimeFunction


Mount = Literal["free", "fixed"] | Spring | Given
"""One direction of a support."""


@dataclass(frozen=True, kw_only=True)
class CoupledSupport(Part):
    """Springs and dampers between all directions of a ring, in the order x, y, z, tilt_x, tilt_y, theta.

    Both matrices are symmetric and positive semidefinite; rows and columns of a driven rotation are 0.
    Directions that are fixed stay where they are.

    Attributes
    ----------
    stiffness : 6 x 6 numbers
        Stiffness [N/m], [N/rad], [N m/rad].
    damping : 6 x 6 numbers
        Damping, the same times seconds [N s/m], [N s/rad], [N m s/rad].
    axial_position : float
        Place on the ring's axis that they hold, in the ring's frame [m].
    """

    stiffness: tuple[tuple[float, ...], ...]
    damping: tuple[tuple[float, ...], ...] = ((0.0,) * 6,) * 6
    axial_position: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Support(Part):
    """How a body is supported on the inertial frame, a direction each.

    An absent direction is fixed for the outer ring, free for the inner ring and the balls; an absent tilt is
    fixed.

    Attributes
    ----------
    x, y, z : Mount or None
        Along the axes.
    theta : Mount or None
        About z. Absent for the inner ring when a given speed drives it.
    tilt_x, tilt_y : Mount or None
        Of a ring, its tilts about x and y; absent: fixed.
    coupled : CoupledSupport or None
        Of a ring, springs and dampers between all directions, beside those above.
    """

    x: Mount | None = None
    y: Mount | None = None
    z: Mount | None = None
    theta: Mount | None = None
    tilt_x: Mount | None = field(default=None, metadata=LEFT_OUT)
    tilt_y: Mount | None = field(default=None, metadata=LEFT_OUT)
    coupled: CoupledSupport | None = field(default=None, metadata=LEFT_OUT)
