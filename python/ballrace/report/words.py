"""Numbers and parts of a scene in words, for tables."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ..scene import (
    AccurateSlices,
    FittedSlices,
    FixedSlices,
    SpeedDrive,
    TorqueDrive,
)
from ..scene.defect import extent, widest

if TYPE_CHECKING:
    from ..ratings.life import RatingLife
    from ..scene import Defect, Lubricant, NormalLaw, Scene, TimeFunction


def number(value: float | None, digits: int = 4) -> str:
    """Return a number with some significant digits.

    Examples
    --------
    >>> number(1234.5678), number(None), number(-1e-7)
    ('1235', '–', '−1e−07')
    """
    if value is None or math.isnan(value):
        return "–"
    return f"{value:.{digits}g}".replace("-", "−")


def with_error(value: float | None, error: float | None) -> str:
    """Return a number with its standard error, both to the second digit of the error and in one notation.

    Examples
    --------
    >>> with_error(597.64, 131.0), with_error(0.031415, 0.00027), with_error(3.0e9, 2.0e7), with_error(1.5, None)
    ('600 ± 130', '0.03141 ± 0.00027', '(3.000 ± 0.020)e+09', '1.5')
    """
    if value is None or error is None or math.isnan(value) or not 0.0 < error < math.inf:
        return number(value) + ("" if error is None else f" ± {number(error, 2)}")
    power = math.floor(math.log10(max(abs(value), error)))
    digits = 1 - math.floor(math.log10(error))
    if -4 <= power < 6:
        both = (f"{round(each, digits):.{max(digits, 0)}f}" for each in (value, error))
        return " ± ".join(both).replace("-", "−")
    value, error = value / 10.0**power, error / 10.0**power
    places = max(digits + power, 0)
    return f"({value:.{places}f} ± {error:.{places}f})e{power:+03d}".replace("-", "−")


def large(value: float) -> str:
    """Return a large number with thin spaces between thousands.

    Examples
    --------
    >>> large(1234567.0).split()
    ['1', '234', '567']
    """
    return "∞" if math.isinf(value) else f"{value:,.0f}".replace(",", "\u202f")


def lasting(life: RatingLife, turns: float) -> str:
    """Return how long a life of some turns lasts."""
    if math.isinf(turns):
        return "unlimited: no load"
    hours = life.hours(turns)
    return f"{number(1e-6 * turns)} million turns" + (f", {large(hours)} h" if hours else "")


def degrees(angle: float) -> str:
    """Return an angle [rad] in degrees."""
    return f"{math.degrees(angle):.1f}°".replace("-", "−")


def bearing(scene: Scene) -> list[tuple[str, str]]:
    """Return what there is to know of the rows of balls."""
    rows = []
    for k, row in enumerate(scene.rows):
        of = f"Row {k}" if len(scene.rows) > 1 else "Balls"
        angle = f"contact angle {degrees(row.contact_angle)}, " if row.contact_angle else ""
        text = (
            f"{row.ball_count} balls of {1e3 * row.ball_diameter:.4g} mm on a pitch circle of "
            f"{1e3 * row.pitch_diameter:.4g} mm, {angle}conformities {row.outer_conformity:.4g} outside and "
            f"{row.inner_conformity:.4g} inside, diametral clearance {1e6 * row.clearance:.3g} µm"
        )
        rows.append((of, text.replace("-", "−")))
    return [*rows, *(("Defect", _defect(name, defect)) for name, defect in scene.defects.items())]


def _defect(name: str, defect: Defect) -> str:
    surface = {"outer_race": "outer race", "inner_race": "inner race"}.get(
        defect.on, f"ball {defect.ball}"
    )
    width = widest(defect)
    place = "where the contact runs"
    if not isinstance(defect.axial_offset, str):
        place = f"{1e3 * defect.axial_offset:.3f} mm from the row's plane"
    size = f"{1e3 * width:.3g} mm along the race, {1e3 * extent(defect):.3g} mm across"
    if defect.shape == "cap":
        size = f"a cap of {1e3 * width:.3g} mm"
    text = (
        f"{name}: on the {surface} of row {defect.row}, at {degrees(defect.angle)}, {place}; {size}"
    )
    return text.replace("-", "−")


def operation(scene: Scene) -> list[tuple[str, str]]:
    """Return loads and speed."""
    rows = []
    for name, load in scene.loads.items():
        x, y, z = load.direction
        force = f"{load.force:.5g} N" if isinstance(load.force, int | float) else "changes in time"
        text = f"{force} on the {load.ring} ring along ({x:.3g}, {y:.3g}, {z:.3g})"
        rows.append((f"Load, {name}", text.replace("-", "−")))
    rows.append(("Speed", _speed(scene.drive)))
    if scene.outer_speed is not None:
        rows.append(("Speed of the outer ring", _turns(scene.outer_speed, "outer")))
    return [*rows, *_unbalances(scene)]


def _unbalances(scene: Scene) -> list[tuple[str, str]]:
    return [
        (f"Unbalance, {name}", f"{1e6 * u.moment:.4g} g·mm on the {u.ring} ring")
        for name, u in scene.unbalances.items()
    ]


def _speed(drive: SpeedDrive | TorqueDrive) -> str:
    if isinstance(drive, TorqueDrive):
        return f"driven by a torque, from {drive.initial_speed:.4g} rad/s"
    return _turns(drive.speed, "inner")


def _turns(speed: TimeFunction, ring: str) -> str:
    if isinstance(speed, int | float):
        return f"{speed * 30.0 / math.pi:.5g} 1/min, {ring} ring".replace("-", "−")
    return f"changes in time, {ring} ring"


def absent(scene: Scene) -> list[str]:
    """Return what a scene could hold and does not."""
    rings = (scene.outer_ring, scene.inner_ring)
    tilts = [mount for ring in rings for mount in (ring.support.tilt_x, ring.support.tilt_y)]
    may_tilt = any(mount not in (None, "fixed") for mount in tilts) or any(
        ring.tilt is not None or ring.support.coupled is not None for ring in rings
    )
    oiled = scene.lubricant is not None or any(row.lubricant is not None for row in scene.rows)
    held = {
        "rings that tilt": may_tilt,
        "oil in the contacts": oiled,
        "balls that spin about any axis": scene.spin == "free",
    }
    return [what for what, is_there in held.items() if not is_there]


def _law(law: NormalLaw) -> str:
    return "Hertz" if law == "hertz" else law.called


def model(scene: Scene) -> list[tuple[str, str]]:
    """Return what of physics a scene holds."""
    contact = scene.contact
    friction = scene.friction
    cage = scene.cage
    rows = [
        (
            "Contact",
            f"{_law(contact.law)}, {_slices(contact.slices)}; Hunt–Crossley damping {contact.damping:.3g} s/m",
        ),
        ("Friction", friction if isinstance(friction, str) else _fields(friction)),
        *([("Lubricant", _oil(scene.lubricant))] if scene.lubricant else []),
        ("Cage", "none" if cage is None else _fields(cage)),
        ("Outer ring", _held(scene.outer_ring.support, "fixed")),
        ("Inner ring", _held(scene.inner_ring.support, "free")),
    ]
    return [(what, text.replace("-", "−")) for what, text in rows]


def _slices(slices: FixedSlices | FittedSlices | AccurateSlices) -> str:
    match slices:
        case FixedSlices():
            return f"{slices.count} fixed slices a ball"
        case FittedSlices():
            return f"{slices.count} fitted nodes a zone"
    return f"nodes fitted to an accuracy of {slices.accuracy:.1g}"


def _oil(oil: Lubricant) -> str:
    effects = [name for name in ("film", "damping", "traction", "rolling") if getattr(oil, name)]
    held = f"with its {', '.join(effects)}" if effects else "without effect"
    return f"{oil.oil or 'by its data sheet'} at {oil.temperature - 273.15:.3g} °C, {held}"


def _fields(part: Any) -> str:
    name = type(part).__name__
    values = {k: v for k, v in vars(part).items() if isinstance(v, int | float)}
    return f"{name}: " + ", ".join(f"{k.replace('_', ' ')} {v:.4g}" for k, v in values.items())


def _held(support: Any, absent: str) -> str:
    parts = []
    for axis in "xyz":
        mount = getattr(support, axis)
        if mount is None or isinstance(mount, str):
            parts.append(f"{axis} {mount or absent}")
        else:
            parts.append(
                f"{axis} spring {mount.stiffness:.3g} N/m, damper {mount.damping:.3g} N s/m"
            )
    return "; ".join(parts)
