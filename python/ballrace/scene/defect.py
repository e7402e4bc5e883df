"""Defects of races and balls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal, get_args

from .._base.document import Part, Told

__all__ = [
    "AxialOffset",
    "Cap",
    "Defect",
    "DefectShape",
    "DefectWalls",
    "Dent",
    "Floor",
    "Patch",
    "Pit",
    "SteepPatch",
    "Surface",
    "Width",
    "WidthProfile",
]


Surface = Literal["outer_race", "inner_race", "ball"]
"""The surface that carries a defect."""

SURFACES: tuple[Surface, ...] = get_args(Surface)


DefectShape = Literal["cap", "pit", "dent"]
"""Word of a document for a kind of damage that is no patch: :class:`Cap`, :class:`Pit`, :class:`Dent`."""


DefectWalls = Literal["steep"]
"""Word of a document for the walls of a :class:`SteepPatch`."""


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
class Defect(Told):
    """A damage of a surface and where it lies; it turns with its body. What it is, is its class.

    :class:`Patch`, :class:`SteepPatch`, :class:`Cap`, :class:`Pit` and :class:`Dent` are the kinds.
    ``Defect`` itself takes the fields of a document, whose ``shape`` and ``walls`` say the kind, and returns
    one of them.

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
        Axial place of the middle, from the row's plane (races) or the ball's centre [m]. ``"contact"``: where
        the most loaded of the contacts runs that meet the defect over a turn of the balls, at the static
        equilibrium of the healthy bearing under the largest value of every load; on the outer race that of a
        ball at the defect's own angle, on a ball that with the race that loads it more. Without equilibrium
        or load it is the place of the nominal contact angle. A run records the number in ``out.scene`` and
        its origin in ``out.defects``.
    shape : "cap", "pit", "dent" or None
        Kind of the damage; None: a patch of ``length`` and ``width``.
    walls : "steep" or None
        Walls of a patch; None: distance and radius of its fault circles are ``width`` and ``edge_radius``.

    Examples
    --------
    >>> pit = Defect(on="outer_race", angle=-1.57, shape="pit", width=0.2e-3)
    >>> pit == Pit(on="outer_race", angle=-1.57, width=0.2e-3)
    True
    """

    _telling: ClassVar[tuple[str, ...]] = ("shape", "walls")

    on: Surface
    row: int = 0
    ball: int | None = None
    angle: float
    axial_offset: AxialOffset = "contact"

    if TYPE_CHECKING:

        def __init__(self, **fields: Any) -> None: ...

        def __getattr__(self, name: str) -> Any: ...


@dataclass(frozen=True, kw_only=True)
class Patch(Defect):
    """A surface that is absent over a length along the axis and a width along rolling, between fault circles.

    Attributes
    ----------
    length : float
        Axial length [m].
    width : Width
        Arc length along the surface [m]; a number, or a profile along the axis.
    edge_radius : float
        Radius of the fault circles at the edges [m].
    floor : Floor or None
        Recessed circles between the edges; None: no floor.
    """

    shape: ClassVar[None] = None
    walls: ClassVar[None] = None

    length: float
    width: Width
    edge_radius: float
    floor: Floor | None = None


@dataclass(frozen=True, kw_only=True)
class SteepPatch(Defect):
    """A patch of one width between steep walls.

    A contact carries load over a steep wall until half of it is over the wall. A run has a :class:`Patch` in
    its place, and records it in ``out.scene``: its fault circles have a radius of a quarter of the ball's
    diameter and stand further apart than the walls by the half-width of the most loaded contact that meets
    the defect at the static equilibrium of the healthy bearing. A defect narrower than 1.25 contacts is
    refused.

    Attributes
    ----------
    length : float
        Axial length [m].
    width : float
        Arc length along the surface from wall to wall [m].
    floor : Floor or None
        Recessed circles between the edges; None: no floor.
    """

    shape: ClassVar[None] = None
    walls: ClassVar[Literal["steep"]] = "steep"
    edge_radius: ClassVar[float] = 0.0

    length: float
    width: float
    floor: Floor | None = None


@dataclass(frozen=True, kw_only=True)
class Cap(Defect):
    """A circle on a ball's surface in which that is absent, with fault circles at its rim, fixed in the ball.

    The direction from the ball's centre to its middle is at ``angle`` about z, with ``axial_offset`` the
    axial place of the middle.

    Attributes
    ----------
    width : float
        Width along the ball's surface, the same in every direction, less than the ball's radius [m].
    edge_radius : float
        Radius of the fault circles at the rim [m].
    floor : Floor or None
        Recessed circles within; None: no floor.
    """

    shape: ClassVar[Literal["cap"]] = "cap"
    walls: ClassVar[None] = None
    length: ClassVar[float] = 0.0

    width: float
    edge_radius: float
    floor: Floor | None = None


@dataclass(frozen=True, kw_only=True)
class Pit(Defect):
    """A deep hole smaller than its contact, into which the surfaces bulge: the contact loses part of its load.

    It is an ellipse with sharp edges, whose floor no contact meets. One too large for its contact is refused.

    Attributes
    ----------
    width : float
        Extent along rolling [m].
    length : float
        Extent across [m]; 0: round.
    """

    shape: ClassVar[Literal["pit"]] = "pit"
    walls: ClassVar[None] = None
    edge_radius: ClassVar[float] = 0.0
    floor: ClassVar[None] = None

    width: float
    length: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Dent(Defect):
    """A dent with a raised rim, as a hard particle leaves it, smaller than its contact.

    It is half an ellipsoid, into which the surfaces bulge down to its floor. The rim begins at its edge, is
    highest in the middle and ends at one and a half times its size. One too large for its contact is refused.
    Forces are right where the rim is lower than a tenth of the contact's approach, which is 4.7 µm for a 6205
    under 250 N a ball; over higher ones a ball is lifted further.

    Attributes
    ----------
    width : float
        Extent along rolling at the level of the surface [m].
    length : float
        Extent across [m]; 0: round.
    depth : float
        Depth in the middle [m].
    rim_height : float
        Height of the rim's crest [m]; 0: no rim.
    """

    shape: ClassVar[Literal["dent"]] = "dent"
    walls: ClassVar[None] = None
    edge_radius: ClassVar[float] = 0.0
    floor: ClassVar[None] = None

    width: float
    length: float = 0.0
    depth: float
    rim_height: float = 0.0


ALONG_AXIS = (Patch, SteepPatch)
"""Kinds with their length along the ring's axis, which a ball that has one must keep."""


def named_by_shape(defect: Defect) -> str:
    """Return the name of a defect that is alone and has none: that of its shape, of a patch ``"spall"``."""
    return defect.shape or "spall"


def widest(defect: Defect) -> float:
    """Return the largest width of a defect [m]."""
    width = defect.width
    return max(width.widths) if isinstance(width, WidthProfile) else float(width)


def extent(defect: Defect) -> float:
    """Return how far a defect reaches along the axis [m]; caps and what is round are as long as they are wide."""
    is_round = defect.shape is not None and defect.length == 0.0
    return widest(defect) if is_round else float(defect.length)
