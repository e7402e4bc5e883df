"""Kinematic frequencies of a bearing from pure rolling.

Everything is in orders, that is in multiples of the speed of the inner ring against the outer, the shaft's where
the outer ring stands still; times its frequency in hertz they are hertz (:meth:`Orders.at`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from .. import _core
from .._base.numbers import real
from ..errors import SceneError

if TYPE_CHECKING:
    from ..scene import Row

_STANDS = 1e-6
"""Turns of a ring, as a part of those of the rings against each other, up to which it stands but for round-off."""


@dataclass(frozen=True, kw_only=True)
class Orders:
    """The four frequencies of a row, in orders, or in hertz after :meth:`at`.

    Attributes
    ----------
    ftf : float
        Cage, the fundamental train frequency, relative to the loads.
    bpfo : float
        Balls passing a place on the outer race.
    bpfi : float
        Balls passing a place on the inner race.
    bsf : float
        Spin of a ball in the cage; a defect on a ball meets a race twice a turn.
    inner, outer : float
        Turns of the rings past the loads, which modulate the impacts on their races: 1 for the inner and 0 for the
        outer ring where the outer ring stands.

    All are rates, from 0 up, whichever way rings, cage and balls turn.
    """

    ftf: float
    bpfo: float
    bpfi: float
    bsf: float
    inner: float = 1.0
    outer: float = 0.0

    def at(self, shaft: float) -> Orders:
        """Return the frequencies [Hz] for a shaft frequency [Hz], of either sign."""
        return Orders(**{name: order * abs(shaft) for name, order in vars(self).items()})

    @property
    def turning(self) -> tuple[float, ...]:
        """Turns of the rings that turn past the loads: the lines of the machine stand at their multiples."""
        return tuple(order for order in (self.inner, self.outer) if order > _STANDS)

    def turned(self, outer: float) -> Orders:
        """Return the orders where the outer ring turns too.

        Parameters
        ----------
        outer : float
            Speed of the outer ring over that of the inner ring against it, Ω_o/(Ω_i − Ω_o): -1 where the inner
            ring stands, as in hubs and idlers.

        Examples
        --------
        Balls pass a place of the outer race as often, which goes through the load once a turn; the cage is faster:

        >>> hub = orders(9, 7.94e-3, 39.04e-3).turned(-1.0)
        >>> round(hub.bpfo, 4), round(hub.ftf, 4), hub.inner, hub.outer
        (3.5848, 0.6017, 0.0, 1.0)
        """
        return replace(
            self, ftf=abs(self.ftf + outer), inner=abs(self.inner + outer), outer=abs(outer)
        )


def orders(
    ball_count: int, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> Orders:
    """Return the kinematic orders of a row of balls.

    Parameters
    ----------
    ball_count : int
        Number of balls.
    ball_diameter, pitch_diameter : float
        Diameters, in the same unit.
    contact_angle : float
        Contact angle [rad].

    Raises
    ------
    SceneError
        A number is not usable.

    Examples
    --------
    The bearing 6205 of the Case Western Reserve data:

    >>> found = orders(9, 7.94e-3, 39.04e-3)
    >>> round(found.bpfo, 4), round(found.bpfi, 4), round(found.ftf, 4), round(2 * found.bsf, 4)
    (3.5848, 5.4152, 0.3983, 4.7135)
    """
    if not 1 <= real(ball_count) < math.inf:
        raise SceneError("ball_count", repr(ball_count), "at least 1")
    if not 1e-6 * real(pitch_diameter) < real(ball_diameter) < real(pitch_diameter) < math.inf:
        raise SceneError(
            "ball_diameter",
            repr(ball_diameter),
            f"above a millionth of the pitch diameter, {pitch_diameter}, and below it",
        )
    if not abs(real(contact_angle)) <= math.pi / 2:
        raise SceneError("contact_angle", repr(contact_angle), "between -π/2 and π/2")
    ftf, bpfo, bpfi, bsf = _core.orders(ball_count, ball_diameter, pitch_diameter, contact_angle)
    return Orders(ftf=ftf, bpfo=bpfo, bpfi=bpfi, bsf=bsf)


def of_row(row: Row) -> Orders:
    """Return the kinematic orders of a row of a scene, at its nominal contact angle.

    Examples
    --------
    >>> import ballrace as br
    >>> row = br.presets.wheel_bearing().rows[0]
    >>> round(br.frequencies.of_row(row).bpfo, 2)
    5.24
    """
    return orders(row.ball_count, row.ball_diameter, row.pitch_diameter, row.contact_angle)


def ftf(
    ball_count: int, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> float:
    """Return the order of the cage; arguments as for :func:`orders`."""
    return orders(ball_count, ball_diameter, pitch_diameter, contact_angle).ftf


def bpfo(
    ball_count: int, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> float:
    """Return the order of balls passing the outer race; arguments as for :func:`orders`."""
    return orders(ball_count, ball_diameter, pitch_diameter, contact_angle).bpfo


def bpfi(
    ball_count: int, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> float:
    """Return the order of balls passing the inner race; arguments as for :func:`orders`."""
    return orders(ball_count, ball_diameter, pitch_diameter, contact_angle).bpfi


def bsf(
    ball_count: int, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> float:
    """Return the order of a ball's spin; arguments as for :func:`orders`."""
    return orders(ball_count, ball_diameter, pitch_diameter, contact_angle).bsf
