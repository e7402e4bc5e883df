"""From evidence to a verdict: what is damaged, that nothing is, or what would decide."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from .combs import WIDTH, Part, comb_of
from .null import ACCUSED, found_of, null_orders, probability

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from .envelopes import Levels
    from .evidence import Evidence
    from .kinematics import Kinematics
    from .strength import Limits

__all__ = ["DOUBT", "NAMES", "UNLIKELY", "Verdict", "Verdicts", "decided", "own_lines"]

Verdicts = Literal["healthy", "damaged", "undecided"]

NAMES: dict[Part, str] = {
    "outer_race": "outer race", "inner_race": "inner race", "ball": "ball", "cage": "cage",
}  # fmt: skip

DOUBT = 3.0
"""Up to so many times the false-alarm rate a part with strong lines is doubted, not cleared.

There the likelihood ratio decides, where the unit is known and no part has lines that stand out: at 1 % it
names 32 of 432 damaged parts more in the sets 47 and 48 (``benches/verdict_set.py``), and none of 432 healthy
bearings. Healthy records of the library with lines of that probability have ratios from 0.15 on, each bearing
judged by all others. Without a unit it would accuse 9 of 500 records of random impacts for 6.
"""

_BESIDE = 0.5
"""A part is named beside another whose z is at most so much higher, as a part of it.

Lines of an outer race that the shaft modulates lie at those of the inner race, since BPFO + BPFI is the number of
balls: a piece of 2 s of a damaged outer race of ``hit-sm`` has 0.43 for its inner race, two simulated faults 0.55.
"""

UNLIKELY: dict[Part, float] = {"outer_race": 0.05, "inner_race": 0.1, "ball": 0.1}
"""Likelihood ratios of sound to damaged below which lines that are not faint are damage, by the part's role.

Healthy bearings have lines of the outer race: of 432 healthy records of the library, each bearing judged by all
others, 3 are accused by it (0.7 %), all of one run of the smallest, a 6000, and 3 more by their strength
(``tests/python/test_diagnosis_size.py``); none else has significant lines with less than 0.1. No healthy one is
accused by the ratio of another part.
"""

_CLEARED = 0.2
"""Likelihood ratio below which a part is not cleared.

8 of 432 records of healthy bearings of the library have less in some part, judged by all other bearings; a ball
with a faint spall, whose lines chance has in 1.5 to 8 % of records, had 0.01 to 0.08 and was cleared.
"""

_MODULATED = range(-2, 3)


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """The verdict: ``healthy``, ``damaged`` with the parts, or ``undecided``; and why, in one sentence."""

    verdict: Verdicts
    parts: tuple[Part, ...]
    why: str


def decided(
    evidence: Mapping[Part, Evidence],
    own: Sequence[Part],
    false_alarm: float,
    *,
    strong: Sequence[Part],
    limits: Limits | None,
    silent: bool,
    impacts: str | None,
    wanting: Sequence[str],
) -> Verdict:
    """Return the verdict.

    Parameters
    ----------
    evidence : mapping of str to Evidence
        Of each part.
    own : sequence of str
        Parts whose lines stand out and are their own, the highest first.
    false_alarm : float
        Share of healthy records that may be called damaged.
    strong : sequence of str
        Those of them whose lines are stronger than in any healthy bearing of the library.
    limits : Limits or None
        Accelerations by which lines are judged; None where their strength is not known.
    silent : bool
        Whether the record has no background, as simulated ones have none.
    impacts : str or None
        What would explain impacts that stand out; None where none do.
    wanting : sequence of str
        What the record lacks for a statement that nothing is damaged.
    """
    ranked = sorted((evidence[part] for part in ACCUSED), key=lambda one: -one.z)
    faint = limits.faint if limits else 0.0
    own_ones = [evidence[part] for part in own]

    def is_loud(one: Evidence) -> bool:
        return one.strength.acceleration >= faint or _of_damaged_ball(one)

    loud = list(filter(is_loud, own_ones))
    open_ = {one.part: _not_sure(one, limits, silent) for one in loud}
    if limits is not None and all(_looks_sound(one) and one.part not in strong for one in loud):
        open_ = {one.part: open_[one.part] or _like_sound(one) for one in loud}
    named = [one for one in loud if open_[one.part] is None]
    if named:
        parts = tuple(one.part for one in named)
        return Verdict(verdict="damaged", parts=parts, why=_lines_of(named[0]))
    doubted = [
        one
        for one in ranked
        if one.probability < DOUBT * false_alarm and not one.strength.is_shallow and is_loud(one)
    ]
    likelier = [] if own or limits is None else [one for one in doubted if not _looks_sound(one)]
    for one in likelier:
        if _not_sure(one, limits, silent) is None:
            return Verdict(verdict="damaged", parts=(one.part,), why=_supported(one))
    unexplained = [] if own or impacts is None else [impacts]
    likely = [one for one in ranked if one.part not in own and _is_likely(one)]
    needs = [
        *filter(None, open_.values()),
        *(_doubt(one, own, false_alarm) for one in doubted),
        *map(_hidden, filter(_is_hidden, ranked)), *unexplained, *wanting, *map(_likely, likely),
    ]  # fmt: skip
    if needs:
        return Verdict(verdict="undecided", parts=(), why=needs[0])
    if own_ones and limits is not None:
        return Verdict(verdict="healthy", parts=(), why=_faint(own_ones[0], faint))
    nearest = f"{NAMES[ranked[0].part]}, come by chance in {_percent(ranked[0])} of records"
    why = f"no lines of a fault; the nearest, {nearest}"
    return Verdict(verdict="healthy", parts=(), why=why)


def _not_sure(one: Evidence, limits: Limits | None, silent: bool) -> str | None:
    """Return what would decide whether lines that stand out are damage; None where they are."""
    if one.strength.is_shallow:
        return _shallow(one)
    if limits is None:
        return _of_no_size(one) if silent or one.strength.is_smooth else None
    if one.strength.acceleration < limits.slow and not _of_damaged_ball(one):
        return _between(one, limits.slow)
    return None


def _looks_sound(one: Evidence) -> bool:
    """Whether simulated bearings with the part sound have such lines as well."""
    return one.ratio is None or one.ratio >= UNLIKELY[one.role]


def _of_damaged_ball(one: Evidence) -> bool:
    """Whether there are impacts of a ball, however weak: neither load zone nor waves of races have its rate."""
    likely = one.ratio is not None and one.ratio < UNLIKELY[one.role]
    return one.part == "ball" and likely and not one.strength.is_smooth


def own_lines(
    evidence: Mapping[Part, Evidence],
    levels: Levels,
    kinematics: Kinematics,
    shaft: float,
    *,
    false_alarm: float,
    seed: int,
) -> list[Part]:
    """Return the parts whose lines stand out and are not those of the part with the highest ones, which is first.

    The first part's lines with two sidebands of each ring that turns are taken away, and what is left has to stand
    out still.
    """  # fmt: skip
    sure = [one for one in map(evidence.__getitem__, ACCUSED) if one.probability < false_alarm]
    least = _BESIDE * max((one.z for one in sure), default=0.0)
    ranked = sorted((one for one in sure if one.z >= least), key=lambda one: -one.height)
    if len(ranked) < 2:
        return [one.part for one in ranked]
    first = ranked[0]
    rate = first.order * first.factor * shaft
    count = int(levels.hidden.size / levels.duration / rate) + 3
    turns = {m * each * shaft for each in kinematics.orders.turning for m in _MODULATED}
    lines = [k * rate + beside for k in range(1, count) for beside in turns]
    rest = levels.without_lines(np.array(lines), WIDTH)
    own = [first.part]
    for other in ranked[1:]:
        null = null_orders(kinematics.orders, other.part, np.random.default_rng([seed, 1]))
        found = found_of(comb_of(other.part, kinematics.orders), rest, shaft, null)
        if probability(found.z, len(ACCUSED)) < false_alarm:
            own.append(other.part)
    return own


def _lines_of(one: Evidence) -> str:
    lines = ", ".join(line.label for line in one.lines[:4]) or "lines"
    return f"{NAMES[one.part]}: {lines} stand out, as by chance in {_percent(one)} of records"


def _supported(one: Evidence) -> str:
    return f"{_lines_of(one)}, and among simulated bearings are {_odds(one):.0f} times likelier with it damaged"


def _shallow(one: Evidence) -> str:
    depth, kurtosis = 100.0 * one.strength.depth, one.strength.kurtosis
    return (
        f"a record from when it was new, or another place to measure: lines of the {NAMES[one.part]} are "
        f"there, but modulate the vibration by {depth:.0f} % only and no impacts stand out "
        f"(kurtosis {kurtosis:.1f}), as from waves of a race"
    )


def _between(one: Evidence, slow: float) -> str:
    return (
        f"a record from when it was new: lines of the {NAMES[one.part]} carry "
        f"{one.strength.acceleration:.2g} m/s², which a slow healthy bearing "
        f"may have, too: up to {slow:.2g}"
    )


def _like_sound(one: Evidence) -> str:
    return (
        f"a record from when it was new: lines of the {NAMES[one.part]} carry "
        f"{one.strength.acceleration:.2g} m/s², which sound bearings may have, too: among simulated ones they are "
        f"{_odds(one):.2g} times likelier with it damaged, where {1.0 / UNLIKELY[one.role]:.0f} times are required"
    )


def _of_no_size(one: Evidence) -> str:
    return (
        f"the record's unit and a bearing with dimensions, to judge the strength of lines: those of the "
        f"{NAMES[one.part]} stand out, but without impacts, or in a record without noise, those of a loaded "
        "healthy bearing do, too"
    )


def _faint(one: Evidence, faint: float) -> str:
    return (
        f"lines of the {NAMES[one.part]} are there, but carry {one.strength.acceleration:.2g} m/s² where damage "
        f"has more than {faint:.2g}, if the record's unit is right: a loaded healthy bearing has such lines, too"
    )


def _percent(one: Evidence) -> str:
    share = 100.0 * one.probability
    if share < 1e-3:
        return "less than 0.001 %"
    return f"{share:.{max(0, 1 - math.floor(math.log10(share)))}f} %"


def _doubt(one: Evidence, own: Sequence[Part], false_alarm: float) -> str:
    if own and one.probability < false_alarm:
        return (
            f"a record from when it was new: lines of the {NAMES[one.part]} stand out, as by chance in "
            f"{_percent(one)} of records, but may be those of the {NAMES[own[0]]}, which are higher"
        )
    return (
        f"another or a longer record: lines of the {NAMES[one.part]} come by chance in {_percent(one)}, "
        "too often to call it damaged and too seldom to call it healthy"
    )


def _is_likely(one: Evidence) -> bool:
    return one.ratio is not None and one.ratio < _CLEARED


def _likely(one: Evidence) -> str:
    name, odds = NAMES[one.part], _odds(one)
    return (
        f"another or a longer record: lines of the {name} come by chance in {_percent(one)}, but among "
        f"simulated bearings what this one shows is {odds:.0f} times likelier with the {name} damaged"
    )


def _odds(one: Evidence) -> float:
    """Return how many times likelier what was found is with the part damaged than with it sound."""
    return math.inf if not one.ratio else 1.0 / one.ratio


def _is_hidden(one: Evidence) -> bool:
    return one.hidden > 0.5


def _hidden(one: Evidence) -> str:
    return f"a longer record: most lines of the {NAMES[one.part]} lie on the shaft's or on what was excluded"
