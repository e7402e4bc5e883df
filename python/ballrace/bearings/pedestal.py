"""The machine around the outer ring where a scene does not give its own: a pedestal with modes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..errors import SceneError
from ..scene import Mode, Structure

if TYPE_CHECKING:
    from ..scene import Compliance

OF_6205 = 52e-3
"""Outside diameter of the bearing that the table is for [m]."""

_HIGHEST = 15_000.0
"""Highest frequency of a mode that moves of its own [Hz]; of those above only the compliance is left."""

_Shape = tuple[float, float, float]
_Line = tuple[float, float, float, _Shape, _Shape]

_FEET: tuple[_Line, ...] = (
    (700.0, 0.04, 2.5, (0.0, 0.0, 1.0), (0.0, 0.0, 1.0)),  # rocking along the shaft
    (900.0, 0.04, 3.0, (1.0, 0.0, 0.0), (1.0, 0.0, 0.0)),  # rocking across it
    (1200.0, 0.04, 3.0, (0.0, 1.0, 0.0), (0.0, 1.0, 0.0)),  # up and down on its plate
    (1850.0, 0.04, 2.0, (0.3, 0.7, 0.0), (-0.3, -1.0, 0.0)),  # plate against casting
)
"""Frequency [Hz], damping ratio, modal mass [kg], shapes at seat and sensor: a casting on bolts and a plate."""
_WALLS: tuple[_Line, ...] = (
    # The cap, which hardly moves the seat.
    (2700.0, 0.035, 0.50, (0.08, 0.08, 0.0), (0.5, 1.0, 0.5)),
    (4800.0, 0.035, 0.28, (0.15, 0.5, 0.0), (-0.5, -1.0, -0.5)),
    (6100.0, 0.035, 0.22, (-0.15, 0.3, 0.0), (-0.5, 1.0, 0.5)),
    (7500.0, 0.035, 0.18, (0.15, 0.5, 0.0), (-0.5, -1.0, 0.5)),
    (9800.0, 0.035, 0.135, (-0.15, 0.5, 0.0), (-0.5, 1.0, 0.5)),
    (12_000.0, 0.035, 0.11, (0.15, 0.5, 0.0), (-0.5, -1.0, 0.5)),
)
"""Walls of the casting between seat and sensor, likewise; their masses go with one over their frequencies."""


def pedestal(outside_diameter: float, count: float = 1.0) -> Structure:
    """Return a cast pedestal with what it stands on, for an outside diameter [m], or so many side by side as one.

    The frequencies are peaks of spectra that were measured on a pedestal with a 6205 (HIT-SM), with the damping
    ratios and masses that come nearest to its records. The masses are not identified: with all of them doubled or
    halved the records are met as well, so levels are orders of magnitude. The walls shake the seat in its plane
    alone: what an inner race's spall sends along the axis is otherwise spread over all of them.

    Sizes are an assumption: bodies of one shape, whose masses grow with the cube of the diameter and whose walls'
    frequencies fall with it, on bolts and a plate whose frequencies stay.
    """
    size = outside_diameter / OF_6205
    mass = size**3 * count
    walls = [(line[0] / size, *line[1:]) for line in _WALLS]
    modes = [_mode(each, mass) for each in (*_FEET, *walls) if each[0] <= _HIGHEST]
    left_out = [_mode(each, mass) for each in walls if each[0] > _HIGHEST]
    return Structure(modes=tuple(modes), static_compliance=_compliance(left_out))


def chosen_housing(
    housing: object, outside_diameter: float, count: float = 1.0
) -> Structure | None:
    """Return the structure that is asked for; None: the ring on a stiff spring.

    Raises
    ------
    SceneError
        It is none.
    """
    if isinstance(housing, str) and housing == "pedestal":
        return pedestal(outside_diameter, count)
    if housing is None or isinstance(housing, Structure):
        return housing
    allowed = (
        '"pedestal", None (the bare ring) or a br.Structure(modes=[br.Mode(…), …]); what lies between it and '
        "a record belongs to br.measuring.Chain"
    )
    raise SceneError("housing", repr(housing), allowed)


def _mode(line: _Line, mass: float) -> Mode:
    """Return a mode by a line of a table, with so many times its mass."""
    frequency, damping, own, seat, sensor = line
    return Mode(
        frequency=frequency, damping=damping, mass=own * mass, seat=seat, sensors={"sensor": sensor}
    )


def _compliance(modes: list[Mode]) -> Compliance | None:
    """Return what modes give at the seat under a static force, Σ Φ Φᵀ / (m ω²) [m/N]."""
    if not modes:
        return None
    total = np.zeros((3, 3))
    for mode in modes:
        omega = 2.0 * math.pi * mode.frequency
        total += np.outer(mode.seat, mode.seat) / (mode.mass * omega**2)
    (xx, xy, xz), (_, yy, yz), (*_, zz) = total.tolist()
    return (xx, xy, xz), (xy, yy, yz), (xz, yz, zz)
