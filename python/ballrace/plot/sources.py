"""Sources of a picture's signal: a column of a run or a recording, or an array."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..channel import Channel, channel_of
from ..errors import EquilibriumError, SceneError
from ..frequencies import operating
from ..frequencies.operating import FaultFrequencies, fault_frequencies
from ..recordings.columns import Columns
from ..scene import Scene, SpeedDrive
from ..scene.defect import SURFACES
from ..scene.turning import relative_speed
from ..signals import Signals
from ..spectra.checks import checked_signal
from .style import unit, words

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..bearings import Bearing
    from ..spectra.bands import Fault
    from ..spectra.checks import Given


def source(of: Given, column: str | None, fs: float | None) -> Channel:
    """Return the signal that is meant, checked, with name and unit as a picture shows them.

    Raises
    ------
    SceneError
        The sampling rate of an array is missing, or the signal is not usable.
    KeyError
        There is no such column.
    """
    found = channel_of(of, fs, column)
    x = checked_signal(found.x, found.fs)
    name = words(found.name) if found.name else "signal"
    return replace(found, x=x, name=name, unit=unit(found.unit))


def check_run(of: object, name: str = "out") -> None:
    """Refuse what is no run, such as what was measured: it has no scene whose bodies could be drawn.

    Raises
    ------
    SceneError
        It is none.
    """
    _check(of, Signals, name, "a run, as ballrace.simulate returns it")


def check_columns(of: object, name: str) -> None:
    """Refuse what has no columns over a time.

    Raises
    ------
    SceneError
        It has none.
    """
    allowed = "a run, as ballrace.simulate returns it, or a record, as ballrace.read does"
    _check(of, Columns, name, allowed)


def _check(of: object, kind: type, name: str, allowed: str) -> None:
    if not isinstance(of, kind):
        raise SceneError(name, f"a {type(of).__name__}", allowed)


def scene_of(of: object) -> Scene | None:
    """Return the scene that a signal is of; None of a measured one."""
    return getattr(of, "scene", None)


def rates_of(
    of: object,
    rates: FaultFrequencies | None,
    row: int,
    bearing: str | Bearing | Scene | None = None,
    speed_rpm: float | None = None,
) -> FaultFrequencies | None:
    """Return the fault frequencies: those given, of a bearing, or of a run's scene under its load.

    Without an equilibrium they are those at the nominal contact angle; where the speed changes there are none.

    Raises
    ------
    SceneError
        A bearing is given beside rates, or a speed without a bearing, or the record does not know its speed.
    """
    if bearing is not None:
        if rates is not None:
            raise SceneError("rates", "given", "None beside a bearing")
        return fault_frequencies(bearing, _speed(of, bearing, speed_rpm), row=row)
    if speed_rpm is not None:
        raise SceneError("bearing", "None", "a bearing beside speed_rpm")
    scene = scene_of(of)
    if rates is not None or scene is None or not isinstance(scene.drive, SpeedDrive):
        return rates
    if not relative_speed(scene):
        return None
    known = of if isinstance(of, Signals) else scene
    try:
        return fault_frequencies(known, row=row)
    except EquilibriumError:
        return fault_frequencies(known, row=row, operating=False)


def _speed(of: object, bearing: str | Bearing | Scene, speed_rpm: float | None) -> float | None:
    """Return the speed that is given, or that the record knows [1/min]; a scene has its own."""
    shaft = getattr(of, "shaft", None)
    if speed_rpm is None and shaft and not isinstance(bearing, Scene):
        return 60.0 * float(shaft)
    return speed_rpm


def spin_of(of: object, rates: FaultFrequencies | None, row: int) -> tuple[float, int] | None:
    """Return order and hits a turn of the balls of a run; None of what was measured, where balls tumble."""
    scene = scene_of(of)
    return None if scene is None or rates is None else operating.spin_of(scene, rates, row)


def faults_of(of: object, faults: Iterable[Fault] | None, row: int) -> tuple[Fault, ...]:
    """Return the faults whose lines are drawn: those given, those of the scene, or all of races and balls.

    Raises
    ------
    SceneError
        There is no such fault.
    """
    if faults is not None:
        chosen = tuple(faults)
        for fault in chosen:
            if fault not in (*SURFACES, "cage"):
                raise SceneError("faults", repr(fault), f"some of {', '.join(SURFACES)}, cage")
        return chosen
    scene = scene_of(of)
    own = {d.on for d in scene.defects.values() if d.row == row} if scene is not None else set()
    return tuple(fault for fault in SURFACES if fault in own) or SURFACES


def row_of(of: object) -> int:
    """Return the row of the first defect of a scene, else 0."""
    scene = scene_of(of)
    return next((d.row for d in scene.defects.values()), 0) if scene is not None else 0
