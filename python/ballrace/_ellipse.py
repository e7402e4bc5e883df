"""Size of the contact ellipse of ball and race, after Hertz."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .scene import Row

__all__ = ["axis_ratio", "semi_axes"]


def axis_ratio(row: Row, race: Literal["outer", "inner"]) -> float:
    """Return the ellipse's axis across the rolling direction over that along it.

    With the curvatures of ball and race added across (A) and along (B) the rolling direction, it solves
    ``(B - A)/(B + A) = ((κ² + 1) E - 2 K) / ((κ² - 1) E)``, where K and E are the complete elliptic integrals of
    ``m = 1 - 1/κ²`` (T. A. Harris, *Rolling Bearing Analysis*, chapter on contact stress).

    Examples
    --------
    >>> import ballrace as br
    >>> row = br.bearing("6205").rows[0]
    >>> round(axis_ratio(row, "outer"), 2), round(axis_ratio(row, "inner"), 2)
    (5.72, 9.34)
    """
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipk

    gamma = row.ball_diameter * math.cos(row.contact_angle) / row.pitch_diameter
    conformity = row.outer_conformity if race == "outer" else row.inner_conformity
    across = 1.0 - 0.5 / conformity
    along = 1.0 - gamma / (1.0 + gamma) if race == "outer" else 1.0 + gamma / (1.0 - gamma)
    wanted = (along - across) / (along + across)

    def missing(logarithm: float) -> float:
        square = math.exp(2.0 * logarithm)
        m = 1.0 - 1.0 / square
        K, E = float(ellipk(m)), float(ellipe(m))
        return ((square + 1.0) * E - 2.0 * K) / ((square - 1.0) * E) - wanted

    return math.exp(float(brentq(missing, 1e-4, 12.0)))


def semi_axes(
    row: Row,
    race: Literal["outer", "inner"],
    load: NDArray[np.float64],
    pressure: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the semi-axes of ellipses of contact, across the rolling direction and along it [m].

    Parameters
    ----------
    row : Row
        The row of balls.
    race : {"outer", "inner"}
        Which race.
    load : ndarray
        Normal forces [N].
    pressure : ndarray
        Their largest Hertz pressures, as of :class:`ballrace.Equilibrium` [Pa]; ``3 load / (2 π a b)``.

    Returns
    -------
    ndarray, ndarray
        Both of the shape of ``load``; 0 without load.
    """
    ratio = axis_ratio(row, race)
    area = np.divide(1.5 * load, math.pi * pressure, out=np.zeros_like(load), where=pressure > 0.0)
    return np.sqrt(area * ratio), np.sqrt(area / ratio)
