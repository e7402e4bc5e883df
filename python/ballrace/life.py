"""Rating life: how many turns nine bearings of ten survive, after ISO 281 and ISO/TS 16281.

ISO 281 takes one equivalent load of the whole bearing. ISO/TS 16281 takes the loads of all balls instead, as
:func:`ballrace.load_distribution` has them, and so knows of clearance, contact angles and rows that share
unevenly.
Both are of a healthy bearing, well lubricated and clean: the factor a_ISO of lubricant and dirt is left out, also
where a scene has an oil.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .bearings.rows import catalogue
from .errors import SceneError
from .scene import Scene, SpeedDrive
from .scene.scene import checked_scene
from .statics import load_distribution

if TYPE_CHECKING:
    from .scene import Row

__all__ = ["FC", "RatingLife", "rating_life"]

FC = (
    29.1, 35.8, 40.3, 43.8, 46.7, 49.1, 51.1, 52.8, 54.3, 55.5, 56.6, 57.5, 58.2, 58.8, 59.3, 59.6, 59.8, 59.9,
    60.0, 59.9, 59.8, 59.6, 59.3, 59.0, 58.6, 58.2, 57.7, 57.1, 56.6, 56.0, 55.3, 54.6, 53.9, 53.2, 52.4, 51.7,
    50.9, 50.0, 49.2, 48.4,
)  # fmt: skip
"""f_c of ISO 281 at D cos α / d_m of 0.01, 0.02, … for grooves up to 0.52 inside and 0.53 outside."""

_DEEP = (
    (0.172, 0.19, 2.30), (0.345, 0.22, 1.99), (0.689, 0.26, 1.71), (1.03, 0.28, 1.55), (1.38, 0.30, 1.45),
    (2.07, 0.34, 1.31), (3.45, 0.38, 1.15), (5.17, 0.42, 1.04), (6.89, 0.44, 1.00),
)  # fmt: skip
"""Of deep groove bearings Fa/(Z D²) [N/mm²], e and Y, ISO 281; X is 0.56."""


@dataclass(frozen=True, kw_only=True)
class RatingLife:
    """Rating life at 90 % reliability, without lubricant and contamination.

    Attributes
    ----------
    rating : float
        Basic dynamic load rating C of the whole bearing [N].
    source : str
        Where it comes from.
    outer_ratings, inner_ratings : tuple of float
        Rolling element loads for the basic rating of each row, Q_ce and Q_ci [N].
    outer_equivalent, inner_equivalent : tuple of float
        Equivalent loads of each row's races, Q_ee and Q_ei [N].
    reference : float
        Basic reference rating life L₁₀ᵣ after ISO/TS 16281 [turns]; infinite without load.
    equivalent_load : float or None
        Dynamic equivalent load P after ISO 281 [N]; None where the scene's loads change, the bearing is no single
        deep groove row, or nothing loads the inner ring.
    basic : float or None
        Basic rating life L₁₀ = (C/P)³ after ISO 281 [turns]; None without P.
    speed : float or None
        Constant speed of the inner ring [rad/s]; None where it changes.
    """

    rating: float
    source: str
    outer_ratings: tuple[float, ...]
    inner_ratings: tuple[float, ...]
    outer_equivalent: tuple[float, ...]
    inner_equivalent: tuple[float, ...]
    reference: float
    equivalent_load: float | None
    basic: float | None
    speed: float | None

    def hours(self, turns: float) -> float | None:
        """Return how long a number of turns takes at the scene's speed [h]; None where it changes or is 0."""
        return turns * 2.0 * math.pi / abs(self.speed) / 3600.0 if self.speed else None


def rating_life(scene: Scene, rating: float | None = None) -> RatingLife:
    """Return the rating life of a bearing under the loads of a scene, its defects left out.

    Parameters
    ----------
    scene : Scene
        The scene. The inner ring turns against the load.
    rating : float, optional
        Basic dynamic load rating C of the whole bearing [N], as its maker prints it. By default that of the
        catalogue if the scene's name is there with the same balls, else by the formula of ISO 281.

    Returns
    -------
    RatingLife
        Lives in turns.

    Raises
    ------
    SceneError
        A field is not usable, or the balls are too large for the table of ISO 281 and no rating is given.
    EquilibriumError
        There is no stable equilibrium.

    Examples
    --------
    >>> import ballrace as br
    >>> life = br.rating_life(br.bearing("6205", radial_load=1400.0))
    >>> life.rating, round(life.basic / 1e6)  # (14000/1400)³
    (14000.0, 1000)
    >>> 0.5 < life.reference / life.basic < 1.5
    True
    """
    healthy = replace(checked_scene(scene), defects={})
    if rating is not None and not 0.0 < rating < math.inf:
        raise SceneError("rating", repr(rating), "a load above 0 [N]")
    value, source = (rating, "given") if rating is not None else _rating(healthy)
    loads = load_distribution(healthy)
    formulas = [row_rating(row) for row in healthy.rows]
    # A printed rating is shared by the rows as the formula shares it.
    scale = value / _together(formulas)
    ratings = [_races(row, scale * own) for row, own in zip(healthy.rows, formulas, strict=True)]
    outer, inner = loads.outer_equivalent, loads.inner_equivalent
    damage = sum(
        (outer[k] / of_outer) ** (10.0 / 3.0) + (inner[k] / of_inner) ** (10.0 / 3.0)
        for k, (of_outer, of_inner) in enumerate(ratings)
    )
    equivalent = _equivalent_load(healthy)
    return RatingLife(
        rating=value,
        source=source,
        outer_ratings=tuple(of_outer for of_outer, _ in ratings),
        inner_ratings=tuple(of_inner for _, of_inner in ratings),
        outer_equivalent=tuple(outer.tolist()),
        inner_equivalent=tuple(inner.tolist()),
        reference=1e6 * float(damage) ** -0.9 if damage > 0.0 else math.inf,
        equivalent_load=equivalent,
        basic=1e6 * (value / equivalent) ** 3 if equivalent else None,
        speed=_speed(healthy),
    )


def row_rating(row: Row) -> float:
    """Return the basic dynamic load rating of a row after ISO 281, ``1.3 f_c (cos α)^0.7 Z^(2/3) D^1.8`` [N].

    D in mm; above 25.4 mm ``3.647 D^1.4``. Where grooves are wider than the table's, f_c is reduced as the formula
    behind it says (ISO/TR 1281-1).
    """
    gamma = _gamma(row)
    if not 0.01 <= gamma <= 0.01 * len(FC):
        allowed = (
            "from 0.01 to 0.4 times the pitch diameter over cos(contact angle), or give a rating"
        )
        raise SceneError("ball_diameter", f"{row.ball_diameter:g}", allowed)
    D = 1e3 * row.ball_diameter
    power = D**1.8 if D <= 25.4 else 3.647 * D**1.4
    f_c = float(np.interp(gamma, 0.01 * np.arange(1, len(FC) + 1), FC))
    wide = _groove_factor(gamma, max(row.inner_conformity, 0.52), max(row.outer_conformity, 0.53))
    f_c *= wide / _groove_factor(gamma, 0.52, 0.53)
    size = math.cos(row.contact_angle) ** 0.7 * row.ball_count ** (2.0 / 3.0) * power
    return 1.3 * f_c * float(size)


def _rating(scene: Scene) -> tuple[float, str]:
    row = scene.rows[0]
    known = catalogue.get(scene.name)
    same = known is not None and (known.ball_count, known.ball_diameter, known.pitch_diameter) == (
        row.ball_count,
        row.ball_diameter,
        row.pitch_diameter,
    )
    if known is not None and same and len(scene.rows) == 1:
        return known.dynamic_rating, f"catalogue: {known.sources.ratings}"
    return _together([row_rating(row) for row in scene.rows]), "formula of ISO 281"


def _together(ratings: list[float]) -> float:
    """Return the rating of rows side by side: i^0.7 times that of one where they are equal, as in ISO 281."""
    each = np.array(ratings)
    return float(np.sum(each ** (10.0 / 7.0)) ** 0.7)


def _races(row: Row, rating: float) -> tuple[float, float]:
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


def _equivalent_load(scene: Scene) -> float | None:
    """Return P = max(Fr, X Fr + Y Fa) of a single deep groove row under constant loads [N], ISO 281."""
    row = scene.rows[0]
    if len(scene.rows) > 1 or row.contact_angle > 0.0 or row.outer_arch or row.inner_arch:
        return None
    total = np.zeros(3)
    for load in scene.loads.values():
        if load.ring != "inner" or not isinstance(load.force, int | float):
            return None
        direction = np.asarray(load.direction)
        total += load.force * direction / np.linalg.norm(direction)
    radial, axial = math.hypot(total[0], total[1]), abs(float(total[2]))
    if radial == axial == 0.0:
        return None
    relative = axial / (row.ball_count * (1e3 * row.ball_diameter) ** 2)
    table = np.array(_DEEP)
    limit, factor = (float(np.interp(relative, table[:, 0], table[:, k])) for k in (1, 2))
    return radial if axial <= limit * radial else max(radial, 0.56 * radial + factor * axial)


def _speed(scene: Scene) -> float | None:
    if isinstance(scene.drive, SpeedDrive) and isinstance(scene.drive.speed, int | float):
        return float(scene.drive.speed)
    return None
