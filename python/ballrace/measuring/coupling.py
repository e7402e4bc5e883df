"""Coupling of a path: how much its modes would act back on the ring, were they in the scene."""

from __future__ import annotations

import math
import warnings
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from ..errors import EquilibriumError, SceneError
from ..scene import Spring
from ..statics import stiffness

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene import Ring, Scene, Structure

TOO_MUCH = 0.3
"""Coupling from which a path belongs into the scene: at 0.1 the rms is right within 10 %."""

_STEEL = 7850.0


def coupling(scene: Scene, path: Structure) -> float:
    r"""Return the largest of κ = |Z_r(ω)| \|Φ\|² / (2 ζ m ω²) over the modes of a path, at their frequencies.

    Z_r = (1/D + 1/(Z_c − ω² m_r))⁻¹ is the dynamic stiffness of ring and bearing behind the seat, D = K + i ω C
    the ring's spring and damper there, Z_c = (1/k_c − 1/(ω² m_s))⁻¹ that of the contacts k_c with the shaft m_s
    behind them. Where a run has no equilibrium, contacts are left out.
    """
    contacts = _contacts(scene)
    support = scene.outer_ring.support
    masses = _mass(scene, scene.outer_ring, 1), _mass(scene, scene.inner_ring, -1)
    found = 0.0
    for mode in path.modes:
        omega = 2.0 * math.pi * mode.frequency
        share = 0.0
        for axis, name in enumerate("xyz"):
            held = getattr(support, name)
            if not isinstance(held, Spring) or mode.seat[axis] == 0.0:
                continue
            spring = held.stiffness + 1j * omega * held.damping
            shaft = contacts[axis] * omega**2 * masses[1]
            behind = shaft / (omega**2 * masses[1] - contacts[axis]) - omega**2 * masses[0]
            share += abs(spring * behind / (spring + behind)) * mode.seat[axis] ** 2
        found = max(found, share / (2.0 * mode.damping * mode.mass * omega**2))
    return found


@lru_cache(maxsize=256)
def _contacts(scene: Scene) -> NDArray[np.float64]:
    """Return the contacts' stiffness along x, y and z [N/m]; 0 where there is no equilibrium."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return np.diag(stiffness(scene).inner)[:3]
    except (EquilibriumError, SceneError):
        return np.zeros(3)


def _mass(scene: Scene, ring: Ring, sign: int) -> float:
    """Return the mass of a ring, by its size that of a hollow cylinder as far as the balls' shoulders [kg]."""
    if ring.mass is not None or ring.diameter is None or ring.width is None:
        return 1.0 if ring.mass is None else ring.mass
    row = scene.rows[0]
    land = row.pitch_diameter + sign * 0.6 * row.ball_diameter
    return 0.25 * math.pi * _STEEL * ring.width * abs(ring.diameter**2 - land**2)
