"""Width of a spall, from the spacing of the two events of a pass and simulated spalls of known width.

The second event comes when the ball has left the first edge by the width less what the contact bridges, some
twentieth of a ball's diameter, which load, speed, edges and clearance move. How much it was in the records of the
library is the interval: nothing but the bearing has to be known. Its spalls have rounded edges, and floors that no
ball meets; in 24 runs with steep walls the contact bridged 0.02 to 0.11 ball diameters, in 12 with floors that
balls meet 0.02 to 0.05. Events closer than a tenth of a diameter are no measure of a width: into a narrow cut a
ball hardly sinks, so that its edges are as far apart as the events, and ringing of a single event beats as fast.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .combs import Part
from .fit import fit
from .passes import AveragedPass, averaged, passes_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from ..bearings import Bearing
    from ..scene import Row
    from .evidence import Evidence
    from .kinematics import Kinematics
    from .passes import Passes

_RACES = ("outer_race", "inner_race")

_HIGH, _ABOVE, _AGREEING, _SHARE = 0.03, 3.0, 3, 0.55
"""Height of the second event, that over anything else, number and share of bands that place it there: where all
are at least so much, it is one."""

_CLOSEST = 0.1
"""Arc between the events below which the library does not say what a spall is wider [ball diameters].

Of the 206 above it in an earlier library with more wide spalls the standard deviation was 0.024 on outer races and
0.020 on inner ones, below it 0.075 and 0.045. The present one has 65 and 18, too few to say.
"""


@dataclass(frozen=True, kw_only=True)
class Width:
    """Width of a spall along the race.

    Attributes
    ----------
    part : {"outer_race", "inner_race"} or None
        Where it is; None where no race is damaged.
    value : float or None
        Width [m]; None where it is not known.
    interval : tuple of two floats, or None
        Interval that holds the widths of 90 % of such spalls in simulated bearings [m].
    spacing : float or None
        Arc between the two events [m], where they are clear; they may be too close for a width.
    why : str
        Reason for the value, or why it is not known.
    """

    part: Part | None
    value: float | None
    interval: tuple[float, float] | None
    spacing: float | None
    why: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Sized:
    """A width with the averaged pass that shows it."""

    width: Width
    ball_diameter: float = 0.0
    averaged: AveragedPass | None = None


def unknown_width(why: str, part: Part | None = None) -> Sized:
    """Return a width that is not known, with the reason."""
    width = Width(part=part, value=None, interval=None, spacing=None, why=f"not known: {why}")
    return Sized(width=width)


def sized(
    x: NDArray[np.float64], fs: float, shaft: float, kinematics: Kinematics, damaged: Sequence[Evidence]
) -> Sized:  # fmt: skip
    """Return the width of the spall of the first race among damaged parts.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Record.
    fs, shaft : float
        Sampling rate, rate of the shaft [Hz].
    kinematics : Kinematics
        Bearing.
    damaged : sequence of Evidence
        Of the parts that are damaged.
    """
    one = next((each for each in damaged if each.part in _RACES), None)
    if one is None:
        return unknown_width("no race is damaged")
    row = kinematics.row
    if row is None:
        return unknown_width("only orders of the bearing are known, not its dimensions", one.part)
    rate = one.order * one.factor * shaft
    speed = along(row, one.part, rate, one.contact_angle or row.contact_angle)
    found = passes_of(x, fs, speed)
    if found is None:
        return unknown_width(
            "no band of the record resolves a pass: raise the sampling rate, or lower the speed",
            one.part,
        )
    if not _stands_out(found.height, found.above, found.bands, found.agreeing):
        return unknown_width(_unclear(row.ball_diameter), one.part)
    return Sized(
        width=_read(found, one.part, row.ball_diameter),
        ball_diameter=row.ball_diameter,
        averaged=averaged(x, fs, speed, found.spacing, speed / rate),
    )


def _read(found: Passes, part: Part, ball: float) -> Width:
    arc = found.spacing * ball
    why = (
        f"the second event of a pass comes {1e3 * arc:.2f} mm behind the first, in {found.agreeing} of "
        f"{found.bands} bands"
    )
    return width_of_arc(part, arc, ball, why)


def width_of_arc(part: Part, arc: float, ball: float, why: str) -> Width:
    """Return the width of a spall like those of the library, unless the events are too close.

    Parameters
    ----------
    part : {"outer_race", "inner_race"}
        Race.
    arc : float
        Between the events [m].
    ball : float
        Diameter of the balls [m].
    why : str
        Where the arc comes from.
    """
    if arc < _CLOSEST * ball:
        why = (
            f"not known: {why}; below a tenth of a ball's diameter ({1e2 * ball:.2f} mm) these may be the edges "
            "of a narrow cut or the ringing of one event, as well as a spall's"
        )
        return Width(part=part, value=None, interval=None, spacing=arc, why=why)
    # A spall may be narrower than its arc, but is no narrower than nothing.
    low, middle, high = (max(arc + bridge * ball, 0.0) for bridge in fit()["bridge"][part])
    why = (
        f"{why}; simulated spalls with rounded edges, deeper than the balls sink, are {1e3 * low:.2f} to "
        f"{1e3 * high:.2f} mm wide where it does, and the interval assumes that shape"
    )
    return Width(part=part, value=middle, interval=(low, high), spacing=arc, why=why)


def _unclear(ball: float) -> str:
    return (
        "no second event of a pass stands out from the ringing of the first, as of spalls below some "
        f"{1e3 * _LEAST * ball:.1f} mm, of heavily loaded or very fast balls, and in noise"
    )


_LEAST = 0.15
"""Width below which the second event is hidden by the first's ringing, or too close [ball diameters]."""


def along(row: Bearing | Row, part: Part, rate: float, angle: float) -> float:
    """Return the speed of the balls along a race [ball diameters a second].

    Parameters
    ----------
    row : Bearing or Row
        Dimensions.
    part : {"outer_race", "inner_race"}
        Race.
    rate : float
        At which balls pass a place of it [Hz].
    angle : float
        Contact angle [rad].
    """
    side = 1.0 if part == "outer_race" else -1.0
    circle = row.pitch_diameter + side * row.ball_diameter * math.cos(angle)
    return math.pi * circle * rate / row.ball_count / row.ball_diameter


def are_clear(rows: NDArray[Any]) -> NDArray[np.bool_]:
    """Say which records have a width: rows with the columns of :class:`Passes`."""
    columns = (rows[name] for name in ("height", "above", "bands", "agreeing"))
    found: NDArray[np.bool_] = _stands_out(*columns) & (rows["spacing"] >= _CLOSEST)
    return found


def _stands_out(height: Any, above: Any, bands: Any, agreeing: Any) -> Any:
    agreed = (agreeing >= _AGREEING) & (agreeing >= _SHARE * bands)
    return (height >= _HIGH) & (above >= _ABOVE) & agreed
