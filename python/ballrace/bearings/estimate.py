"""The balls of a bearing that is known by its boundary dimensions alone.

The rule's numbers are those that the catalogue's bearings have, and its errors those that it makes of them; both
are checked by ``tests/python/test_dimensions.py``.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import cast, get_args

from .._base.numbers import real
from ..errors import SceneError
from ..frequencies.kinematic import Orders, orders
from ..ratings.load_rating import dynamic_rating, static_rating
from .entry import Bearing, Kind, Uncertainty
from .sources import CONFORMITY, Sources

_INCH = 25.4e-3
BALLS = tuple(
    sorted(
        [_INCH * k / 64 for k in range(3, 40)]  # up to 5/8 inch
        + [_INCH * k / 32 for k in range(20, 36)]  # up to 1 1/8 inch
        + [_INCH * k / 16 for k in range(18, 64)]
        + [3.5e-3, 6.0e-3]
    )
)
"""Diameters of ISO 3290-1 that the catalogue's bearings have [m]: steps of an inch, and two of millimetres."""

_SECTION, _WIDTH, _ASSEMBLY = 0.30, 0.71, math.radians(187.0)
_ANGLES = {"deep_groove": 0.0, "double_row": math.radians(25.0)}

_OFF = {
    "deep_groove": (0.13, Orders(ftf=0.04, bpfo=0.17, bpfi=0.12, bsf=0.15)),
    "angular_contact": (0.08, Orders(ftf=0.016, bpfo=0.10, bpfi=0.075, bsf=0.08)),
    "double_row": (0.08, Orders(ftf=0.02, bpfo=0.115, bpfi=0.095, bsf=0.08)),
}
"""Errors of ball diameter and orders that nine of ten bearings of the catalogue keep, as shares."""
_ESTIMATED = ("ftf", "bpfo", "bpfi", "bsf")
_PITCH_OFF = 0.015
"""Uncertainty of the pitch diameter, as a part: six of seven published ones are nearer to the middle."""


def estimated(
    bore: float, outside: float, width: float, kind: Kind, contact_angle: float | None
) -> Bearing:
    """Return the bearing; parameters and errors as of :meth:`Bearing.from_dimensions`."""
    kind = _kind(kind)
    _sizes(bore, outside, width)
    angle = _angle(kind, contact_angle)
    pitch = 0.5 * (bore + outside)
    ball = _ball(kind, outside - bore, width)
    count = _count(kind, angle, ball / pitch)
    rows = 2 if kind == "double_row" else 1
    made = Bearing(
        designation=f"{1e3 * bore:g}x{1e3 * outside:g}x{1e3 * width:g} {kind.replace('_', ' ')}",
        kind=kind,
        ball_count=count,
        ball_diameter=ball,
        pitch_diameter=pitch,
        bore=bore,
        outside_diameter=outside,
        width=width,
        contact_angle=angle,
        outer_conformity=0.53,
        inner_conformity=0.52,
        dynamic_rating=dynamic_rating(count, ball, pitch, angle, rows),
        static_rating=static_rating(count, ball, pitch, angle, rows),
        sources=_SOURCES,
    )
    return replace(made, uncertainty=_uncertainty(made))


_SOURCES = Sources(
    balls="estimated: from bore, outside diameter and width by the proportions of the catalogue's bearings",
    pitch_diameter="estimated: the mean of bore and outside diameter",
    boundary="given",
    conformity=CONFORMITY,
    ratings="estimated: ISO 281 and ISO 76 from the estimated balls",
)


def _kind(kind: str) -> Kind:
    known = [name for name in get_args(Kind) if name != "thrust"]
    for name in known:
        if isinstance(kind, str) and kind.replace(" ", "_") == name:
            return cast("Kind", name)
    raise SceneError("kind", repr(kind), "one of " + ", ".join(known))


def _sizes(bore: float, outside: float, width: float) -> None:
    sizes = {"d": bore, "D": outside, "B": width}
    for name, size in sizes.items():
        if not 1e-3 <= real(size) <= 2.0:
            raise SceneError(name, repr(size), "a length [m], from 1 mm to 2 m")
    if not 1.1 * bore <= outside <= 6.0 * bore:
        raise SceneError("D", repr(outside), f"1.1 to 6 times the bore, {bore:g} m")
    if not 0.15 * (outside - bore) <= width <= 2.0 * (outside - bore):
        allowed = f"0.15 to 2 times outside diameter less bore, {outside - bore:g} m"
        raise SceneError("B", repr(width), allowed)


def _angle(kind: Kind, angle: float | None) -> float:
    if angle is None and kind in _ANGLES:
        return _ANGLES[kind]
    least = 0.0 if kind == "deep_groove" else math.radians(5.0)
    if angle is None or not least <= real(angle) <= math.radians(60.0):
        allowed = f"an angle [rad], from {least:.3g} to 1.05, such as 0.698 (40°)"
        raise SceneError("contact_angle", repr(angle), allowed)
    return float(angle)


def _ball(kind: Kind, section: float, width: float) -> float:
    most = math.inf if kind == "double_row" else _WIDTH * width
    wanted = min(_SECTION * section, most)
    return min(BALLS, key=lambda ball: abs(ball / wanted - 1.0))


def _count(kind: Kind, angle: float, share: float) -> int:
    if kind == "angular_contact":
        filled = 0.86 if angle >= math.radians(27.5) else 0.80
        return round(filled * math.pi / share)
    return round(1.0 + _ASSEMBLY / (2.0 * math.asin(share)))


def _uncertainty(made: Bearing) -> Uncertainty:
    ball, of_orders = _OFF[made.kind]
    mean = orders(made.ball_count, made.ball_diameter, made.pitch_diameter, made.contact_angle)
    return Uncertainty(
        ball_count=1,
        ball_diameter=ball * made.ball_diameter,
        pitch_diameter=_PITCH_OFF * made.pitch_diameter,
        orders=Orders(
            **{name: getattr(of_orders, name) * getattr(mean, name) for name in _ESTIMATED},
            inner=0.0,
        ),
    )
