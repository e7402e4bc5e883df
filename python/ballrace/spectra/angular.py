"""Signals over the angle of the shaft: orders instead of frequencies, whatever the speed does.

An order is a multiple of the shaft's rate, so a line that follows the speed stands at one order throughout a
run-up (computed order tracking: K. R. Fyfe, E. D. S. Munck, Mech. Syst. Signal Process. 11 (1997) 187).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .._interrupt import answers_ctrl_c
from .._numbers import counted, real_row
from ..errors import SceneError
from .checks import checked_signal
from .lines import spectrum

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["by_order", "order_spectrum", "turning"]

_FINER = 4
"""Samples that a cubic spline is laid through, for each of the signal: exact to 0.2 % up to 0.4 fs."""

_FILTER = {"window": ("kaiser", 8.0), "padtype": "antireflect"}
"""Filter of the resampling: ripple and leakage below 1e-4, and a record that goes on as its ends point."""

_FEWEST = 8
"""Samples over the angle, at least."""

_SLOWEST = 0.05
"""Part of the highest speed below which a shaft all but stands."""

_MOST = 64
"""Samples over the angle for each over time, at most."""


@answers_ctrl_c
def by_order(
    x: ArrayLike, angle: ArrayLike, per_turn: int | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a signal at equal steps of the shaft's angle.

    Parameters
    ----------
    x : array_like, shape (n,)
        Signal, at equal steps of time.
    angle : array_like, shape (n,)
        Angle of the shaft at the same times, rising throughout [rad], such as ``out["inner.theta"]``; of a hub
        that of the ring that turns, ``out["outer.theta"]``. Where both turn, fault lines stand at their orders
        over the angle of one against the other, their difference.
    per_turn : int, optional
        Samples a turn; the signal then holds orders up to half of it. By default as many as the slowest turn has,
        so that nothing is lost. With fewer, what lies above is filtered off first.

    Returns
    -------
    turn : ndarray
        Turns of the shaft since the first sample.
    value : ndarray
        The signal there, in the unit of ``x``.

    Raises
    ------
    SceneError
        An argument is not usable: the angle does not rise, or is so slow at places that a signal at equal steps
        would take 64 times the samples.

    Examples
    --------
    Three waves a turn, while the shaft goes from 10 to 30 turns a second:

    >>> t = np.arange(8000) / 4000.0
    >>> turns = 10.0 * t + 5.0 * t**2
    >>> turn, value = by_order(np.cos(2 * np.pi * 3.0 * turns), 2 * np.pi * turns, per_turn=64)
    >>> bool(np.allclose(value, np.cos(2 * np.pi * 3.0 * turn), atol=2e-3))
    True
    """
    from scipy.interpolate import CubicSpline, PchipInterpolator
    from scipy.signal import resample_poly

    signal = checked_signal(x, 1.0)
    turns = _checked_turns(angle, signal.size)
    rate, filtered = _rates(turns, per_turn)
    finer = resample_poly(signal, _FINER, 1, **_FILTER)
    at = np.arange(int(turns[-1] * rate * filtered) + 1) / (rate * filtered)
    sample = PchipInterpolator(turns, np.arange(signal.size))(np.minimum(at, turns[-1]))
    value = CubicSpline(np.arange(finer.size) / _FINER, finer)(sample)
    if filtered > 1:
        value, at = resample_poly(value, 1, filtered, **_FILTER), at[::filtered]
    return at, value


def turning(angle: ArrayLike) -> slice:
    """Return the longest part of a record in which the shaft has at least a twentieth of its highest speed.

    Of a run from rest, what :func:`by_order` takes: no turn has more than 20 times the samples of the fastest.

    Parameters
    ----------
    angle : array_like, shape (n,)
        Angle of the shaft at equal steps of time [rad].

    Examples
    --------
    >>> t = np.arange(8001) / 4000.0
    >>> turning(2 * np.pi * 10.0 * t**2)
    slice(400, 8001, None)
    """
    speed = np.diff(real_row("angle", angle), axis=0)
    slowest = _SLOWEST * speed.max(initial=0.0)
    if speed.ndim != 1 or not slowest > 0.0 or speed.min() < -slowest:
        return slice(0, speed.size + 1)  # which by_order refuses
    turns = np.concatenate(([0], (speed >= slowest).astype(np.int8), [0]))
    begins, ends = np.flatnonzero(np.diff(turns) == 1), np.flatnonzero(np.diff(turns) == -1)
    longest = int(np.argmax(ends - begins))
    return slice(int(begins[longest]), int(ends[longest]) + 1)


def order_spectrum(
    x: ArrayLike, angle: ArrayLike, per_turn: int | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the amplitude spectrum of a signal over the shaft's angle.

    Of a squared envelope it has the lines of a defect, at the same orders in a run-up as at constant speed:
    ``order_spectrum(squared_envelope(x, fs, band), angle)``.

    Parameters
    ----------
    x, angle, per_turn
        As for :func:`by_order`.

    Returns
    -------
    order : ndarray
        Orders, multiples of the shaft's rate, from 0 to half the samples a turn.
    value : ndarray
        Amplitudes, in the unit of ``x``.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> t = np.arange(8000) / 4000.0
    >>> turns = 10.0 * t + 5.0 * t**2
    >>> order, value = order_spectrum(2.0 * np.cos(2 * np.pi * 3.0 * turns), 2 * np.pi * turns)
    >>> round(float(order[np.argmax(value)]), 2), round(float(value.max()), 2)
    (3.0, 2.0)
    """
    turn, value = by_order(x, angle, per_turn)
    return spectrum(value, 1.0 / float(turn[1]))


def _checked_turns(angle: ArrayLike, samples: int) -> NDArray[np.float64]:
    turns = real_row("angle", angle) / (2.0 * math.pi)
    if turns.shape != (samples,):
        raise SceneError(
            "angle", f"an array of shape {turns.shape}", f"one angle a sample, ({samples},)"
        )
    if not np.isfinite(turns).all() or not (np.diff(turns) > 0.0).all():
        raise SceneError(
            "angle",
            "not rising",
            "finite, and rising from each sample to the next, as that of a ring that turns",
        )
    found: NDArray[np.float64] = turns - turns[0]
    return found


def _rates(turns: NDArray[np.float64], per_turn: int | None) -> tuple[int, int]:
    """Return the samples a turn, and how many times as many are taken before the filter."""
    needed = math.ceil(1.0 / np.diff(turns).min())
    rate = needed if per_turn is None else counted("per_turn", per_turn, 2)
    if rate * turns[-1] < _FEWEST:
        text = f"more; at {rate} samples a turn it gives fewer than {_FEWEST}"
        raise SceneError("angle", f"{turns[-1]:.3g} turns", text)
    filtered = max(math.ceil(needed / rate), 1)
    if rate * filtered * turns[-1] > _MOST * turns.size:
        text = f"{needed} samples a turn where it is slowest"
        raise SceneError(
            "angle",
            text,
            "one without the time in which the shaft almost stands; turning(angle) returns the rest",
        )
    return rate, filtered
