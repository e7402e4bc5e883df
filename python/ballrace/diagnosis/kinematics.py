"""The orders at which a bearing's faults are looked for, whatever names the bearing."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import TypeAlias

from .._base.numbers import counted, real
from ..bearings import Bearing, catalogue
from ..errors import EquilibriumError, SceneError
from ..frequencies.kinematic import Orders, of_row
from ..frequencies.operating import FaultFrequencies, rates_at_a_turn
from ..scene import Row, Scene

AnyBearing: TypeAlias = (
    "str | Bearing | Scene | Row | Orders | FaultFrequencies | Mapping[str, float]"
)
"""Name of a bearing: a designation, a bearing of the catalogue, a scene or a row of one, or its orders."""

_NEEDED = ("ftf", "bpfo", "bpfi", "bsf")

LEAST = 0.05
"""Least order that is looked for: a cage may all but stand where the rings turn in opposite ways."""

_WANTED = "a designation, a Bearing, a Scene, a Row, or orders: a mapping of ftf, bpfo, bpfi, bsf"


@dataclass(frozen=True, kw_only=True)
class Kinematics:
    """Orders of a row of balls, and its dimensions where they are known.

    Attributes
    ----------
    name : str
        What the bearing is called.
    orders : Orders
        Orders that are expected.
    row : Bearing, Row or None
        Where the dimensions stand; None where only orders were given.
    """

    name: str
    orders: Orders
    row: Bearing | Row | None = None

    def angle_at(self, bpfo: float) -> float | None:
        """Return the contact angle at which balls that roll pass at an order ``bpfo`` [rad]; None if at none."""
        if self.row is None:
            return None
        row = self.row
        cosine = (1.0 - 2.0 * bpfo / row.ball_count) * row.pitch_diameter / row.ball_diameter
        return math.acos(cosine) if 0.0 < cosine <= 1.0 else None


def kinematics_of(
    bearing: AnyBearing, row: int = 0, speeds: tuple[float, float] | None = None
) -> Kinematics:
    """Return the orders of what names a bearing.

    Parameters
    ----------
    bearing : str, Bearing, Scene, Row, Orders, FaultFrequencies or mapping
        What names it.
    row : int
        Row of balls of a scene, from 0.
    speeds : tuple of two floats, optional
        Rates of outer and inner ring with their signs [Hz]; by default those of the scene or of the orders, else
        the outer ring stands.

    Raises
    ------
    SceneError
        It names none, or has an outer ring of its own that turns where speeds are given.
    """
    if isinstance(bearing, str):
        bearing = catalogue[bearing]
    if isinstance(bearing, Scene):
        return _of_scene(bearing, row, speeds)
    found = _at_rest(bearing)
    if speeds is None:
        return found
    if found.orders.outer:
        allowed = "absent, since the orders of the bearing include how its outer ring turns"
        raise SceneError("outer_rpm", f"{60.0 * speeds[0]:g}", allowed)
    outer, inner = speeds
    return replace(found, orders=found.orders.turned(outer / (inner - outer)))


def _at_rest(bearing: AnyBearing) -> Kinematics:
    """Return the orders where no scene is given; without speeds in them the outer ring stands."""
    if isinstance(bearing, Bearing):
        return Kinematics(name=bearing.designation, orders=bearing.orders, row=bearing)
    if isinstance(bearing, Row):
        return Kinematics(name="a row of a scene", orders=of_row(bearing), row=bearing)
    if isinstance(bearing, FaultFrequencies):
        bearing = bearing.orders
    if isinstance(bearing, Mapping):
        bearing = _of_mapping(bearing)
    if not isinstance(bearing, Orders):
        raise SceneError("bearing", repr(bearing)[:60], _WANTED)
    return Kinematics(name="orders that were given", orders=_checked(bearing))


def _of_scene(scene: Scene, row: int, speeds: tuple[float, float] | None) -> Kinematics:
    of = scene.rows[counted("row", row, 0, len(scene.rows) - 1)]
    try:
        found = rates_at_a_turn(scene, row, speeds=speeds).orders
    except EquilibriumError:
        found = rates_at_a_turn(scene, row, speeds=speeds, operating=False).orders
    return Kinematics(name=scene.name or "the scene's bearing", orders=found, row=of)


def _of_mapping(given: Mapping[str, float]) -> Orders:
    if not set(_NEEDED) <= set(given) <= {field.name for field in fields(Orders)}:
        raise SceneError("bearing", repr(dict(given)), f"orders by the names {', '.join(_NEEDED)}")
    return Orders(**given)


def _checked(given: Orders) -> Orders:
    for name, order in vars(given).items():
        turns = name in ("inner", "outer") or (name == "ftf" and given.outer > 0.0)
        least = 0.0 if turns else LEAST
        if not least <= real(order) <= 100.0:
            allowed = f"an order of the shaft, {least:g} to 100"
            raise SceneError(f"bearing.{name}", repr(order), allowed)
    return given
