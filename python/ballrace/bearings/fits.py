"""Fits of bearings by the classes of ISO 286, and what an interference does to a ring, after Lamé."""

from __future__ import annotations

import bisect
import re
from dataclasses import dataclass

from .._base.numbers import real
from ..errors import SceneError

_UP_TO = (6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
"""Ends of the ranges of nominal diameters, from above 3 [mm]."""

_GRADES = {
    4: (4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20),
    5: (5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    6: (8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    7: (12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    8: (18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
}
"""Standard tolerances IT4 to IT8, ISO 286-1 [µm]."""

_LOWER = {
    "j": (-2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20),
    "k": (1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5),
    "m": (4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23),
    "n": (8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40),
    "p": (12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62, 68),
}
"""Lower deviations of shafts, ISO 286-1 [µm]; of j in the grades 5 and 6."""

_UPPER = {
    "f": (-10, -13, -16, -20, -25, -30, -36, -43, -50, -56, -62, -68),
    "g": (-4, -5, -6, -7, -9, -10, -12, -14, -15, -17, -18, -20),
    "h": (0,) * 12,
}
"""Upper deviations of shafts, ISO 286-1 [µm]; those of holes F to H are their negatives below."""

_J = {
    6: (5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29, 33),
    7: (6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39, 43),
}
"""Upper deviations of holes J6 and J7, ISO 286-2 [µm]."""

_BORE_UP_TO, _BORE = (18, 30, 50, 80, 120, 180), (-8, -10, -12, -15, -20, -25)
_OUTSIDE_UP_TO = (18, 30, 50, 80, 120, 150, 180, 250, 315)
_OUTSIDE = (-8, -9, -11, -13, -15, -18, -25, -30, -35)
"""Lower deviations of bore and outside diameter of bearings, class Normal of ISO 492 [µm]; the upper are 0."""

_ALLOWED = (
    "a class of ISO 286, of shafts f5 to p7 such as k5, m6; of housings F6 to P8 such as H7, N7"
)


def limits(fit: str, diameter: float) -> tuple[float, float]:
    """Return lower and upper deviation of a shaft or a hole [m]; capitals are holes.

    Parameters
    ----------
    fit : str
        Class of ISO 286, such as ``"k5"`` or ``"H7"``.
    diameter : float
        Nominal diameter, above 3 to 500 mm [m].

    Raises
    ------
    SceneError
        There is no such class here, or the diameter is beyond the table.

    Examples
    --------
    >>> [round(1e6 * each) for each in limits("k5", 25e-3)], [round(1e6 * each) for each in limits("N7", 52e-3)]
    ([2, 11], [-39, -9])
    """
    found = re.fullmatch(
        r"(js|[f-hjkmnp]|JS|[F-HJKMNP])([5-8])", fit if isinstance(fit, str) else ""
    )
    if not found:
        raise SceneError("fit", repr(fit), _ALLOWED)
    letter, grade = found[1], int(found[2])
    at = _range(diameter, _UP_TO, 3.0)
    width = _GRADES[grade][at]
    made = _shaft if letter.islower() else _hole
    low = made(letter.lower(), grade, at, fit)
    return 1e-6 * low, 1e-6 * (low + width)


def _shaft(letter: str, grade: int, at: int, fit: str) -> float:
    if letter in _UPPER:
        return _UPPER[letter][at] - _GRADES[grade][at]
    if letter == "js":
        return -0.5 * _GRADES[grade][at]
    if grade == 8 or (letter == "j" and grade == 7):
        raise SceneError("fit", repr(fit), _ALLOWED)
    return _LOWER[letter][at]


def _hole(letter: str, grade: int, at: int, fit: str) -> float:
    width = _GRADES[grade][at]
    if letter in _UPPER:
        return -_UPPER[letter][at]
    if letter == "js":
        return -0.5 * width
    if letter == "j":
        if grade not in _J:
            raise SceneError("fit", repr(fit), _ALLOWED)
        return _J[grade][at] - width
    if (letter, grade, _UP_TO[at]) == ("m", 6, 315):
        return -9 - width  # the one exception of ISO 286-1
    # Holes K to P mate as shafts one grade finer do.
    return -_LOWER[letter][at] + (width - _GRADES[grade - 1][at]) - width


def bearing_limits(surface: str, diameter: float) -> tuple[float, float]:
    """Return lower and upper deviation of a bearing's ``"bore"`` or ``"outside"`` diameter, class Normal [m]."""
    ends, lower = (_BORE_UP_TO, _BORE) if surface == "bore" else (_OUTSIDE_UP_TO, _OUTSIDE)
    return 1e-6 * lower[_range(diameter, ends, 2.5)], 0.0


def _range(diameter: float, ends: tuple[int, ...], above: float) -> int:
    mm = round(1e3 * real(diameter), 6)
    if not above < mm <= ends[-1]:
        raise SceneError("diameter", repr(diameter), f"above {above:g} mm, up to {ends[-1]} mm [m]")
    return bisect.bisect_left(ends, mm)


def interference(fit: str, diameter: float) -> float:
    """Return the mean interference of a bearing on a shaft or in a housing of a class [m]; below 0: play.

    Examples
    --------
    >>> round(1e6 * interference("k5", 25e-3), 1), round(1e6 * interference("H7", 52e-3), 1)
    (11.5, -21.5)
    """
    seat = sum(limits(fit, diameter)) / 2.0
    if fit.islower():
        return seat - sum(bearing_limits("bore", diameter)) / 2.0
    return sum(bearing_limits("outside", diameter)) / 2.0 - seat


@dataclass(frozen=True, kw_only=True)
class Seat:
    """Material and free diameter of a shaft or a housing.

    Attributes
    ----------
    free_diameter : float
        Bore of a shaft (0: solid), or outside diameter of a housing (infinity: thick) [m].
    youngs_modulus : float
        Young's modulus [Pa].
    poisson_ratio : float
        Poisson's ratio [1].
    expansion : float
        Linear thermal expansion [1/K].
    """

    free_diameter: float
    youngs_modulus: float = 207e9
    poisson_ratio: float = 0.3
    expansion: float = 12e-6


@dataclass(frozen=True, kw_only=True)
class Interference:
    """Effects of an interference between two thick-walled rings, after Lamé.

    Attributes
    ----------
    pressure : float
        Pressure in the joint [Pa].
    raceway : float
        By how much the diameter of the bearing's raceway changes [m]: grows on a shaft, shrinks in a housing.
    """

    pressure: float
    raceway: float

    @classmethod
    def of(cls, size: float, joint: float, raceway: float, seat: Seat, ring: Seat) -> Interference:
        """Return that of a ring with a raceway of a diameter, joined to a seat at another; 0 where there is play.

        ``p = I / (d (C_ring + C_seat))`` with ``C = ((b² + a²)/(b² - a²) ± ν)/E``, + for the outer of both bodies;
        the free surface moves by ``2 p d² F / (E |F² - d²|)``.

        Parameters
        ----------
        size : float
            Interference, of diameters [m].
        joint, raceway : float
            Diameters of the joint and of the raceway [m].
        seat, ring : Seat
            Shaft or housing, and the ring, of which ``free_diameter`` is not used.
        """
        outward = 1.0 if raceway > joint else -1.0
        compliance = _compliance(joint, raceway, ring, outward)
        compliance += _compliance(joint, seat.free_diameter, seat, -outward)
        pressure = max(size, 0.0) / (joint * compliance)
        moved = 2.0 * pressure * joint**2 * raceway
        moved /= ring.youngs_modulus * (raceway**2 - joint**2)
        return cls(pressure=pressure, raceway=moved)


def _compliance(joint: float, free: float, of: Seat, outward: float) -> float:
    """Return by how much a ring's diameter at a joint changes, over diameter and pressure [1/Pa]."""
    square = (min(joint, free) / max(joint, free)) ** 2
    ratio = (1.0 + square) / (1.0 - square)
    return (ratio + outward * of.poisson_ratio) / of.youngs_modulus
