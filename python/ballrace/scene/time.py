"""Values that may change in time."""

from __future__ import annotations

from dataclasses import dataclass

from .._document import Variant

__all__ = ["Ramp", "Sine", "Table", "TimeFunction"]


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
        A value a time [unit of the field].
    """

    times: tuple[float, ...]
    values: tuple[float, ...]


TimeFunction = float | Ramp | Sine | Table
"""A value that may change in time; a plain number is constant."""
