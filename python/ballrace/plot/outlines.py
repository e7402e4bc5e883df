"""Outlines of a bearing's parts in the plane through its axis: axial place and radius, in millimetres."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ..scene import Row, Scene

Array = NDArray[np.float64]

_WALL = 0.35
"""Wall of a ring under the ball over the ball's diameter, where the scene gives no boundary diameter."""

_SIDE = 0.75
"""Half a width over the ball's diameter, where the scene gives none."""

_SHOULDER = math.radians(52.0)
"""Angle at which a groove ends if the scene gives no shoulders: their height is then a fifth of the ball."""


@dataclass(frozen=True, eq=False)
class Outlines:
    """Outlines of what is drawn of a bearing; lengths in millimetres.

    Attributes
    ----------
    outer, inner : ndarray, shape (n, 2)
        Closed outlines of the rings, axial place and radius.
    left, right : float
        Axial places of the side faces.
    outside, bore : float
        Boundary radii.
    assumed : bool
        Whether a boundary dimension is not the scene's.
    """

    outer: Array
    inner: Array
    left: float
    right: float
    outside: float
    bore: float
    assumed: bool


def outlines(scene: Scene) -> Outlines:
    """Return the outlines of a bearing's rings."""
    rows = sorted(scene.rows, key=lambda row: row.axial_position)
    sizes = [
        (1e3 * row.axial_position, 1e3 * row.pitch_diameter / 2, 1e3 * row.ball_diameter)
        for row in rows
    ]
    top = max(r + (0.5 + _WALL) * D for _, r, D in sizes)
    floor = min(r - (0.5 + _WALL) * D for _, r, D in sizes)
    outer, inner = scene.outer_ring, scene.inner_ring
    outside = 0.5e3 * outer.diameter if outer.diameter else top
    bore = 0.5e3 * inner.diameter if inner.diameter else max(floor, 0.0)
    left, right = min(z - _SIDE * D for z, _, D in sizes), max(z + _SIDE * D for z, _, D in sizes)
    if outer.width:
        middle = 0.5 * (left + right)
        left, right = middle - 0.5e3 * outer.width, middle + 0.5e3 * outer.width
    return Outlines(
        outer=_ring(rows, "outer", outside, left, right),
        inner=_ring(rows, "inner", bore, left, right),
        left=left,
        right=right,
        outside=outside,
        bore=bore,
        assumed=not all((outer.diameter, inner.diameter, outer.width)),
    )


def race_radius(row: Row, race: str) -> float:
    """Return where contacts nominally run, as a radius [m], on a race that is named as one or as a surface."""
    outward = 1.0 if race.startswith("outer") else -1.0
    return 0.5 * (row.pitch_diameter + outward * row.ball_diameter * math.cos(row.contact_angle))


def groove(row: Row, race: Literal["outer", "inner"], angles: Array) -> Array:
    """Return points of a groove by their angles from its middle towards +z, shape (n, 2)."""
    outward = 1.0 if race == "outer" else -1.0
    z, radius, r = _centre(row, race)
    points = np.column_stack([z + r * np.sin(angles), radius + outward * r * np.cos(angles)])
    return 1e3 * points


def on_groove(row: Row, race: Literal["outer", "inner"], z: Array) -> Array:
    """Return the points of a groove at axial places from the row's plane [m], shape (n, 2)."""
    middle, _, r = _centre(row, race)
    return groove(row, race, np.arcsin(np.clip((row.axial_position + z - middle) / r, -1.0, 1.0)))


def _centre(row: Row, race: Literal["outer", "inner"]) -> tuple[float, float, float]:
    """Return axial place and radius of a groove's centre, and its own radius [m], as the model has them."""
    outward = 1.0 if race == "outer" else -1.0
    conformity = row.outer_conformity if race == "outer" else row.inner_conformity
    off = (conformity - 0.5) * row.ball_diameter
    radius = 0.5 * row.pitch_diameter - outward * (
        off * math.cos(row.contact_angle) - 0.25 * row.clearance
    )
    z = row.axial_position - outward * row.side * off * math.sin(row.contact_angle)
    z += row.side * row.axial_preload if race == "inner" else 0.0
    return z, radius, conformity * row.ball_diameter


def circle(z: float, radius: float, size: float) -> Array:
    """Return a circle in the same plane, shape (61, 2)."""
    turn = np.linspace(0.0, 2.0 * np.pi, 61)
    return np.column_stack([z + size * np.cos(turn), radius + size * np.sin(turn)])


def _ring(
    rows: list[Row], race: Literal["outer", "inner"], edge: float, left: float, right: float
) -> Array:
    """Return a ring: its grooves from left to right, shoulders that step midway, and closed around its edge."""
    line: list[Array] = []
    for row in rows:
        low, high = getattr(row, f"{race}_shoulders") or _ends(row, race)
        of_row = groove(row, race, np.linspace(low, high, 41))
        if line:
            (before, low_radius), (after, high_radius) = line[-1][-1], of_row[0]
            middle = 0.5 * (before + after)
            line.append(np.array([[middle, low_radius], [middle, high_radius]]))
        line.append(of_row)
    running = np.vstack(line)
    running = running[(running[:, 0] >= left) & (running[:, 0] <= right)]
    ends = [[left, running[0, 1]], *running.tolist(), [right, running[-1, 1]]]
    return np.array([*ends, [right, edge], [left, edge], ends[0]])


def _ends(row: Row, race: Literal["outer", "inner"]) -> tuple[float, float]:
    """Return where a groove ends: of an angular contact row the shoulder away from the load is low."""
    away = 1.0 if race == "outer" else -1.0
    open_ = math.radians(15.0) if row.contact_angle > math.radians(5.0) else _SHOULDER
    loaded_above = row.side * away > 0.0
    return (-open_, _SHOULDER) if loaded_above else (-_SHOULDER, open_)
