"""What a record would need to have for a statement, or for a better one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ..channel import Channel
    from .kinematics import Kinematics

__all__ = ["HELD", "lack_of", "notes_of", "wanting_of"]

_TURNS = 20.0
"""Turns of the shaft below which the running median under a line has too few bins for a null."""

HELD = 2.0
"""Lines of an inner race that a band has to hold: an envelope has none above the width of its band."""

_CLIPPED = 1e-3
"""Share of samples at the largest or the smallest value from which on a record counts as clipped."""


def lack_of(channel: Channel, shaft: float, kinematics: Kinematics, bands: int) -> str | None:
    """Say what a record would need to have for any evidence; None if it has it."""
    turns = channel.n_samples / channel.fs * shaft
    if not channel.x.std() > 1e-12 * np.abs(channel.x).max():
        return "a signal: this one is silent"
    if turns < _TURNS:
        return f"a longer record, at least {_TURNS / shaft:.3g} s: this one has {turns:.3g} turns of the shaft"
    if not bands:
        needed = 2.0 * HELD * kinematics.orders.bpfi * shaft / 0.92
        return (
            f"a higher sampling rate, at least {needed:.3g} Hz: no band holds two lines of a race"
        )
    return None


def wanting_of(channel: Channel) -> list[str]:
    """Return what a record lacks for a statement that nothing is damaged."""
    x = channel.x
    at_rails = np.count_nonzero((x == x.max()) | (x == x.min()))
    if at_rails > max(_CLIPPED * x.size, 8):
        return ["a record within the logger's range: this one is clipped"]
    return []


def notes_of(channel: Channel, kinematics: Kinematics) -> tuple[str, ...]:
    """Return what the record was warned of, and why its lines' size was not judged."""
    notes = list(channel.warnings)
    if channel.unit != "m/s^2":
        unit = f"{channel.unit} is no acceleration" if channel.unit else "its unit is not known"
        notes.append(f"how strong lines are was not judged: {unit}; give unit=")
    elif kinematics.row is None:
        notes.append("how strong lines are was not judged: only orders of the bearing are known")
    return tuple(notes)
