"""The housing of the outer ring: a mass on a mount, part of the dynamics."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .._base.numbers import positive
from ..errors import SceneError
from ..scene import Structure

__all__ = ["Pedestal"]

_MASS, _DIAMETER = 0.8, 52e-3
"""Mass of a pillow block unit UCP205 [kg], and outside diameter of its bearing [m]."""
_FREQUENCY = 1000.0
"""Natural frequency of the housing on its mount [Hz]."""
_DAMPING_RATIO = 0.03


@dataclass(frozen=True, kw_only=True)
class Pedestal:
    """A housing with the outer ring in it, as one mass on a mount that is alike in x, y and z.

    It takes part in the dynamics: the balls push it, and the probe ``outer`` records its motion. A
    :class:`ballrace.measuring.Housing` is something else: the transfer of a run's acceleration from the ring to a
    sensor, applied afterwards.

    Attributes
    ----------
    mass : float
        Mass of the housing and the outer ring together [kg], above 0.
    stiffness : float
        Stiffness of the mount [N/m], above 0.
    damping : float
        Damping of the mount [N s/m], from 0; ``2 ζ sqrt(stiffness * mass)`` with a damping ratio ζ.

    Raises
    ------
    SceneError
        A number is not usable; it names ``housing.mass`` and so on.

    Examples
    --------
    >>> import ballrace as br
    >>> stiff = br.Pedestal(mass=3.0, stiffness=1.2e8, damping=1100.0)  # 1 kHz, 3 %
    >>> br.bearing("6205", housing=stiff, speed_rpm=1800.0).outer_ring.mass
    3.0
    """

    mass: float
    stiffness: float
    damping: float

    def __post_init__(self) -> None:
        for name, unit in (("mass", "kg"), ("stiffness", "N/m"), ("damping", "N s/m")):
            value = getattr(self, name)
            positive(f"housing.{name}", value, unit, zero=name == "damping")


def pillow_block(outside_diameter: float) -> Pedestal:
    """Return a cast pillow block for an outside diameter [m], and what it stands on.

    Makers' catalogues give 0.8 kg for a unit UCP205 (52 mm), housing and bearing together. The mass here is
    that with the cube of the diameter, as of bodies of one shape, which is an approximation: units grow more
    slowly. A UCP210 (90 mm) has some 2.7 kg in catalogues, and 3.0 by its length, height and width (206 x 113 x
    60 mm beside 140 x 70 x 38); the cube gives 4.1. The mount is a choice, not a measurement: 1 kHz, and a
    damping ratio of 3 %.
    """
    mass = _MASS * (outside_diameter / _DIAMETER) ** 3
    omega = 2.0 * math.pi * _FREQUENCY
    return Pedestal(
        mass=mass, stiffness=mass * omega**2, damping=2.0 * _DAMPING_RATIO * mass * omega
    )


def chosen_housing(housing: object, outside_diameter: float) -> Pedestal | Structure | None:
    """Return the housing that is asked for; None: the bare ring.

    Raises
    ------
    SceneError
        It is none.
    """
    if isinstance(housing, str) and housing == "pedestal":
        return pillow_block(outside_diameter)
    if housing is None or isinstance(housing, Pedestal | Structure):
        return housing
    allowed = (
        '"pedestal", None (the bare ring), a br.Pedestal(mass=…, stiffness=…, damping=…) or a '
        "br.Structure(modes=[br.Mode(…), …]); what lies between ring and sensor, as in br.measuring.Housing, "
        "belongs to br.measuring.Chain"
    )
    raise SceneError("housing", repr(housing), allowed)
