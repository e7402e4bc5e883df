"""Materials of rings and balls."""

from __future__ import annotations

from dataclasses import dataclass

from .._base.document import Part

__all__ = ["Material", "Materials"]


@dataclass(frozen=True, kw_only=True)
class Material(Part):
    """A linear elastic, isotropic material; the default is bearing steel.

    Attributes
    ----------
    density : float
        Density [kg/m³].
    youngs_modulus : float
        Young's modulus [Pa]; used by the Hertz law.
    poisson_ratio : float
        Poisson's ratio [1].
    """

    density: float = 7850.0
    youngs_modulus: float = 206e9
    poisson_ratio: float = 0.3


@dataclass(frozen=True, kw_only=True)
class Materials(Part):
    """Materials of the parts.

    Attributes
    ----------
    rings, balls : Material
        Material of both rings, and of the balls.
    """

    rings: Material = Material()
    balls: Material = Material()
