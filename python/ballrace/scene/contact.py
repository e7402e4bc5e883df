"""How a ball meets a race: elastic law, damping, and where the ball is cut."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from .._base.document import LEFT_OUT, Part, Variant

__all__ = [
    "AccurateSlices",
    "Contact",
    "FittedSlices",
    "FixedSlices",
    "Iso16281",
    "NormalLaw",
    "Slices",
    "SqueezeFilm",
]


@dataclass(frozen=True, kw_only=True)
class Iso16281(Variant, tag="iso16281"):
    """The paper's law, after the roller slices of ISO/TS 16281: the sum of ``c s^(10/9)`` over the slices.

    With the paper's constants ball and race approach about three times as far as by Hertz's law;
    :func:`ballrace.explain` gives the ratio at a scene's own load.

    Attributes
    ----------
    constant : float
        Constant of the law for lengths in metres [N/m²].
    length_ratio : float
        Equivalent length of the line contact over the ball diameter [1].
    """

    called: ClassVar[str] = "ISO/TS 16281 slices"

    constant: float = 3.5948e10
    length_ratio: float = 0.5


NormalLaw = Iso16281 | Literal["hertz"]
"""Elastic force of a slice; ``"hertz"`` is Hertz's point contact cut into slices."""


@dataclass(frozen=True)
class FixedSlices(Variant, tag="fixed", wraps=True):
    """Slices of equal width over the whole ball, fixed in it: the paper's method.

    Attributes
    ----------
    count : int
        Number of slices, 10 to 100 000.
    """

    count: int


@dataclass(frozen=True)
class FittedSlices(Variant, tag="fitted", wraps=True):
    """Quadrature nodes on every smooth piece of the zone of contact.

    Attributes
    ----------
    count : int
        Nodes on each piece, 2 to 64.
    """

    count: int


@dataclass(frozen=True)
class AccurateSlices(Variant, tag="accuracy", wraps=True):
    """Fitted nodes, as many as give normal and friction force of rolling balls to an accuracy.

    Attributes
    ----------
    accuracy : float
        Error of the force over the normal force [1], 1e-9 to 0.1; each race has its own number of nodes.
    """

    accuracy: float


Slices = FixedSlices | FittedSlices | AccurateSlices
"""Cutting of a ball into slices."""


@dataclass(frozen=True, kw_only=True)
class SqueezeFilm(Part):
    """Squeeze film of grease or oil between ball and race: a force against the speed v at which a gap g closes.

    ``damping * v / (1 + |g| / thickness)``, and of a film that is pulled apart at most ``pull``. It takes the
    rattle from balls that no load presses, and next to nothing from those that carry. The defaults are a 6205's
    in starved grease, fitted to the decay of measured impacts; flooded it has some hundred N s/m.

    Attributes
    ----------
    damping : float
        Damping where ball and race just touch [N s/m].
    thickness : float
        Thickness of the film [m].
    pull : float
        Largest force by which the film holds ball and race together [N].
    """

    damping: float = 15.0
    thickness: float = 0.3e-6
    pull: float = 0.02


@dataclass(frozen=True, kw_only=True)
class Contact(Part):
    """Contact of a ball and a race: elastic law, slices, damping.

    Attributes
    ----------
    law : NormalLaw
        Force of a slice from its penetration; Hertz's law by default.
    slices : Slices
        Where the ball is cut; 6 fitted nodes by default.
    damping : float
        Hunt-Crossley damping [s/m]: restitution is about ``1 - damping * v`` at an impact speed v.
    clamp_pull : bool
        Whether a slice that would pull is set to zero (and counted); False keeps the paper's bare sum.
    squeeze : SqueezeFilm, optional
        Film of grease or oil that damps the approach of ball and race where they do not press.
    """

    law: NormalLaw = "hertz"
    slices: Slices = FittedSlices(6)
    damping: float = 0.2
    clamp_pull: bool = True
    squeeze: SqueezeFilm | None = field(default=None, metadata=LEFT_OUT)
