"""Advice on what a record would need to have for a statement, or for a better one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._base.units import VELOCITIES
from .upper import needed_edge, upper_edge

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..channel import Channel
    from .kinematics import Kinematics
    from .shaft import ShaftRate

FEWEST_TURNS = 20.0
"""Turns of the shaft below which the running median under a line has too few bins for a null."""

HELD = 2.0
"""Lines of an inner race that a band has to hold: an envelope has none above the width of its band."""

_APART = 8.0
"""Turns by the distance of a race's order from a whole one, below which its lines and the shaft's flow together.

Spalls of 0.8 mm on the inner race of a simulated 6309 (order 4.94) and 7208B (8.05) stand out from 6.2 and from
7 to 10.6 on, silent and in noise at 10 dB; below, they were called healthy.
"""

_EXACT = 2e-3
"""How far a speed may be off, as a part of it, that is called exact."""

_CLIPPED = 1e-3
"""Share of samples at the largest or the smallest value from which on a record counts as clipped."""


def lack_of(channel: Channel, shaft: float, kinematics: Kinematics, bands: int) -> str | None:
    """Say what a record would need to have for any evidence; None if it has it."""
    turns = channel.n_samples / channel.fs * shaft
    if not channel.x.std() > 1e-12 * np.abs(channel.x).max():
        return "a signal: this one is silent"
    if turns < FEWEST_TURNS:
        longer = f"a longer record, at least {FEWEST_TURNS / shaft:.3g} s"
        return f"{longer}: this one has {turns:.3g} turns of the shaft"
    if not bands:
        needed = 2.0 * HELD * kinematics.orders.bpfi * shaft / 0.92
        return (
            f"a higher sampling rate, at least {needed:.3g} Hz: no band holds two lines of a race"
        )
    return None


def wanting_of(
    channel: Channel, shaft: ShaftRate, kinematics: Kinematics, within: float | None, impacts: str | None
) -> list[str]:  # fmt: skip
    """Return what a record lacks for a statement that nothing is damaged, the gravest first.

    Parameters
    ----------
    channel : Channel
        Record.
    shaft : ShaftRate
        Rate of the shaft, and whether the record shows it.
    kinematics : Kinematics
        Bearing.
    within : float, optional
        How far the speed may be off, as a part of it.
    impacts : str, optional
        What would explain impacts that stand out.
    """
    found = []
    if channel.unit in VELOCITIES:
        found.append(
            f"an acceleration: this is a velocity in {channel.unit}, in which ringing after impacts is weak"
        )
    found += _reaching(channel, kinematics)
    found += [] if impacts is None else [impacts]
    found += _long_enough(channel, shaft.rate, kinematics, within)
    if shaft.by == "nominal" and (within is None or within > _EXACT):
        found.append(
            f"the exact speed: the record has no clear lines of a shaft at {60.0 * shaft.nominal:.5g} 1/min "
            f"(speed_within={_EXACT:g} or less where that is measured)"
        )
    return found


def _reaching(channel: Channel, kinematics: Kinematics) -> list[str]:
    """Require a band that holds what impacts excite, unless the record is a run's."""
    if channel.is_run:
        return []
    row = kinematics.row
    edge = upper_edge(channel.x, channel.fs)
    needed = needed_edge(None if row is None else row.pitch_diameter)
    if edge >= needed:
        return []
    return [
        f"a record with a wider band, to {_khz(needed)} and more: this one ends at {_khz(edge)}, and impacts "
        "ring above"
    ]


def _khz(f: float) -> str:
    return f"{f / 1e3:.2g} kHz" if f < 10e3 else f"{f / 1e3:.0f} kHz"


def unexplained(kurtosis: float | None, *, exact: bool, cage: bool) -> str | None:
    """Say what would explain impacts that are no race's or ball's; None where there are none.

    Parameters
    ----------
    kurtosis : float or None
        Of the band where impacts stand out; None where none do.
    exact : bool
        Whether bearing and speed are a run's own, so that only a longer record is left.
    cage : bool
        Whether the cage's lines stand out: a damaged ball meets the load zone once in its turn.
    """
    if kurtosis is None:
        return None
    needed = (
        "a longer record" if exact else "the exact speed, the right bearing, or a longer record"
    )
    at = (
        "only at the cage's rate, as a damaged ball may have"
        if cage
        else "at no rate of this bearing"
    )
    return f"{needed}: impacts stand out (kurtosis {kurtosis:.0f}), but {at}"


def unclipped(x: NDArray[np.float64]) -> list[str]:
    """Require a record that no rail of the logger has cut."""
    at_rails = np.count_nonzero((x == x.max()) | (x == x.min()))
    if at_rails > max(_CLIPPED * x.size, 8):
        return ["a record within the logger's range: this one is clipped"]
    return []


def _long_enough(
    channel: Channel, shaft: float, kinematics: Kinematics, within: float | None
) -> list[str]:
    """Require more turns where an order of a race is so near an integer that the shaft's lines hide its own."""
    orders = kinematics.orders
    part, order, near = min(
        (
            (part, order, turns * round(order / turns))
            for part, order in (("outer", orders.bpfo), ("inner", orders.bpfi))
            for turns in orders.turning
        ),
        key=lambda one: abs(one[1] - one[2]),
    )
    apart = abs(order - near)
    if channel.n_samples / channel.fs * shaft * apart >= _APART:
        return []
    longer = f", at least {_APART / apart / shaft:.3g} s" if apart > 1e-3 else ""
    exact = (
        ", or for damage to show the exact speed (speed_within)"
        if within is None or within > _EXACT
        else ""
    )
    return [
        f"a longer record{longer}{exact}: the {part} race's order {order:.3f} is too near "
        f"the shaft's {near:g}"
    ]


def notes_of(channel: Channel, kinematics: Kinematics) -> tuple[str, ...]:
    """Return the warnings of the record, and why the strength of its lines was not judged."""
    notes = list(channel.warnings)
    if unclipped(channel.x) and not any("clipped" in note for note in notes):
        notes.append("the record is clipped: levels, lines and impacts are larger than recorded")
    if channel.unit != "m/s^2":
        known = f"{channel.unit} is no acceleration; give the record of one"
        unit = known if channel.unit in VELOCITIES else "its unit is not known; give unit="
        notes.append(f"the strength of lines was not judged: {unit}")
    elif kinematics.row is None:
        notes.append("the strength of lines was not judged: only orders of the bearing are known")
    return tuple(notes)
