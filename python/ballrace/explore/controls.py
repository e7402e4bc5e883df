"""The controls of numbers: their ranges about a scene, and how what they show becomes settings."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .settings import Settings

_TAG = re.compile(r"(?:\\|&#92;)u003c.*?(?:\\|&#92;)u003e")
"""A tag in an attribute of an element, as marimo writes it there."""

_Element = TypeVar("_Element")

_Steps = tuple[float, float, float]
"""Least and largest value, and step."""


@dataclass(frozen=True, kw_only=True)
class Control:
    """A number that is turned.

    Attributes
    ----------
    field : str
        Field of :class:`ballrace.explore.settings.Settings`.
    label : str
        What it is, with its unit.
    start, stop, step, value : float
        Range, steps and where it begins, in the unit of its label.
    scale : float
        What a value is multiplied with to be in the unit of the field.
    """

    field: str
    label: str
    start: float
    stop: float
    step: float
    value: float
    scale: float = 1.0


def controls(begun: Settings) -> tuple[Control, ...]:
    """Return the controls of a scene's settings; what is not one number in the scene has none."""
    made = (
        *_forces(begun),
        _speed("speed_rpm", "speed / 1/min", begun.speed_rpm, turns=begun.outer_rpm is None),
        _speed("outer_rpm", "speed of the outer ring / 1/min", begun.outer_rpm),
        _clearance(begun),
        _plain("temperature_c", "oil temperature / °C", (0.0, 120.0, 1.0), begun.temperature_c),
        _plain("width_mm", "damage: size / mm", (0.1, 8.0, 0.1), begun.width_mm),
        _plain("angle_deg", "damage: place / °", (-180.0, 180.0, 5.0), begun.angle_deg),
        *_mount(begun),
        _plain("noise", "noise of the sensor / m/s²", (0.0, 20.0, 0.1), begun.noise),
    )
    return tuple(each for each in made if each is not None)


def taken(begun: Settings, made: tuple[Control, ...], shown: Mapping[str, float]) -> Settings:
    """Return settings by what the controls show; one that stands where it began leaves its field as it was."""
    moved: dict[str, Any] = {
        each.field: each.scale * shown[each.field]
        for each in made
        if each.field in shown and shown[each.field] != each.value
    }
    return begun.moved(**moved)


def named(element: _Element) -> _Element:
    """Return an element whose fields have plain names; of labels marimo makes Markdown, with tags in names."""
    for field in ("_text", "_inner_text"):
        text = getattr(element, field, None)
        if isinstance(text, str):
            setattr(element, field, _TAG.sub("", text))
    return element


def _forces(begun: Settings) -> tuple[Control | None, ...]:
    known = [abs(f) for f in (begun.radial_load, begun.axial_load) if f is not None]
    stop = _round_up(5.0 * max([*known, 20.0]))
    moment = _round_up(0.1 * stop * begun.base.rows[0].pitch_diameter)
    return (
        _given("radial_load", "radial load / N", (0.0, stop, 1e-3 * stop), begun.radial_load),
        _given("axial_load", "thrust / N", (-stop, stop, 1e-3 * stop), begun.axial_load),
        _plain("moment", "moment / N m", (-moment, moment, 0.01 * moment), begun.moment),
    )


def _speed(field: str, label: str, begun: float | None, *, turns: bool = False) -> Control | None:
    """Return the control of a ring's speed, which begins above 0 where it alone turns."""
    stop = _round_up(max(6000.0, 2.0 * abs(begun or 0.0)))
    return _given(field, label, (60.0 if turns else -stop, stop, 10.0), begun)


def _clearance(begun: Settings) -> Control | None:
    if begun.clearance is None:
        return None
    micro = 1e6 * begun.clearance
    stop = _round_up(max(5.0 * micro, 50.0))
    made = _given("clearance", "clearance / µm", (-20.0, stop, 0.5), micro)
    return None if made is None else replace(made, scale=1e-6)


def _mount(begun: Settings) -> tuple[Control | None, ...]:
    mass = begun.housing_mass
    return (_given("housing_mass", "housing: masses, times", (0.1, 10.0, 0.1), mass),)


def _given(field: str, label: str, steps: _Steps, value: float | None) -> Control | None:
    """Return a control of what may be no number; a value outside of the range widens it."""
    if value is None:
        return None
    start, stop, step = steps
    low, high = step * math.floor(value / step), step * math.ceil(value / step)
    return _plain(field, label, (min(start, low), max(stop, high), step), value)


def _plain(field: str, label: str, steps: _Steps, value: float) -> Control:
    start, stop, step = steps
    return Control(
        field=field, label=label, start=start, stop=stop, step=step, value=_shown(value, start, step)
    )  # fmt: skip


def _shown(value: float, start: float, step: float) -> float:
    """Return the step that is nearest to a number, which is what a slider shows of it."""
    return float(f"{start + step * round((value - start) / step):.10g}")


def _round_up(value: float) -> float:
    """Return the next 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(each * power for each in (1.0, 2.0, 5.0, 10.0) if value <= 1.000001 * each * power)
