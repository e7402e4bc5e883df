"""The life modification factor a_ISO of ISO 281:2007: the effect of oil and contamination on a rating life."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, get_args

from ..errors import SceneError
from ..scene import Lubricant, SpeedDrive
from ..scene.turning import relative_speed
from ..statics import RaceFilm, equilibrium

if TYPE_CHECKING:
    from ..scene import Scene

Contamination = Literal["extreme", "high", "normal", "slight", "typical", "severe", "very severe"]
"""Classes of ISO 281: extreme, high and normal cleanliness; slight, typical, severe, very severe contamination."""

_CLEANLINESS = {
    "extreme": (1.0, 1.0),
    "high": (0.7, 0.85),
    "normal": (0.55, 0.7),
    "slight": (0.4, 0.5),
    "typical": (0.2, 0.3),
    "severe": (0.05, 0.05),
    "very severe": (0.0, 0.0),
}
"""e_C of pitch diameters below 100 mm and from there on: middles of the ranges of ISO 281:2007, table 13."""

_FATIGUE_PRESSURE = 1.5e9
"""Hertz pressure of the fatigue limit of bearing steel [Pa], ISO 281:2007, B.3.1."""
_LARGEST = 50.0
"""Largest a_ISO, ISO 281:2007, 9.3.3."""


@dataclass(frozen=True, kw_only=True)
class LifeFactor:
    """a_ISO with the numbers it follows from.

    Attributes
    ----------
    value : float
        a_ISO, 0.1 to 50.
    kappa : float
        Viscosity ratio κ, of the row where it is least.
    kappa_from : {"viscosity", "film"}
        ``"viscosity"``: ν/ν₁. ``"film"``: λ^1.3 of the thinner film, of a lubricant with a roughness of its own.
    cleanliness : float
        Contamination factor e_C, 0 to 1.
    fatigue_limit : float
        Fatigue load limit C_u [N] by the static rating, C₀/22.
    pressure_fatigue_limit : float
        C_u by the load whose Hertz pressure is 1.5 GPa [N], beside it.
    """

    value: float
    kappa: float
    kappa_from: Literal["viscosity", "film"]
    cleanliness: float
    fatigue_limit: float
    pressure_fatigue_limit: float


def check_contamination(contamination: Contamination | float) -> None:
    """Refuse what is neither a class nor an e_C."""
    is_number = isinstance(contamination, int | float) and not isinstance(contamination, bool)
    if not (contamination in _CLEANLINESS or (is_number and 0.0 <= float(contamination) <= 1.0)):
        classes = ", ".join(f'"{name}"' for name in get_args(Contamination))
        raise SceneError("contamination", repr(contamination), f"{classes}, or e_C, 0 to 1")


def life_factor(
    scene: Scene, load: float, contamination: Contamination | float, static_rating: float
) -> LifeFactor | None:
    """Return a_ISO of a scene with steady loads and speed; None where a row has no oil, or nothing turns.

    ISO 281:2007, equations 27, 28, 31 to 33 and B.3 (radial ball bearings), D_pw in mm, ν in mm²/s, n in 1/min::

        a_ISO = 0.1 (1 - (2.5671 - k/κ^p)^0.83 (e_C C_u/P)^(1/3))^-9.3,  at most 50
        k, p  = 2.2649, 0.054381 for κ from 0.1;  1.9987, 0.19087 from 0.4;  1.9987, 0.071739 from 1 to 4
        κ     = ν/ν₁,  ν₁ = 4500 n^-0.5 D_pw^-0.5,  below 1000 1/min 45000 n^-0.83 D_pw^-0.5
        C_u   = C₀/22 (100/D_pw)^(1/2),  the root only above 100 mm

    κ above 4 counts as 4; below 0.1, of which the standard says nothing, a_ISO is 0.1, to which it falls there.
    Where a lubricant has a roughness other than that of :class:`ballrace.scene.Lubricant`, somebody knows the
    surfaces, and κ is λ^1.3 of the model's film, as the standard allows: layer of oil and roughness count. Beside
    C_u is the one by pressure, ``0.2288 Σ_rows Z cos α Q_u`` with the same root, where Q_u is the load of the
    contact that reaches 1.5 GPa first.

    Parameters
    ----------
    scene : Scene
        Scene with steady loads.
    load : float
        Equivalent load P [N].
    contamination : Contamination or float
        Class of contamination, or e_C.
    static_rating : float
        Basic static load rating C₀ of the whole bearing [N].
    """
    if relative_speed(scene) == 0.0:
        return None
    films = equilibrium(_at_its_speed(scene)).films
    if len(films) < 2 * len(scene.rows):
        return None
    kappa, kappa_from = _kappa(scene, films)
    if not kappa > 0.0:
        return None
    pitch = max(1e3 * row.pitch_diameter for row in scene.rows)
    large = min(1.0, math.sqrt(100.0 / pitch))
    limit = static_rating / 22.0 * large
    cleanliness = (
        _CLEANLINESS[contamination][pitch >= 100.0]
        if isinstance(contamination, str)
        else float(contamination)
    )
    value = _factor(kappa, cleanliness * limit / load)
    return LifeFactor(
        value=value,
        kappa=kappa,
        kappa_from=kappa_from,
        cleanliness=cleanliness,
        fatigue_limit=limit,
        pressure_fatigue_limit=_fatigue_limit(scene, films) * large,
    )


def _kappa(scene: Scene, films: tuple[RaceFilm, ...]) -> tuple[float, Literal["viscosity", "film"]]:
    """Return κ, and what it follows from."""
    oils = [row.lubricant or scene.lubricant for row in scene.rows]
    if any(oil is not None and oil.roughness != Lubricant.roughness for oil in oils):
        return min(film.lambda_ratio for film in films) ** 1.3, "film"
    turns = abs(relative_speed(scene) or films[0].reference_speed) * 30.0 / math.pi
    ratios = [
        1e6 * oil.properties().kinematic_viscosity / rated_viscosity(turns, row.pitch_diameter)
        for oil, row in zip(oils, scene.rows, strict=True)
        if oil is not None
    ]
    return min(ratios), "viscosity"


def rated_viscosity(speed_rpm: float, pitch_diameter: float) -> float:
    """Return ν₁ of ISO 281 at a speed [1/min] and a pitch diameter [m]: the viscosity of κ = 1 [mm²/s]."""
    by_size = (1e3 * pitch_diameter) ** -0.5
    if speed_rpm < 1000.0:
        return float(45_000.0 * speed_rpm**-0.83 * by_size)
    return float(4500.0 * speed_rpm**-0.5 * by_size)


def _factor(kappa: float, ratio: float) -> float:
    """Return a_ISO of κ and e_C C_u/P."""
    kappa = min(kappa, 4.0)
    if kappa <= 0.1:
        return 0.1
    k, p = (
        (2.2649, 0.054381)
        if kappa < 0.4
        else (1.9987, 0.19087)
        if kappa < 1.0
        else (1.9987, 0.071739)
    )
    left = 1.0 - max(2.5671 - k / kappa**p, 0.0) ** 0.83 * ratio ** (1.0 / 3.0)
    return min(0.1 * left**-9.3, _LARGEST) if left > 0.0 else _LARGEST


def _fatigue_limit(scene: Scene, films: tuple[RaceFilm, ...]) -> float:
    """Return C_u by the pressure, without the factor of large bearings [N]."""
    total = 0.0
    for index, row in enumerate(scene.rows):
        # Hertz pressures go with the cube root of the load.
        first = min(
            film.reference_load * (_FATIGUE_PRESSURE / film.pressure) ** 3
            for film in films
            if film.row == index and film.pressure > 0.0
        )
        total += 0.2288 * row.ball_count * math.cos(row.contact_angle) * first
    return total


def _at_its_speed(scene: Scene) -> Scene:
    """Return the scene with films for the speed that it has, not for one of reference."""
    if not isinstance(scene.drive, SpeedDrive):
        return scene

    def own(lubricant: Lubricant | None) -> Lubricant | None:
        return None if lubricant is None else replace(lubricant, reference_speed=None)

    rows = tuple(replace(row, lubricant=own(row.lubricant)) for row in scene.rows)
    return replace(scene, lubricant=own(scene.lubricant), rows=rows)
