"""Defects by their usual names: a spall, a dent, a line, a pit, a cap of a ball, with sizes in millimetres.

Each is a :class:`ballrace.scene.Defect`, placed where the contact runs unless ``axial_offset`` says
otherwise; put them into a scene by name: ``br.bearing("6205", defects={"spall": spall(on="inner_race",
width_mm=1.0)})``.

>>> import ballrace as br
>>> spall(on="outer_race", width_mm=1.0).width
0.001
>>> dent(on="ball", diameter_mm=0.2, ball=3).depth
8e-06
>>> cap(width_mm=1.0, ball=3).shape
'cap'
>>> pit(on="outer_race", diameter_mm=0.178).shape
'pit'
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

from ._base.numbers import positive
from .errors import SceneError
from .scene import Cap, Dent, Floor, Patch, Pit, SteepPatch, WidthProfile

if TYPE_CHECKING:
    from .scene import AxialOffset, Surface, Width

__all__ = ["cap", "dent", "line", "pit", "spall"]

_DOWN = -math.pi / 2.0
"""Angle at which a load along -y presses the balls into the outer race."""

_ROLLED = 0.3
"""Radius of rolled edges [mm]."""

_CHORDS = 16
"""Pieces that the outline of a round patch is drawn with."""

_DEPTH, _RIM = 25.0, 500.0
"""Diameter of a dent over its depth and over the height of its rim."""


def spall(
    *,
    on: Surface,
    width_mm: float,
    length_mm: float = 2.0,
    depth_mm: float | None = None,
    edge_radius_mm: float | None = None,
    walls: Literal["rolled", "steep"] = "rolled",
    angle: float = _DOWN,
    axial_offset: AxialOffset = "contact",
    row: int = 0,
    ball: int | None = None,
) -> Patch | SteepPatch:
    """Return a spall: a rectangle in which the surface is absent.

    Parameters
    ----------
    on : {"outer_race", "inner_race", "ball"}
        Which surface.
    width_mm, length_mm : float
        Extent along the rolling direction, and across it [mm].
    depth_mm : float, optional
        Depth of its floor [mm]; by default so deep that no ball meets it. A shallow floor is a bed of ten
        bumps. For a seeded hole of 0.1 to 0.6 mm give 0.77 of the largest approach of the contacts under the load
        (``br.equilibrium(scene).outer_deflection``; 0.0025 for a 6205 under 300 N): it stands for what carries a
        ball beside a hole that is shorter than the contact. It was fitted at that load, which is assumed, so that
        four records of Case Western Reserve University have their levels within a factor of 2; edges do not.
    edge_radius_mm : float, optional
        Radius of its rolled edges, that of the fault circles [mm]; by default 0.3. Left out with steep walls.
    walls : {"rolled", "steep"}
        Edges that are rolled over, or steep walls, which set the radius and move the fault circles apart so
        that contacts unload as in boundary-element solutions: see :class:`ballrace.scene.Defect`. Steep walls
        need a spall at least 1.25 contacts wide.
    angle : float
        Angular place on the body, counter-clockwise from its own x axis [rad]; by default where a load along -y
        presses on the outer race.
    axial_offset : float or "contact"
        Axial place of its middle [m], or where the contact runs, as of :class:`ballrace.scene.Defect`.
    row, ball : int
        Row, and of a ball defect which ball; by default the first of each.

    Raises
    ------
    SceneError
        A number is not usable. What depends on the bearing is checked with the scene.
    """
    _positive(width_mm=width_mm, length_mm=length_mm)
    edge_radius = _edge_radius(walls, edge_radius_mm)
    floor = None
    if depth_mm is not None:
        _positive(depth_mm=depth_mm)
        floor = Floor(depth=1e-3 * depth_mm, elements=10)
    place = _place(on, row, ball, angle, axial_offset)
    length, width = 1e-3 * length_mm, 1e-3 * width_mm
    if edge_radius is None:
        return SteepPatch(**place, length=length, width=width, floor=floor)
    return Patch(**place, length=length, width=width, edge_radius=edge_radius, floor=floor)


def _edge_radius(walls: str, given: float | None) -> float | None:
    """Return the radius of fault circles beside walls [m]; None where it follows from them."""
    if walls not in ("rolled", "steep"):
        raise SceneError("walls", repr(walls), "'rolled' or 'steep'")
    if walls == "steep":
        if given is not None:
            raise SceneError(
                "edge_radius_mm", repr(given), "left out with walls='steep', from which it follows"
            )
        return None
    radius = _ROLLED if given is None else given
    _positive(edge_radius_mm=radius)
    return 1e-3 * radius


def dent(
    *,
    on: Surface,
    diameter_mm: float,
    length_mm: float | None = None,
    depth_mm: float | None = None,
    rim_height_mm: float | None = None,
    edge_radius_mm: float | None = None,
    angle: float = _DOWN,
    axial_offset: AxialOffset = "contact",
    row: int = 0,
    ball: int | None = None,
) -> Dent | Patch:
    """Return a dent with a raised rim, as a hard particle leaves between ball and race.

    It is smaller than its contact, like a :func:`pit`: the surfaces bulge into it, and its rim presses them
    back. One larger than the contact is refused when the scene is used. With ``edge_radius_mm`` it is a round
    patch instead, in which the surface is absent, for dents wider than their contact.

    Parameters
    ----------
    diameter_mm : float
        Extent along the rolling direction at the level of the surface [mm].
    length_mm : float, optional
        Extent across it [mm]; by default the dent is round.
    depth_mm : float, optional
        Depth in the middle [mm]; by default a twenty-fifth of the diameter. From some hundredth on, contacts
        do not meet its floor.
    rim_height_mm : float, optional
        Height of the rim's crest [mm], 0 for none; by default a five-hundredth of the diameter, an assumption
        of what overrolling leaves.
    edge_radius_mm : float, optional
        Radius of the rolled edges of a round patch [mm], which has neither rim, depth nor length.
    on, angle, axial_offset, row, ball
        As for :func:`spall`.

    Raises
    ------
    SceneError
        A number is not usable.
    """
    _positive(diameter_mm=diameter_mm)
    place = _place(on, row, ball, angle, axial_offset)
    diameter = 1e-3 * diameter_mm
    given = {"length_mm": length_mm, "depth_mm": depth_mm, "rim_height_mm": rim_height_mm}
    if edge_radius_mm is not None:
        for name, value in given.items():
            if value is not None:
                raise SceneError(name, repr(value), "left out beside edge_radius_mm")
        _positive(edge_radius_mm=edge_radius_mm)
        edge = 1e-3 * edge_radius_mm
        return Patch(**place, length=diameter, width=_round(diameter), edge_radius=edge)
    _positive(**{name: value for name, value in given.items() if value not in (None, 0.0)})
    return Dent(
        **place,
        width=diameter,
        length=1e-3 * (length_mm or 0.0),
        depth=diameter / _DEPTH if depth_mm is None else 1e-3 * depth_mm,
        rim_height=diameter / _RIM if rim_height_mm is None else 1e-3 * rim_height_mm,
    )


def line(
    *,
    on: Surface,
    width_mm: float = 0.2,
    length_mm: float = 2.0,
    edge_radius_mm: float = 0.05,
    angle: float = _DOWN,
    axial_offset: AxialOffset = "contact",
    row: int = 0,
    ball: int | None = None,
) -> Patch:
    """Return a narrow line with sharp edges across the rolling direction, as an engraver or a wire leaves it.

    Parameters
    ----------
    on, width_mm, length_mm, edge_radius_mm, angle, axial_offset, row, ball
        As for :func:`spall`; only the default sizes differ.

    Raises
    ------
    SceneError
        A number is not usable.
    """
    _positive(width_mm=width_mm, length_mm=length_mm, edge_radius_mm=edge_radius_mm)
    return Patch(
        **_place(on, row, ball, angle, axial_offset),
        length=1e-3 * length_mm,
        width=1e-3 * width_mm,
        edge_radius=1e-3 * edge_radius_mm,
    )


def cap(
    *,
    width_mm: float,
    edge_radius_mm: float = 0.3,
    angle: float = _DOWN,
    axial_offset: AxialOffset = "contact",
    row: int = 0,
    ball: int = 0,
) -> Cap:
    """Return a cap of a ball: a circle on its surface, within which the surface is absent, fixed in the ball.

    Parameters
    ----------
    width_mm : float
        Width along the ball's surface, the same in every direction [mm].
    edge_radius_mm, angle, axial_offset, row, ball
        As for :func:`spall`; angle and axial place are those of its middle.

    Raises
    ------
    SceneError
        A number is not usable.
    """
    _positive(width_mm=width_mm, edge_radius_mm=edge_radius_mm)
    return Cap(
        **_place("ball", row, ball, angle, axial_offset),
        width=1e-3 * width_mm,
        edge_radius=1e-3 * edge_radius_mm,
    )


def pit(
    *,
    on: Surface,
    diameter_mm: float,
    length_mm: float | None = None,
    angle: float = _DOWN,
    axial_offset: AxialOffset = "contact",
    row: int = 0,
    ball: int | None = None,
) -> Pit:
    """Return a pit smaller than its contact, as electric discharge or a seeded fault of a data set.

    The surfaces bulge into it, and the contact loses part of its load. It is a hole with sharp edges, so deep
    that nothing meets its floor. A pit longer than some nine tenths of its contact is refused when the scene is
    used: it is a :func:`spall`.

    Parameters
    ----------
    diameter_mm : float
        Extent along the rolling direction [mm].
    length_mm : float, optional
        Extent across it [mm]; by default the pit is round.
    on, angle, axial_offset, row, ball
        As for :func:`spall`.

    Raises
    ------
    SceneError
        A number is not usable.
    """
    _positive(diameter_mm=diameter_mm)
    if length_mm is not None:
        _positive(length_mm=length_mm)
    return Pit(
        **_place(on, row, ball, angle, axial_offset),
        length=1e-3 * (length_mm or 0.0),
        width=1e-3 * diameter_mm,
    )


def _round(diameter: float) -> Width:
    """Return the widths of a disc along its axial places."""
    turn = [math.pi * (k / _CHORDS - 1.0) for k in range(_CHORDS + 1)]
    positions = tuple(0.5 * diameter * math.cos(t) for t in turn)
    widths = tuple(abs(diameter * math.sin(t)) for t in turn)
    return WidthProfile(positions=positions, widths=(0.0, *widths[1:-1], 0.0))


def _place(
    on: Surface, row: int, ball: int | None, angle: float, axial_offset: AxialOffset
) -> dict[str, Any]:
    """Return where a defect lies, of a ball on the first one unless another is given."""
    ball = 0 if on == "ball" and ball is None else ball
    return {"on": on, "row": row, "ball": ball, "angle": angle, "axial_offset": axial_offset}


def _positive(**sizes: float) -> None:
    for name, size in sizes.items():
        positive(name, size, "mm")
