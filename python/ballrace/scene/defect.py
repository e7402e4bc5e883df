"""Defects of races and balls."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, get_args

from .._document import LEFT_OUT, Part

__all__ = [
    "AxialOffset",
    "Defect",
    "DefectShape",
    "DefectWalls",
    "Floor",
    "Surface",
    "Width",
    "WidthProfile",
]


Surface = Literal["outer_race", "inner_race", "ball"]
"""The surface that carries a defect."""

SURFACES: tuple[Surface, ...] = get_args(Surface)


DefectShape = Literal["cap", "pit"]
"""Outline of a defect that is not a patch of its length and width (see :class:`Defect`)."""


DefectWalls = Literal["steep"]
"""Walls from which the fault circles of a patch follow (see :class:`Defect`)."""


@dataclass(frozen=True, kw_only=True)
class WidthProfile(Part):
    """Width given at axial places, linear between them, constant beyond.

    Attributes
    ----------
    positions : tuple of float
        Axial places from the defect's middle, increasing [m].
    widths : tuple of float
        Widths [m].
    """

    positions: tuple[float, ...]
    widths: tuple[float, ...]


Width = float | WidthProfile
"""Width of a defect along its length; a plain number is constant [m]."""

AxialOffset = float | Literal["contact"]
"""Axial place of a defect's middle: a number [m], or where the contact runs (see :class:`Defect`)."""


@dataclass(frozen=True, kw_only=True)
class Floor(Part):
    """Fault circles between the edges of a defect, their crests at a depth: a bed of bumps.

    Attributes
    ----------
    depth : float
        Depth of the crests below the surface [m].
    elements : int
        Number of circles, 1 to 1000.
    """

    depth: float
    elements: int


@dataclass(frozen=True, kw_only=True)
class Defect(Part):
    """A surface that is absent over an arc, with fault circles at its edges; it turns with its body.

    Attributes
    ----------
    on : {"outer_race", "inner_race", "ball"}
        Which surface.
    row : int
        Row, from 0.
    ball : int or None
        Ball of the row, from 0; needed for a ball defect, absent otherwise.
    angle : float
        Angular place on the body, counter-clockwise from its own x axis [rad].
    axial_offset : AxialOffset
        Axial place of the middle, from the row's plane (races) or the ball's centre [m]. ``"contact"``: where the
        most loaded of the contacts runs that meet the defect over a turn of the balls, at the static equilibrium
        of the healthy bearing under the largest value of every load; on the outer race that of a ball at the
        defect's own angle, on a ball that with the race that loads it more. Without equilibrium or load it is the
        place of the nominal contact angle. A run records the number in ``out.scene`` and its origin in
        ``out.defects``.
    shape : "cap", "pit" or None
        Outline; None: a patch of ``length`` and ``width``. A cap of a ball is a circle on its surface, ``width``
        wide along the surface in every direction, less than the ball's radius. The direction from the ball's
        centre to its middle is fixed in the ball: at ``angle`` about z, with ``axial_offset`` the axial place of
        the middle. A pit is a deep hole smaller than its contact, into which the surfaces bulge so that the
        contact loses part of its load: an ellipse of ``width`` along rolling and ``length`` across. A pit too
        large for its contact is refused.
    length : float
        Axial length [m]; 0 or left out for a cap and for a round pit.
    width : Width
        Arc length along the surface [m]; for a cap, a pit and steep walls one number.
    edge_radius : float
        Radius of the fault circles at the edges [m]; left out for a pit, which has none, and with ``walls``,
        which set it.
    walls : "steep" or None
        Walls of a patch of one width; None: distance and radius of the fault circles are ``width`` and
        ``edge_radius``. Over a steep wall a contact carries load until half of it is over the wall: its fault
        circles get a radius of a quarter of the ball's diameter and stand further apart than ``width`` by the
        half-width of the most loaded contact that meets the defect at the static equilibrium of the healthy
        bearing. A defect narrower than 1.25 contacts is refused. A run records both numbers in ``out.scene``.
    floor : Floor or None
        Recessed circles between the edges; None: no floor.
    """

    on: Surface
    row: int = 0
    ball: int | None = None
    angle: float
    axial_offset: AxialOffset = "contact"
    shape: DefectShape | None = field(default=None, metadata=LEFT_OUT)
    length: float = 0.0
    width: Width
    edge_radius: float = 0.0
    walls: DefectWalls | None = field(default=None, metadata=LEFT_OUT)
    floor: Floor | None = None


def widest(defect: Defect) -> float:
    """Return the largest width of a defect [m]."""
    width = defect.width
    return max(width.widths) if isinstance(width, WidthProfile) else float(width)


def extent(defect: Defect) -> float:
    """Return how far a defect reaches along the axis [m]; caps and round pits are as long as they are wide."""
    is_round = defect.shape is not None and defect.length == 0.0
    return widest(defect) if is_round else defect.length
