"""Friction torque of a bearing by the formulas of makers, for comparison with that of a run.

SKF's model and Palmgren's take size, load, speed and oil of a bearing. They were fitted to measured bearings,
one of which differs from another by some 20 %, and include what a scene leaves out: sliding cages, grease, spin.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .._base.numbers import real
from ..errors import SceneError

_SERIES = {
    ("160", "161"): (4.3e-7, 1.7, 4.63e-3, 4.25),
    ("60", "630"): (4.1e-7, 1.7, 3.73e-3, 14.6),
    ("62", "622"): (3.9e-7, 1.7, 3.23e-3, 36.5),
    ("63", "623"): (3.7e-7, 1.7, 2.84e-3, 92.8),
    ("64",): (3.6e-7, 1.7, 2.43e-3, 198.0),
    ("617", "618", "628", "637", "638"): (4.7e-7, 1.7, 6.50e-3, 0.78),
    ("619", "639"): (4.3e-7, 1.7, 4.75e-3, 3.6),
}
"""R₁, R₂, S₁, S₂ of deep groove ball bearings for mm, N and N mm (SKF, Rolling bearings, chapter on friction)."""

CONSTANTS = {series: constants for group, constants in _SERIES.items() for series in group}
"""The same, series by series."""

_REPLENISHMENT = 3e-8
"""K_rs of an oil bath at a low level, or a jet."""
_GEOMETRY = 3.1
"""K_Z of single row deep groove ball bearings."""
_BOUNDARY = 0.12
"""μ_bl, of asperities in a turning bearing."""


@dataclass(frozen=True, kw_only=True)
class FrictionTorque:
    """Friction torque of a bearing without seals.

    Attributes
    ----------
    rolling : float
        Part that depends on speed and oil [N m]: SKF's rolling frictional moment M_rr, Palmgren's M₀.
    sliding : float
        Part that depends on load [N m]: SKF's sliding frictional moment M_sl, Palmgren's M₁.
    source : str
        Source of the formula.
    """

    rolling: float
    sliding: float
    source: str

    @property
    def total(self) -> float:
        """Both together [N m]."""
        return self.rolling + self.sliding


def friction_torque_skf(
    series: str,
    *,
    bore: float,
    outside_diameter: float,
    speed_rpm: float,
    viscosity: float,
    radial_load: float,
    axial_load: float = 0.0,
    static_rating: float | None = None,
    film_friction: float = 0.05,
) -> FrictionTorque:
    """Return the friction torque of a deep groove ball bearing by SKF's model, without seals and drag of the oil.

    With lengths in mm and ν in mm²/s, for a radial load alone (the catalogue has those with an axial load)::

        M_rr = φ_ish φ_rs R₁ d_m^1.96 F^0.54 (ν n)^0.6        φ_ish = 1/(1 + 1.84e-9 (n d_m)^1.28 ν^0.64)
        M_sl = S₁ d_m^-0.26 F^(5/3) μ_sl                      φ_rs = exp(-3e-8 ν n (d + D) √(3.1/(2 (D - d))))
        μ_sl = φ_bl 0.12 + (1 - φ_bl) film_friction           φ_bl = exp(-2.6e-8 (n ν)^1.4 d_m)

    An axial load, however small, takes the catalogue's other formula: sliding jumps there by d_m^0.115.

    Parameters
    ----------
    series : str
        Series of the bearing, ``"62"`` of a 6205.
    bore, outside_diameter : float
        Diameters d and D [m]; d_m is their mean.
    speed_rpm : float
        Speed n of one ring against the other [1/min].
    viscosity : float
        Kinematic viscosity ν of the oil at its temperature [m²/s], as ``Lubricant.properties()`` has it.
    radial_load, axial_load : float
        Loads [N].
    static_rating : float, optional
        Static load rating C₀ [N]; required with an axial load.
    film_friction : float
        Coefficient of friction of a full film: 0.05 for mineral oils, 0.04 for synthetic ones.

    Raises
    ------
    SceneError
        An argument is not usable, or the series is not one of deep groove ball bearings.

    Examples
    --------
    >>> import ballrace as br
    >>> made = br.catalogue["6205"]
    >>> found = br.friction_torque_skf(
    ...     "62", bore=made.bore, outside_diameter=made.outside_diameter,
    ...     speed_rpm=1797.0, viscosity=34.8e-6, radial_load=500.0)  # VG 68 at 55 °C
    >>> round(1e3 * found.total, 1)  # N mm
    12.1
    """
    if series not in CONSTANTS:
        known = ", ".join(CONSTANTS)
        raise SceneError("series", repr(series), f"of deep groove ball bearings: {known}")
    _check("bore", bore, "m")
    _check("outside_diameter", outside_diameter, "m", above=bore)
    n, nu = _speed(speed_rpm), 1e6 * _check("viscosity", viscosity, "m²/s")
    d, D = 1e3 * bore, 1e3 * outside_diameter
    d_m = 0.5 * (d + D)
    G_rr, G_sl = _load_variables(series, d_m, radial_load, axial_load, static_rating)
    heating = 1.0 / (1.0 + 1.84e-9 * (n * d_m) ** 1.28 * nu**0.64)
    starvation = math.exp(
        -_REPLENISHMENT * nu * n * (d + D) * math.sqrt(_GEOMETRY / (2.0 * (D - d)))
    )
    boundary = math.exp(-2.6e-8 * (n * nu) ** 1.4 * d_m)
    film = _check("film_friction", film_friction, "-")
    return FrictionTorque(
        rolling=1e-3 * heating * starvation * G_rr * (nu * n) ** 0.6,
        sliding=1e-3 * G_sl * (boundary * _BOUNDARY + (1.0 - boundary) * film),
        source="SKF, Rolling bearings (catalogue)",
    )


def friction_torque_palmgren(
    *,
    pitch_diameter: float,
    speed_rpm: float,
    viscosity: float,
    load: float,
    f_0: float,
    f_1: float,
) -> FrictionTorque:
    """Return the friction torque of a bearing by Palmgren, ``M₀ + M₁``.

    With lengths in mm and ν in mm²/s, in N mm::

        M₀ = f₀ 1e-7 (ν n)^(2/3) d_m³,  f₀ 160e-7 d_m³ below ν n = 2000        M₁ = f₁ P₁ d_m

    Parameters
    ----------
    pitch_diameter : float
        Pitch diameter d_m [m].
    speed_rpm : float
        Speed n of one ring against the other [1/min].
    viscosity : float
        Kinematic viscosity ν of the oil at its temperature [m²/s].
    load : float
        Load P₁ [N]: of a deep groove bearing the radial load, or three times the axial one less a tenth of the
        radial one if that is more.
    f_0 : float
        Factor of kind and oiling: about 2 for a deep groove ball bearing in an oil bath, 1 in oil mist.
    f_1 : float
        Factor of kind and load: 0.0004 to 0.0006 times (P₀/C₀)^0.55 for a deep groove ball bearing (Harris), its
        static equivalent load over its static load rating.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> found = br.friction_torque_palmgren(
    ...     pitch_diameter=38.5e-3, speed_rpm=1797.0, viscosity=34.8e-6, load=500.0,
    ...     f_0=2.0, f_1=0.0005 * (500.0 / 7800.0) ** 0.55)
    >>> round(1e3 * found.rolling, 1), round(1e3 * found.sliding, 1)  # N mm
    (18.0, 2.1)
    """
    d_m = 1e3 * _check("pitch_diameter", pitch_diameter, "m")
    stirred = _speed(speed_rpm) * 1e6 * _check("viscosity", viscosity, "m²/s")
    _check("load", load, "N", least=0.0)
    _check("f_0", f_0, "-", least=0.0)
    _check("f_1", f_1, "-", least=0.0)
    growth = stirred ** (2.0 / 3.0) if stirred >= 2000.0 else 160.0
    return FrictionTorque(
        rolling=1e-3 * f_0 * 1e-7 * growth * d_m**3,
        sliding=1e-3 * f_1 * load * d_m,
        source="Palmgren, Grundlagen der Wälzlagertechnik",
    )


def _load_variables(
    series: str, d_m: float, radial: float, axial: float, static_rating: float | None
) -> tuple[float, float]:
    """Return G_rr and G_sl of SKF's model, for mm, N and N mm."""
    R_1, R_2, S_1, S_2 = CONSTANTS[series]
    _check("radial_load", radial, "N", least=0.0)
    axial = abs(_check("axial_load", axial, "N", least=-math.inf))
    if axial == 0.0:
        return R_1 * d_m**1.96 * radial**0.54, S_1 * d_m**-0.26 * radial ** (5.0 / 3.0)
    if static_rating is None:
        raise SceneError("static_rating", "None", "a rating [N], since there is an axial load")
    _check("static_rating", static_rating, "N")
    sine = math.sin(math.radians(24.6 * (axial / static_rating) ** 0.24))
    sliding = (radial**5 + S_2 * d_m**1.5 / sine * axial**4) ** (1.0 / 3.0)
    return R_1 * d_m**1.96 * (radial + R_2 / sine * axial) ** 0.54, S_1 * d_m**-0.145 * sliding


def _speed(speed_rpm: float) -> float:
    return abs(_check("speed_rpm", speed_rpm, "1/min", least=-math.inf))


def _check(
    name: str, value: float, unit: str, *, above: float = 0.0, least: float | None = None
) -> float:
    """Return a finite number above a bound, or from ``least`` on."""
    number = real(value)
    if not (number > above if least is None else number >= least) or math.isinf(number):
        bound = f"above {above:g}" if least is None else f"from {least:g} on"
        raise SceneError(name, repr(value), f"a number {bound} [{unit}]")
    return number
