"""Simplifications that change the result."""

from __future__ import annotations

from dataclasses import dataclass

from .._base.document import Part

__all__ = ["Approximations"]


@dataclass(frozen=True, kw_only=True)
class Approximations(Part):
    """Simplifications that change the answer, all off by default.

    What each costs in accuracy is measured in ``benches/records.md``; :func:`ballrace.explain` offers those that
    apply to a scene, and ``out.provenance.left_out`` lists those that a run used.

    Attributes
    ----------
    rolling : bool
        Balls and cage are kinematic: every row orbits at the share of the inner ring's speed at which it rolls at
        the start, with the spacing of its balls at the start; balls move only along their radii and z. Friction
        and cage are left out, also from :meth:`Model.rhs` and :meth:`Model.forces`, which otherwise include free
        balls. Needs a given speed.
    plane : bool
        Rings and balls keep their axial places from the start, all balls of a row the same one: the plane
        model of a bearing with a contact angle, for loads along z that do not change.
    one_row : bool
        Of two rows, the one that carries less than 2 % of the load at the start is left out, where loads do not
        change.
    """

    rolling: bool = False
    plane: bool = False
    one_row: bool = False
