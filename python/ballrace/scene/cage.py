"""The cage: links between neighbouring balls."""

from __future__ import annotations

from dataclasses import dataclass

from .._document import Part

__all__ = ["Cage"]


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
