"""Radial internal clearance of deep groove ball bearings, ISO 5753-1."""

from __future__ import annotations

import math

from .._base.numbers import real
from ..errors import SceneError

CLASSES = ("C2", "CN", "C3", "C4", "C5")

# Bore up to and including [mm], then least and largest clearance of C2, CN, C3, C4, C5 [µm].
_TABLE = (
    (10.0, ((0, 7), (2, 13), (8, 23), (14, 29), (20, 37))),
    (18.0, ((0, 9), (3, 18), (11, 25), (18, 33), (25, 45))),
    (24.0, ((0, 10), (5, 20), (13, 28), (20, 36), (28, 48))),
    (30.0, ((1, 11), (5, 20), (13, 28), (23, 41), (30, 53))),
    (40.0, ((1, 11), (6, 20), (15, 33), (28, 46), (40, 64))),
    (50.0, ((1, 11), (6, 23), (18, 36), (30, 51), (45, 73))),
    (65.0, ((1, 15), (8, 28), (23, 43), (38, 61), (55, 90))),
    (80.0, ((1, 15), (10, 30), (25, 51), (46, 71), (65, 105))),
    (100.0, ((1, 18), (12, 36), (30, 58), (53, 84), (75, 120))),
    (120.0, ((2, 20), (15, 41), (36, 66), (61, 97), (90, 140))),
    (140.0, ((2, 23), (18, 48), (41, 81), (71, 114), (105, 160))),
    (160.0, ((2, 23), (18, 53), (46, 91), (81, 130), (120, 180))),
    (180.0, ((2, 25), (20, 61), (53, 102), (91, 147), (135, 200))),
    (200.0, ((2, 30), (25, 71), (63, 117), (107, 163), (150, 230))),
    (225.0, ((2, 35), (25, 85), (75, 140), (125, 195), (175, 265))),
    (250.0, ((2, 40), (30, 95), (85, 160), (145, 225), (205, 300))),
    (280.0, ((2, 45), (35, 105), (90, 170), (155, 245), (225, 340))),
    (315.0, ((2, 55), (40, 115), (100, 190), (175, 270), (245, 370))),
    (355.0, ((3, 60), (45, 125), (110, 210), (195, 300), (275, 410))),
    (400.0, ((3, 70), (55, 145), (130, 240), (225, 340), (315, 460))),
    (450.0, ((3, 80), (60, 170), (150, 270), (250, 380), (350, 520))),
    (500.0, ((3, 90), (70, 190), (170, 300), (280, 420), (390, 570))),
)


def radial_clearance(bore: float, clearance: str | float) -> float:
    """Return the diametral clearance of a deep groove bearing [m]: the middle of a class, or the given number.

    Parameters
    ----------
    bore : float
        Bore [m].
    clearance : {"C2", "CN", "C3", "C4", "C5"} or float
        Class of ISO 5753-1, before mounting; or the clearance [m].

    Raises
    ------
    SceneError
        There is no such class, or the bore is beyond the table.

    Examples
    --------
    >>> round(1e6 * radial_clearance(25e-3, "CN"), 2)
    12.5
    """
    if not isinstance(clearance, str):
        if not math.isfinite(real(clearance)):
            raise SceneError(
                "clearance", repr(clearance), "a number [m], or one of " + ", ".join(CLASSES)
            )
        return float(clearance)
    low, high = _micrometres(bore, clearance)
    return 0.5e-6 * (low + high)


def clearance_limits(bore: float, clearance: str) -> tuple[float, float]:
    """Return the least and the largest diametral clearance of a class [m].

    Raises
    ------
    SceneError
        There is no such class, or the bore is beyond the table.

    Examples
    --------
    >>> [round(1e6 * limit) for limit in clearance_limits(25e-3, "CN")]
    [5, 20]
    """
    low, high = _micrometres(bore, clearance)
    return 1e-6 * low, 1e-6 * high


def _micrometres(bore: float, clearance: str) -> tuple[int, int]:
    if clearance not in CLASSES:
        raise SceneError(
            "clearance", repr(clearance), "a number [m], or one of " + ", ".join(CLASSES)
        )
    for largest, limits in _TABLE:
        if bore <= largest * (1e-3 + 1e-12):
            return limits[CLASSES.index(clearance)]
    raise SceneError("clearance", clearance, "a number [m]: the table ends at a bore of 500 mm")
