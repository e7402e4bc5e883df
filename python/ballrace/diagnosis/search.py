"""The search for lines of all parts: the surest first, then the others at the speed of the cage that it shows.

Balls of one bearing have one cage. A part whose lines stand out shows how fast it turns, and lines of others are
looked for at that speed only, in what is left without the lines of the first: those of an outer race that the
shaft modulates lie at those of the inner race, since BPFO + BPFI is the number of balls.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..frequencies.kinematic import Orders
from .combs import CAGE_FACTORS, PARTS, WIDTH, Comb, Part, cage_factor_of, comb_of
from .envelopes import Levels
from .kinematics import LEAST
from .null import ACCUSED, Found, found_of, null_orders, probability
from .strength import SHALLOW, Envelopes

_SURE = 0.03
"""How often chance may have lines as high as those that show how fast the cage turns."""

_BESIDE = 0.7
"""A part may be the first where its z is at least so much of the highest, as a part of it; the highest lines
decide."""

_ALIKE = 6.0
"""Difference of the lines of two races within which the one whose cage is nearer to rolling is the first [dB].

Sidebands of an inner race lie near the lines of an outer race whose cage lags: in a 6222 BPFI - 2 f_r is BPFO at
0.96 of the cage's speed. Chosen on simulated records: of 2226 three, of the sets of seeds 48 and 56 of
``benches/verdict_set.py``, show the right race by it where the highest lines show the wrong one, and one of the
library the wrong one.
"""

_ASIDE = 5.0
"""Level of the lines of a race that stands still over their sidebands at the shaft's turns below which they are
sidebands of the other race's lines [dB].

In 18 records of damaged outer races of the set of seed 44 of ``benches/verdict_set.py`` lines are 9.4 dB and more
above, in ten of damaged inner races, whose sidebands pass for an outer race's lines with a z above 10, up to 2 dB.
"""

_NEAR = 0.0025
"""How far from that speed of the cage the others are looked for, as a part of it."""

_SIDEBANDS = range(-3, 4)
"""Sidebands of a fault's lines, at the turns of each ring and of a ball's cage, that are its own."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Search:
    """A search for the comb of a part and what it found.

    Attributes
    ----------
    part : {"outer_race", "inner_race", "ball", "cage"}
        Part.
    comb : Comb
        Its comb.
    null : ndarray, shape (n,)
        Orders of the null.
    found : Found
        The comb beside its null.
    levels, null_levels : Levels
        Where it was looked for, and where the null's combs were.
    taken : ndarray, shape (m,)
        Lines of a surer part, which are not this one's [Hz].
    """

    part: Part
    comb: Comb
    null: NDArray[np.float64]
    found: Found
    levels: Levels
    null_levels: Levels
    taken: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Record:
    """Levels and squared envelopes of a record, orders of the bearing, and rate of the shaft [Hz]."""

    levels: Levels
    envelopes: Envelopes
    orders: Orders
    shaft: float

    def rate(self, comb: Comb, found: Found) -> float:
        """Return the rate at which a comb was found [Hz]."""
        return comb.order * float(comb.factors[found.at]) * self.shaft

    def cage(self, race: Search) -> float:
        """Return the speed of the cage that the lines of a race show, over the nominal one."""
        factor = float(race.comb.factors[race.found.at])
        return cage_factor_of(race.part, self.orders, factor)

    def lines(self, comb: Comb, found: Found) -> NDArray[np.float64]:
        """Return all lines of a fault up to the end of the spectra [Hz]."""
        rate = self.rate(comb, found)
        count = int(self.levels.hidden.size / self.levels.duration / rate) + 3
        turns = {*self.orders.turning, comb.sideband}
        beside = {m * each * self.shaft for each in turns for m in _SIDEBANDS}
        return np.array([k * rate + one for k in range(1, count) for one in beside])

    def is_aside(self, one: Search) -> bool:
        """Return whether lines of a race that stands still are sidebands of the other race's lines."""
        if one.part == "ball" or one.comb.sideband != 0.0:
            return False
        rate = self.rate(one.comb, one.found)
        turns = [m * order * self.shaft for order in self.orders.turning for m in (-1, 1)]
        harmonics = [k * rate for k in range(1, 5)]
        sidebands = [f + turn for f in harmonics for turn in turns]
        lines, beside = (
            self.levels.highest(np.array(f), WIDTH)[one.found.row].mean()
            for f in (harmonics, sidebands)
        )
        return bool(lines - beside < _ASIDE)

    def search(self, part: Part, comb: Comb, null: NDArray[np.float64]) -> Search:
        """Return what is found of a comb beside its null.

        Where a part modulates the vibration deeply, its own lines are no part of the null, which they fill
        otherwise.
        """
        rest = self.levels
        found = found_of(comb, self.levels, self.shaft, null, null_levels=rest)
        deep = self.envelopes.deepest(self.rate(comb, found)) >= SHALLOW
        if part in ACCUSED and found.z > 0.0 and deep:
            rest = self.levels.without_lines(self.lines(comb, found), WIDTH)
            found = found_of(comb, self.levels, self.shaft, null, null_levels=rest)
        return Search(
            part=part, comb=comb, null=null, found=found, levels=self.levels, null_levels=rest,
            taken=np.empty(0),
        )  # fmt: skip

    def without(self, first: Search, others: Iterable[Search]) -> dict[Part, Search]:
        """Return what is found of others without the lines of a surer part, at the speed of the cage it shows."""
        cage = None if first.part == "ball" else self.cage(first)
        taken = self.lines(first.comb, first.found)
        rest = self.levels.without_lines(taken, WIDTH)
        result: dict[Part, Search] = {}
        for each in others:
            comb, near = each.comb, None
            if cage is not None and each.part == "ball":
                comb = comb_of(each.part, self.orders, cage)
            elif cage is not None:
                near = np.abs(CAGE_FACTORS / cage - 1.0) <= _NEAR
            found = found_of(comb, rest, self.shaft, each.null, null_levels=rest, near=near)
            result[each.part] = replace(
                each, comb=comb, found=found, levels=rest, null_levels=rest, taken=taken
            )
        return result


def searched(
    levels: Levels, envelopes: Envelopes, orders: Orders, shaft: float, seed: int
) -> dict[Part, Search]:
    """Return what is found of the comb of each part.

    Parameters
    ----------
    levels : Levels
        Levels of the record.
    envelopes : Envelopes
        Its squared envelopes.
    orders : Orders
        Those of the bearing.
    shaft : float
        Rate of the shaft [Hz].
    seed : int
        Which combs the null has.
    """
    record = _Record(levels=levels, envelopes=envelopes, orders=orders, shaft=shaft)
    result: dict[Part, Search] = {}
    for part in PARTS:
        comb = comb_of(part, orders)
        if comb.order >= LEAST:
            null = null_orders(orders, part, np.random.default_rng([seed, len(part)]))
            result[part] = record.search(part, comb, null)
    first = _first(record, [result[part] for part in ACCUSED if part in result])
    if first is None:
        return result
    return result | record.without(first, (one for one in result.values() if one is not first))


def _first(record: _Record, searches: Iterable[Search]) -> Search | None:
    """Return the search that comes first of those whose lines stand out; None where none do.

    It has the highest lines, or of two races whose lines are nearly as high and show two speeds of the cage the
    one nearer to rolling.
    """
    sure = [one for one in searches if probability(one.found.z, len(ACCUSED)) < _SURE]
    if {"outer_race", "inner_race"} <= {one.part for one in sure}:
        sure = [one for one in sure if not record.is_aside(one)]
    least = _BESIDE * max((one.found.z for one in sure), default=0.0)
    ranked = [one for one in sure if one.found.z >= least]
    first = max(ranked, key=lambda one: one.found.height, default=None)
    if first is None or first.part == "ball":
        return first
    least = first.found.height - _ALIKE
    cages = {
        record.cage(one): one for one in ranked if one.part != "ball" and one.found.height >= least
    }
    if max(cages) - min(cages) <= _NEAR:
        return first
    return cages[min(cages, key=lambda cage: abs(cage - 1.0))]
