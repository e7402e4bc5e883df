"""Settings of the controls, and the scene that follows from them."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Literal, get_args

from .. import defects
from ..bearings.filled import with_spin
from ..errors import SceneError
from ..scene import Component, Load, Moment, MotionProbe, Scene, SpeedDrive, Spring, Surface
from ..scene.defect import SURFACES
from ..scene.lubricant import chosen

if TYPE_CHECKING:
    from ..scene import Defect, Support

__all__ = ["DAMAGE", "SURFACES", "Settings", "outer_speed_of", "speed_of"]

Damage = Literal["none", "spall", "dent", "line", "pit"]
DAMAGE = get_args(Damage)
"""Kinds of damage, as :mod:`ballrace.defects` makes them."""

_SHOWN: dict[str, Component] = {"outer": "ay", "inner": "theta"}
"""Signals of a run that the page shows: bodies, which are names of probes as well, and their components."""

_TILT_DAMPING = 0.05
"""Damping of a tilt that a moment sets free, as of a small bearing's surroundings [N m s/rad]."""

_ABSOLUTE_ZERO = -273.15
"""0 K [°C]."""


@dataclass(frozen=True, kw_only=True)
class Settings:
    """Values of all controls. What is None the scene says otherwise than by one number, and it stays as it is.

    Attributes
    ----------
    base : Scene
        Where they began; what no control has moved stays as it is there.
    radial_load, axial_load : float or None
        Forces of the first load across and of the first along the axis [N]; None: they change in time.
    moment : float
        Moment on the inner ring about x [N m]; one that is not 0 sets the ring free to tilt.
    speed_rpm : float or None
        Speed of the inner ring [1/min]; None: it changes, or a torque drives.
    outer_rpm : float or None
        Speed of the outer ring [1/min]; None: it stands, or its speed changes.
    clearance : float or None
        Diametral clearance of all rows [m]; None: the contact angle says it.
    oil : str or None
        Oil by its name; None: dry, or as in the scene where that has one of its own.
    temperature_c : float
        Temperature of an oil by name [°C].
    damage : {"none", "spall", "dent", "line", "pit"}
        Damage beside that of the scene.
    on : {"outer_race", "inner_race", "ball"}
        Where it is.
    width_mm : float
        Its extent along the rolling direction [mm].
    angle_deg : float
        Its place, counter-clockwise from +x [°]; -90 is where a load along -y presses on the outer race.
    housing_mass : float or None
        Masses of the modes of the structure over those of the scene; None: it has no structure.
    noise : float
        Root mean square of white noise of the sensor [m/s²].
    """

    base: Scene
    radial_load: float | None = None
    axial_load: float | None = None
    moment: float = 0.0
    speed_rpm: float | None = None
    outer_rpm: float | None = None
    clearance: float | None = None
    oil: str | None = None
    temperature_c: float = 60.0
    damage: Damage = "none"
    on: Surface = "outer_race"
    width_mm: float = 1.0
    angle_deg: float = -90.0
    housing_mass: float | None = None
    noise: float = 0.0

    @classmethod
    def of(cls, scene: Scene) -> Settings:
        """Return the settings of a scene as it is."""
        oil = scene.lubricant
        temperature = cls.temperature_c if oil is None else oil.temperature + _ABSOLUTE_ZERO
        return cls(
            base=scene,
            radial_load=_force(scene, along=False),
            axial_load=_force(scene, along=True),
            speed_rpm=speed_of(scene),
            outer_rpm=outer_speed_of(scene),
            clearance=scene.rows[0].clearance if _has_clearance(scene) else None,
            oil=None if oil is None else oil.oil,
            housing_mass=None if scene.structure is None else 1.0,
            temperature_c=temperature,
        )

    def moved(self, **values: Any) -> Settings:
        """Return the settings with other values."""
        return replace(self, **values)

    def scene(self) -> Scene:
        """Return the scene, checked.

        Raises
        ------
        SceneError
            A value is not usable.
        """
        begun = Settings.of(self.base)
        names = [each.name for each in fields(self) if each.name != "base"]
        moved = {name for name in names if getattr(self, name) != getattr(begun, name)}
        changes: dict[str, Any] = {}
        for change in (_loads, _drive, _clearances, _oil, _damage, _housing):
            changes |= change(self, moved)
        if not changes or self.base.spin == "axial":
            return _recorded(self.base.replace(changes))
        # Other loads and speeds may want balls that spin about any axis, or no longer.
        return _recorded(with_spin(replace(self.base, spin=None).replace(changes)))


def _loads(of: Settings, moved: set[str]) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    for field, along in (("radial_load", False), ("axial_load", True)):
        if field in moved:
            name = _load(of.base, along=along)
            pull = (0.0, 0.0, 1.0) if along else (0.0, -1.0, 0.0)
            force = getattr(of, field)
            new = Load(ring="inner", direction=pull, force=force)
            changes |= {f"loads.{name}.force": force} if name else {f"loads.{field}": new}
    if of.moment != 0.0:
        changes["moments.moment"] = Moment(
            ring="inner", direction=(1.0, 0.0, 0.0), moment=of.moment
        )
        changes |= _tilts(of.base.inner_ring.support)
    return changes


def _tilts(support: Support) -> dict[str, Spring]:
    """Set tilts free that are held."""
    held = [axis for axis in ("tilt_x", "tilt_y") if getattr(support, axis) in (None, "fixed")]
    return {f"inner_ring.support.{axis}": Spring(damping=_TILT_DAMPING) for axis in held}


def _drive(of: Settings, moved: set[str]) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    if "speed_rpm" in moved and of.speed_rpm is not None:
        changes["drive"] = SpeedDrive(of.speed_rpm * math.pi / 30.0)
    if "outer_rpm" in moved and of.outer_rpm is not None:
        changes["outer_speed"] = of.outer_rpm * math.pi / 30.0
    return changes


def _clearances(of: Settings, moved: set[str]) -> dict[str, Any]:
    if "clearance" not in moved:
        return {}
    return {f"rows[{k}].clearance": of.clearance for k in range(len(of.base.rows))}


def _oil(of: Settings, moved: set[str]) -> dict[str, Any]:
    if not moved & {"oil", "temperature_c"}:
        return {}
    if of.oil is None:
        return {"lubricant": None} if "oil" in moved else {}
    return {"lubricant": chosen(of.oil, of.temperature_c)}


def _damage(of: Settings, moved: set[str]) -> dict[str, Any]:
    del moved
    return {} if of.damage == "none" else {"defects.damage": _made(of)}


def _made(of: Settings) -> Defect:
    place = math.radians(of.angle_deg)
    match of.damage:
        case "spall":
            return defects.spall(on=of.on, width_mm=of.width_mm, angle=place)
        case "line":
            return defects.line(on=of.on, width_mm=of.width_mm, angle=place)
        case "dent":
            return defects.dent(on=of.on, diameter_mm=of.width_mm, angle=place)
        case "pit":
            return defects.pit(on=of.on, diameter_mm=of.width_mm, angle=place)
    raise SceneError("damage", repr(of.damage), f"one of {', '.join(DAMAGE)}")


def _housing(of: Settings, moved: set[str]) -> dict[str, Any]:
    """Make all modes of the structure heavier or lighter, at their frequencies."""
    if "housing_mass" not in moved:
        return {}
    structure, factor = of.base.structure, of.housing_mass
    if structure is None or factor is None:
        raise SceneError("housing_mass", repr(factor), "None, since the scene has no structure")
    modes = enumerate(structure.modes)
    return {f"structure.modes[{k}].mass": factor * mode.mass for k, mode in modes}


def _load(scene: Scene, *, along: bool) -> str | None:
    """Return the name of the first load across or along the axis."""
    found = (name for name, load in scene.loads.items() if _is_along(load) is along)
    return next(found, None)


def _is_along(load: Load) -> bool | None:
    x, y, z = load.direction
    return (z != 0.0) if (x == y == 0.0) != (z == 0.0) else None


def _force(scene: Scene, *, along: bool) -> float | None:
    name = _load(scene, along=along)
    force = 0.0 if name is None else scene.loads[name].force
    return float(force) if isinstance(force, int | float) else None


def speed_of(scene: Scene) -> float | None:
    """Return the speed of the inner ring [1/min]; None where it is not given, or changes."""
    drive = scene.drive
    constant = isinstance(drive, SpeedDrive) and isinstance(drive.speed, int | float)
    return drive.speed * 30.0 / math.pi if constant else None  # type: ignore[operator,union-attr]


def outer_speed_of(scene: Scene) -> float | None:
    """Return the speed of the outer ring [1/min]; None where it stands, or its speed changes."""
    speed = scene.outer_speed
    return speed * 30.0 / math.pi if isinstance(speed, int | float) else None


def _has_clearance(scene: Scene) -> bool:
    return all(row.contact_angle == 0.0 for row in scene.rows)


def _recorded(scene: Scene) -> Scene:
    """Return the scene with probes of what the page shows: the outer ring's acceleration, the shaft's angle."""
    for name, component in _SHOWN.items():
        probe = scene.probes.get(name)
        own = isinstance(probe, MotionProbe) and probe.body == name
        had = probe.components if own else ()  # type: ignore[union-attr]
        # Without a list all components are recorded.
        if had is not None and component not in had:
            new = MotionProbe(body=name, components=(*had, component))
            scene = scene.replace({f"probes.{name}": new})
    return scene
