"""A record in pieces of the length and sampling rate that a model was trained on."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

from numpy.typing import ArrayLike

from .._base.numbers import real
from ..channel import Channel, Recorded, channel_of
from ..diagnosis.arguments import nominal_rate
from ..errors import SceneError
from ..measuring import Logger

FEWEST_TURNS = 5.0
"""A shorter record has no usable lines."""

_RATIOS = 100
"""Rates over each other are fractions of whole numbers up to this, half a percent off at most."""


def pieces_of(
    record: Recorded | ArrayLike,
    turns: float,
    rate: float,
    *,
    speed_rpm: float | None = None,
    fs: float | None = None,
    column: str | None = None,
) -> list[Channel]:
    """Return a record in pieces of so many turns, at a sampling rate near ``rate`` or its own if that is lower.

    A record of fewer turns is one piece.

    Raises
    ------
    SceneError
        It has fewer than five turns, samples that are no numbers, or a speed that is not given.
    KeyError
        There is no such column.
    """
    channel = channel_of(record, fs, column, name="record")
    shaft = abs(nominal_rate(channel, speed_rpm))
    channel = _slower(replace(channel, shaft=shaft), rate)
    size = round(turns / shaft * channel.fs)
    if channel.n_samples < FEWEST_TURNS / shaft * channel.fs:
        given = f"{channel.n_samples / channel.fs * shaft:.2g} turns of the shaft"
        raise SceneError("record", given, f"{FEWEST_TURNS:g} and more")
    size = min(size, channel.n_samples)
    starts = range(0, channel.n_samples - size + 1, size)
    return [replace(channel, x=channel.x[k : k + size], start=k / channel.fs) for k in starts]


def _slower(channel: Channel, rate: float) -> Channel:
    """Return a channel at about a lower rate."""
    if channel.fs <= rate * (1.0 + 1.0 / _RATIOS):
        return channel
    ratio = Fraction(rate / channel.fs).limit_denominator(_RATIOS)
    if ratio == 0:
        raise SceneError("fs", f"{channel.fs:g}", f"at most {_RATIOS} times {rate:g} [Hz]")
    x, fs = Logger(fs=float(ratio) * channel.fs).sampled(channel.x, channel.fs)
    return replace(channel, x=x, fs=fs)


def checked_turns(turns: float) -> float:
    """Return the length of a piece, checked."""
    if not FEWEST_TURNS <= real(turns) < math.inf:
        raise SceneError("turns", repr(turns), f"turns of the shaft, {FEWEST_TURNS:g} and more")
    return float(turns)
