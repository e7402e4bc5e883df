"""The clearance that a deep groove bearing runs with: of the box, less fits and heat.

Rings, shaft and housing are free of each other along the axis; temperatures are even within each. With the balls
half-way between the rings, heat takes ``α d_m (T_inner - T_outer)`` of the clearance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from .._base.numbers import positive, real
from ..errors import EquilibriumError, SceneError
from .build import asked_clearance
from .clearance import radial_clearance
from .entry import Bearing
from .fits import Interference, Seat, interference
from .rows import catalogue

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..scene import Scene

_RING = Seat(free_diameter=math.nan)
"""Material of the rings, bearing steel."""

_SOLID, _THICK = Seat(free_diameter=0.0), Seat(free_diameter=math.inf)

_MOST = 200
"""Steps of a fixed point."""


@dataclass(frozen=True, kw_only=True)
class Temperatures:
    """Temperatures of a bearing and its seats [°C].

    Attributes
    ----------
    inner, outer : float
        Of the rings; the balls have their mean.
    shaft, housing : float or None
        Of the seats; None: those of the rings.
    assembled : float
        At which fits and clearance were measured.
    """

    inner: float = 20.0
    outer: float = 20.0
    shaft: float | None = None
    housing: float | None = None
    assembled: float = 20.0

    def __post_init__(self) -> None:
        for name in ("inner", "outer", "shaft", "housing", "assembled"):
            value = getattr(self, name)
            absent = value is None and name in ("shaft", "housing")
            if not (absent or -273.15 < real(value) < 1000.0):
                raise SceneError(name, repr(value), "a temperature [°C], -273.15 to 1000")


@dataclass(frozen=True, kw_only=True)
class OperatingClearance:
    """Parts of the clearance in operation, all diametral [m]; ``print`` shows them.

    Attributes
    ----------
    designation : str
        The bearing.
    initial : float
        Before mounting.
    shaft_fit, housing_fit : float
        Reduction by each fit, from the interference in operation after Lamé.
    heat : float
        Reduction by the expansion of rings and balls; below 0: an increase.
    shaft_interference, housing_interference : float
        Interferences in operation, less smoothing; below 0: play, which moves no raceway.
    smoothing : float
        Loss of each interference by smoothing of the surfaces.
    """

    designation: str
    initial: float
    shaft_fit: float
    housing_fit: float
    heat: float
    shaft_interference: float
    housing_interference: float
    smoothing: float

    @property
    def clearance(self) -> float:
        """Clearance that is left [m]; below 0: the bearing is preloaded."""
        return self.initial - self.shaft_fit - self.housing_fit - self.heat

    def apply(self, scene: Scene) -> Scene:
        """Return a scene of this bearing with this clearance.

        Raises
        ------
        SceneError
            Its clearance is not the initial one of this.
        """
        if not all(math.isclose(r.clearance, self.initial, rel_tol=1e-6) for r in scene.rows):
            given = f"{scene.rows[0].clearance:g}"
            raise SceneError("rows[0].clearance", given, f"{self.initial:g}, before mounting")
        return replace(
            scene, rows=tuple(replace(row, clearance=self.clearance) for row in scene.rows)
        ).validate()

    def __str__(self) -> str:
        parts = (
            ("before mounting", self.initial, ""),
            ("fit on the shaft", -self.shaft_fit, _fit_in_words(self.shaft_interference)),
            ("fit in the housing", -self.housing_fit, _fit_in_words(self.housing_interference)),
            ("heat", -self.heat, ""),
            ("in operation", self.clearance, ""),
        )
        # Nothing taken is 0, not -0.
        lines = [
            f"  {name:<20} {round(1e6 * value, 2) + 0.0:+8.2f} µm{note}"
            for name, value, note in parts
        ]
        if max(self.shaft_interference, self.housing_interference) > 0.0:
            lines.append(f"  smoothing took {1e6 * self.smoothing:.2f} µm of each interference")
        return "\n".join([f"diametral clearance of {self.designation}", *lines])


def _fit_in_words(size: float) -> str:
    if size == 0.0:
        return ""
    kind = "interference" if size > 0.0 else "play"
    return f"  ({kind} {1e6 * abs(size):.2f} µm)"


def operating_clearance(
    name: str | Bearing,
    *,
    clearance: str | float | None = None,
    shaft_fit: str | float | None = None,
    housing_fit: str | float | None = None,
    temperatures: Temperatures | None = None,
    shaft: Seat = _SOLID,
    housing: Seat = _THICK,
    smoothing: float = 2.6e-6,
) -> OperatingClearance:
    """Return the clearance of a deep groove bearing in operation, with its parts.

    Parameters
    ----------
    name : str or Bearing
        As of :func:`ballrace.bearing`.
    clearance : str or float, optional
        Class of ISO 5753-1 or diametral clearance before mounting [m]; by default what the name says, else CN.
    shaft_fit, housing_fit : str or float, optional
        Class of ISO 286, such as ``"k5"`` and ``"H7"``, of which the mean is taken with that of the bearing's own
        tolerance (class Normal of ISO 492); or the interference of the diameters [m]. None: no fit, no effect.
    temperatures : Temperatures, optional
        By default all at 20 °C.
    shaft, housing : Seat
        Their materials and free diameters; by default a solid shaft and a thick housing, of steel.
    smoothing : float
        Loss of an interference by smoothing of both surfaces [m]: by default 0.8 (Rz + Rz) of ground surfaces
        with Rz 1.6 µm, after DIN 7190-1.

    Raises
    ------
    SceneError
        The bearing is not known or not a deep groove bearing, or an argument is not usable.

    Examples
    --------
    >>> from ballrace.bearings import Temperatures, operating_clearance
    >>> warm = operating_clearance("6205", temperatures=Temperatures(inner=60.0, outer=50.0))
    >>> f"{1e6 * warm.heat:.1f} of {1e6 * warm.initial:.1f} µm"
    '4.7 of 12.5 µm'
    """
    made = name if isinstance(name, Bearing) else catalogue[name]
    if made.kind != "deep_groove":
        raise SceneError("name", repr(made.designation), "a deep groove bearing, such as 6205")
    if not 0.0 <= real(smoothing) < 1e-3:
        raise SceneError("smoothing", repr(smoothing), "a length [m], 0 to 1 mm")
    heat = temperatures or Temperatures()
    inner, outer = heat.inner - heat.assembled, heat.outer - heat.assembled
    on_shaft = inner if heat.shaft is None else heat.shaft - heat.assembled
    around = outer if heat.housing is None else heat.housing - heat.assembled
    pitch, ball, alpha = made.pitch_diameter, made.ball_diameter, _RING.expansion
    # The raceways' bottoms, and what seats and rings add to the interferences as they warm up.
    tight = made.bore * (shaft.expansion * on_shaft - alpha * inner)
    held = made.outside_diameter * (alpha * outer - housing.expansion * around)
    on = _size("shaft_fit", shaft_fit, made.bore, smoothing, tight)
    within = _size("housing_fit", housing_fit, made.outside_diameter, smoothing, held)
    grown = Interference.of(on, made.bore, pitch - ball, shaft, _RING).raceway
    shrunk = -Interference.of(within, made.outside_diameter, pitch + ball, housing, _RING).raceway
    took = (pitch - ball) * inner + ball * (inner + outer) - (pitch + ball) * outer
    return OperatingClearance(
        designation=made.designation,
        initial=radial_clearance(made.bore, asked_clearance(name, made, clearance)),
        shaft_fit=grown,
        housing_fit=shrunk,
        heat=alpha * took,
        shaft_interference=on,
        housing_interference=within,
        smoothing=smoothing,
    )


def _size(
    name: str, fit: str | float | None, diameter: float, smoothing: float, heat: float
) -> float:
    """Return an interference in operation [m]; without a fit play, whatever the heat."""
    if fit is None:
        return 0.0
    if isinstance(fit, str):
        if fit.islower() is not (name == "shaft_fit"):
            allowed = "small letters, such as k5" if name == "shaft_fit" else "capitals, such as H7"
            raise SceneError(name, repr(fit), f"a class of ISO 286 in {allowed}")
        try:
            size = interference(fit, diameter)
        except SceneError as refused:
            if refused.path != "fit":
                raise
            raise SceneError(name, repr(fit), refused.allowed) from None
    else:
        size = real(fit)
        if not -1e-3 < size < 1e-3:
            raise SceneError(name, repr(fit), "a class of ISO 286, or a length below 1 mm [m]")
    return size + heat - smoothing


def steady_temperatures(
    losses: float | Callable[[float], float],
    *,
    inner_conductance: float,
    outer_conductance: float,
    ambient: float = 20.0,
    inner_share: float = 0.5,
) -> Temperatures:
    """Return the temperatures at which rings give off the heat that friction produces, by fixed-point iteration.

    ``T = T_ambient + share P((T_inner + T_outer)/2) / G`` for each ring, half a step at a time.

    Parameters
    ----------
    losses : float or callable
        Power of friction [W], or a function that returns it at a mean temperature of the rings [°C], such as by
        the oil's viscosity there.
    inner_conductance, outer_conductance : float
        From each ring by its seat to the surroundings [W/K].
    ambient : float
        Temperature of the surroundings [°C].
    inner_share : float
        Share of the losses that leaves by the inner ring, 0 to 1.

    Raises
    ------
    SceneError
        An argument is not usable.
    EquilibriumError
        There is no steady temperature: losses grow faster than what is given off.

    Examples
    --------
    >>> found = steady_temperatures(10.0, inner_conductance=0.2, outer_conductance=0.5)
    >>> round(found.inner, 3), round(found.outer, 3)
    (45.0, 30.0)
    """
    conductances = {"inner_conductance": inner_conductance, "outer_conductance": outer_conductance}
    for name, value in conductances.items():
        positive(name, value, "W/K")
    if not 0.0 <= real(inner_share) <= 1.0:
        raise SceneError("inner_share", repr(inner_share), "0 to 1")
    if not -273.15 < real(ambient) < 1000.0:
        raise SceneError("ambient", repr(ambient), "a temperature [°C], -273.15 to 1000")
    share, rest = inner_share / inner_conductance, (1.0 - inner_share) / outer_conductance
    mean = ambient
    for _ in range(_MOST):
        power = _power(losses, mean)
        wanted = ambient + 0.5 * power * (share + rest)
        if abs(wanted - mean) < 1e-9 * max(abs(wanted), 1.0):
            return Temperatures(inner=ambient + power * share, outer=ambient + power * rest)
        if not wanted < 1000.0:
            break
        mean += 0.5 * (wanted - mean)
    raise EquilibriumError(
        f"no steady temperature: at {mean:.0f} °C losses of {power:.4g} W would need {wanted:.0f} °C"
    )


def _power(losses: float | Callable[[float], float], mean: float) -> float:
    power = losses(mean) if callable(losses) else losses
    if not 0.0 <= real(power) < math.inf:
        raise SceneError(
            "losses", repr(power), "a power from 0 [W], or a function that returns one"
        )
    return float(power)
