"""The duty cycle of a scene: its steady loads and speeds, each with its share of the time.

Where loads, moments or the speed follow sines or tables, a life is a sum over one period of theirs: the whole
tables, repeated without end, or the shortest time in which every sine has a whole number of periods.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from .errors import SceneError
from .scene import Ramp, Sine, SpeedDrive, Spline, Table
from .scene.time import values_at

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .scene import Scene, TimeFunction

__all__ = ["duty_cycle"]

_GAUSS = np.polynomial.legendre.leggauss(3)
"""Nodes and weights on [-1, 1], exact for powers up to the fifth."""
_PIECES = 16
"""Pieces of a period, at least, and two for every quarter of a sine's turn."""
_MULTIPLES = 100
"""Turns of the slowest sine that may make a common period."""
_WHOLE = 1e-6
"""How far a number of turns may be off a whole one."""


def duty_cycle(scene: Scene) -> list[tuple[float, Scene]]:
    """Return steady scenes and the share of the time that each lasts; their shares are 1 together.

    A ramp of the speed counts as the speed that it ends at.

    Raises
    ------
    SceneError
        A load or moment is a ramp or jumps once, which has no period, or there is no common one.
    """
    functions = _functions(scene)
    varying = {path: f for path, f in functions.items() if _changes(path, f)}
    scene = scene.replace(
        {path: _lasting(f) for path, f in functions.items() if path not in varying}
    )
    if not varying:
        return [(1.0, scene)]
    times, shares = _nodes(varying)
    values = {path: values_at(function, times) for path, function in varying.items()}
    together: dict[tuple[float, ...], float] = {}
    for share, *found in zip(shares, *values.values(), strict=True):
        state = tuple(map(float, found))
        together[state] = together.get(state, 0.0) + float(share)
    return [
        (share, scene.replace(dict(zip(values, state, strict=True))))
        for state, share in together.items()
    ]


def _functions(scene: Scene) -> dict[str, Ramp | Sine | Table | Spline]:
    """Return what may change in time, by its path."""
    found: dict[str, TimeFunction] = {
        f"loads.{name}.force": load.force for name, load in scene.loads.items()
    }
    found |= {f"moments.{name}.moment": moment.moment for name, moment in scene.moments.items()}
    if isinstance(scene.drive, SpeedDrive):
        found["drive.speed"] = scene.drive.speed
    if scene.outer_speed is not None:
        found["outer_speed"] = scene.outer_speed
    return {path: f for path, f in found.items() if isinstance(f, Ramp | Sine | Table | Spline)}


def _lasting(function: Ramp | Sine | Table | Spline) -> float:
    """Return the value of what does not change, or the last of a ramp."""
    if isinstance(function, Ramp):
        return function.to
    return float(values_at(function, 0.0))


def _changes(path: str, function: Ramp | Sine | Table | Spline) -> bool:
    if isinstance(function, Sine):
        return function.amplitude != 0.0 and function.frequency != 0.0
    if isinstance(function, Spline):
        return len(set(function.values)) > 1 or any(function.rates)
    if isinstance(function, Table):
        if function.times[0] == function.times[-1] and len(set(function.values)) > 1:
            raise SceneError(path, "a table that jumps once", _PERIODIC)
        return len(set(function.values)) > 1
    if function.from_ != function.to and path not in ("drive.speed", "outer_speed"):
        raise SceneError(path, f"a ramp from {function.from_:g} to {function.to:g}", _PERIODIC)
    return False


_PERIODIC = "a number, a sine or a table, since a life needs loads that repeat; give a lasting load as a number"


def _nodes(
    varying: dict[str, Ramp | Sine | Table | Spline],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return times of one period and the share of the period that each stands for."""
    start, end = _period(varying)
    fastest = max((abs(f.frequency) for f in varying.values() if isinstance(f, Sine)), default=0.0)
    longest = min((end - start) / _PIECES, 1.0 / (8.0 * fastest) if fastest else math.inf)
    corners = [t for f in varying.values() if isinstance(f, Table | Spline) for t in f.times]
    edges = np.unique([start, *corners, end])
    times, shares = [], []
    for left, right in pairwise(edges):
        pieces = np.linspace(left, right, math.ceil((right - left) / longest - _WHOLE) + 1)
        half = 0.5 * np.diff(pieces)[:, None]
        times.append((pieces[:-1, None] + half * (1.0 + _GAUSS[0])).ravel())
        shares.append((half * _GAUSS[1]).ravel() / (end - start))
    return np.concatenate(times), np.concatenate(shares)


def _period(varying: dict[str, Ramp | Sine | Table | Spline]) -> tuple[float, float]:
    """Return first and last time of one period of everything that changes."""
    spans = {
        path: (f.times[0], f.times[-1])
        for path, f in varying.items()
        if isinstance(f, Table | Spline)
    }
    rates = {path: abs(f.frequency) for path, f in varying.items() if isinstance(f, Sine)}
    if not spans:
        slowest = 1.0 / min(rates.values())
        whole = (n * slowest for n in range(1, _MULTIPLES + 1))
        common = (span for span in whole if all(_fits(f * span) for f in rates.values()))
        spans[next(iter(rates))] = (0.0, next(common, slowest))
    (first, span), *others = spans.items()
    for path, other in others:
        if other != span:
            given = f"a table from {other[0]:g} to {other[1]:g} s"
            allowed = f"a table as long as that of {first}, {span[0]:g} to {span[1]:g} s"
            raise SceneError(path, given, f"{allowed}: a life needs their common period")
    for path, frequency in rates.items():
        if not _fits(frequency * (span[1] - span[0])):
            given = f"a sine of {frequency:g} Hz"
            allowed = f"a whole number of periods in {span[1] - span[0]:g} s, the period of {first}"
            raise SceneError(path, given, f"{allowed}: a life needs their common period")
    return span


def _fits(turns: float) -> bool:
    return abs(turns - round(turns)) <= _WHOLE * max(turns, 1.0)
