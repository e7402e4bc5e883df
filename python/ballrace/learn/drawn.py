"""Fields of a scene in which simulated bearings differ, drawn by chance, by their dotted paths."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from .._base.units import GRAVITY
from ..errors import SceneError
from ..scene import Unbalance
from ..statics import equilibrium

if TYPE_CHECKING:
    import numpy as np

    from ..bearings import Bearing
    from ..scene import Scene, Structure, Surface

_SLIP_BY_BALLS = 1.4e4
"""Scatter of the times between impacts over that of the balls' diameters [1/m].

Measured of a 6205 under 300 N and 80 N of thrust, three bearings each: 0.06 to 0.10, 0.36 to 0.48 and 0.76 to
0.98 % at 0.2 µm and 0.1, 0.2 and 0.33 mm of play (both sides of a pocket), 0.22 to 0.32, 0.65 to 0.76 and 1.07 to
1.26 % at 0.5 µm.
"""
_PLAY = (0.08e-3, 0.2e-3)
"""Play of a ball in its pocket of a 6205 [m], up to the slip below, with which it grows; others by the ball
diameter."""
_PLAIN_SLIP = 6e-3
_BALL_OF_6205 = 7.94e-3

_AMPLITUDE = (0.2e-9, 5e-9)
"""Texture of races at order 30 [m], and its slope: from quiet to poor bearings of this size (ISO 15242-2)."""
_SLOPE = (1.5, 2.5)
_OVAL = 0.6e-6
"""Largest wave of order 2 [m]: finished races are rounder."""
_BALL_TEXTURE = (0.3, 3.0)
"""Amplitude of balls over that which is as good as the races wavelength by wavelength."""

_EDGE = (0.01, 0.25)
"""Radius of a spall's edges in ball diameters: engraved ones, to what steep walls amount to in a contact."""
_LENGTH = 0.6
"""Longest spall across rolling in ball diameters: wider than any contact."""
_AROUND = 0.7
"""Largest angle of a fault of the outer race from the middle of the load zone [rad]."""

_ROTATING = 2.0 / 3.0
"""Largest force of an unbalance over the load."""

_MASS = (0.5, 4.0)
"""Masses of the machine over those of a pedestal."""
_FREQUENCY, _APART = (0.6, 1.6), (0.8, 1.25)
"""Natural frequencies over those of a pedestal, all together and each by itself."""
_DAMPING = (0.01, 0.1)
"""Damping ratio of a mode."""


def slip_fields(bearing: Bearing, slip: float, rng: np.random.Generator) -> dict[str, Any]:
    """Return unequal balls and a play of the cage which give impacts a scatter (:class:`Recipe`, ``slip``)."""
    unlike = slip / _SLIP_BY_BALLS * rng.standard_normal(bearing.ball_count)
    scale = bearing.ball_diameter / _BALL_OF_6205 * max(1.0, slip / _PLAIN_SLIP)
    return {
        "rows[0].diameter_errors": unlike.tolist(),
        "cage.ring.pocket_clearance": 0.5 * scale * float(rng.uniform(*_PLAY)),
    }


def structure_fields(structure: Structure, rng: np.random.Generator) -> dict[str, Any]:
    """Return a machine like a structure, with other masses, frequencies and dampings."""
    mass, frequency = log_uniform(rng, _MASS), log_uniform(rng, _FREQUENCY)
    drawn: dict[str, Any] = {}
    for k, mode in enumerate(structure.modes):
        own = {
            "frequency": mode.frequency * frequency * log_uniform(rng, _APART),
            "damping": log_uniform(rng, _DAMPING),
            "mass": mode.mass * mass,
        }
        drawn |= {f"structure.modes[{k}].{name}": value for name, value in own.items()}
    return drawn


def unbalance(load: float, speed: float, grade: float, rng: np.random.Generator) -> Unbalance:
    """Return the unbalance of a rotor as heavy as a load [N] at a speed [rad/s], for a balance grade [mm/s].

    Its force is at most two thirds of the load, whatever the grade: rotors that fast are balanced better.
    """
    # A grade is eccentricity times speed (ISO 21940-11).
    moment = load / GRAVITY * min(1e-3 * grade / speed, _ROTATING * GRAVITY / speed**2)
    return Unbalance(ring="inner", moment=moment, angle=float(rng.uniform(0.0, 2.0 * math.pi)))


def texture_fields(bearing: Bearing, rng: np.random.Generator) -> dict[str, Any]:
    """Return a texture of races and balls."""
    slope = float(rng.uniform(*_SLOPE))
    ends = (_AMPLITUDE[0], min(_AMPLITUDE[1], _OVAL / 15.0**slope))
    outer, inner = log_uniform(rng, ends), log_uniform(rng, ends)
    as_good = math.sqrt(outer * inner) * (bearing.ball_diameter / bearing.pitch_diameter) ** slope
    drawn = {"outer": outer, "inner": inner, "ball": as_good * log_uniform(rng, _BALL_TEXTURE)}
    drawn |= {"slope": slope, "seed": int(rng.integers(2**53))}
    return {f"rows[0].texture.{name}": value for name, value in drawn.items()}


def fault_fields(
    on: Surface, size: float, ball: float, rng: np.random.Generator
) -> tuple[dict[str, float], dict[str, float]]:
    """Return the fields of a pit of a size [m], and those of a spall, for a ball diameter [m]."""
    around = _AROUND if on == "outer_race" else math.pi
    edge = log_uniform(rng, (_EDGE[0] * ball, _EDGE[1] * ball))
    length = log_uniform(rng, (size, max(size, _LENGTH * ball)))
    pit = {"width": size, "angle": -0.5 * math.pi + float(rng.uniform(-around, around))}
    spall = pit | {"edge_radius": edge}
    return pit, spall if on == "ball" else spall | {"length": length}


def is_small(scene: Scene, name: str) -> bool:
    """Return whether a pit or a dent is smaller than its contact: a scene with one that is not is refused."""
    try:
        equilibrium(scene)
    except SceneError as error:
        if error.path == f"defects.{name}.width":
            return False
        raise
    return True


def log_uniform(rng: np.random.Generator, ends: tuple[float, float]) -> float:
    """Draw a number whose logarithm is even."""
    return math.exp(rng.uniform(math.log(ends[0]), math.log(ends[1])))
