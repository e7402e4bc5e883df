"""A scene of a bearing of the catalogue, with reasonable defaults for all but its name and load."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

from .._base.arguments import knows
from .._base.numbers import finite, positive
from ..errors import SceneError
from ..scene import Defect, Load, Lubricant, Ring, Row, Scene, Spring, Structure, Support, Texture
from .clearance import radial_clearance
from .entry import Bearing
from .filled import filled
from .pedestal import chosen_housing
from .rows import catalogue

_HALF_THE_BALLS = 1.22
"""Thrust over Fr tan α with which half of the balls carry (Sjövall's integrals at ε = 0.5)."""

_OF_6205 = (52e-3**2 - 39.04e-3**2) * 15e-3
"""Metal of the outer ring of a 6205, but for a factor [m³]."""

SEAT_STIFFNESS, SEAT_DAMPING = 1e8, 300.0
"""Spring and damper between the outer ring of a 6205 and its seat [N/m, N s/m]."""

OUTER_RING = 0.064
"""Mass of the outer ring of a 6205 [kg]."""

_ROW_DISTANCE = 1.08
"""Distance of two rows over the ball diameter: 1.03 to 1.18, by the load centres that NSK prints of 52 and 53."""

_SPEED = "speed_rpm, the speed of the inner ring [1/min]"
OUTER = dict.fromkeys(
    ("outer_speed", "outer_speed_rpm"), "outer_rpm, the speed of the outer ring [1/min]"
)
_SIZE = (
    'a designation or a Bearing as the first argument, such as br.bearing("6205"); br.catalogue.find(bore=25e-3) '
    "looks by size [m]"
)
_LOADS = "radial_load and axial_load [N]"
_MEANT = {
    **dict.fromkeys(("speed", "rpm", "n", "speed_hz"), _SPEED),
    **OUTER,
    **dict.fromkeys(("d", "D", "B", "bore", "outside_diameter", "width", "ball_count"), _SIZE),
    **dict.fromkeys(("load", "force", "Fr", "Fa"), _LOADS),
}
"""Advice on what to write instead of arguments that there are not."""


@knows(_MEANT)
def bearing(
    name: str | Bearing,
    *,
    radial_load: float | None = None,
    axial_load: float | None = None,
    speed_rpm: float | None = None,
    outer_rpm: float | None = None,
    clearance: str | float | None = None,
    defects: Defect | Mapping[str, Defect] | None = None,
    lubricant: str | Lubricant | None = None,
    temperature_c: float | None = None,
    housing: Literal["pedestal"] | Structure | None = "pedestal",
    texture: Texture | None = None,
) -> Scene:
    """Return a scene of a bearing of the catalogue, ready to run.

    The scene has Hertz's law, Coulomb friction, a squeeze film of grease, a steel cage with pockets, balls that
    spin about any axis where that changes orbit speed or a load at rest by more than 0.2 % (else about the
    bearing's), the inner ring on a shaft (1 kg in a 6205, damped, held by the balls only), the outer ring on a
    stiff spring on the seat of a pedestal that vibrates, and probes of the motion of both rings, of the pedestal's
    sensor (``housing.sensor.ay``) and of the force on its seat. All of this can be changed by
    :meth:`ballrace.Scene.replace`.

    Parameters
    ----------
    name : str or Bearing
        Name as on the box, such as ``"6205"``, ``"SKF 6205-2RSH/C3"`` or ``"7205B"``, or a bearing by
        :meth:`Bearing.from_dimensions`.
    radial_load : float, optional
        Load on the inner ring along -y [N]; by default a tenth of the static load rating, which the scene shows.
    axial_load : float, optional
        Load on the inner ring along +z [N]. Deep groove bearings take either sign; by default 0. An angular
        contact bearing takes it towards +z only, and has to have more than ``radial_load * tan(contact_angle)``;
        by default 1.22 times that, the thrust under which half of its balls carry load, as from an opposed
        bearing. A double row bearing, back to back without play and preload, takes either sign; by default 0.
    speed_rpm : float, optional
        Speed of the inner ring [1/min]; may be left out only where the outer ring turns, and is then 0.
    outer_rpm : float, optional
        Speed of the outer ring with its seat [1/min], as in hubs, idlers and planets; by default it stands. Its
        defects, waviness and texture turn with it, loads and gravity do not.
    clearance : {"C2", "CN", "C3", "C4", "C5"} or float, optional
        For deep groove bearings: the middle of a class of ISO 5753-1, or a diametral clearance [m]; by default the
        class in the name (``"6205-2RS/C3"``), else CN. Fits are not subtracted. In angular contact bearings the
        clearance follows from the contact angle, whatever class is in their name.
    defects : Defect, or mapping of str to Defect
        Defects, as :mod:`ballrace.defects` makes them; a single one is named ``defect``.
    lubricant : str or Lubricant, optional
        Oil by its name (:func:`ballrace.lubricants`) or its numbers; by default friction is dry.
    temperature_c : float, optional
        Temperature of an oil by name where it enters the contacts [°C].
    housing : {"pedestal"}, Structure or None
        What the outer ring stands on, by a spring of 100 N/µm in a 6205. ``"pedestal"``: a casting on bolts and a
        plate, with ten modes from 0.7 to 12 kHz in a 6205 after measured spectra, and an accelerometer on top, the
        column ``housing.sensor.ay``. Its masses grow with the cube of the outside diameter, and its walls'
        frequencies fall with it, an assumption; levels are orders of magnitude. A
        :class:`ballrace.Structure`: another machine, by its modes. None: the spring ends on the ground (near
        5 kHz, damped at 5 %, whatever the size), as in :func:`ballrace.presets.deep_groove_6205`.
    texture : Texture, optional
        Texture of races and balls; by default they are smooth.

    Raises
    ------
    SceneError
        The name is not known (the message says what it is, or suggests similar ones), it is a thrust bearing, an
        argument is not usable, no ring has a speed, or a named oil has no temperature.

    Warns
    -----
    SceneWarning
        The name has marks that are not known, or that mean other balls.

    Examples
    --------
    >>> import ballrace as br
    >>> scene = br.bearing("6205", radial_load=500.0, speed_rpm=1797.0,
    ...                    defects=br.defects.spall(on="inner_race", width_mm=0.5))
    >>> eq = br.equilibrium(scene)
    >>> out = br.simulate(scene, duration=0.002)
    """
    made = name if isinstance(name, Bearing) else catalogue[name]
    smooth = rows_of(made, asked_clearance(name, made, clearance))
    rows = tuple(replace(row, texture=texture) for row in smooth)
    if radial_load is None:
        radial_load = 0.1 * made.static_rating
    radial = positive("radial_load", radial_load, "N", zero=True)
    axial = _thrust(made, radial, axial_load)
    size = metal(made)
    around = chosen_housing(housing, made.outside_diameter)
    return filled(
        name=made.designation,
        rows=rows,
        outer_ring=_ring(made.outside_diameter, made, SEAT_STIFFNESS * size, SEAT_DAMPING * size),
        structure=around,
        # With 1 kg of shaft in a 6205, damped by its surroundings.
        inner_ring=_ring(made.bore, made, 0.0, 300.0 * size, mass=1.0 * size),
        loads={
            "radial": Load(ring="inner", direction=(0.0, -1.0, 0.0), force=radial),
            "axial": Load(ring="inner", direction=(0.0, 0.0, 1.0), force=axial),
        },
        speed_rpm=speed_rpm,
        outer_rpm=outer_rpm,
        defects=defects,
        lubricant=lubricant,
        temperature_c=temperature_c,
    )


def rows_of(made: Bearing, clearance: str | float) -> tuple[Row, ...]:
    """Return the row of a bearing at z = 0, or its two about it, the first of which takes thrust towards +z.

    Parameters
    ----------
    made : Bearing
        The bearing, none of thrust.
    clearance : str or float
        Class of ISO 5753-1 or diametral clearance [m]; ``"CN"`` where it follows from the contact angle.
    """
    if made.kind == "thrust":
        allowed = "a radial bearing: contact angles of scenes end at 80°; br.catalogue has its fault frequencies"
        raise SceneError("name", repr(made.designation), allowed)
    if made.kind != "deep_groove" and clearance != "CN":
        allowed = "absent, since the clearance of an angular contact bearing follows from its contact angle"
        raise SceneError("clearance", repr(clearance), allowed)
    single = Row(
        ball_count=made.ball_count,
        ball_diameter=made.ball_diameter,
        pitch_diameter=made.pitch_diameter,
        outer_conformity=made.outer_conformity,
        inner_conformity=made.inner_conformity,
        contact_angle=made.contact_angle,
        clearance=radial_clearance(made.bore, clearance) if made.kind == "deep_groove" else 0.0,
        # A ball on the load line at the start.
        start_angle=-math.pi / 2.0,
    )
    if made.row_count == 1:
        return (single,)
    aside = 0.5 * _ROW_DISTANCE * made.ball_diameter
    return replace(single, axial_position=-aside), replace(single, side=-1, axial_position=aside)


def asked_clearance(
    name: str | Bearing, made: Bearing, clearance: str | float | None = None
) -> str | float:
    """Return the clearance that was asked for, by the name of a bearing or as an argument."""
    named = isinstance(name, str) and made.kind == "deep_groove"
    designated = catalogue.read(str(name)).clearance if named else None
    if designated and clearance not in (None, designated):
        raise SceneError("clearance", repr(clearance), f"{designated!r}, as in {name!r}, or absent")
    return designated or ("CN" if clearance is None else clearance)


def metal(made: Bearing) -> float:
    """Return the metal of the outer ring of a bearing, over that of a 6205."""
    return (made.outside_diameter**2 - made.pitch_diameter**2) * made.width / _OF_6205


def _ring(
    diameter: float, made: Bearing, stiffness: float, damping: float, mass: float | None = None
) -> Ring:
    held = Spring(stiffness=stiffness, damping=damping)
    support = Support(x=held, y=held, z=held)
    return Ring(mass=mass, diameter=diameter, width=made.width, support=support)


def _thrust(made: Bearing, radial: float, axial: float | None) -> float:
    """Return the axial load, which an angular contact bearing needs to hold together."""
    single = made.kind == "angular_contact"
    least = radial * math.tan(made.contact_angle) if single else 0.0
    if axial is None:
        return _HALF_THE_BALLS * least
    axial = finite("axial_load", axial, "N")
    if single and not (axial > least or axial == radial == 0.0):
        allowed = (
            f"above {least:.4g} N towards +z, radial_load * tan(contact angle): with less the rings of a "
            f"{made.designation} come apart; left out, it is the thrust under which half of the balls carry load"
        )
        raise SceneError("axial_load", f"{axial:g}", allowed)
    return axial
