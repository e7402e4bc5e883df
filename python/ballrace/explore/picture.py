"""A bearing at rest as drawings in SVG: along the axis, cut through it, and its largest contacts."""

from __future__ import annotations

import math
from html import escape
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..plot.ellipse import semi_axes
from ..plot.outlines import circle, outlines
from ..scene.defect import extent, widest
from ..scene.drawing import seen_along_axis

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from ..scene import Defect, Row
    from .live import Live

    Race = Literal["outer", "inner"]
    Points = NDArray[np.float64] | list[tuple[float, float]]

_INK, _STEEL, _BALL, _DAMAGE, _LOAD = "#333", "#dfe6ee", "#f9fafb", "#c8452f", "#1f6fb4"
_SIZE = 320
"""Width and height of a drawing [px]."""

_RACES: tuple[Race, ...] = ("outer", "inner")
_REACH = 0.55
"""How far the largest load reaches beyond the outer ring, over its radius."""

_FRAME = 1.82
"""Half of a drawing along the axis, over the radius of the outer ring."""


def pictures(live: Live) -> str:
    """Return all drawings side by side."""
    rows = range(len(live.scene.rows))
    shown = [section(live), *(turned(live, k) for k in rows), *(contacts(live, k) for k in rows)]
    return f'<div class="pictures">{"".join(shown)}</div>'


def turned(live: Live, number: int) -> str:
    """Return a row seen from +z; around it, outward, the load of a ball wherever it stands."""
    scene, row = live.scene, live.scene.rows[number]
    damage = [each for each in scene.defects.values() if each.row == number]
    shapes, outside = seen_along_axis(
        row, (scene.outer_ring, scene.inner_ring), damage, scene.loads.values()
    )
    angle, load = live.around.around(number, "outer")
    largest = _largest(live)
    around = 1e3 * outside * (1.03 + _REACH * load / largest)
    outline = np.column_stack([around * np.cos(angle), around * np.sin(angle)])
    reach = _FRAME * 1e3 * outside
    # The shapes are in metres.
    body = f'<g transform="scale(1000)" stroke-width="{2e-3 * reach / _SIZE:.4g}">{shapes}</g>'
    zone = _polygon(outline, fill="rgba(31,111,180,0.18)", stroke=_LOAD)
    label = f"row {number}: loads around, largest {load.max():.0f} N"
    marks = _loads_of_balls(live, number, 1e3 * outside, largest)
    return _framed(
        f"Row {number} from +z" if len(scene.rows) > 1 else "From +z",
        zone + body + "".join(marks),
        reach,
        label,
    )


def _largest(live: Live) -> float:
    return max(float(live.around.outer_load.max()), 1e-9)


def _loads_of_balls(live: Live, number: int, outside: float, largest: float) -> Iterable[str]:
    """Yield the load of each ball, written where it stands, beyond the outline of all loads."""
    eq = live.equilibrium
    for k in np.flatnonzero(eq.row == number):
        load, angle = float(eq.outer_load[k]), float(eq.angle[k])
        if load > 0.005 * largest:
            r = outside * (1.15 + _REACH * load / largest)
            yield _text(r * math.cos(angle), r * math.sin(angle), f"{load:.0f}", outside, _LOAD)


def section(live: Live) -> str:
    """Return the bearing cut through its axis, with the balls next to top and bottom and how they are pressed."""
    shapes = outlines(live.scene)
    parts = []
    for half in (1.0, -1.0):
        parts += [_polygon(r * (1.0, half), fill=_STEEL) for r in (shapes.outer, shapes.inner)]
        parts += [
            _ball(live, number, row, half, shapes.outside)
            for number, row in enumerate(live.scene.rows)
        ]
    parts.append(
        f'<line x1="{shapes.left:.4g}" y1="0" x2="{shapes.right:.4g}" y2="0" stroke-dasharray="3 2"/>'
    )
    reach = 1.12 * max(shapes.outside, 0.5 * (shapes.right - shapes.left))
    middle = 0.5 * (shapes.left + shapes.right)
    body = f'<g transform="translate({-middle:.4g},0)">{"".join(parts)}</g>'
    return _framed("Cut through the axis, +z to the right", body, reach, "section with contacts")


def _ball(live: Live, number: int, row: Row, half: float, outside: float) -> str:
    """Return the ball that is nearest to the top or the bottom, with its forces to scale."""
    eq = live.equilibrium
    own = np.flatnonzero(eq.row == number)
    k = own[np.argmax(half * np.sin(eq.angle[own]))]
    z, r, size = 1e3 * eq.z[k], 1e3 * eq.radius[k], 0.5e3 * row.ball_diameter
    parts = [_polygon(circle(z, r, size) * (1.0, half), fill=_BALL)]
    for race in _RACES:
        load, angle = float(getattr(eq, f"{race}_load")[k]), float(getattr(eq, f"{race}_angle")[k])
        if load > 0.0:
            # A line from the middle to the contact, as thick as the ball is loaded.
            outward = 1.0 if race == "outer" else -1.0
            tip_z = z + outward * row.side * size * math.sin(angle)
            tip_r = r + outward * size * math.cos(angle)
            width = 0.01 * outside + 0.05 * outside * load / _largest(live)
            parts.append(
                f'<line x1="{z:.5g}" y1="{half * r:.5g}" x2="{tip_z:.5g}" y2="{half * tip_r:.5g}" '
                f'stroke="{_LOAD}" stroke-width="{width:.3g}"/>'
            )
    return "".join(parts)


def contacts(live: Live, number: int) -> str:
    """Return the ellipses of the most loaded ball on both races in one scale, with the damage over them."""
    row, eq = live.scene.rows[number], live.equilibrium
    own = np.flatnonzero(eq.row == number)
    axes = {}
    for race in _RACES:
        load, pressure = getattr(eq, f"{race}_load")[own], getattr(eq, f"{race}_pressure")[own]
        across, along = semi_axes(row, race, load, pressure)
        k = int(np.argmax(load))
        axes[race] = (1e3 * across[k], 1e3 * along[k], load[k], 1e-6 * pressure[k])
    reach = max(*(a for a, *_ in axes.values()), *_extents(live, number), 1e-3)
    parts = []
    for place, (race, (across, along, load, pressure)) in enumerate(axes.items()):
        x = (2 * place - 1) * 0.85 * reach
        text = f"{load:.0f} N, {pressure:.0f} MPa"
        sizes = f"{2.0 * across:.2f} × {2.0 * along:.2f} mm"
        parts += [
            f'<ellipse class="{race}" cx="{x:.5g}" cy="0" rx="{along:.5g}" ry="{across:.5g}" fill="{_LOAD}" '
            f'fill-opacity="0.5"><title>{text}</title></ellipse>',
            *(_spot(d, x) for d in live.scene.defects.values() if _lies_on(d, number, race)),
            _text(x, 1.45 * reach, f"{race} race", reach, _INK),
            _text(x, -1.3 * reach, text, reach, _INK),
            _text(x, -1.55 * reach, sizes, reach, _INK),
        ]
    title = "Largest contacts" + (f" of row {number}" if len(live.scene.rows) > 1 else "")
    return _framed(
        f"{title}, rolling to the right", "".join(parts), 1.8 * reach, "contact ellipses"
    )


def _lies_on(defect: Defect, number: int, race: Race) -> bool:
    return defect.row == number and defect.on in (f"{race}_race", "ball")


def _extents(live: Live, number: int) -> list[float]:
    """Return half of the larger extent of each defect of a row [mm]."""
    own = [each for each in live.scene.defects.values() if each.row == number]
    return [0.5e3 * max(widest(each), extent(each)) for each in own] or [0.0]


def _spot(defect: Defect, x: float) -> str:
    wide, long = 1e3 * widest(defect), 1e3 * extent(defect)
    return (
        f'<rect class="damage" x="{x - 0.5 * wide:.5g}" y="{-0.5 * long:.5g}" width="{wide:.5g}" '
        f'height="{long:.5g}" fill="{_DAMAGE}" fill-opacity="0.3" stroke="{_DAMAGE}"/>'
    )


def _polygon(points: Points, *, fill: str, stroke: str = _INK) -> str:
    listed = " ".join(f"{x:.5g},{y:.5g}" for x, y in np.asarray(points).tolist())
    return f'<polygon points="{listed}" fill="{fill}" stroke="{stroke}"/>'


def _text(x: float, y: float, text: str, reach: float, colour: str) -> str:
    """Return a text about a point; lettering does not go upside down with y."""
    return (
        f'<text x="{x:.5g}" y="{-y:.5g}" transform="scale(1,-1)" font-size="{0.17 * reach:.4g}" '
        f'text-anchor="middle" dominant-baseline="middle" stroke="none" fill="{colour}">{escape(text)}</text>'
    )


def _framed(title: str, body: str, reach: float, label: str) -> str:
    """Return a drawing of what lies within a reach about the middle, y up, with its title above."""
    thin = 2.0 * reach / _SIZE
    box = f"{-reach:.5g} {-reach:.5g} {2.0 * reach:.5g} {2.0 * reach:.5g}"
    return (
        f"<figure><figcaption>{escape(title)}</figcaption>"
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_SIZE}" height="{_SIZE}" viewBox="{box}" role="img" '
        f'aria-label="{escape(label)}"><g transform="scale(1,-1)" stroke="{_INK}" '
        f'stroke-width="{thin:.4g}">{body}</g></svg></figure>'
    )
