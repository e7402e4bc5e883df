"""Size of the contact ellipse of ball and race, after Hertz."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

import numpy as np

from .. import _core

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene import Row


def axis_ratio(row: Row, race: Literal["outer", "inner"]) -> float:
    """Return the ellipse's axis across the rolling direction over that along it, at the nominal contact angle.

    Examples
    --------
    >>> import ballrace as br
    >>> row = br.bearing("6205", speed_rpm=1800.0).rows[0]
    >>> round(axis_ratio(row, "outer"), 2), round(axis_ratio(row, "inner"), 2)
    (5.72, 9.34)
    """
    outer = race == "outer"
    return _core.axis_ratio(
        1.0 if outer else -1.0,
        row.ball_diameter,
        row.pitch_diameter,
        row.outer_conformity if outer else row.inner_conformity,
        row.contact_angle,
    )


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
        Their largest Hertz pressures, as of :class:`ballrace.statics.Equilibrium` [Pa]; ``3 load / (2 π a b)``.

    Returns
    -------
    ndarray, ndarray
        Both of the shape of ``load``; 0 without load.
    """
    ratio = axis_ratio(row, race)
    area = np.divide(1.5 * load, math.pi * pressure, out=np.zeros_like(load), where=pressure > 0.0)
    return np.sqrt(area * ratio), np.sqrt(area / ratio)
