"""Basic load ratings of rows and races after ISO 281 and ISO 76, and equivalent loads after ISO 281."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..errors import SceneError

if TYPE_CHECKING:
    from ..scene import Row, Scene

FC = (
    29.1, 35.8, 40.3, 43.8, 46.7, 49.1, 51.1, 52.8, 54.3, 55.5, 56.6, 57.5, 58.2, 58.8, 59.3, 59.6, 59.8, 59.9,
    60.0, 59.9, 59.8, 59.6, 59.3, 59.0, 58.6, 58.2, 57.7, 57.1, 56.6, 56.0, 55.3, 54.6, 53.9, 53.2, 52.4, 51.7,
    50.9, 50.0, 49.2, 48.4,
)  # fmt: skip
"""f_c of ISO 281 at D cos α / d_m of 0.01, 0.02, … for grooves up to 0.52 inside and 0.53 outside."""

F0 = (
    14.7, 14.9, 15.1, 15.3, 15.5, 15.7, 15.9, 16.1, 16.3, 16.5, 16.4, 16.1, 15.9, 15.6, 15.4, 15.2, 14.9, 14.7,
    14.4, 14.2, 14.0, 13.7, 13.5, 13.2, 13.0, 12.8, 12.5, 12.3, 12.1, 11.8, 11.6, 11.4, 11.2, 10.9, 10.7, 10.5,
    10.3, 10.0, 9.8, 9.6, 9.4,
)  # fmt: skip
"""f_0 of ISO 76 [N/mm²] at D cos α / d_m of 0, 0.01, … for radial and angular contact bearings."""

_DEEP = (
    (0.172, 0.19, 2.30), (0.345, 0.22, 1.99), (0.689, 0.26, 1.71), (1.03, 0.28, 1.55), (1.38, 0.30, 1.45),
    (2.07, 0.34, 1.31), (3.45, 0.38, 1.15), (5.17, 0.42, 1.04), (6.89, 0.44, 1.00),
)  # fmt: skip
"""Table of deep groove bearings Fa/(Z D²) [N/mm²], e and Y, ISO 281; X is 0.56."""


def dynamic_rating(
    balls: float, ball_diameter: float, pitch_diameter: float, contact_angle: float, rows: int = 1
) -> float:
    """Return C of a bearing with usual grooves after ISO 281, ``1.3 f_c (i cos α)^0.7 Z^(2/3) D^1.8`` [N].

    D in mm; above 25.4 mm ``3.647 D^1.4``. Lengths in metres, the angle in radians.
    """
    cosine, D = math.cos(contact_angle), 1e3 * ball_diameter
    power = D**1.8 if D <= 25.4 else 3.647 * D**1.4
    shares = 0.01 * np.arange(1, len(FC) + 1)
    f_c = float(np.interp(ball_diameter * cosine / pitch_diameter, shares, FC))
    return float(1.3 * f_c * (rows * cosine) ** 0.7 * balls ** (2.0 / 3.0) * power)


def static_rating(
    balls: float, ball_diameter: float, pitch_diameter: float, contact_angle: float, rows: int = 1
) -> float:
    """Return C₀ of a bearing with usual grooves after ISO 76, ``f_0 i Z D² cos α`` [N].

    D in mm. Lengths in metres, the angle in radians.
    """
    cosine, D = math.cos(contact_angle), 1e3 * ball_diameter
    f_0 = float(np.interp(ball_diameter * cosine / pitch_diameter, 0.01 * np.arange(len(F0)), F0))
    return float(f_0 * rows * balls * D**2 * cosine)


def row_rating(row: Row) -> float:
    """Return the basic dynamic load rating of a row after ISO 281 [N].

    Where grooves are wider than the table's, f_c is reduced as the formula behind it says (ISO/TR 1281-1).
    """
    gamma = _gamma(row)
    if not 0.01 <= gamma <= 0.01 * len(FC):
        allowed = (
            "from 0.01 to 0.4 times the pitch diameter over cos(contact angle), or give a rating"
        )
        raise SceneError("ball_diameter", f"{row.ball_diameter:g}", allowed)
    wide = _groove_factor(gamma, max(row.inner_conformity, 0.52), max(row.outer_conformity, 0.53))
    usual = dynamic_rating(row.ball_count, row.ball_diameter, row.pitch_diameter, row.contact_angle)
    return usual * wide / _groove_factor(gamma, 0.52, 0.53)


def together(ratings: list[float]) -> float:
    """Return the rating of rows side by side: i^0.7 times that of one where they are equal, as in ISO 281."""
    each = np.array(ratings)
    return float(np.sum(each ** (10.0 / 7.0)) ** 0.7)


def race_ratings(row: Row, rating: float) -> tuple[float, float]:
    """Return Q_ce and Q_ci of a row of a rating, ISO/TS 16281: ball loads that a race bears a million turns."""
    gamma = _gamma(row)
    ratio = (1.044 / 1.04) * _ratio(gamma, row.inner_conformity, row.outer_conformity)
    single = rating / (row.ball_count * math.cos(row.contact_angle))
    inner = single / 0.407 * (1.0 + ratio ** (10.0 / 3.0)) ** 0.3
    outer = single / 0.389 * (1.0 + ratio ** (-10.0 / 3.0)) ** 0.3
    return outer, inner


def _ratio(gamma: float, inner: float, outer: float) -> float:
    """Return the rating of the inner race over that of the outer, ISO/TR 1281-1."""
    grooves: float = inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0))
    rolling = ((1.0 - gamma) / (1.0 + gamma)) ** 1.72
    return 1.04 * float(rolling * grooves**0.41)


def _groove_factor(gamma: float, inner: float, outer: float) -> float:
    """Return what conformities do to f_c."""
    together = float((1.0 + _ratio(gamma, inner, outer) ** (10.0 / 3.0)) ** -0.3)
    return together * float((2.0 * inner / (2.0 * inner - 1.0)) ** 0.41)


def _gamma(row: Row) -> float:
    return row.ball_diameter * math.cos(row.contact_angle) / row.pitch_diameter


def equivalent_load(scene: Scene) -> float | None:
    """Return P = max(Fr, X Fr + Y Fa) of a single deep groove row under steady loads [N], ISO 281."""
    row = scene.rows[0]
    if len(scene.rows) > 1 or row.contact_angle > 0.0 or row.outer_arch or row.inner_arch:
        return None
    total = np.zeros(3)
    for load in scene.loads.values():
        if load.ring != "inner":
            return None
        direction = np.asarray(load.direction)
        assert isinstance(load.force, int | float)
        total += load.force * direction / np.linalg.norm(direction)
    radial, axial = math.hypot(total[0], total[1]), abs(float(total[2]))
    relative = axial / (row.ball_count * (1e3 * row.ball_diameter) ** 2)
    table = np.array(_DEEP)
    limit, factor = (float(np.interp(relative, table[:, 0], table[:, k])) for k in (1, 2))
    return radial if axial <= limit * radial else max(radial, 0.56 * radial + factor * axial)
