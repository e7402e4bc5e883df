"""The cases of a recipe: scenes, and rows of a table with what differs between bearings."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import defects
from ..bearings import bearing
from ..scene import SeatProbe, StructureProbe, Texture, Unbalance
from .drawn import (
    fault_fields,
    is_small,
    log_uniform,
    slip_fields,
    structure_fields,
    texture_fields,
    unbalance,
)
from .recipe import SURFACES, Recipe, ends_of

if TYPE_CHECKING:
    from ..scene import Defect, Scene, Spin, Surface

LABELS = ("bearing_id", "part", "shape", "size_mm")
"""Columns of the table that are no fields of a scene; ``shape`` is ``none``, ``pit`` or ``spall``."""


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
        if recipe.balance_grade is not None:
            healthy = replace(healthy, unbalances={"rotor": Unbalance(ring="inner", moment=0.0)})
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
        return self.rows(kind, number, 1)[0]

    def rows(self, kind: str | None, number: int, count: int) -> list[dict[str, Any]]:
        """Return rows of a bearing with one fault under several loads and speeds, the first as of `row`."""
        place = 0 if kind is None else 1 + list(SURFACES).index(kind)
        rng = np.random.default_rng([self.seed, 1, place, number])
        part = "healthy" if kind is None else SURFACES[kind]
        first = self._operation(rng)
        later = np.random.default_rng([self.seed, 2, place, number])
        own = self._bearing(number)
        each = [own | first, *(own | self._operation(later) for _ in range(count - 1))]
        if kind == "ball" and self.recipe.surfaces == "as_made":
            # Its texture is around one axis, about which such a ball does not turn.
            for row in each:
                row["rows[0].texture.ball"] = 0.0
        size, scene, shape = 0.0, "healthy", "none"
        fault: dict[str, Any] = {}
        if kind is not None:
            size = log_uniform(rng, self.recipe.faults[kind])
            shape, fault = self._fault(SURFACES[kind], 1e-3 * size, each, rng)
            scene = f"{part}.{shape}"
        labels = dict(zip(LABELS, (number, part, shape, size), strict=True))
        return [labels | {"scene": scene} | row | fault for row in each]

    def _bearing(self, number: int) -> dict[str, Any]:
        """Return what a bearing has of its own, and what it sits in."""
        recipe, rng = self.recipe, np.random.default_rng([self.seed, 0, number])
        own: dict[str, Any] = {"rows[0].start_angle": float(rng.uniform(0.0, 2.0 * math.pi))}
        structure = self.scenes["healthy"].structure
        assert structure is not None
        own |= structure_fields(structure, rng)
        if recipe.clearances is not None:
            own["rows[0].clearance"] = float(rng.uniform(*recipe.clearances))
        if recipe.slip is not None:
            slip = log_uniform(rng, ends_of(recipe.slip))
            own |= slip_fields(recipe.made, slip, rng)
        return own | (texture_fields(recipe.made, rng) if recipe.surfaces == "as_made" else {})

    def _operation(self, rng: np.random.Generator) -> dict[str, Any]:
        """Return speed and loads of a case."""
        recipe = self.recipe
        drawn = {
            "drive.speed": float(rng.uniform(*recipe.speed)) * math.pi / 30.0,
            "loads.radial.force": float(rng.uniform(*recipe.radial)),
            "loads.axial.force": float(rng.uniform(*recipe.axial)),
        }
        if recipe.balance_grade is None:
            return drawn
        grade, load = log_uniform(rng, ends_of(recipe.balance_grade)), drawn["loads.radial.force"]
        rotor = unbalance(load, drawn["drive.speed"], grade, rng)
        return drawn | {
            f"unbalances.rotor.{name}": getattr(rotor, name) for name in ("moment", "angle")
        }

    def _fault(
        self, on: Surface, size: float, rows: list[dict[str, Any]], rng: np.random.Generator
    ) -> tuple[str, dict[str, Any]]:
        """Return the shape of a fault of a size [m] and its fields: a pit if always smaller than its contact."""
        pit, spall = map(_named, fault_fields(on, size, self.recipe.made.ball_diameter, rng))
        scene = self.scenes[f"{on}.pit"]
        is_pit = all(is_small(scene.replace(row | pit), "fault") for row in rows)
        return ("pit", pit) if is_pit else ("spall", spall)


def _shapes(on: Surface, ball: float) -> dict[str, Defect]:
    """Return a pit and a spall of a surface, whose sizes the rows set, for a ball diameter [mm]."""
    width = 0.1 * ball
    wide = defects.cap(width_mm=width) if on == "ball" else defects.spall(on=on, width_mm=width)
    return {"pit": defects.pit(on=on, diameter_mm=0.01 * ball), "spall": wide}


def _named(fault: dict[str, float]) -> dict[str, Any]:
    return {f"defects.fault.{name}": value for name, value in fault.items()}
