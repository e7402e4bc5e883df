"""A scene as a small drawing, seen from +z: rings, balls at the start, defects, loads. SVG, without a library."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .bearing import Ring, Row
    from .defect import Defect
    from .load import Load

__all__ = ["drawing", "seen_along_axis"]

_SIZE = 220
"""Width and height of a row's drawing [px]."""

_FILLED = 0.47
"""Radius of the bearing over the width of its drawing."""

_WALL = 0.35
"""Wall of a ring under the ball over the ball's diameter, where no boundary diameter is given."""

_INK, _STEEL, _BALL, _DAMAGE, _LOAD = "#333", "#dfe6ee", "#f9fafb", "#d62728", "#2ca02c"


def drawing(
    rows: Iterable[Row],
    rings: tuple[Ring, Ring],
    defects: Iterable[Defect],
    loads: Iterable[Load],
) -> str:
    """Return a drawing of each row, side by side; y goes up, and a load is an arrow from the axis.

    ``rings`` are the outer and the inner.
    """
    damage, pulls = list(defects), list(loads)
    return "".join(
        _row(number, row, rings, [d for d in damage if d.row == number], pulls)
        for number, row in enumerate(rows)
    )


def _row(
    number: int, row: Row, rings: tuple[Ring, Ring], defects: list[Defect], loads: list[Load]
) -> str:
    parts, outside = seen_along_axis(row, rings, defects, loads)
    half = outside / (2.0 * _FILLED)
    line = f'stroke="{_INK}" stroke-width="{2.0 * half / _SIZE:.4g}"'
    box = f"{-half:.6g} {-half:.6g} {2.0 * half:.6g} {2.0 * half:.6g}"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_SIZE}" height="{_SIZE}" viewBox="{box}" role="img" '
        f'aria-label="row {number} from +z"><g transform="scale(1,-1)" {line}>{parts}</g></svg>'
    )


def seen_along_axis(
    row: Row, rings: tuple[Ring, Ring], defects: Iterable[Defect], loads: Iterable[Load]
) -> tuple[str, float]:
    """Return the shapes of a row in metres, y up, and the radius that they reach to."""
    outer, inner = rings
    pitch, ball = 0.5 * row.pitch_diameter, 0.5 * row.ball_diameter
    wall = (1.0 + 2.0 * _WALL) * ball
    outside = 0.5 * outer.diameter if outer.diameter else pitch + wall
    bore = 0.5 * inner.diameter if inner.diameter else max(pitch - wall, 0.1 * pitch)
    parts = [
        _circle(0.0, 0.0, outside, _STEEL),
        # Races lie by the groove's depth behind the balls' outermost points; shoulders are what is seen.
        _circle(0.0, 0.0, pitch + 0.55 * ball, "#fff"),
        _circle(0.0, 0.0, pitch - 0.55 * ball, _STEEL),
        _circle(0.0, 0.0, min(bore, pitch - ball), "#fff"),
    ]
    for k in range(row.ball_count):
        angle = row.start_angle + 2.0 * math.pi * k / row.ball_count
        parts.append(_circle(pitch * math.cos(angle), pitch * math.sin(angle), ball, _BALL))
    parts += [_damage(row, defect) for defect in defects]
    parts += [_arrow(load, 0.9 * min(bore, pitch - ball)) for load in loads]
    return "".join(parts), outside


def _circle(x: float, y: float, radius: float, fill: str) -> str:
    return f'<circle cx="{x:.6g}" cy="{y:.6g}" r="{radius:.6g}" fill="{fill}"/>'


def _damage(row: Row, defect: Defect) -> str:
    """Return a spot on a race at its angle, or on the ball that has it."""
    pitch, ball = 0.5 * row.pitch_diameter, 0.5 * row.ball_diameter
    if defect.on == "ball":
        turned = row.start_angle + 2.0 * math.pi * (defect.ball or 0) / row.ball_count
        return _circle(pitch * math.cos(turned), pitch * math.sin(turned), 0.4 * ball, _DAMAGE)
    radius = pitch + (ball if defect.on == "outer_race" else -ball)
    angle = defect.angle
    return _circle(radius * math.cos(angle), radius * math.sin(angle), 0.3 * ball, _DAMAGE)


def _arrow(load: Load, length: float) -> str:
    """Return the load's part across the axis, of one length whatever its size; nothing where it is along z."""
    x, y, z = load.direction
    size = math.hypot(x, y)
    force = load.force if isinstance(load.force, int | float) else 1.0
    if force == 0.0 or not size > 1e-6 * math.hypot(size, z):
        return ""
    along = math.copysign(length, force)
    dx, dy = along * x / size, along * y / size
    tip = f"{dx:.6g},{dy:.6g} {0.7 * dx - 0.15 * dy:.6g},{0.7 * dy + 0.15 * dx:.6g} "
    tip += f"{0.7 * dx + 0.15 * dy:.6g},{0.7 * dy - 0.15 * dx:.6g}"
    shaft = f'<line x1="0" y1="0" x2="{0.7 * dx:.6g}" y2="{0.7 * dy:.6g}" stroke="{_LOAD}" '
    return f'{shaft}stroke-width="{0.1 * length:.4g}"/><polygon points="{tip}" fill="{_LOAD}"/>'
