"""Ready-made scenes; ``ballrace scene NAME`` prints one as TOML.

The reason for every number stands in the Rust module ``scene::presets``.
"""

from __future__ import annotations

from . import _core
from .scene import Scene

__all__ = ["deep_groove_6205", "names", "wheel_bearing"]


def wheel_bearing(axial_load: float = 0.0) -> Scene:
    """Return the paper's double-row wheel bearing with a defect on the outer ring.

    Two rows of 13 balls under 7 kN radial load, the inner ring at 30 Hz, outer ring defect at -90°.

    Parameters
    ----------
    axial_load : float
        Axial load along +z on the inner ring [N]; the paper has 0, +3000 and -3000.
    """
    return Scene.from_json(_core.preset_wheel_bearing(axial_load))


def deep_groove_6205(
    radial_load: float = 500.0, axial_load: float = 0.0, speed_rpm: float = 1800.0
) -> Scene:
    """Return a healthy deep-groove ball bearing 6205.

    Parameters
    ----------
    radial_load, axial_load : float
        Loads on the inner ring along -y and +z [N].
    speed_rpm : float
        Speed of the inner ring [rev/min].
    """
    return Scene.from_json(_core.preset_deep_groove_6205(radial_load, axial_load, speed_rpm))


def names() -> tuple[str, ...]:
    """Return the names of the presets."""
    return ("wheel_bearing", "deep_groove_6205")
