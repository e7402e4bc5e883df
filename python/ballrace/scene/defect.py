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
        Axial place of the middle, from the row's plane (races) or the ball's centre [m]. ``"contact"`` places it
        where the contact runs that it is there for: the most loaded of those that meet it over a turn of the
        balls, at the static equilibrium of the healthy bearing under the largest value of every load. Of a
        defect on the outer race that is a ball's at the defect's own angle; of one on a ball, its contact with
        the race that loads it more. Without equilibrium or load it is the place of the nominal contact angle.
        A run records the number in ``out.scene`` and its origin in ``out.defects``.
    shape : "cap", "pit" or None
        Outline; None: a patch of ``length`` and ``width``. A cap of a ball is a circle on its surface, as wide in
        every direction as ``width`` says, less than the ball's radius. Its middle is seen from the ball's centre
        in a direction that is fixed in the ball: at ``angle`` about z, and where it meets the surface at
        ``axial_offset``. A pit is a deep hole smaller than its contact, which bulges into it and shares load: an
        ellipse of ``width`` along rolling and ``length`` across; what is too large for its contact is refused.
    length : float
        Axial length [m]; of a cap 0, or left out, and of a round pit.
    width : Width
        Arc length along the surface [m]; of a cap or pit a plain number.
    edge_radius : float
        Radius of the fault circles at the edges [m]; a pit has none, and one with walls none of its own.
    walls : "steep" or None
        Walls of a patch of one width; None: the fault circles are as given. A contact hangs over a steep wall by
        half of itself before it reaches the surface beside it: its fault circles get a radius of a quarter of the
        ball's diameter and stand further apart than ``width`` by the half-width of the most loaded contact that
        meets the defect at the static equilibrium of the healthy bearing. What is narrower than 1.25 contacts is
        refused. A run records both numbers in ``out.scene``.
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
