"""The cage: links between neighbouring balls, or a rigid ring with pockets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .._base.document import Part, Variant

__all__ = ["Cage", "CageGuidance", "CageRing"]


@dataclass(frozen=True, kw_only=True)
class Cage(Part):
    """Springs that keep the centres of neighbouring balls of a row at their distance.

    Attributes
    ----------
    stiffness : float
        Stiffness [N/m].
    damping : float
        Damping, while engaged [N s/m].
    play : float
        Total play [m]: free within ± half of it around the nominal distance.
    """

    stiffness: float
    damping: float = 0.0
    play: float = 0.0


CageGuidance = Literal["centred", "held", "outer", "inner", "balls"]
"""Guidance of a cage that is a ring: a soft spring, the outer ring itself, a land of a ring, or the balls."""


@dataclass(frozen=True, kw_only=True)
class CageRing(Variant, tag="ring"):
    """A rigid ring around the axis with a pocket for each ball of a row; every row has one of its own.

    Attributes
    ----------
    mass : float or None
        Mass [kg]; None: of a steel ring of 0.2 D × 0.9 D around the pitch circle less its pockets, 8 g for a 6205.
    inertia : float or None
        Moment of inertia about its axis [kg m²]; None: the mass times the square of the pitch radius.
    eccentricity : float
        Distance of its centre of mass from its centre, towards its pocket 0 [m]; only of a cage that is not held.
    pocket_clearance : float or None
        Clearance of a ball on either side of its pocket [m], half of the play; None: D/160, 50 µm at D = 8 mm.
    stiffness : float or None
        Stiffness of a pocket's wall [N/m]; None: 3.75e7 N/m² times D, 3e5 N/m at D = 8 mm.
    damping : float or None
        Damping of a pocket's wall [N s/m]; None: half of the critical one of a ball.
    damping_depth : float
        Depth over which that damping sets in [m].
    friction : float
        Coefficient of friction of ball and pocket [1].
    slip_speed : float or None
        Slip speed below which friction in pockets and on the land fades [m/s]; None: that of the row's friction,
        or 0.01 m/s.
    pocket_errors : tuple of float
        Errors of the pockets' angles [rad], one for each ball of a row; empty: none.
    pocket_error : float
        Standard deviation of further errors, drawn from the seed [rad].
    seed : int
        What they are drawn from.
    guided : {"centred", "held", "outer", "inner", "balls"}
        What carries it. ``"centred"``: a soft spring and a damper hold it at the outer ring's centre. ``"held"``:
        its centre is the outer ring's, which what balls do to the pockets strikes, and it has a moment of inertia
        only. ``"outer"``, ``"inner"``: a land of that ring carries its weight. ``"balls"``: the balls do, in round
        pockets.
    centring_stiffness : float or None
        Stiffness of the spring that centres it [N/m], with half of the critical damping; None: one on which its
        weight lowers it by a sixth of the usual clearance of its pockets, 9.4e3 N/m in a 6205.
    land_clearance : float or None
        Clearance of the cage in its land, along any radius [m]; None: that of the pockets. With more the pockets
        carry the cage.
    land_radius : float or None
        Radius of the land [m]; None: that of the ring's shoulders, or 0.3 D beyond the pitch radius.
    land_stiffness : float
        Stiffness of the land [N/m]; its damping is half of the critical one.
    land_friction : float
        Coefficient of friction on the land [1].
    """

    mass: float | None = None
    inertia: float | None = None
    eccentricity: float = 0.0
    pocket_clearance: float | None = None
    stiffness: float | None = None
    damping: float | None = None
    damping_depth: float = 0.2e-6
    friction: float = 0.02
    slip_speed: float | None = None
    pocket_errors: tuple[float, ...] = ()
    pocket_error: float = 0.0
    seed: int = 0
    guided: CageGuidance = "centred"
    centring_stiffness: float | None = None
    land_clearance: float | None = None
    land_radius: float | None = None
    land_stiffness: float = 1e6
    land_friction: float = 0.05
