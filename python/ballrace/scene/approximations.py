"""Simplifications that change the result."""

from __future__ import annotations

from dataclasses import dataclass

from .._document import Part

__all__ = ["Approximations"]


@dataclass(frozen=True, kw_only=True)
class Approximations(Part):
    """Simplifications that change the answer, all off by default.

    What each costs in accuracy is measured in ``benches/records.md``; :func:`ballrace.explain` offers those that
    apply to a scene, and ``out.provenance.left_out`` lists those that a run used.

    Attributes
    ----------
    rolling : bool
        Balls and cage are kinematic: every row orbits in proportion to the inner ring as it rolls at the start,
        its balls spaced as there, and moves along its radii and z only. Friction and cage are left out, of
        :meth:`Model.rhs` and :meth:`Model.forces` too, which else are those of free balls. Needs a driven speed.
    plane : bool
        Rings and balls keep their axial places from the start, the balls of a row all the same one: the plane
        model of a bearing with a contact angle, where loads along z do not change.
    one_row : bool
        Of two rows the one that carries less than 2 % of the load at the start is left out, where loads do not
        change.
    """

    rolling: bool = False
    plane: bool = False
    one_row: bool = False
