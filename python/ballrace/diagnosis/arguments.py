"""Checks of the arguments of a diagnosis."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from .._base.libraries import scipy
from .._base.numbers import real
from .._base.units import ACCELERATIONS, VELOCITIES
from ..errors import SceneError
from ..frequencies.operating import FaultFrequencies, ring_rates, scene_rates
from ..scene import Scene
from ..spectra.checks import checked_signal
from .kinematics import kinematics_of
from .shaft import FURTHEST

if TYPE_CHECKING:
    from ..channel import Channel
    from .kinematics import AnyBearing, Kinematics


def checked_channel(channel: Channel, unit: str | None, name: str = "record") -> Channel:
    """Return the channel in m/s² where its unit is known, cut to a length that transforms quickly."""
    x = checked_signal(channel.x, channel.fs, name)
    channel = replace(channel, x=x[: scipy.fft.prev_fast_len(x.size, real=True)])
    if unit is not None:
        channel = replace(channel, unit=_checked_unit(unit, channel.unit))
    return channel.to("m/s^2") if channel.unit in ACCELERATIONS else channel


def _checked_unit(unit: str, known: str) -> str:
    """Return the given unit, for a record that has no other."""
    if not isinstance(unit, str) or unit.replace("²", "^2") not in ACCELERATIONS:
        raise SceneError("unit", repr(unit), f"one of {', '.join(ACCELERATIONS)}, or None")
    unit = unit.replace("²", "^2")
    if known in ACCELERATIONS | VELOCITIES and unit != known:
        raise SceneError("unit", repr(unit), f"left out: the record is in {known}")
    return unit


def known_bearing(
    channel: Channel,
    bearing: AnyBearing | None,
    row: int,
    speed_rpm: float | None = None,
    outer_rpm: float | None = None,
) -> tuple[Kinematics, float]:
    """Return the bearing that was given, or that of the record, and the rate of its rings against each other [Hz].

    Raises
    ------
    SceneError
        There is none, or no speed, or one that is not usable.
    """
    bearing = channel.scene if bearing is None else bearing
    if bearing is None:
        raise SceneError("bearing", "None", "a bearing: the record does not know its own")
    speeds = _given_speeds(bearing, speed_rpm, outer_rpm)
    kinematics = kinematics_of(bearing, row, speeds)
    if speeds is not None:
        return kinematics, abs(speeds[1] - speeds[0])
    if speed_rpm is None and not channel.shaft and isinstance(bearing, FaultFrequencies):
        return kinematics, bearing.shaft
    return kinematics, nominal_rate(channel, speed_rpm)


def _given_speeds(
    bearing: AnyBearing, speed_rpm: float | None, outer_rpm: float | None
) -> tuple[float, float] | None:
    """Return the rates of outer and inner ring with their signs [Hz] where the outer ring turns; None as known."""
    turns = isinstance(bearing, Scene) and bearing.outer_speed is not None
    if speed_rpm == 0.0 and outer_rpm is None and not turns:
        allowed = "not 0, or 0 beside the outer_rpm of a hub [1/min]"
        raise SceneError("speed_rpm", repr(speed_rpm), allowed)
    if outer_rpm is None and (speed_rpm is None or not turns):
        return None
    if not turns:
        return ring_rates(0.0 if speed_rpm is None else speed_rpm, outer_rpm or 0.0)
    assert isinstance(bearing, Scene)
    return scene_rates(bearing, speed_rpm, outer_rpm)


def nominal_rate(channel: Channel, speed_rpm: float | None) -> float:
    """Return the rate of the shaft that was given, or that the record knows [Hz]."""
    if speed_rpm is None:
        if not channel.shaft:
            raise SceneError("speed_rpm", "None", "the speed [1/min]: the record does not know it")
        return abs(channel.shaft)
    rate = abs(real(speed_rpm)) / 60.0
    if not 0.0 < rate < math.inf:
        raise SceneError("speed_rpm", repr(speed_rpm), "a speed of the inner ring [1/min], not 0")
    return rate


def known_within(channel: Channel, *, given: bool, speed_within: float | None) -> float | None:
    """Return how far the speed may be off, as a part of it, 0 where it is a run's own; None by default."""
    if speed_within is None:
        return 0.0 if not given and channel.scene is not None else None
    if not 0.0 <= real(speed_within) <= FURTHEST:
        allowed = f"a part of the speed, 0 to {FURTHEST:g}, or None"
        raise SceneError("speed_within", repr(speed_within), allowed)
    return real(speed_within)


def other_rates(exclude: Iterable[float], mains: float | None) -> tuple[list[float], list[float]]:
    """Return orders, and frequencies [Hz], whose multiples are not the bearing's."""
    orders = [real(order) for order in exclude] if isinstance(exclude, Iterable) else [math.nan]
    for order in orders:
        if not 0.05 <= order < math.inf:
            raise SceneError("exclude", repr(exclude), "orders of the shaft from 0.05 on")
    if mains is not None and not 1.0 <= real(mains) <= 1000.0:
        raise SceneError("mains", repr(mains), "a frequency, 1 to 1000 Hz, or None")
    return orders, [] if mains is None else [real(mains)]


def check_false_alarm(false_alarm: float) -> None:
    """Refuse a false-alarm rate that is none.

    Raises
    ------
    SceneError
        It is none.
    """
    if not 1e-6 <= real(false_alarm) <= 0.2:
        raise SceneError("false_alarm", repr(false_alarm), "a share of records, 1e-6 to 0.2")
