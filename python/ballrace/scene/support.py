"""Supports of bodies on the inertial frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from .._base.document import LEFT_OUT, Part, Variant
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
    """A ring follows a given motion along an axis or of a tilt; not about z, where a speed is given.

    Attributes
    ----------
    motion : TimeFunction
        Its place over time [m], of tilts the angle [rad]: a number, a sine or a spline.
    """

    motion: TimeFunction


Mount = Literal["free", "fixed"] | Spring | Given
"""Mount of a ring in one direction."""


@dataclass(frozen=True, kw_only=True)
class CoupledSupport(Part):
    """Springs and dampers between all directions of a ring, in the order x, y, z, tilt_x, tilt_y, theta.

    Both matrices are symmetric and positive semidefinite; row and column of theta are 0 where the ring's speed is
    given. Fixed directions stay fixed.

    Attributes
    ----------
    stiffness : 6 x 6 numbers
        Stiffness [N/m], [N/rad], [N m/rad].
    damping : 6 x 6 numbers
        Damping, the same times seconds [N s/m], [N s/rad], [N m s/rad].
    axial_position : float
        Axial place of the point of the ring's axis on which they act, in the ring's frame [m].
    """

    stiffness: tuple[tuple[float, ...], ...]
    damping: tuple[tuple[float, ...], ...] = ((0.0,) * 6,) * 6
    axial_position: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Support(Part):
    """How a body is supported on the inertial frame, direction by direction.

    An absent direction is fixed for the outer ring, free for the inner ring and the balls; an absent tilt is
    fixed.

    Attributes
    ----------
    x, y, z : Mount or None
        Along the axes.
    theta : Mount or None
        About z; absent for a ring whose speed is given.
    tilt_x, tilt_y : Mount or None
        Tilts about x and y, of rings only; absent: fixed.
    coupled : CoupledSupport or None
        Springs and dampers between all directions, in addition to those above; of rings only.
    """

    x: Mount | None = None
    y: Mount | None = None
    z: Mount | None = None
    theta: Mount | None = None
    tilt_x: Mount | None = field(default=None, metadata=LEFT_OUT)
    tilt_y: Mount | None = field(default=None, metadata=LEFT_OUT)
    coupled: CoupledSupport | None = field(default=None, metadata=LEFT_OUT)
