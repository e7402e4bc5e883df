"""A rigid shaft on bearings at their places."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

from .._base.arguments import knows
from .._base.numbers import real
from ..bearings import Bearing, catalogue
from ..bearings.build import (
    OUTER,
    OUTER_RING,
    SEAT_DAMPING,
    SEAT_STIFFNESS,
    asked_clearance,
    metal,
    rows_of,
)
from ..bearings.filled import filled
from ..bearings.pedestal import chosen_housing
from ..errors import SceneError
from ..scene import Defect, Load, Lubricant, Ring, Row, Scene, Spring, Support, Unbalance

if TYPE_CHECKING:
    from ..scene import Structure

SPEEDS = {
    **dict.fromkeys(("speed", "rpm", "n"), "speed_rpm, the speed of the shaft [1/min]"),
    **OUTER,
}
_MEANT = {
    **SPEEDS,
    **dict.fromkeys(
        ("load", "force", "radial_load", "axial_load"),
        'loads={"name": br.machines.force(y=-500.0, at=0.1)}, each at its place',
    ),
}
"""Advice on what to write instead of arguments that there are not."""

_STEEL = 7850.0
_DAMPING = 300.0
"""Damping of the shaft's surroundings at each bearing [N s/m], as of a bearing of its own."""

_BEARINGS = 'bearings with their places [m], such as [("6309", 0.0), ("6207", 0.25)]'
_MASSES = (
    "masses and their places, such as [(12.0, 0.12)] [kg, m], of discs with a diameter behind them"
)
_UNBALANCES = (
    "moments and their places, such as [(50e-6, 0.12)] [kg m, m], with an angle behind them [rad]"
)


@dataclass(frozen=True)
class _Place:
    """A bearing at its place; ``side`` as of a row."""

    made: Bearing
    at: float
    rows: tuple[Row, ...]


@knows(_MEANT)
def shaft(
    bearings: Sequence[tuple[str | Bearing, float] | tuple[str | Bearing, float, int]],
    *,
    speed_rpm: float | None = None,
    outer_rpm: float | None = None,
    masses: Sequence[tuple[float, float] | tuple[float, float, float]] = (),
    unbalances: Sequence[tuple[float, float] | tuple[float, float, float]] = (),
    loads: Mapping[str, Load] | None = None,
    defects: Defect | Mapping[str, Defect] | None = None,
    lubricant: str | Lubricant | None = None,
    temperature_c: float | None = None,
    housing: Literal["pedestal"] | Structure | None = "pedestal",
) -> Scene:
    """Return a rigid shaft on two or more bearings, as one scene with a row for each row of balls.

    The shaft is one body that moves and tilts: a steel cylinder of the smallest bore from the first bearing to the
    last, with the masses on it. All outer rings are another, which moves and does not tilt.

    The shaft does not bend, and no outer ring slides in its seat: every deep groove bearing holds the shaft
    axially, within its clearance.

    Parameters
    ----------
    bearings : sequence of (str or Bearing, float) or (str or Bearing, float, int)
        Names as of :func:`ballrace.bearing`, and axial places of their middles [m]; bearings may touch but not
        overlap. For angular contact bearings of one row also the side: +1 takes thrust on the shaft towards +z,
        -1 towards -z.
    speed_rpm : float, optional
        Speed of the shaft [1/min]; may be left out only where the outer rings turn, and is then 0.
    outer_rpm : float, optional
        Speed of all outer rings [1/min], as in wheel hubs, idlers and sheaves on an axle; by default they stand.
        What they stand on does not turn.
    masses : sequence of (float, float) or (float, float, float)
        Masses on the shaft: mass [kg], axial place [m], and the diameter of a disc [m] (without: a point).
    unbalances : sequence of (float, float) or (float, float, float)
        Mass times eccentricity [kg m], axial place [m], and angle on the shaft [rad] (without: 0).
    loads : mapping of str to Load
        Loads by name, as :func:`ballrace.machines.belt`, ``gear`` and ``force`` make them, in addition to gravity.
    defects : Defect, or mapping of str to Defect
        Defects by name, or one alone; their ``row`` counts the rows in the order of the bearings, from 0.
    lubricant, temperature_c
        As of :func:`ballrace.bearing`.
    housing : {"pedestal"}, Structure or None
        What all outer rings stand on together, as of :func:`ballrace.bearing`; ``"pedestal"``: pedestals of the
        bearings' mean size side by side.

    Returns
    -------
    Scene
        :func:`ballrace.machines.reactions` has what each row carries, ``br.fault_frequencies(scene, row=1)`` the
        frequencies of the second.

    Raises
    ------
    SceneError
        A bearing is not known, or an argument is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> motor = br.shaft(
    ...     [("6309/C3", 0.0), ("6207/C3", 0.25)], speed_rpm=1480.0, masses=[(9.0, 0.13, 0.12)],
    ...     unbalances=[(40e-6, 0.13)], loads={"belt": br.machines.belt(900.0, at=-0.08)},
    ... )
    >>> [round(float(each.force[1])) for each in br.machines.reactions(motor)]
    [1239, -232]
    """
    places = [_placed(each) for each in _several(bearings)]
    _check_apart(places)
    return filled(
        name=" + ".join(place.made.designation for place in places),
        rows=tuple(row for place in places for row in place.rows),
        outer_ring=_outer(places),
        structure=_around(places, housing),
        inner_ring=_inner(places, masses),
        speed_rpm=speed_rpm,
        outer_rpm=outer_rpm,
        loads=loads,
        unbalances=_unbalances(unbalances),
        defects=defects,
        lubricant=lubricant,
        temperature_c=temperature_c,
    )


def _several(bearings: object) -> list[tuple[object, ...]]:
    """Return bearings with their places."""
    given = list(bearings) if isinstance(bearings, Sequence) else []
    pairs = [tuple(each) for each in given if isinstance(each, Sequence) and len(each) in (2, 3)]
    placed = [each for each in pairs if math.isfinite(real(each[1]))]
    if len(given) < 2 or len(placed) < len(given):
        raise SceneError("bearings", repr(bearings), f"two or more {_BEARINGS}")
    return pairs


def _check_apart(places: list[_Place]) -> None:
    """Refuse bearings that stand in each other; side by side they may touch."""
    for first, second in pairwise(sorted(places, key=lambda place: place.at)):
        apart, least = second.at - first.at, 0.5 * (first.made.width + second.made.width)
        if apart < least * (1.0 - 1e-9):
            pair = f"{first.made.designation} at {first.at:g} m, {second.made.designation} at {second.at:g} m"
            allowed = f"places {least:g} m apart or more: by their widths these two overlap"
            raise SceneError("bearings", pair, allowed)


def _placed(each: tuple[object, ...]) -> _Place:
    name, at, side = each[0], float(real(each[1])), each[2] if len(each) == 3 else None
    if not isinstance(name, str | Bearing):
        raise SceneError("bearings", repr(each), _BEARINGS)
    made = catalogue[name] if isinstance(name, str) else name
    single = made.kind == "angular_contact"
    if (side in (1, -1)) is not single or (side is not None and not single):
        allowed = f"{made.designation} with its place" + (
            " and its side, +1 (takes thrust towards +z) or -1" if single else " alone"
        )
        raise SceneError("bearings", repr(each), allowed)
    placed = [
        replace(row, axial_position=at + row.axial_position)
        for row in rows_of(made, asked_clearance(name, made))
    ]
    if isinstance(side, int):
        placed = [replace(row, side=side) for row in placed]
    return _Place(made, at, tuple(placed))


def _inner(places: list[_Place], masses: Sequence[Sequence[float]]) -> Ring:
    """Return the shaft with what sits on it, about the common centre of mass."""
    ends = [place.at for place in places]
    bore = min(place.made.bore for place in places)
    length = max(ends) - min(ends)
    bar = _STEEL * 0.25 * math.pi * bore**2 * length
    middle = 0.5 * (max(ends) + min(ends))
    parts = [(bar, middle, bar * bore**2 / 8.0, bar * (bore**2 / 16.0 + length**2 / 12.0))]
    for mass, at, *rest in _tuples("masses", masses, _MASSES):
        if mass <= 0.0 or (rest and rest[0] < 0.0):
            raise SceneError("masses", repr(masses), _MASSES)
        square = mass * (rest[0] if rest else 0.0) ** 2
        parts.append((mass, at, square / 8.0, square / 16.0))
    whole = sum(part[0] for part in parts)
    centre = sum(part[0] * part[1] for part in parts) / whole
    across = sum(part[3] + part[0] * (part[1] - centre) ** 2 for part in parts)
    held = Spring(damping=_DAMPING * len(places))
    tilts = Spring(damping=_DAMPING * sum((at - centre) ** 2 for at in ends))
    return Ring(
        mass=whole,
        inertia=sum(part[2] for part in parts),
        transverse_inertia=across,
        centre_of_mass=centre,
        support=Support(x=held, y=held, z=held, tilt_x=tilts, tilt_y=tilts),
    )


def _outer(places: Sequence[_Place]) -> Ring:
    """Return all outer rings as one, on the springs of their seats."""
    size = sum(metal(place.made) for place in places)
    held = Spring(stiffness=SEAT_STIFFNESS * size, damping=SEAT_DAMPING * size)
    return Ring(mass=OUTER_RING * size, support=Support(x=held, y=held, z=held))


def _around(places: Sequence[_Place], housing: object) -> Structure | None:
    """Return what the rings stand on; of pedestals that many of the mean size, by the masses."""
    cubes = [place.made.outside_diameter**3 for place in places]
    mean = (sum(cubes) / len(cubes)) ** (1.0 / 3.0)
    return chosen_housing(housing, mean, len(cubes))


def _unbalances(given: Sequence[Sequence[float]]) -> dict[str, Unbalance]:
    made = _tuples("unbalances", given, _UNBALANCES)
    return {
        f"unbalance{i}": Unbalance(
            ring="inner", moment=moment, axial_position=at, angle=rest[0] if rest else 0.0
        )
        for i, (moment, at, *rest) in enumerate(made)
    }


def _tuples(name: str, given: object, allowed: str) -> list[list[float]]:
    """Return tuples of two or three numbers."""
    read = [
        [real(number) for number in each] if isinstance(each, Sequence) else []
        for each in (given if isinstance(given, Sequence) else [None])
    ]
    if not all(len(each) in (2, 3) and all(map(math.isfinite, each)) for each in read):
        raise SceneError(name, repr(given), allowed)
    return read
