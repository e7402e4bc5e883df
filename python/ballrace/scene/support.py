"""How bodies hang on the inertial frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .._document import Part, Variant

__all__ = ["Mount", "Spring", "Support"]


@dataclass(frozen=True, kw_only=True)
class Spring(Variant, tag="spring"):
    """A spring and a damper to the inertial frame, relaxed at the body's nominal place.

    Attributes
    ----------
    stiffness : float
        Stiffness [N/m], about z [N m/rad].
    damping : float
        Damping [N s/m], about z [N m s/rad].
    """

    stiffness: float = 0.0
    damping: float = 0.0


Mount = Literal["free", "fixed"] | Spring
"""One direction of a support."""


@dataclass(frozen=True, kw_only=True)
class Support(Part):
    """How a body hangs on the inertial frame, a direction each.

    An absent direction is fixed for the outer ring, free for the inner ring and the balls.

    Attributes
    ----------
    x, y, z : Mount or None
        Along the axes.
    theta : Mount or None
        About z. Absent for the inner ring when a given speed drives it.
    """

    x: Mount | None = None
    y: Mount | None = None
    z: Mount | None = None
    theta: Mount | None = None
