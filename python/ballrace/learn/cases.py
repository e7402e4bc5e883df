"""The cases of a recipe: scenes, and rows of a table with what differs between bearings."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import defects
from ..bearings import bearing
from ..errors import SceneError
from ..scene import SeatProbe, StructureProbe, Texture
from ..statics import equilibrium
from .recipe import SURFACES, Recipe, ends_of

if TYPE_CHECKING:
    from ..scene import Defect, Scene, Spin, Surface

__all__ = ["LABELS", "Drawing"]

LABELS = ("bearing_id", "part", "shape", "size_mm")
"""Columns of the table that are no fields of a scene; ``shape`` is ``none``, ``pit`` or ``spall``."""

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
"""How far from the middle of the load zone a fault of the outer race may lie [rad]."""

_MASS = (0.5, 4.0)
"""Masses of the machine over those of a pedestal."""
_FREQUENCY, _APART = (0.6, 1.6), (0.8, 1.25)
"""Natural frequencies over those of a pedestal, all together and each by itself."""
_DAMPING = (0.01, 0.1)
"""Damping ratio of a mode."""


@dataclass(frozen=True)
class Drawing:
    """A recipe, and the seed that its cases are drawn from."""

    recipe: Recipe
    seed: int

    @cached_property
    def scenes(self) -> dict[str, Scene]:
        """Scenes that rows of the table choose from: ``healthy``, ``outer_race.pit`` and so on."""
        recipe = self.recipe
        rough = Texture(outer=1e-9, inner=1e-9)
        healthy = bearing(
            recipe.bearing,
            radial_load=recipe.radial[0],
            axial_load=recipe.axial[0],
            speed_rpm=recipe.speed[1],
            clearance=None if recipe.clearance == "scatter" else recipe.clearance,
            texture=rough if recipe.surfaces == "as_made" else None,
        )
        healthy = replace(healthy, probes={"housing": StructureProbe(), "seat": SeatProbe()})
        found = {"healthy": healthy}
        for kind in recipe.faults:
            for shape, defect in _shapes(SURFACES[kind], 1e3 * recipe.made.ball_diameter).items():
                # A ball that turns about one axis alone brings its fault round far too regularly.
                spin: Spin | None = "free" if kind == "ball" else healthy.spin
                found[f"{SURFACES[kind]}.{shape}"] = replace(
                    healthy, defects={"fault": defect}, spin=spin
                )
        return found

    def row(self, kind: str | None, number: int) -> dict[str, Any]:
        """Return a row of the table: a bearing by its number, with a fault of a kind, or None.

        The bearing of a number is the same for all kinds; its load, its speed and its fault are not.
        """
        place = 0 if kind is None else 1 + list(SURFACES).index(kind)
        rng = np.random.default_rng([self.seed, 1, place, number])
        part = "healthy" if kind is None else SURFACES[kind]
        own = self._bearing(number) | self._operation(rng)
        if kind == "ball" and self.recipe.surfaces == "as_made":
            # Its texture is around one axis, about which such a ball does not turn.
            own["rows[0].texture.ball"] = 0.0
        size, scene, shape = 0.0, "healthy", "none"
        fault: dict[str, Any] = {}
        if kind is not None:
            size = _log(rng, self.recipe.faults[kind])
            shape, fault = self._fault(SURFACES[kind], 1e-3 * size, own, rng)
            scene = f"{part}.{shape}"
        labels = dict(zip(LABELS, (number, part, shape, size), strict=True))
        return labels | {"scene": scene} | own | fault

    def _bearing(self, number: int) -> dict[str, Any]:
        """Return what a bearing has of its own, and what it sits in."""
        recipe, rng = self.recipe, np.random.default_rng([self.seed, 0, number])
        own: dict[str, Any] = {"rows[0].start_angle": float(rng.uniform(0.0, 2.0 * math.pi))}
        own |= self._structure(rng)
        if recipe.clearances is not None:
            own["rows[0].clearance"] = float(rng.uniform(*recipe.clearances))
        if recipe.slip is not None:
            slip = _log(rng, ends_of(recipe.slip))
            unlike = slip / _SLIP_BY_BALLS * rng.standard_normal(recipe.made.ball_count)
            scale = recipe.made.ball_diameter / _BALL_OF_6205 * max(1.0, slip / _PLAIN_SLIP)
            own["rows[0].diameter_errors"] = unlike.tolist()
            own["cage.ring.pocket_clearance"] = 0.5 * scale * float(rng.uniform(*_PLAY))
        return own | (self._texture(rng) if recipe.surfaces == "as_made" else {})

    def _structure(self, rng: np.random.Generator) -> dict[str, Any]:
        """Return the machine that it stands on: a pedestal with other masses, frequencies and dampings."""
        structure = self.scenes["healthy"].structure
        assert structure is not None
        mass, frequency = _log(rng, _MASS), _log(rng, _FREQUENCY)
        drawn: dict[str, Any] = {}
        for k, mode in enumerate(structure.modes):
            own = {
                "frequency": mode.frequency * frequency * _log(rng, _APART),
                "damping": _log(rng, _DAMPING),
                "mass": mode.mass * mass,
            }
            drawn |= {f"structure.modes[{k}].{name}": value for name, value in own.items()}
        return drawn

    def _texture(self, rng: np.random.Generator) -> dict[str, Any]:
        made, slope = self.recipe.made, float(rng.uniform(*_SLOPE))
        ends = (_AMPLITUDE[0], min(_AMPLITUDE[1], _OVAL / 15.0**slope))
        outer, inner = _log(rng, ends), _log(rng, ends)
        as_good = math.sqrt(outer * inner) * (made.ball_diameter / made.pitch_diameter) ** slope
        drawn = {"outer": outer, "inner": inner, "ball": as_good * _log(rng, _BALL_TEXTURE)}
        drawn |= {"slope": slope, "seed": int(rng.integers(2**53))}
        return {f"rows[0].texture.{name}": value for name, value in drawn.items()}

    def _operation(self, rng: np.random.Generator) -> dict[str, Any]:
        """Return speed and loads of a case."""
        return {
            "drive.speed": float(rng.uniform(*self.recipe.speed)) * math.pi / 30.0,
            "loads.radial.force": float(rng.uniform(*self.recipe.radial)),
            "loads.axial.force": float(rng.uniform(*self.recipe.axial)),
        }

    def _fault(
        self, on: Surface, size: float, own: dict[str, Any], rng: np.random.Generator
    ) -> tuple[str, dict[str, Any]]:
        """Return the shape of a fault of a size [m] and its fields: a pit if smaller than its contact."""
        around = _AROUND if on == "outer_race" else math.pi
        ball = self.recipe.made.ball_diameter
        edge = _log(rng, (_EDGE[0] * ball, _EDGE[1] * ball))
        length = _log(rng, (size, max(size, _LENGTH * ball)))
        fault = {"width": size, "angle": -0.5 * math.pi + float(rng.uniform(-around, around))}
        pit, spall = _named(fault), _named(fault | {"edge_radius": edge})
        if on != "ball":
            spall |= _named({"length": length})
        is_pit = _is_small(self.scenes[f"{on}.pit"].replace(own | pit))
        return ("pit", pit) if is_pit else ("spall", spall)


def _shapes(on: Surface, ball: float) -> dict[str, Defect]:
    """Return a pit and a spall of a surface, whose sizes the rows set, for a ball diameter [mm]."""
    width = 0.1 * ball
    wide = defects.cap(width_mm=width) if on == "ball" else defects.spall(on=on, width_mm=width)
    return {"pit": defects.pit(on=on, diameter_mm=0.01 * ball), "spall": wide}


def _named(fault: dict[str, float]) -> dict[str, Any]:
    return {f"defects.fault.{name}": value for name, value in fault.items()}


def _is_small(scene: Scene) -> bool:
    """Whether a pit is smaller than its contact, which a scene with one that is not refuses."""
    try:
        equilibrium(scene)
    except SceneError as error:
        if error.path == "defects.fault.width":
            return False
        raise
    return True


def _log(rng: np.random.Generator, ends: tuple[float, float]) -> float:
    """Draw a number whose logarithm is even."""
    return math.exp(rng.uniform(math.log(ends[0]), math.log(ends[1])))
