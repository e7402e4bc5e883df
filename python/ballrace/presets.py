"""Ready-made scenes; ``ballrace scene NAME`` prints one as TOML.

The reason for every number stands in the Rust module ``scene::presets``, or with the preset.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal, get_args

from . import _core
from ._base.numbers import finite
from .errors import SceneError
from .scene import Lubricant, Scene
from .scene.lubricant import chosen

__all__ = [
    "angular_contact_pair",
    "cornering_wheel",
    "deep_groove_6205",
    "motor",
    "names",
    "wheel_bearing",
]


Arrangement = Literal["back_to_back", "face_to_face"]
"""How two rows of angular contact face each other."""


Damping = Literal["heavy", "light"]
"""Damping of the wheel bearing, of which the paper gives nothing."""


def wheel_bearing(
    axial_load: float = 0.0,
    *,
    damping: Damping = "heavy",
    lubricant: str | Lubricant | None = None,
    temperature_c: float | None = None,
) -> Scene:
    """Return the paper's double-row wheel bearing with a defect on the outer ring.

    Two rows of 13 balls under 7 kN radial load, the inner ring at 30 Hz, outer ring defect at -90°.

    Parameters
    ----------
    axial_load : float
        Axial load along +z on the inner ring [N]; the paper has 0, +3000 and -3000.
    damping : str
        Of what the paper does not give, one of two sets identified from its results. ``"heavy"`` settles within
        milliseconds, and impacts are regular at -3 kN, too. ``"light"`` has clearance, and they vary there as in
        the paper's figure 11; ``ballrace paper`` has this one.
    lubricant : str or Lubricant, optional
        Oil by its name (:func:`ballrace.lubricants`) or its numbers; by default none, as in the paper.
    temperature_c : float, optional
        Temperature of an oil by name where it enters the contacts [°C].

    Raises
    ------
    SceneError
        An argument is not usable, or a named oil has no temperature.
    """
    allowed = get_args(Damping)
    if damping not in allowed:
        raise SceneError("damping", repr(damping), " or ".join(map(repr, allowed)))
    oil = chosen(lubricant, temperature_c)
    heavy = _lubricated(_core.preset_wheel_bearing(finite("axial_load", axial_load, "N")), oil)
    return heavy if damping == "heavy" else heavy.replace(_LIGHT)


# Identified with `benches/identify_paper.py`: loose enough for the lightly loaded row to rattle at -3 kN. A
# light ring on a soft support makes impacts strong beside what the cold start leaves. The balls begin so that
# one stands at -90° at t = 0.017992 s, as in the paper's figure 9.
_LIGHT: dict[str, object] = {
    "name": "wheel bearing, lightly damped",
    "outer_ring.mass": 0.62,
    "inner_ring.mass": 0.42,
    "contact.damping": 0.0,
    "friction.coulomb.coefficient": 0.037,
    "friction.coulomb.slip_speed": 0.065,
    "cage.stiffness": 1.5e4,
    "cage.damping": 31.0,
    "defects.spall.axial_offset": 2.7e-3,
    **{f"outer_ring.support.{axis}.spring.stiffness": 7e8 for axis in "xyz"},
    **{f"outer_ring.support.{axis}.spring.damping": 440.0 for axis in "xyz"},
    **{f"inner_ring.support.{axis}.spring.damping": 320.0 for axis in "xyz"},
    **{f"rows[{r}].pitch_diameter": 64e-3 for r in range(2)},
    **{f"rows[{r}].contact_angle": math.radians(15.55) for r in range(2)},
    **{f"rows[{r}].outer_conformity": 0.5223 for r in range(2)},
    **{f"rows[{r}].inner_conformity": 0.5159 for r in range(2)},
    **{f"rows[{r}].clearance": 42e-6 for r in range(2)},
    "rows[0].start_angle": -2.00766,
    "rows[1].start_angle": -2.00766 + math.pi / 13.0,
}


def cornering_wheel(lateral: float = 0.3) -> Scene:
    """Return the wheel bearing in a curve, loaded where the road meets the tyre; its inner ring tilts.

    The road acts 0.3 m from the axis with 7 kN and a side force along +z. Balls spin about any axis where that
    matters: with their axis held they would go round 1.6 % slower at 0.3.

    Parameters
    ----------
    lateral : float
        Side force over the wheel's load: 0.3 is a fast curve, 0.6 one near the limit of many tyres.

    Raises
    ------
    SceneError
        An argument is not usable.
    """
    from .bearings.filled import with_spin

    made = Scene.from_json(_core.preset_cornering_wheel(finite("lateral", lateral, "1")))
    return with_spin(made)


def angular_contact_pair(
    radial_load: float = 500.0,
    axial_load: float = 300.0,
    speed_rpm: float = 2900.0,
    *,
    arrangement: Arrangement = "back_to_back",
) -> Scene:
    """Return two angular-contact bearings 7205B on a pump's shaft, lightly preloaded; the shaft tilts.

    Parameters
    ----------
    radial_load : float
        Load on the impeller along -y, 60 mm before the middle of the pair towards -z [N].
    axial_load : float
        Load on the shaft along +z [N].
    speed_rpm : float
        Speed of the shaft [1/min].
    arrangement : str
        ``"back_to_back"``, stiff against tilting, or ``"face_to_face"``, compliant with a tilted shaft.

    Raises
    ------
    SceneError
        An argument is not usable.
    """
    allowed = get_args(Arrangement)
    if arrangement not in allowed:
        raise SceneError("arrangement", repr(arrangement), " or ".join(map(repr, allowed)))
    return Scene.from_json(
        _core.preset_angular_contact_pair(
            arrangement == "face_to_face",
            finite("radial_load", radial_load, "N"),
            finite("axial_load", axial_load, "N"),
            finite("speed_rpm", speed_rpm, "1/min"),
        )
    )


def deep_groove_6205(
    radial_load: float = 500.0,
    axial_load: float = 0.0,
    speed_rpm: float = 1800.0,
    *,
    lubricant: str | Lubricant | None = None,
    temperature_c: float | None = None,
) -> Scene:
    """Return a healthy deep-groove ball bearing 6205.

    Parameters
    ----------
    radial_load, axial_load : float
        Loads on the inner ring along -y and +z [N].
    speed_rpm : float
        Speed of the inner ring [1/min].
    lubricant : str or Lubricant, optional
        Oil by its name (:func:`ballrace.lubricants`) or its numbers; by default the contacts are dry.
    temperature_c : float, optional
        Temperature of an oil by name where it enters the contacts [°C].

    Raises
    ------
    SceneError
        An argument is not usable, or a named oil has no temperature.
    """
    oil = chosen(lubricant, temperature_c)
    radial, axial = finite("radial_load", radial_load, "N"), finite("axial_load", axial_load, "N")
    speed = finite("speed_rpm", speed_rpm, "1/min")
    return _lubricated(_core.preset_deep_groove_6205(radial, axial, speed), oil)


def motor(belt_pull: float = 900.0, speed_rpm: float = 1480.0) -> Scene:
    """Return an electric motor of some 11 kW with a belt: a rotor on a 6309 and a 6207, both C3.

    The rotor's disc of 25 kg is midway between the bearings, 0.25 m apart, and is unbalanced by 160 g mm, which is
    G 1 of ISO 21940-11 at 1480 1/min; the belt pulls down 80 mm outside of the 6309. Sizes are chosen, not those
    of one motor.

    Parameters
    ----------
    belt_pull : float
        Force of both strands on the pulley [N], above 0.
    speed_rpm : float
        Speed of the rotor [1/min].

    Raises
    ------
    SceneError
        An argument is not usable.
    """
    from .machines import belt, shaft

    return shaft(
        [("6309/C3", 0.0), ("6207/C3", 0.25)],
        speed_rpm=finite("speed_rpm", speed_rpm, "1/min"),
        masses=[(25.0, 0.125, 0.15)],
        unbalances=[(160e-6, 0.125)],
        loads={"belt": belt(belt_pull, at=-0.08)},
    )


def names() -> tuple[str, ...]:
    """Return the names of the presets."""
    return ("wheel_bearing", "cornering_wheel", "angular_contact_pair", "deep_groove_6205", "motor")


def _lubricated(document: str, lubricant: Lubricant | None) -> Scene:
    scene = Scene.from_json(document)
    return replace(scene, lubricant=lubricant).validate() if lubricant else scene
