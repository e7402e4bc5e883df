"""Values that may change in time."""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._base.document import Variant, encode
from .._base.libraries import scipy

__all__ = ["Ramp", "Sine", "Spline", "Table", "TimeFunction"]


@dataclass(frozen=True, kw_only=True)
class Ramp(Variant, tag="ramp"):
    """Linear from one value to another, constant before and after; a jump when ``start == end``.

    Attributes
    ----------
    from_, to : float
        Value before ``start`` and from ``end`` on [unit of the field]. In documents and paths the first is named
        ``from``.
    start, end : float
        Times at which the change begins and is over [s].
    """

    from_: float
    to: float
    start: float
    end: float


@dataclass(frozen=True, kw_only=True)
class Sine(Variant, tag="sine"):
    """``mean + amplitude * sin(2 pi frequency t + phase)``.

    Attributes
    ----------
    mean, amplitude : float
        Mean value and amplitude [unit of the field].
    frequency : float
        Frequency [Hz].
    phase : float
        Phase at t = 0 [rad].
    """

    mean: float
    amplitude: float
    frequency: float
    phase: float


@dataclass(frozen=True, kw_only=True)
class Table(Variant, tag="table"):
    """Linear between points, constant beyond them; two equal times make a jump.

    Attributes
    ----------
    times : tuple of float
        Times, not decreasing [s].
    values : tuple of float
        Value at each time [unit of the field].
    """

    times: tuple[float, ...]
    values: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Spline(Variant, tag="spline"):
    """Cubic between points, with the given rates at the points (Hermite interpolation); linear beyond them.

    Attributes
    ----------
    times : tuple of float
        Times, strictly increasing [s].
    values : tuple of float
        Value at each time [unit of the field].
    rates : tuple of float
        Rate of change at each time [unit of the field / s].
    """

    times: tuple[float, ...]
    values: tuple[float, ...]
    rates: tuple[float, ...]

    @classmethod
    def through(cls, times: ArrayLike, values: ArrayLike) -> Spline:
        """Return the smooth curve through points: the cubic spline whose ends are "not a knot".

        Parameters
        ----------
        times, values : array-like of float, shape (n,)
            Times, strictly increasing [s], and the value at each; two or more.

        Raises
        ------
        ValueError
            The times do not increase, or the arrays differ in length or have fewer than two numbers.

        Examples
        --------
        >>> from ballrace.scene import Spline
        >>> cubic = Spline.through([0.0, 1.0, 2.0, 3.0], [0.0, 2.0, 10.0, 30.0])  # t³ + t
        >>> [round(rate, 9) for rate in cubic.rates]
        [1.0, 4.0, 13.0, 28.0]
        """
        curve = scipy.interpolate.CubicSpline(times, values)
        points = (curve.x, np.asarray(values, float), curve(curve.x, 1))
        at, of, rate = (tuple(map(float, each)) for each in points)
        return cls(times=at, values=of, rates=rate)


def values_at(function: TimeFunction, times: ArrayLike) -> NDArray[np.float64]:
    """Return the values of a function at times [s]; at a jump the one after it."""
    t = np.asarray(times, np.float64)
    found = _core.time_values(json.dumps(encode(function, "function")), np.ravel(t))
    return found.reshape(t.shape)


TimeFunction = float | Ramp | Sine | Table | Spline
"""A value that may change in time; a plain number is constant."""
