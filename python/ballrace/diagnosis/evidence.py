"""The evidence for a fault of one part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from .combs import WIDTH, Part, role_of
from .null import ACCUSED, levels_by_chance, probability
from .strength import Strength, strength_at

if TYPE_CHECKING:
    from .combs import Comb
    from .envelopes import Levels
    from .kinematics import Kinematics
    from .null import Found
    from .search import Search
    from .strength import Envelopes

_SHARES = (0.5, 0.99)
"""Shares of the null's lines that bound its band in pictures; above the second one a line counts."""


@dataclass(frozen=True, kw_only=True)
class Line:
    """A line of the squared envelope's spectrum.

    Attributes
    ----------
    label : str
        Its name, such as ``2·BPFI − f_r``.
    order : float
        Where it was found, in multiples of the shaft's rate.
    expected, found : float
        Where it was expected by the nominal orders, and where it was found [Hz].
    level : float
        Height over the median beside it [dB], 35 at most.
    """

    label: str
    order: float
    expected: float
    found: float
    level: float


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """Evidence for a fault of one part.

    Attributes
    ----------
    part : {"outer_race", "inner_race", "ball", "cage"}
        The part.
    role : {"outer_race", "inner_race", "ball", "cage"}
        The part whose rules apply, those of a bearing whose outer ring stands. In a hub the inner race stands, and
        is judged as an outer race: its lines are those of balls that pass through the load zone.
    order : float
        Order of its fault that was expected, of a ball 2·BSF.
    factor : float
        Order that was found over it: the effect of slip, contact angle and dimensions.
    contact_angle : float or None
        The angle at which rolling balls explain the factor [rad]; None if none does, or dimensions are not known.
    z : float
        How far its comb of lines stands above the null's, in the null's standard deviations.
    probability : float
        How often the largest of both races' and the ball's combs stands that high by chance.
    band : tuple of two floats
        Band in which it stands out most [Hz].
    whitening : {"cepstrum", "smoothed"}
        The prewhitening with which it stands out most: each amplitude of the spectrum set to one, or divided by a
        running root mean square.
    chance : tuple of two floats
        Median and 99 % quantile of the null's lines in that band [dB].
    height : float
        Mean level of its lines in that band [dB].
    lines : tuple of Line
        Significant lines: those above the null's 99 % quantile.
    hidden : float
        Share of its lines that are not counted, since they nominally lie on the shaft's or on excluded ones.
    strength : Strength
        Depth of modulation and acceleration at the fault's rate.
    ratio : float or None
        Likelihood ratio among simulated bearings: how many times more likely this is with the part healthy than
        with it damaged, 0.01 to 100; None for the cage.
    """

    part: Part
    role: Part
    order: float
    factor: float
    contact_angle: float | None
    z: float
    probability: float
    band: tuple[float, float]
    whitening: Literal["cepstrum", "smoothed"]
    chance: tuple[float, float]
    height: float
    lines: tuple[Line, ...]
    hidden: float
    strength: Strength
    ratio: float | None = None


def evidence_of(
    search: Search,
    envelopes: Envelopes,
    *,
    kinematics: Kinematics,
    shaft: float,
) -> Evidence:
    """Return the evidence for a part by the search for its comb, at a shaft's rate [Hz]."""
    part, comb, found = search.part, search.comb, search.found
    factor = float(comb.factors[found.at])
    chance = levels_by_chance(comb, search.null_levels, shaft, search.null, _SHARES)[:, found.row]
    levels = search.levels
    lines = comb.frequencies(np.array([comb.order * shaft]), shaft)[:, 0]
    at = np.clip(np.rint(lines * levels.duration).astype(int), 0, levels.hidden.size - 1)
    return Evidence(
        part=part,
        role=role_of(part, kinematics.orders),
        order=comb.order,
        factor=factor,
        contact_angle=_angle(part, comb.order * factor, kinematics),
        z=found.z,
        probability=probability(found.z, len(ACCUSED)),
        band=envelopes.bands[found.row % len(envelopes.bands)],
        whitening="cepstrum" if found.row < len(envelopes.bands) else "smoothed",
        chance=(float(chance[0]), float(chance[1])),
        height=found.height,
        lines=_speaking(comb, levels, shaft, found, float(chance[1])),
        hidden=float(levels.hidden[at].mean()),
        strength=strength_at(envelopes, comb.order * factor * shaft, search.taken),
    )


def _angle(part: Part, order: float, kinematics: Kinematics) -> float | None:
    if kinematics.row is None or part not in ("outer_race", "inner_race"):
        return None
    balls = kinematics.row.ball_count
    return kinematics.angle_at(order if part == "outer_race" else balls - order)


def _speaking(
    comb: Comb, levels: Levels, shaft: float, found: Found, above: float
) -> tuple[Line, ...]:
    lines = []
    nominal = comb.frequencies(np.array([comb.order * shaft]), shaft)[:, 0]
    moved = comb.frequencies(np.array([comb.order * float(comb.factors[found.at]) * shaft]), shaft)[
        :, 0
    ]
    for line, expected, near in zip(comb.lines, nominal.tolist(), moved.tolist(), strict=True):
        at, level = _summit(levels, found.row, near)
        if level > above:
            lines.append(
                Line(
                    label=comb.label(line),
                    order=at / shaft,
                    expected=expected,
                    found=at,
                    level=level,
                )
            )
    return tuple(lines)


def _summit(levels: Levels, row: int, near: float) -> tuple[float, float]:
    """Return the highest bin within a line's width [Hz], and its level [dB]."""
    at, reach = round(near * levels.duration), round(WIDTH * near * levels.duration)
    first = max(at - reach, 0)
    near_by = levels.db[row, first : at + reach + 1]
    if near_by.size == 0:
        return near, float("-inf")
    best = int(np.argmax(near_by))
    return (first + best) / levels.duration, float(near_by[best])
