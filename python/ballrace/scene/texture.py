"""Texture of races and balls: what grinding and honing leave on them."""

from __future__ import annotations

from dataclasses import dataclass, field

from .._base.document import LEFT_OUT, Part

__all__ = ["Texture"]


@dataclass(frozen=True, kw_only=True)
class Texture(Part):
    """Many small waves around the races and balls of a row, drawn from a seed.

    A wave of order n has the amplitude ``a * (30 / n) ** slope`` times a random number of Rayleigh's distribution,
    and a random phase, so that heights are Gaussian; contacts average waves over their width. The same seed gives
    the same surfaces, whatever else changes. Needs plain grooves: no profiles, arches or rounded shoulders.

    Attributes
    ----------
    outer, inner : float
        Amplitude a of the races at order 30 [m], 0 to 1e-6: quiet bearings of some 50 mm have 0.2e-9 to 5e-9.
    ball : float
        The same of the balls [m]. Balls as smooth as a race of radius R at equal wavelengths have (D / 2R) **
        slope of its amplitude, with the ball diameter D: some hundredth.
    slope : float
        Exponent by which amplitudes fall with the order [1], 0.5 to 4; measured ones have 1.5 to 2.5.
    orders : tuple of two ints, or None
        Lowest and highest order on the races, 2 to 20 000; None: from 2 to waves half as long as a contact
        is wide. On balls the highest order is that of waves as short on them, if it is lower.
    seed : int
        Seed of phases and amplitudes, 0 to 2**53 - 1.
    reference_load : float or None
        Load of the contact over whose width waves are averaged [N]; None: that of the equilibrium at the start.

    Examples
    --------
    >>> import ballrace as br
    >>> made = br.scene.Texture(outer=1e-9, inner=1e-9, ball=3e-11, seed=4)
    >>> scene = br.bearing("6205", radial_load=300.0, axial_load=80.0, texture=made, speed_rpm=1800.0)
    """

    outer: float = 0.0
    inner: float = 0.0
    ball: float = 0.0
    slope: float = 2.0
    orders: tuple[int, int] | None = field(default=None, metadata=LEFT_OUT)
    seed: int = 0
    reference_load: float | None = field(default=None, metadata=LEFT_OUT)
