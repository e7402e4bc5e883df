"""Signals over the angle of the shaft: orders instead of frequencies, whatever the speed does.

An order is a multiple of the shaft's rate, so a line that follows the speed stands at one order throughout a
run-up (computed order tracking: K. R. Fyfe, E. D. S. Munck, Mech. Syst. Signal Process. 11 (1997) 187).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._base.interrupt import answers_ctrl_c
from .._base.numbers import counted, real_row
from ..errors import SceneError
from .checks import checked_signal
from .lines import spectrum


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

    >>> import numpy as np
    >>> t = np.arange(8000) / 4000.0
    >>> turns = 10.0 * t + 5.0 * t**2
    >>> turn, value = by_order(np.cos(2 * np.pi * 3.0 * turns), 2 * np.pi * turns, per_turn=64)
    >>> bool(np.allclose(value, np.cos(2 * np.pi * 3.0 * turn), atol=2e-3))
    True
    """
    signal = checked_signal(x, 1.0)
    turned = real_row("angle", angle)
    if turned.shape != signal.shape:
        text = f"one angle a sample, {signal.shape}"
        raise SceneError("angle", f"an array of shape {turned.shape}", text)
    rate = None if per_turn is None else counted("per_turn", per_turn, 2)
    return _core.by_order(signal, turned, rate)


def turning(angle: ArrayLike) -> slice:
    """Return the longest part of a record in which the shaft has at least a twentieth of its highest speed.

    Of a run from rest, what :func:`by_order` takes: no turn has more than 20 times the samples of the fastest.

    Parameters
    ----------
    angle : array_like, shape (n,)
        Angle of the shaft at equal steps of time [rad].

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(8001) / 4000.0
    >>> turning(2 * np.pi * 10.0 * t**2)
    slice(400, 8001, None)
    """
    turned = real_row("angle", angle)
    if turned.ndim != 1:
        return slice(0, len(turned) if turned.ndim else 1)  # which by_order refuses
    return slice(*_core.turning(turned))


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
    >>> import numpy as np
    >>> t = np.arange(8000) / 4000.0
    >>> turns = 10.0 * t + 5.0 * t**2
    >>> order, value = order_spectrum(2.0 * np.cos(2 * np.pi * 3.0 * turns), 2 * np.pi * turns)
    >>> round(float(order[np.argmax(value)]), 2), round(float(value.max()), 2)
    (3.0, 2.0)
    """
    turn, value = by_order(x, angle, per_turn)
    return spectrum(value, 1.0 / float(turn[1]))
