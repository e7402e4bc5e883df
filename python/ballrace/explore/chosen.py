"""The bearing to begin with: by the name on its box, by its size, or from a file."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

from ..bearings import Bearing, bearing
from ..presets import names as presets

if TYPE_CHECKING:
    from pathlib import Path

    from ..bearings.entry import Kind
    from ..scene import Scene

Housing = Literal["pedestal", "bare ring"]
_SPEED = 1800.0
"""Speed at which the slider begins [1/min]."""


def named(name: str, housing: Housing = "pedestal") -> Scene:
    """Return a scene by what stands on the box, such as ``6205-2RSH/C3``, or by the name of a preset.

    Raises
    ------
    SceneError
        The name is not known, or not of a radial ball bearing.
    """
    from .. import presets as made

    plain = name.strip().replace("-", "_")
    if plain in presets():
        ready: Scene = getattr(made, plain)()
        return ready
    return bearing(name.strip(), speed_rpm=_SPEED, housing=_housing(housing))


def described(
    bore_mm: float,
    outside_mm: float,
    width_mm: float,
    *,
    kind: Kind = "deep_groove",
    contact_angle_deg: float | None = None,
    ball_count: int | None = None,
    ball_diameter_mm: float | None = None,
    housing: Housing = "pedestal",
) -> tuple[Scene, Bearing]:
    """Return a scene by boundary dimensions, and the bearing that was worked out from them.

    Number and diameter of the balls are estimated unless they are given.

    Raises
    ------
    SceneError
        A number is not usable.
    """
    angle = None if contact_angle_deg is None else math.radians(contact_angle_deg)
    made = Bearing.from_dimensions(
        1e-3 * bore_mm, 1e-3 * outside_mm, 1e-3 * width_mm, kind=kind, contact_angle=angle
    )
    if ball_count is not None:
        made = replace(made, ball_count=ball_count)
    if ball_diameter_mm is not None:
        made = replace(made, ball_diameter=1e-3 * ball_diameter_mm)
    return bearing(made, speed_rpm=_SPEED, housing=_housing(housing)), made


def read_file(path: Path) -> Scene | None:
    """Return the scene of a file; None of a record, whatever its format.

    Raises
    ------
    SceneError
        It is no usable scene.
    OSError
        It cannot be read.
    """
    from ..scene import Scene

    return Scene.load(path) if path.suffix.lower() in (".toml", ".json") else None


def summary(scene: Scene, made: Bearing | None = None) -> str:
    """Return what a scene's balls are, and how far an estimate of them may be off."""
    rows = (
        f"{row.ball_count} balls of {1e3 * row.ball_diameter:.2f} mm on {1e3 * row.pitch_diameter:.2f} mm"
        for row in scene.rows
    )
    text = f"{scene.name or 'bearing'}: {'; '.join(dict.fromkeys(rows))}"
    if made is None or made.uncertainty is None:
        return text
    off = made.uncertainty
    return f"{text}. An estimate: nine of ten are within {off.ball_count} balls and {off.orders.bpfo:.2f} of BPFO."


def _housing(name: Housing) -> Literal["pedestal"] | None:
    return "pedestal" if name == "pedestal" else None
