"""Loads on a shaft at their places; angles are counter-clockwise from +x, seen from +z."""

from __future__ import annotations

import math

from .._base.numbers import finite, positive, real
from ..errors import SceneError
from ..scene import Load


def force(x: float = 0.0, y: float = 0.0, z: float = 0.0, *, at: float) -> Load:
    """Return a force on a shaft's axis, such as of an overhung impeller.

    Parameters
    ----------
    x, y, z : float
        Its parts [N], not all 0.
    at : float
        Axial place [m].

    Raises
    ------
    SceneError
        A number is not usable.
    """
    parts = tuple(finite(name, each, "N") for name, each in (("x", x), ("y", y), ("z", z)))
    size = math.hypot(*parts)
    if not size > 0.0:
        raise SceneError("force", repr(parts), "a force that is not 0 [N]")
    direction = (parts[0] / size, parts[1] / size, parts[2] / size)
    return Load(ring="inner", direction=direction, force=size, at=(0.0, 0.0, finite("at", at, "m")))


def belt(pull: float, *, at: float, angle: float = -0.5 * math.pi) -> Load:
    """Return the pull of a belt on a shaft.

    Parameters
    ----------
    pull : float
        Force of both strands on the shaft [N], above 0.
    at : float
        Axial place of the pulley's middle [m].
    angle : float
        Direction of the pull [rad]; by default down.

    Raises
    ------
    SceneError
        A number is not usable.

    Examples
    --------
    >>> round(belt(800.0, at=-0.08).force)
    800
    """
    size, towards = positive("pull", pull, "N"), finite("angle", angle, "rad")
    return force(size * math.cos(towards), size * math.sin(towards), at=at)


def gear(
    torque: float,
    pitch_diameter: float,
    *,
    at: float,
    angle: float = 0.0,
    pressure_angle: float = math.radians(20.0),
    helix_angle: float = 0.0,
) -> Load:
    """Return the force of a gear's mesh on its shaft: tangential, separating, and axial where teeth are helical.

    ``F_t = 2 T/d``, ``F_r = F_t tan α_n/cos β``, ``F_a = F_t tan β`` (ISO 6336-1 has the same).

    Parameters
    ----------
    torque : float
        Torque that the mesh puts on the shaft about z [N m], of either sign, not 0.
    pitch_diameter : float
        Pitch diameter of the gear on the shaft [m].
    at : float
        Axial place of the middle of its width [m].
    angle : float
        Direction from the shaft's axis to the mesh [rad].
    pressure_angle : float
        Normal pressure angle α_n [rad].
    helix_angle : float
        Helix angle β [rad]; above 0: the axial force is along +z.

    Raises
    ------
    SceneError
        A number is not usable.

    Examples
    --------
    >>> mesh = gear(50.0, 0.1, at=0.12)
    >>> round(mesh.force)  # 2 · 50/0.1 over cos 20°
    1064
    """
    turning = finite("torque", torque, "N m")
    if turning == 0.0:
        raise SceneError("torque", repr(torque), "a torque that is not 0 [N m]")
    diameter, met = positive("pitch_diameter", pitch_diameter, "m"), finite("angle", angle, "rad")
    pressed = _within("pressure_angle", pressure_angle, 0.0, math.radians(45.0))
    helix = _within("helix_angle", helix_angle, -math.radians(60.0), math.radians(60.0))
    tangential = 2.0 * turning / diameter
    apart = abs(tangential) * math.tan(pressed) / math.cos(helix)
    x = -apart * math.cos(met) - tangential * math.sin(met)
    y = -apart * math.sin(met) + tangential * math.cos(met)
    whole = force(x, y, abs(tangential) * math.tan(helix), at=at)
    radius = 0.5 * diameter
    return Load(
        ring="inner",
        direction=whole.direction,
        force=whole.force,
        at=(radius * math.cos(met), radius * math.sin(met), finite("at", at, "m")),
    )


def _within(name: str, value: float, least: float, most: float) -> float:
    if not least <= real(value) <= most:
        raise SceneError(name, repr(value), f"an angle from {least:.3g} to {most:.3g} rad")
    return float(value)
