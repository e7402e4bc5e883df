"""Friction of balls and races."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .._base.document import Variant

__all__ = ["Coulomb", "Friction", "Stribeck", "Traction"]


@dataclass(frozen=True, kw_only=True)
class Coulomb(Variant, tag="coulomb"):
    """Friction with a constant coefficient.

    Attributes
    ----------
    coefficient : float
        Coefficient of friction [1].
    slip_speed : float
        Slip speed below which friction fades [m/s].
    """

    coefficient: float
    slip_speed: float


@dataclass(frozen=True, kw_only=True)
class Stribeck(Variant, tag="stribeck"):
    """Friction that falls from a static to a kinetic coefficient, ``k + (s - k) exp(-(u / u_s)²)``.

    Attributes
    ----------
    static_coefficient, kinetic_coefficient : float
        The two coefficients, s and k [1].
    stribeck_speed : float
        Stribeck speed u_s [m/s].
    slip_speed : float
        Slip speed below which friction fades [m/s].
    """

    static_coefficient: float
    kinetic_coefficient: float
    stribeck_speed: float
    slip_speed: float


@dataclass(frozen=True, kw_only=True)
class Traction(Variant, tag="traction"):
    """A lubricated traction curve, ``(a + b u) exp(-c u) + d`` at a slip speed u.

    Attributes
    ----------
    a : float
        Traction coefficient at no slip, less ``d`` [1].
    b : float
        Initial slope [s/m].
    c : float
        Decay [s/m].
    d : float
        Traction coefficient at high slip [1].
    slip_speed : float
        Slip speed below which friction fades [m/s].
    """

    a: float
    b: float
    c: float
    d: float
    slip_speed: float


Friction = Literal["none"] | Coulomb | Stribeck | Traction
"""Friction of a slice against its slip velocity."""
