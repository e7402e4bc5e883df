"""How strong the vibration of a machine is, by ISO 20816-3, and how impulsive the deciding band is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from .._base.units import ACCELERATIONS
from ..errors import SceneError

if TYPE_CHECKING:
    from ..channel import Channel
    from .strength import Envelopes

Machine = Literal["large_rigid", "large_flexible", "medium_rigid", "medium_flexible"]
"""Class of a machine: large, above 300 kW, or medium, 15 to 300 kW; on a rigid or a flexible foundation."""

ZONES: dict[Machine, tuple[float, float, float]] = {
    "large_rigid": (2.3, 4.5, 7.1),
    "large_flexible": (3.5, 7.1, 11.0),
    "medium_rigid": (1.4, 2.8, 4.5),
    "medium_flexible": (2.3, 4.5, 7.1),
}
"""Boundaries A/B, B/C and C/D of the rms velocity [mm/s].

ISO 10816-3:2009, Tables A.1 (group 1) and A.2 (group 2). ISO 20816-3:2022, which replaces it, is understood to
have kept them; its print was not at hand.
"""

_SLOW = 10.0
"""Rate of the shaft [Hz] below which the band begins at 2 instead of 10 Hz (600 1/min, ISO 10816-3)."""


@dataclass(frozen=True, kw_only=True)
class Change:
    """Change of a vibration: ratios of the record to the reference.

    Attributes
    ----------
    velocity : float or None
        Ratio of the velocities; None where the unit is not known.
    crest_factor, kurtosis : float
        Ratios in the deciding band of the record.
    """

    velocity: float | None
    crest_factor: float
    kurtosis: float


@dataclass(frozen=True, kw_only=True)
class Severity:
    """Size of a vibration.

    Attributes
    ----------
    velocity : float or None
        Its root mean square in ``band`` [mm/s]; None where the unit of the record is not known.
    band : tuple of two floats
        10, or 2 below 600 1/min, to 1000 Hz, or to fs/2 where that is less.
    zone : {"A", "B", "C", "D"} or None
        Zone of ISO 20816-3, from that of new machines to that of damage; None without a class of the machine.
    machine : str or None
        The class that was given.
    crest_factor, kurtosis : float
        Of the deciding band: peak over root mean square, and 3 for Gaussian noise.
    change : Change or None
        All of it over that of the reference record; None without one.
    """

    velocity: float | None
    band: tuple[float, float]
    zone: Literal["A", "B", "C", "D"] | None
    machine: Machine | None
    crest_factor: float
    kurtosis: float
    change: Change | None = None

    def over(self, before: Severity) -> Severity:
        """Return the severity with its change since another one, of the same bands."""
        known = self.velocity is not None and before.velocity
        change = Change(
            velocity=self.velocity / before.velocity if known else None,  # type: ignore[operator]
            crest_factor=self.crest_factor / before.crest_factor,
            kurtosis=self.kurtosis / before.kurtosis,
        )
        return replace(self, change=change)


def checked_machine(machine: Machine | None) -> Machine | None:
    """Return a class of machines, or None.

    Raises
    ------
    SceneError
        There is no such class.
    """
    if machine is not None and machine not in ZONES:
        raise SceneError("machine", repr(machine), "one of " + ", ".join(get_args(Machine)))
    return machine


def severity_of(
    channel: Channel, shaft: float, envelopes: Envelopes, deciding: int, machine: Machine | None
) -> Severity:
    """Return the severity of a record in m/s², for a shaft's rate [Hz] and the deciding band."""
    band = (2.0 if shaft < _SLOW else 10.0, min(1000.0, channel.fs / 2.0))
    known = channel.unit in ACCELERATIONS and band[0] < band[1]
    velocity = float(np.std(channel.to("mm/s", band).x)) if known else None
    return Severity(
        velocity=velocity,
        band=band,
        zone=None if velocity is None or machine is None else zone_of(velocity, machine),
        machine=machine,
        crest_factor=envelopes.crest_factor(deciding),
        kurtosis=envelopes.kurtosis(deciding),
    )


def zone_of(velocity: float, machine: Machine) -> Literal["A", "B", "C", "D"]:
    """Return the zone of a velocity [mm/s].

    Examples
    --------
    >>> zone_of(1.0, "medium_rigid"), zone_of(3.0, "medium_rigid"), zone_of(12.0, "large_flexible")
    ('A', 'C', 'D')
    """
    above = sum(velocity > boundary for boundary in ZONES[machine])
    zones: tuple[Literal["A", "B", "C", "D"], ...] = ("A", "B", "C", "D")
    return zones[above]
